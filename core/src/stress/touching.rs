//! Solids of glass that touch, overlap and contain one another.

use glam::{DMat3, DVec3, Vec3, dvec3};

use super::{
    Bench, Case, Outcome, Random,
    mesh::{Mesh, Objects, bare, rotation},
    ray, unexposed,
};
use crate::{
    Result, Scene, Settings,
    reference::{Cause, Limits, Reference, Rounding},
    scene::{Material, Object, Sphere},
};

pub const CASE: Case = Case {
    name: "touching",
    construction: "two slabs of glass at gaps of 0, 1 ulp and 1e-6 to 1e-3; glued and overlapping slabs of different \
                   indices; a small slab in contact with a large one; a ball of the same index, and a bubble, in glass; \
                   turned at random, between walls of different colours",
    rule: "the radiance is that of the reference",
    run,
};

/// Relative to the sum of all weights, which is at most 1.
const ERROR: f64 = 1.0 / 4096.0;
/// Evaluations of the displaced reference before a difference counts as wrong.
const TRIES: u64 = 512;
/// Half the width of the slabs.
const WIDE: f64 = 0.8;

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let settings = Settings { depth: 6, min_weight: 1.0e-3, ..unexposed() };
    let limits = Limits::of(&settings);
    let names = SCENES.len() as u64;
    for (index, (name, build)) in SCENES.iter().enumerate() {
        let mut random = Random(bench.seed ^ (index as u64) << 16);
        let scene = between_walls(*build, rotation(&mut random));
        let reference = Reference::new(&scene);
        let scene = bench.upload(scene)?;
        let rays: Vec<_> = (0..bench.rays.div_ceil(names))
            .map(|_| {
                let eye = random.inside(DVec3::splat(-2.5), DVec3::splat(2.5));
                ray(eye, random.inside(DVec3::splat(-0.6), DVec3::splat(0.6)) - eye)
            })
            .collect();
        for (ray, sample) in rays.iter().zip(bench.probe(&scene).shade(&rays, &settings)?) {
            let (along, _) = ray.exact();
            let right = |mut rounding: Rounding| {
                let exact = reference.sample(&along, &limits, &mut rounding).color;
                (DVec3::from_array(sample.color.map(f64::from)) - exact).abs().max_element() <= ERROR
            };
            if right(Rounding::none()) {
                outcome.pass();
            } else if (0..TRIES).any(|seed| right(Rounding::of(Cause::Several, seed))) {
                outcome.explain("an edge or the critical angle within the errors of f32");
            } else {
                outcome.fail(|| format!("{name}, seed {}: {ray:?} shows {:?}", bench.seed, sample.color));
            }
        }
    }
    Ok(outcome)
}

type Build = fn(&mut Scene, DMat3);

const SCENES: [(&str, Build); 11] = [
    ("no gap", |scene, turn| slabs(scene, turn, [1.5, 1.5], 0.0)),
    ("a gap of 1 ulp", |scene, turn| slabs(scene, turn, [1.5, 1.5], f64::from(f32::EPSILON))),
    ("a gap of 1e-6", |scene, turn| slabs(scene, turn, [1.5, 1.5], 1.0e-6)),
    ("a gap of 1e-5", |scene, turn| slabs(scene, turn, [1.5, 1.5], 2.0e-5)),
    ("a gap of 1e-4", |scene, turn| slabs(scene, turn, [1.5, 1.5], 1.0e-4)),
    ("a gap of 1e-3", |scene, turn| slabs(scene, turn, [1.5, 1.5], 1.0e-3)),
    ("different indices", |scene, turn| slabs(scene, turn, [1.33, 1.7], 0.0)),
    ("an overlap", |scene, turn| {
        slab(scene, turn, 1.33, [WIDE, -0.4, 0.05]);
        slab(scene, turn, 1.7, [0.9 * WIDE, -0.05, 0.3]);
    }),
    ("a smaller slab", |scene, turn| {
        slab(scene, turn, 1.5, [WIDE, -0.4, 0.0]);
        slab(scene, turn, 1.33, [0.05 * WIDE, 0.0, 0.3]);
    }),
    ("a ball in glass", |scene, turn| ball_in(scene, turn, 1.5)),
    ("a bubble in glass", |scene, turn| ball_in(scene, turn, 1.0)),
];

fn glass(ior: f32) -> Material {
    Material { roughness: 0.0, transmission: 1.0, ior, casts_shadow: false, ..Material::default() }
}

/// A cube of unlit walls around the origin with the solids in it.
fn between_walls(build: Build, turn: DMat3) -> Scene {
    let mut scene = bare(Material::default());
    for wall in 0..6 {
        let mut color = Vec3::splat(0.2);
        color[wall / 2] = if wall % 2 == 0 { 0.5 } else { 1.0 };
        scene.materials.push(Material { base_color: color, unlit: true, ..Material::default() });
        let side = if wall % 2 == 0 { -3.0 } else { 3.0 };
        let corner = |u: f64, v: f64| {
            let mut p = DVec3::splat(side);
            (p[(wall / 2 + 1) % 3], p[(wall / 2 + 2) % 3]) = (u, v);
            p
        };
        let [a, b, c, d] = [corner(-3.0, -3.0), corner(3.0, -3.0), corner(3.0, 3.0), corner(-3.0, 3.0)];
        add(&mut scene, &Mesh { triangles: vec![[a, b, c], [a, c, d]] }, DMat3::IDENTITY);
    }
    build(&mut scene, turn);
    scene
}

/// Adds a mesh as an object of the material added last.
fn add(scene: &mut Scene, mesh: &Mesh, turn: DMat3) {
    mesh.placed(turn, DVec3::ZERO).add_to(scene, Objects::One);
    if let Some(object) = scene.objects.last_mut() {
        object.material = scene.materials.len() as u32 - 1;
    }
}

/// Two slabs on either side of a plane, with a gap between them.
fn slabs(scene: &mut Scene, turn: DMat3, iors: [f32; 2], gap: f64) {
    slab(scene, turn, iors[0], [WIDE, -0.4, -0.5 * gap]);
    slab(scene, turn, iors[1], [WIDE, 0.5 * gap, 0.3]);
}

/// A slab across y: half its width, and where it begins and ends.
fn slab(scene: &mut Scene, turn: DMat3, ior: f32, [wide, low, high]: [f64; 3]) {
    let corner = |i: usize| {
        let side = |bit: usize| if i & bit == 0 { -wide } else { wide };
        dvec3(side(1), if i & 2 == 0 { low } else { high }, side(4))
    };
    // Seen from outside, counter-clockwise.
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    scene.materials.push(glass(ior));
    add(scene, &Mesh { triangles: triangles.map(|t| t.map(corner)).collect() }, turn);
}

fn ball_in(scene: &mut Scene, turn: DMat3, ior: f32) {
    slab(scene, turn, 1.5, [WIDE, -0.5, 0.5]);
    scene.materials.push(glass(ior));
    let object = scene.objects.len() as u32;
    scene.objects.push(Object { name: "ball".into(), material: scene.materials.len() as u32 - 1 });
    scene.spheres.push(Sphere { center: Vec3::new(0.05, 0.0, -0.05), radius: 0.3, object });
}
