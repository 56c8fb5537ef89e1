//! Rays a second of the traversal alone, by kind of ray, from the pixels of one 1024x1024 frame, and what each measure
//! against rounding costs (medians of interleaved runs with all of them and without each):
//! `cargo run --release -p glimpse-tests --example traversal_rates -- SCENE.glb`
//!
//! On a software driver wall time swings with the machine's other work, so rays are counted against the CPU time of
//! this process too (Linux alone), times the number of cores.

use std::error::Error;

use glam::Vec3;
use glimpse::stress::Random;
use glimpse::{
    Camera, Gpu, GpuScene, Method, PixelRecord, Renderer, Robustness, Scene, Settings,
    probe::{Probe, ProbeRay},
    scene::LightKind,
};

const SIDE: u32 = 1024;
const RUNS: usize = 5;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("expected a .glb file")?;
    let scene = Scene::from_gltf(&std::fs::read(&path)?, &mut |uri| Err(format!("refers to {uri}")))?;
    let camera = *scene.camera(None)?;
    let light = scene.lights.iter().find_map(|light| match light.kind {
        LightKind::Point { position, .. } | LightKind::Spot { position, .. } => Some(position),
        LightKind::Directional { .. } => None,
    });
    let gpu = Gpu::headless(None)?;
    println!("{}: {} triangles, {}", path, scene.positions.len(), gpu.facts().info.name);
    let scene = GpuScene::upload(&gpu, scene)?;

    let settings = Settings { method: Method::Full, depth: 1, ..Settings::default() };
    let pixels = Renderer::new(&gpu, &scene, [SIDE, SIDE], &settings)?.inspect(&camera)?.pixels;
    let hits: Vec<_> =
        pixels.iter().enumerate().filter_map(|(i, pixel)| hit(&camera, i as u32, pixel)).collect();

    let mut random = Random(1);
    let primary: Vec<_> =
        (0..SIDE * SIDE).map(|i| ray(camera.origin, direction(&camera, i), false)).collect();
    report(&gpu, &scene, "primary", &primary)?;
    if let Some(light) = light {
        let towards = |h: &HitPoint| ProbeRay { t_max: 0.999, ..ray(h.point, light - h.point, true) };
        report(&gpu, &scene, "shadow", &hits.iter().map(towards).collect::<Vec<_>>())?;
    }
    let reflection: Vec<_> =
        hits.iter().map(|h| ray(h.point, h.direction.reflect(h.normal), false)).collect();
    report(&gpu, &scene, "reflection", &reflection)?;
    let diffuse: Vec<_> = hits
        .iter()
        .map(|h| ray(h.point, (h.normal + random.direction().as_vec3()).normalize_or(h.normal), false))
        .collect();
    report(&gpu, &scene, "diffuse", &diffuse)
}

struct HitPoint {
    point: Vec3,
    direction: Vec3,
    normal: Vec3,
}

/// Pixels in tiles of 8x8: neighbouring threads see neighbouring pixels.
fn direction(camera: &Camera, index: u32) -> Vec3 {
    let (tile, local) = (index / 64, index % 64);
    let (x, y) = (tile % (SIDE / 8) * 8 + local % 8, tile / (SIDE / 8) * 8 + local / 8);
    through(camera, x, y)
}

fn through(camera: &Camera, x: u32, y: u32) -> Vec3 {
    let at = |v: u32| (2 * v + 1) as f32 / SIDE as f32 - 1.0;
    camera.forward + at(x) * camera.right - at(y) * camera.up
}

fn hit(camera: &Camera, index: u32, pixel: &PixelRecord) -> Option<HitPoint> {
    pixel.object?;
    let direction = through(camera, index % SIDE, index / SIDE);
    let normal = Vec3::from(pixel.normal);
    let point = camera.origin + pixel.depth * direction + 1e-4 * pixel.depth * normal;
    Some(HitPoint { point, direction: direction.normalize_or_zero(), normal })
}

fn ray(origin: Vec3, direction: Vec3, any: bool) -> ProbeRay {
    ProbeRay {
        origin: origin.into(),
        t_max: 3e38,
        direction: direction.into(),
        any: any.into(),
        ..ProbeRay::default()
    }
}

/// All measures against rounding, and each left out. The offset of spawned rays does not affect the traversal.
const MEASURES: [(&str, Robustness); 3] = [
    ("with all measures", Robustness { watertight: true, boxes: true, offset: true }),
    ("without watertight", Robustness { watertight: false, boxes: true, offset: true }),
    ("without boxes", Robustness { watertight: true, boxes: false, offset: true }),
];

fn report(gpu: &Gpu, scene: &GpuScene, kind: &str, rays: &[ProbeRay]) -> Result<(), Box<dyn Error>> {
    let probes = MEASURES.map(|(_, robustness)| Probe::new(gpu, scene, robustness));
    let cores = std::thread::available_parallelism()?.get() as f64;
    let mut runs = MEASURES.map(|_| Vec::new());
    for run in 0..=RUNS {
        for (probe, runs) in probes.iter().zip(&mut runs) {
            let start = cpu_seconds();
            probe.trace(&rays[..64])?;
            let begun = cpu_seconds();
            let (_, ms) = probe.trace(rays)?;
            // The first run compiles. The CPU time of a call with 64 rays is subtracted as overhead.
            if run > 0 {
                runs.push((ms * 1e-3, cpu_seconds() - begun - (begun - start)));
            }
        }
    }
    let median = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let rate = |seconds: f64| rays.len() as f64 / seconds * 1e-6;
    let mut with_all = f64::NAN;
    for ((name, _), runs) in MEASURES.iter().zip(&runs) {
        let wall = median(runs.iter().map(|r| r.0).collect());
        let cpu = median(runs.iter().map(|r| r.1).collect());
        with_all = if with_all.is_nan() { cpu } else { with_all };
        println!(
            "{kind:<11}{name:<19}{:>8.2} Mrays/s, {:>8.2} Mrays per CPU second x {cores}, {:+6.1} % time",
            rate(wall),
            cores * rate(cpu),
            100.0 * (cpu / with_all - 1.0)
        );
    }
    Ok(())
}

/// User and system time of this process in seconds; NaN without /proc.
fn cpu_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |i: usize| fields.get(i).and_then(|f| f.parse::<f64>().ok()).unwrap_or(f64::NAN);
    (ticks(11) + ticks(12)) / 100.0
}
