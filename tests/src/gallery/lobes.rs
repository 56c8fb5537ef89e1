//! Scenes of materials with every lobe.

use glam::{Vec3, vec3};
use glimpse::{
    Camera, Scene,
    scene::{EnvironmentMap, Material},
};

use crate::builder::{Builder, glass, matte, mirror};

/// Materials of the balls of [`lobes`], by row.
fn balls() -> Vec<Vec<Material>> {
    let metal = |roughness| Material { roughness, ..mirror(vec3(0.9, 0.6, 0.3)) };
    let plastic = |roughness| Material { roughness, ior: 1.5, ..matte(vec3(0.2, 0.4, 0.8)) };
    let frosted = |roughness| Material { roughness, ..glass(1.4) };
    let lacquer = |clearcoat_roughness| Material { clearcoat: 0.9, clearcoat_roughness, ..metal(0.5) };
    vec![
        vec![metal(0.08), metal(0.3), metal(0.6), metal(1.0), Material { metallic: 0.5, ..metal(0.4) }],
        vec![plastic(0.1), plastic(0.5), frosted(0.3), lacquer(0.0), lacquer(0.3)],
    ]
}

/// Balls of metal, plastic, glass and lacquer at several roughnesses, with a frosted pane, a lamp and punctual lights, in
/// a studio.
///
/// # Panics
/// Never.
#[must_use]
pub fn lobes() -> Scene {
    let mut b = Builder::new();
    for (row, materials) in balls().into_iter().enumerate() {
        for (column, material) in materials.into_iter().enumerate() {
            let ball = b.object(material);
            b.sphere(ball, vec3(-1.2 + 0.6 * column as f32, 0.3 + 0.6 * row as f32, 0.0), 0.27);
        }
    }
    let pane = b.object(Material { thin: true, roughness: 0.4, ..glass(1.5) });
    b.quad(pane, vec3(-0.9, 0.05, 0.5), vec3(0.7, 0.0, 0.1), 0.8 * Vec3::Y);
    let floor = b.object(Material { roughness: 0.6, ior: 1.5, ..matte(Vec3::splat(0.5)) });
    b.quad(floor, vec3(-2.0, 0.0, 2.0), 4.0 * Vec3::X, -4.0 * Vec3::Z);
    let lamp = b.object(Material { emission: vec3(9.0, 7.0, 5.0), ..matte(Vec3::ZERO) });
    b.quad(lamp, vec3(-0.4, 2.6, 0.6), 0.8 * Vec3::X, 0.6 * Vec3::Z);
    b.point_light(vec3(1.5, 2.0, 2.0), vec3(3.0, 4.0, 5.0));
    let camera = Camera::look_at(vec3(0.4, 1.1, 4.0), vec3(0.0, 0.7, 0.0), 0.7).expect("a valid camera");
    let mut scene = b.seen_by(camera);
    scene.surround(EnvironmentMap::studio().rotated(0.4));
    scene
}
