//! Draws the models of a conformance pack beside their reference pictures, a row for each model:
//! `cargo run --release -p glimpse-tests --example conformance_sheets -- PACK OUT [METHOD] [NAME...]`
//!
//! PACK has the folders `models` and `references` and the file `scenarios.json`, which places the cameras. OUT gets
//! `sheet-1.png`, ...; the rows are printed, with what the importer says of each file. A file that is refused has an
//! empty row.

use std::{
    error::Error,
    fs,
    path::{Path, PathBuf},
};

use glam::Vec3;
use glimpse::{Camera, Gpu, GpuScene, Method, Renderer, Settings};
use glimpse_measure::scene_file;
use image::{DynamicImage, RgbaImage, imageops};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Width and height of a picture on a sheet in pixels.
const SIDE: u32 = 192;
const ROWS: usize = 8;
/// Ours and up to three references.
const COLUMNS: u32 = 4;

fn main() -> Result<()> {
    let mut arguments = std::env::args().skip(1);
    let pack = PathBuf::from(arguments.next().ok_or("expected a folder with models")?);
    let out = PathBuf::from(arguments.next().ok_or("expected a folder for the sheets")?);
    let method = arguments.next().unwrap_or_else(|| "full".to_owned());
    let method = Method::named(&method).ok_or("expected a method")?;
    let wanted: Vec<String> = arguments.collect();
    fs::create_dir_all(&out)?;
    let scenarios: serde_json::Value = serde_json::from_slice(&fs::read(pack.join("scenarios.json"))?)?;
    let mut files = Vec::new();
    collect(&pack.join("models"), &mut files)?;
    files.sort();
    files.retain(|file| {
        let name = file.to_string_lossy();
        wanted.is_empty() || wanted.iter().any(|wanted| name.contains(wanted.as_str()))
    });
    let gpu = Gpu::headless(None)?;
    for (sheet, files) in files.chunks(ROWS).enumerate() {
        let mut picture = RgbaImage::new(COLUMNS * SIDE, SIDE * files.len() as u32);
        for (row, file) in files.iter().enumerate() {
            let stem = file.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
            println!("sheet {} row {}: {stem}", sheet + 1, row + 1);
            let top = row as i64 * i64::from(SIDE);
            match draw(&gpu, file, &scenarios, method) {
                Ok(drawn) => imageops::overlay(&mut picture, &drawn, 0, top),
                Err(error) => println!("    refused: {error}"),
            }
            for (column, reference) in references(&pack, &stem)?.iter().take(COLUMNS as usize - 1).enumerate()
            {
                let reference = image::open(reference)?.resize(SIDE, SIDE, imageops::FilterType::Triangle);
                imageops::overlay(
                    &mut picture,
                    &on_grey(reference),
                    i64::from(SIDE) * (1 + column as i64),
                    top,
                );
            }
        }
        DynamicImage::from(picture).into_rgb8().save(out.join(format!("sheet-{}.png", sheet + 1)))?;
    }
    Ok(())
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        match path.extension().and_then(|ending| ending.to_str()) {
            _ if path.is_dir() => collect(&path, files)?,
            Some("glb" | "gltf") => files.push(path),
            _ => {}
        }
    }
    Ok(())
}

fn draw(gpu: &Gpu, file: &Path, scenarios: &serde_json::Value, method: Method) -> Result<RgbaImage> {
    let scene = scene_file::load(file)?;
    scene.warnings.iter().for_each(|warning| println!("    {warning}"));
    scene.not_shown.iter().for_each(|not_shown| println!("    not shown: {not_shown}"));
    let scenario = scenario(scenarios, file);
    let camera = scenario.and_then(camera).map_or_else(|| scene.camera(None).copied(), Ok)?;
    let size = scenario.and_then(size).unwrap_or([SIDE, SIDE]);
    let scene = GpuScene::upload(gpu, scene)?;
    let mut renderer = Renderer::new(gpu, &scene, size, &Settings::for_method(method))?;
    let frames = if method.is_path_traced() { 64 } else { 1 };
    for _ in 0..frames {
        renderer.render(&camera)?;
    }
    Ok(renderer.display_image()?)
}

/// The scenario of a model, which is named by its path below the folder of models.
fn scenario<'a>(scenarios: &'a serde_json::Value, file: &Path) -> Option<&'a serde_json::Value> {
    let of_file = |scenario: &&serde_json::Value| {
        scenario["model"].as_str().is_some_and(|model| file.ends_with(Path::new("models").join(model)))
    };
    scenarios["scenarios"].as_array()?.iter().find(of_file)
}

fn camera(scenario: &serde_json::Value) -> Option<Camera> {
    let number = |value: &serde_json::Value| value.as_f64().map(|number| number as f32);
    let of = |name: &str| number(&scenario["orbit"][name]);
    let (theta, phi) = (of("theta")?.to_radians(), of("phi")?.to_radians());
    let target: Vec<f32> = scenario["target"].as_array()?.iter().filter_map(number).collect();
    let target = Vec3::from_slice(target.get(..3)?);
    let away = Vec3::new(phi.sin() * theta.sin(), phi.cos(), phi.sin() * theta.cos());
    let lens = number(&scenario["vertical_fov"])?.to_radians();
    Camera::look_at(target + of("radius")? * away, target, lens).ok()
}

/// The size of a scenario's picture, scaled to fit on the sheet.
fn size(scenario: &serde_json::Value) -> Option<[u32; 2]> {
    let [width, height] = [scenario["size"][0].as_f64()?, scenario["size"][1].as_f64()?];
    let scale = f64::from(SIDE) / width.max(height);
    Some([width, height].map(|pixels| (scale * pixels).round().max(1.0) as u32))
}

fn references(pack: &Path, stem: &str) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(pack.join("references"))? {
        let path = entry?.path();
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if name.strip_prefix(stem).is_some_and(|rest| rest.starts_with('.')) {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

/// A picture whose transparent parts show grey.
fn on_grey(picture: DynamicImage) -> RgbaImage {
    let picture = picture.into_rgba8();
    let mut grey =
        RgbaImage::from_pixel(picture.width(), picture.height(), image::Rgba([150, 150, 150, 255]));
    imageops::overlay(&mut grey, &picture, 0, 0);
    grey
}
