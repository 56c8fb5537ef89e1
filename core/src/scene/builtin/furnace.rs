//! The furnace test: radiance 1 from all directions and surfaces that absorb nothing, so that every pixel is 1.

use glam::{Vec2, Vec3, vec3};

use super::shapes::Builder;
use crate::scene::camera::Camera;
use crate::scene::{Environment, Material, Scene, Weights};

pub(super) fn scene() -> Option<Scene> {
    let mut b = Builder::default();
    let plain = Material { roughness: 0.0, ..Material::default() };
    let weights = |diffuse, mirror| Some(Weights { diffuse, mirror, refraction: 0.0 });
    let white = b.material("white", Material { weights: weights(1.0, 0.0), ..plain.clone() });
    let mirror = b.material("mirror", Material { weights: weights(0.0, 1.0), ..plain.clone() });
    let metal = b.material("metal", Material { metallic: 1.0, ..plain.clone() });
    // At roughness 0.25 half of the reflection is traced and half is ambient light.
    let satin = b.material("satin metal", Material { metallic: 1.0, roughness: 0.25, ..plain.clone() });
    let clear = Material { transmission: 1.0, casts_shadow: false, ..plain.clone() };
    let glass = b.material("glass", clear.clone());
    let pane = b.material("pane", Material { thin: true, ..clear });
    let unlit = b.material("unlit", Material { unlit: true, ..plain.clone() });
    let glow = b.material(
        "glow",
        Material { base_color: Vec3::ZERO, emission: Vec3::ONE, weights: weights(0.0, 0.0), ..plain },
    );

    b.sphere("white ball", white, vec3(-1.8, 0.6, 0.0), 0.5);
    b.sphere("mirror ball", mirror, vec3(-0.6, 0.6, 0.0), 0.5);
    b.sphere("glass ball", glass, vec3(0.6, 0.6, 0.0), 0.5);
    b.sphere("metal ball", metal, vec3(1.8, 0.6, 0.0), 0.5);
    b.object("white box", white);
    b.cuboid(vec3(-2.2, -1.0, -0.4), vec3(-1.4, -0.2, 0.4), 1.0);
    b.object("satin ring", satin);
    b.torus(vec3(-0.6, -0.6, 0.0), Vec3::Z, [0.35, 0.12], [24, 12]);
    b.object("glass box", glass);
    b.cuboid(vec3(0.25, -1.0, -0.3), vec3(0.95, -0.3, 0.3), 1.0);
    b.object("pane", pane);
    b.quad(vec3(-1.2, -1.2, 0.8), Vec3::X, Vec3::Y * 2.4, Vec2::ONE);
    b.object("unlit quad", unlit);
    b.quad(vec3(1.4, -1.0, 0.0), Vec3::X * 0.4, Vec3::Y * 0.8, Vec2::ONE);
    b.object("glowing quad", glow);
    b.quad(vec3(1.9, -1.0, 0.0), Vec3::X * 0.4, Vec3::Y * 0.8, Vec2::ONE);
    b.object("floor", mirror);
    b.quad(vec3(-3.0, -1.3, 3.0), Vec3::X * 6.0, Vec3::NEG_Z * 6.0, Vec2::ONE);

    b.scene.environment =
        Environment { background: Vec3::ONE, ambient: Vec3::ONE, fallback_radiance: Vec3::ONE };
    let camera = Camera::look_at(vec3(0.4, 0.6, 5.5), vec3(0.0, -0.1, 0.0), 42.0_f32.to_radians()).ok()?;
    b.scene.cameras.push(("main".to_owned(), camera));
    Some(b.finish())
}
