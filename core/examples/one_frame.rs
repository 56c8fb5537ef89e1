//! Renders one frame of a scene: `one_frame SCENE OUT.png`. SCENE is a `.glb` or `.gltf` file or `builtin:NAME`.

use std::{env, error::Error, fs, path::Path};

use glimpse::{Gpu, GpuScene, Renderer, Scene, Settings, scene::builtin, to_png};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<_> = env::args().skip(1).collect();
    let [name, out] = arguments.as_slice() else { return Err("usage: one_frame SCENE OUT.png".into()) };
    let mut beside = |uri: &str| fs::read(Path::new(name).with_file_name(uri)).map_err(|e| e.to_string());
    let scene = match name.strip_prefix("builtin:") {
        Some(name) => builtin(name).ok_or("no such built-in scene")?,
        None => Scene::from_gltf(&fs::read(name)?, &mut beside)?,
    };
    let camera = *scene.camera(None)?;
    let gpu = Gpu::headless(None)?;
    let scene = GpuScene::upload(&gpu, scene)?;
    let mut renderer = Renderer::new(&gpu, &scene, [640, 360], &Settings::default())?;
    renderer.render(&camera)?;
    fs::write(out, to_png(&renderer.display_image()?)?)?;
    Ok(())
}
