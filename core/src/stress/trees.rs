//! Inputs that make deep or useless trees.

use glam::{DVec3, dvec3};

use super::{
    Bench, Case, Outcome, Random, judge, matte,
    mesh::{Mesh, Objects},
    ray, ray_through,
};
use crate::{Result, acceleration, reference::Tracer};

pub const CASE: Case = Case {
    name: "trees",
    construction: "triangles that shrink along a spiral, that grow exponentially from a corner, that all lie in one place (up to \
                   2^21 of them, which few rays are enough for), in needles along the axes; points and lines alone",
    rule: "object as the reference, but for ties; the traversal's stack stays below the bound that the builder keeps",
    run,
};

const COINCIDENT_TESTS: u64 = 20_000_000;

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let count = (bench.rays / 20).clamp(2_000, 10_000) as usize;
    let coincident = (bench.rays / 5).clamp(2_000, 1 << 21) as usize;
    let scenes = [
        ("spiral", spiral(count)),
        ("exponential", exponential(40 * 24)),
        ("coincident", Mesh { triangles: vec![[DVec3::ZERO, DVec3::X, DVec3::Y]; coincident] }),
        ("needles", needles(count)),
        ("points and lines", degenerate(count)),
    ];
    let share = bench.rays.div_ceil(scenes.len() as u64 - 1);
    for (index, (name, mesh)) in scenes.into_iter().enumerate() {
        let mut random = Random(bench.seed ^ index as u64);
        let objects = if name == "coincident" { Objects::One } else { Objects::EachTriangle };
        let scene = mesh.scene(matte(), objects);
        let tracer = Tracer::new(&scene);
        let scene = bench.upload(scene)?;
        outcome.check(scene.facts().bvh_stack <= acceleration::DEPTH_LIMIT, || {
            format!("{name}: a stack of {}", scene.facts().bvh_stack)
        });
        // A ray tests everything that lies in one place.
        let share =
            if name == "coincident" { share.min(COINCIDENT_TESTS / coincident as u64) } else { share };
        let rays: Vec<_> = (0..share)
            .map(|i| {
                let [a, b, c] = mesh.triangles[random.below(mesh.triangles.len())];
                let size = (b - a).length().max((c - a).length()).max(1e-6);
                let target = (a + b + c) / 3.0;
                let from = target + 3.0 * size * random.direction();
                if i % 4 == 0 { ray(from, random.direction()) } else { ray_through(from, target) }
            })
            .collect();
        let (hits, _) = bench.probe(&scene).trace(&rays)?;
        judge(&mut outcome, &tracer, &rays, &hits, || format!("{name}, seed {}", bench.seed));
    }
    Ok(outcome)
}

fn spiral(count: usize) -> Mesh {
    let at = |i: usize| {
        let phi = 0.05 * i as f64;
        let radius = 0.999_f64.powf(i as f64);
        dvec3(radius * phi.cos(), radius * phi.sin(), 0.3 * radius)
    };
    let triangle = |i: usize| [at(i), at(i + 1), 0.9 * at(i)].map(|p| p.as_vec3().as_dvec3());
    Mesh { triangles: (0..count).map(triangle).collect() }
}

/// From 1e-6 to 1e17, each 1.06 times as large as the one before and around it.
fn exponential(count: usize) -> Mesh {
    let triangle = |i: usize| {
        let size = 1.0e-6 * 10_f64.powf(23.0 * i as f64 / count as f64);
        [dvec3(size, 0.0, 0.0), dvec3(0.0, size, 0.0), dvec3(0.0, 0.0, size)].map(|p| p.as_vec3().as_dvec3())
    };
    Mesh { triangles: (0..count).map(triangle).collect() }
}

fn needles(count: usize) -> Mesh {
    let mut random = Random(7);
    let needle = |i: usize| {
        let at = random.inside(DVec3::splat(-1.0), DVec3::splat(1.0));
        let along = DVec3::AXES[i % 3];
        let across = 1.0e-4 * DVec3::AXES[(i + 1) % 3];
        [at - 2.0 * along, at + 2.0 * along, at + across].map(|p| p.as_vec3().as_dvec3())
    };
    Mesh { triangles: (0..count).map(needle).collect() }
}

fn degenerate(count: usize) -> Mesh {
    let mut random = Random(11);
    let triangle = |i: usize| {
        let a = random.inside(DVec3::splat(-1.0), DVec3::splat(1.0)).as_vec3().as_dvec3();
        let b = random.inside(DVec3::splat(-1.0), DVec3::splat(1.0)).as_vec3().as_dvec3();
        if i.is_multiple_of(2) { [a; 3] } else { [a, b, a] }
    };
    Mesh { triangles: (0..count).map(triangle).collect() }
}
