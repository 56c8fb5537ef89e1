//! Lights in extreme places with extreme intensities.

use std::f32::consts::FRAC_PI_2;

use glam::{DMat3, DVec3, Vec3, vec3};

use super::{
    Bench, Case, Outcome, Random,
    mesh::{Mesh, Objects},
    ray, unexposed,
};
use crate::{
    Result,
    scene::{Light, LightKind, MIN_RANGE, Material},
};

pub const CASE: Case = Case {
    name: "lights",
    construction: "point, spot and directional lights at a surface, in a corner, at the eye, inside a sphere, 1e17 away; \
                   intensities 0, denormal, 1 and 1e30; cones of no width and the shortest ranges; matte, glossy and \
                   metallic surfaces, random rays and rays from the light",
    rule: "finite and not negative",
    run,
};

const INTENSITIES: [f32; 4] = [0.0, 1.0e-40, 1.0, 1.0e30];

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let materials = [
        Material { roughness: 1.0, ..Material::default() },
        Material { roughness: 0.0, ..Material::default() },
        Material { roughness: 0.01, metallic: 1.0, ..Material::default() },
    ];
    let mesh = Mesh::sphere(2).placed(DMat3::IDENTITY, DVec3::ZERO);
    let corner = mesh.triangles[0][0];
    let middle = mesh.triangles[0].iter().sum::<DVec3>() / 3.0;
    let places = [middle, corner, DVec3::new(0.1, 0.2, 0.3), DVec3::splat(2.0), DVec3::splat(1.0e17)];
    let cases: Vec<_> = (0..materials.len() * places.len() * INTENSITIES.len()).collect();
    let share = bench.rays.div_ceil(cases.len() as u64);
    for case in cases {
        let (material, rest) = (&materials[case % 3], case / 3);
        let (place, intensity) = (places[rest % places.len()], INTENSITIES[rest / places.len()]);
        let mut random = Random(bench.seed ^ case as u64);
        let mut scene = mesh.scene(material.clone(), Objects::One);
        scene.lights = lights(place.as_vec3(), Vec3::splat(intensity));
        let scene = bench.upload(scene)?;
        let rays: Vec<_> = (0..share)
            .map(|i| {
                let from = if i % 2 == 0 { place } else { 2.0 * random.direction() };
                let target = if i % 4 < 2 { random.direction() * 0.9 } else { middle };
                ray(from, if target == from { DVec3::X } else { target - from })
            })
            .collect();
        for (ray, sample) in rays.iter().zip(bench.probe(&scene).shade(&rays, &unexposed())?) {
            let right = sample.color.iter().all(|c| c.is_finite() && *c >= 0.0);
            outcome.check(right, || {
                let m = (material.roughness, material.metallic);
                format!("lights of {intensity:e} at {place}, roughness and metallic {m:?}, seed {}: {ray:?} shows {:?}", bench.seed, sample.color)
            });
        }
    }
    Ok(outcome)
}

fn lights(position: Vec3, intensity: Vec3) -> Vec<Light> {
    let down = vec3(0.0, -1.0, 0.0);
    let spot = |range: f32, start: f32, end: f32| LightKind::Spot {
        position,
        range,
        direction: down,
        cone: start..end,
    };
    let kinds = [
        LightKind::Point { position, range: f32::INFINITY, falloff: true },
        LightKind::Point { position, range: MIN_RANGE, falloff: true },
        LightKind::Point { position, range: f32::INFINITY, falloff: false },
        LightKind::Directional { direction: down },
        spot(f32::INFINITY, 0.0, 0.0),
        spot(MIN_RANGE, 0.0, FRAC_PI_2),
        spot(f32::INFINITY, FRAC_PI_2, FRAC_PI_2),
    ];
    kinds.into_iter().map(|kind| Light { kind, intensity, radius: 0.0 }).collect()
}
