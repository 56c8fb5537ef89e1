//! Mirrors in mirrors, glass in glass.

use glam::{DMat3, DVec3, Vec3, dvec3};

use super::{
    Bench, Case, Outcome, Random,
    mesh::{Mesh, Objects, bare},
    ray, unexposed,
};
use crate::{
    MAX_DEPTH, Result, Scene, Settings,
    scene::{Environment, Material, Object, Sphere},
};

pub const CASE: Case = Case {
    name: "recursion",
    construction: "facing mirrors, a room of mirrors, five nested spheres of glass, a glass mesh in glass; a world whose \
                   radiance is 1 everywhere; depth 64, no weight too small to follow",
    rule: "it ends; no sample above 1, and none below: mirrors and glass take nothing away",
    run,
};

/// 64 products of numbers that are each right to a few units in the last place.
const ERROR: f32 = 64.0 * 8.0 * f32::EPSILON;

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let settings = Settings { depth: MAX_DEPTH, min_weight: 0.0, ..unexposed() };
    let scenes = [
        ("facing mirrors", facing(mirror(), 2)),
        ("room of mirrors", facing(mirror(), 6)),
        ("nested spheres", nested()),
        ("glass in glass", glass_meshes()),
    ];
    let share = bench.rays.div_ceil(scenes.len() as u64);
    for (index, (name, scene)) in scenes.into_iter().enumerate() {
        let mut random = Random(bench.seed ^ index as u64);
        let scene = bench.upload(scene)?;
        let rays: Vec<_> = (0..share)
            .map(|_| ray(random.inside(DVec3::splat(-0.9), DVec3::splat(0.9)), random.direction()))
            .collect();
        for (ray, sample) in rays.iter().zip(bench.probe(&scene).shade(&rays, &settings)?) {
            let right = sample.color.iter().all(|c| (c - 1.0).abs() <= ERROR);
            outcome.check(right, || format!("{name}, seed {}: {ray:?} shows {:?}", bench.seed, sample.color));
        }
    }
    Ok(outcome)
}

fn white() -> Environment {
    Environment { background: Vec3::ONE, ambient: Vec3::ONE, fallback_radiance: Vec3::ONE }
}

fn mirror() -> Material {
    Material { base_color: Vec3::ONE, metallic: 1.0, roughness: 0.0, ..Material::default() }
}

fn glass() -> Material {
    Material {
        base_color: Vec3::ONE,
        metallic: 0.0,
        roughness: 0.0,
        transmission: 1.0,
        ior: 1.5,
        casts_shadow: false,
        ..Material::default()
    }
}

/// Walls of the cube from -1 to 1: two that face each other, or all.
fn facing(material: Material, walls: usize) -> Scene {
    let mut triangles = Vec::new();
    for wall in 0..walls {
        let (axis, side) = (wall / 2, if wall % 2 == 0 { -1.0 } else { 1.0 });
        let corner = |u: f64, v: f64| {
            let mut p = DVec3::ZERO;
            p[axis] = side;
            p[(axis + 1) % 3] = side * u;
            p[(axis + 2) % 3] = v;
            p
        };
        let (a, b, c, d) = (corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0));
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    let mut scene = Mesh { triangles }.scene(material, Objects::One);
    scene.environment = white();
    scene
}

fn nested() -> Scene {
    let mut scene = bare(glass());
    for i in 0..5_u8 {
        scene.objects.push(Object { name: format!("sphere {i}"), material: 0 });
        scene.spheres.push(Sphere {
            center: Vec3::ZERO,
            radius: 1.0 - 0.15 * f32::from(i),
            object: i.into(),
        });
    }
    scene.environment = white();
    scene
}

fn glass_meshes() -> Scene {
    let mut inner = Mesh::torus(24, 12);
    inner.triangles.iter_mut().flatten().for_each(|p| *p *= 0.5);
    let mut scene = Mesh::sphere(3).placed(DMat3::IDENTITY, DVec3::ZERO).scene(glass(), Objects::One);
    inner.placed(DMat3::IDENTITY, dvec3(0.05, 0.0, 0.0)).add_to(&mut scene, Objects::One);
    scene.environment = white();
    scene
}
