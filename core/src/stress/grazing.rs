//! Grazing incidence: light and view nearly parallel to the surface.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};

use super::{
    Bench, Case, Outcome, Random, matte,
    mesh::{Mesh, Objects, rotation},
    ray_through, unexposed,
};
use crate::{
    Result,
    scene::{Light, LightKind},
};

pub const CASE: Case = Case {
    name: "grazing",
    construction: "planes in any position under 32 directional lights at 90 degrees minus 1e-1 to 1e-7 from all sides, seen \
                   from anywhere and at the same grazing angles",
    rule: "finite, albedo / pi x E x cos within the rounding of the light's direction, never black where that is positive",
    run,
};

const PLANES: u64 = 56;
const LIGHTS: usize = 32;
/// Upper bound of the error of a cosine from the rounding of its two unit vectors.
const COSINE_ERROR: f64 = 4.0e-7;

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    for plane in 0..PLANES {
        let mut random = Random(bench.seed ^ plane << 8);
        let turn = rotation(&mut random);
        let by = 3.0 * random.direction();
        let corners =
            [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)].map(|(x, z)| DVec3::new(x, 0.0, z));
        let [a, b, c, d] = corners;
        let mesh = Mesh { triangles: vec![[a, b, c], [a, c, d]] }.placed(turn, by);
        let [a, b, c] = mesh.triangles[0];
        let normal = (b - a).cross(c - a).normalize();
        let angle = 10_f64.powi(-1 - (plane % 7) as i32).to_radians();
        let low = |random: &mut Random| {
            let along = random.direction();
            let along = (along - along.dot(normal) * normal).normalize();
            angle.cos() * along + angle.sin() * normal
        };
        let mut scene = mesh.scene(matte(), Objects::One);
        let mut directions = Vec::new();
        for _ in 0..LIGHTS {
            let direction = (-low(&mut random)).as_vec3().normalize();
            directions.push(direction.as_dvec3());
            scene.lights.push(Light {
                kind: LightKind::Directional { direction },
                intensity: Vec3::splat(PI as f32),
                radius: 0.0,
            });
        }
        let scene = bench.upload(scene)?;
        // Each sample asks every light; some rays pass by.
        let share = (11 * bench.rays).div_ceil(10 * PLANES * LIGHTS as u64);
        let rays: Vec<_> = (0..share)
            .map(|i| {
                let target = a + 0.9 * (random.unit() * (b - a) + random.unit() * (c - b)) + 0.05 * (c - a);
                let up = random.direction();
                let from = if i % 2 == 0 { up * up.dot(normal).signum() } else { low(&mut random) };
                ray_through(target + (0.5 + random.unit()) * from, target)
            })
            .collect();
        let samples = bench.probe(&scene).shade(&rays, &unexposed())?;
        let albedo = f64::from(matte().base_color.x);
        let expected = |slack: f64| -> f64 {
            directions.iter().map(|d| albedo * (-d.dot(normal) + slack).max(0.0)).sum()
        };
        let (least, most) = (expected(-COSINE_ERROR), expected(COSINE_ERROR));
        for (ray, sample) in rays.iter().zip(&samples) {
            if sample.object == 0 {
                outcome.explain("the ray grazes past the plane");
                continue;
            }
            let found = f64::from(sample.color[0]);
            let right = (least * (1.0 - 1e-5)..=most * (1.0 + 1e-5)).contains(&found);
            outcome.check(right, || {
                format!(
                    "plane {plane}, seed {}: {ray:?} shows {found:e}, expected {least:e} to {most:e}",
                    bench.seed
                )
            });
            outcome.rays += LIGHTS as u64;
        }
    }
    Ok(outcome)
}
