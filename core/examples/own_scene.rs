//! Renders a scene that is built in code: `own_scene OUT.png`. A mirroring and a glass sphere on a floor.

use std::{env, error::Error, fs};

use glimpse::{
    Camera, Gpu, GpuScene, Renderer, Scene, Settings,
    glam::{Vec3, vec3},
    scene::{Environment, Light, LightKind, Material},
    to_png,
};

fn main() -> Result<(), Box<dyn Error>> {
    let out = env::args().nth(1).ok_or("usage: own_scene OUT.png")?;
    let mut scene = Scene::default();
    let stone = scene.add_material(Material { base_color: vec3(0.6, 0.55, 0.5), ..Material::default() });
    let metal =
        Material { metallic: 1.0, roughness: 0.0, base_color: Vec3::splat(0.95), ..Material::default() };
    let metal = scene.add_material(metal);
    let glass = Material { transmission: 1.0, roughness: 0.0, casts_shadow: false, ..Material::default() };
    let glass = scene.add_material(glass);

    // Metres, y up; the floor faces up, as its corners run counter-clockwise from above.
    let [a, b, c, d] = [[-4.0, 4.0], [4.0, 4.0], [4.0, -4.0], [-4.0, -4.0]].map(|[x, z]| vec3(x, 0.0, z));
    scene.add_triangles("floor", stone, &[[a, b, c], [a, c, d]]);
    scene.add_sphere("mirror", metal, vec3(-0.7, 0.8, 0.0), 0.8);
    scene.add_sphere("glass", glass, vec3(0.9, 0.5, 0.8), 0.5);
    scene.lights.push(Light {
        kind: LightKind::Point { position: vec3(2.0, 4.0, 3.0), range: f32::INFINITY, falloff: true },
        // Watts per steradian.
        intensity: Vec3::splat(40.0),
        radius: 0.0,
    });
    scene.environment = Environment::with_background(vec3(0.35, 0.5, 0.7));

    let camera = Camera::look_at(vec3(0.0, 1.6, 4.5), vec3(0.0, 0.6, 0.0), 45.0_f32.to_radians())?;
    let gpu = Gpu::headless(None)?;
    let scene = GpuScene::upload(&gpu, scene)?;
    let mut renderer = Renderer::new(&gpu, &scene, [640, 360], &Settings::default())?;
    renderer.render(&camera)?;
    fs::write(out, to_png(&renderer.display_image()?)?)?;
    Ok(())
}
