//! The Cornell box (Goral et al. 1984), 2 m wide, with a mirror sphere and a glass sphere.

use glam::{Affine3A, Vec2, Vec3, vec3};

use super::shapes::{Builder, turned};
use crate::scene::camera::Camera;
use crate::scene::{Environment, Light, LightKind, Material, Scene};

pub(super) fn scene() -> Option<Scene> {
    let mut b = Builder::default();
    let matt = |color: Vec3| Material { base_color: color, ..Material::default() };
    let white = b.material("white", matt(Vec3::splat(0.73)));
    let red = b.material("red", matt(vec3(0.63, 0.06, 0.05)));
    let green = b.material("green", matt(vec3(0.14, 0.45, 0.09)));
    let panel = b.material("panel", Material { emission: vec3(1.0, 0.9, 0.75) * 4.0, ..matt(Vec3::ZERO) });
    let mirror =
        b.material("mirror", Material { metallic: 1.0, roughness: 0.0, ..matt(vec3(0.95, 0.95, 0.93)) });
    let glass = b.material(
        "glass",
        Material { transmission: 1.0, roughness: 0.0, casts_shadow: false, ..matt(Vec3::ONE) },
    );

    let (x, y, z) = (Vec3::X * 2.0, Vec3::Y * 2.0, Vec3::Z * 2.0);
    let low = vec3(-1.0, 0.0, -1.0);
    b.object("floor", white);
    b.quad(low + z, x, -z, Vec2::ONE);
    b.object("ceiling", white);
    b.quad(low + y, x, z, Vec2::ONE);
    b.object("back wall", white);
    b.quad(low, x, y, Vec2::ONE);
    b.object("left wall", red);
    b.quad(low + z, -z, y, Vec2::ONE);
    b.object("right wall", green);
    b.quad(low + x, z, y, Vec2::ONE);
    b.object("light panel", panel);
    b.cuboid(vec3(-0.3, 1.96, -0.25), vec3(0.3, 2.0, 0.25), 1.0);

    b.place = Affine3A::from_translation(vec3(0.36, 0.0, -0.38)) * turned(Vec3::Y, -0.3);
    b.object("tall box", white);
    b.cuboid(vec3(-0.3, 0.0, -0.3), vec3(0.3, 1.15, 0.3), 1.0);
    b.place = Affine3A::IDENTITY;
    b.sphere("mirror sphere", mirror, vec3(-0.46, 0.4, -0.2), 0.4);
    b.sphere("glass sphere", glass, vec3(0.32, 0.28, 0.5), 0.28);

    for at in [-0.15, 0.15] {
        b.scene.lights.push(Light {
            kind: LightKind::Point { position: vec3(at, 1.93, 0.0), range: f32::INFINITY, falloff: true },
            intensity: vec3(1.0, 0.88, 0.7) * 2.8,
            radius: 0.0,
        });
    }
    b.scene.environment = Environment::with_background(Vec3::ZERO);
    let camera = Camera::look_at(vec3(0.0, 1.0, 3.75), vec3(0.0, 1.0, 0.0), 39.8_f32.to_radians()).ok()?;
    b.scene.cameras.push(("main".to_owned(), camera));
    Some(b.finish())
}
