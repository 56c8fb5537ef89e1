//! The five spheres of Heckbert's "minray" (the shortest ray tracer of the 1987 contest, recursion level 3), in
//! that program's axes: x right, y forward, z up.
//!
//! minray shades with radiance = colour x kd x light x cos; this renderer divides by pi, so lights are pi times
//! as strong.

use std::f32::consts::PI;

use glam::Vec3;
use libm::tan;

use super::shapes::Builder;
use crate::scene::camera::Camera;
use crate::scene::{Environment, Light, LightKind, Material, Scene, Weights};

struct Ball {
    center: [f32; 3],
    color: [f32; 3],
    radius: f32,
    /// Weights of the local, mirrored, transmitted and emitted light.
    k: [f32; 4],
    ior: f32,
}

#[rustfmt::skip]
const BALLS: [Ball; 5] = [
    Ball { center: [ 0.0,  6.0,  0.5], color: [1.0, 1.0, 1.0], radius: 0.9, k: [0.05, 0.2, 0.85, 0.0 ], ior: 1.7 },
    Ball { center: [-1.0,  8.0, -0.5], color: [1.0, 0.5, 0.2], radius: 1.0, k: [0.7,  0.3, 0.0,  0.05], ior: 1.2 },
    Ball { center: [ 1.0,  8.0, -0.5], color: [0.1, 0.8, 0.8], radius: 1.0, k: [0.3,  0.7, 0.0,  0.0 ], ior: 1.2 },
    Ball { center: [ 3.0, -6.0, 15.0], color: [1.0, 0.8, 1.0], radius: 7.0, k: [0.0,  0.0, 0.0,  0.6 ], ior: 1.5 },
    Ball { center: [-3.0, -3.0, 12.0], color: [0.8, 1.0, 1.0], radius: 5.0, k: [0.0,  0.0, 0.0,  0.5 ], ior: 1.5 },
];

pub(super) fn scene() -> Scene {
    let mut b = Builder::default();
    for (i, ball) in BALLS.iter().enumerate() {
        let (center, color) = (Vec3::from(ball.center), Vec3::from(ball.color));
        let [diffuse, mirror, refraction, emission] = ball.k;
        let name = format!("ball{i}");
        let material = b.material(
            &name,
            Material {
                base_color: color,
                emission: emission * color,
                ior: ball.ior,
                weights: Some(Weights { diffuse, mirror, refraction }),
                ..Material::default()
            },
        );
        b.sphere(name, material, center, ball.radius);
        if emission > 0.0 {
            b.scene.lights.push(Light {
                kind: LightKind::Point { position: center, range: f32::INFINITY, falloff: false },
                intensity: PI * emission * color,
                radius: ball.radius,
            });
        }
    }
    let dim = Vec3::splat(0.02);
    b.scene.environment = Environment { background: dim, ambient: dim, fallback_radiance: Vec3::ZERO };
    b.scene.cameras.push(("main".to_owned(), camera()));
    b.finish()
}

/// For 32 x 32 pixels: minray's pixel (i, j) looks along (i - 16, 16 / tan 12.5 deg, 16 - j), through the pixel's
/// corner, so the lens is shifted by half a pixel.
fn camera() -> Camera {
    let tan = tan(12.5_f64.to_radians()) as f32;
    let half_pixel = tan / 32.0;
    Camera {
        origin: Vec3::ZERO,
        right: Vec3::X * tan,
        up: Vec3::Z * tan,
        forward: Vec3::new(-half_pixel, 1.0, half_pixel),
        orthographic: false,
    }
}
