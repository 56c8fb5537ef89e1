//! Measures what separate lists could save for samples that fail only the shadow check or only the check of mirrored
//! colours, for which shadow rays or secondary rays would suffice (Kim 2016, section 5, traces all rays):
//! `cargo run --release -p glimpse-tests --example split_failures -- SCENE.glb...`
//!
//! Prints, for one adaptive frame of 1024x1024, the shares of the traced samples and of the traversal's work that
//! belong to such samples. The work is an upper bound on the savings, as it includes the rays that are still needed.

use std::error::Error;

use glimpse::{Check, Gpu, GpuScene, Origin, PixelRecord, Renderer, Scene, Settings};

const SIZE: [u32; 2] = [1024, 1024];

fn main() -> Result<(), Box<dyn Error>> {
    let gpu = Gpu::headless(None)?;
    println!("{:<32}{:>22}{:>22}{:>22}", "samples %, work %", "shadow alone", "gcol alone", "both alone");
    for path in std::env::args().skip(1) {
        let scene = Scene::from_gltf(&std::fs::read(&path)?, &mut |uri| Err(format!("refers to {uri}")))?;
        let camera = *scene.camera(None)?;
        let scene = GpuScene::upload(&gpu, scene)?;
        let pixels = Renderer::new(&gpu, &scene, SIZE, &Settings::default())?.inspect(&camera)?.pixels;
        let traced: Vec<_> = pixels.iter().filter(|pixel| pixel.origin != Origin::Interpolated).collect();
        let columns: Vec<_> =
            [Check::Shadow.bit(), Check::Gcol.bit(), Check::Shadow.bit() | Check::Gcol.bit()]
                .map(|failed| shares(&traced, failed))
                .iter()
                .map(|[samples, work]| format!("{:>22}", format!("{samples:.1}, {work:.1}")))
                .collect();
        println!("{:<32}{}", path.rsplit('/').next().unwrap_or(&path), columns.concat());
    }
    Ok(())
}

/// Percentage of the traced samples that fail exactly these checks, and of the traversal's work in them.
fn shares(traced: &[&PixelRecord], failed: u32) -> [f64; 2] {
    let work = |pixels: &mut dyn Iterator<Item = &&PixelRecord>| -> f64 {
        pixels.map(|pixel| f64::from(pixel.cost)).sum()
    };
    let alone = || traced.iter().filter(|pixel| pixel.failed == failed);
    let samples = alone().count() as f64 / traced.len() as f64;
    [100.0 * samples, 100.0 * work(&mut alone()) / work(&mut traced.iter())]
}
