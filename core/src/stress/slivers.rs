//! Slivers: triangles with one very small angle.

use glam::DVec3;

use super::{
    Bench, Case, Outcome, Random, judge, matte,
    mesh::{Mesh, Objects, rotation},
    ray, ray_through,
};
use crate::{Result, reference::Tracer};

pub const CASE: Case = Case {
    name: "slivers",
    construction: "500 triangles of length 1 and width 1e-2 to 1e-8 in a unit box, each an object; a half of the rays at \
                   random points of them, a half at random",
    rule: "object as the reference, but for ties",
    run,
};

const COUNT: usize = 500;

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let share = bench.rays.div_ceil(7);
    for decade in 2..=8 {
        let mut random = Random(bench.seed ^ decade as u64);
        let width = 0.1_f64.powi(decade);
        let mesh = soup(width, &mut random);
        let scene = mesh.scene(matte(), Objects::EachTriangle);
        let tracer = Tracer::new(&scene);
        let scene = bench.upload(scene)?;
        let rays: Vec<_> = (0..share)
            .map(|i| {
                let eye = random.inside(DVec3::splat(-1.5), DVec3::splat(1.5));
                if i % 2 == 0 {
                    return ray(eye, random.direction());
                }
                let [a, b, c] = mesh.triangles[random.below(COUNT)];
                let (u, v) = (random.unit(), random.unit());
                let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                ray_through(eye, a + u * (b - a) + v * (c - a))
            })
            .collect();
        let (hits, _) = bench.probe(&scene).trace(&rays)?;
        judge(&mut outcome, &tracer, &rays, &hits, || format!("aspect 1e{decade}, seed {}", bench.seed));
    }
    Ok(outcome)
}

fn soup(width: f64, random: &mut Random) -> Mesh {
    let sliver = Mesh { triangles: vec![[DVec3::ZERO, DVec3::X, DVec3::X * 0.4 + DVec3::Y * width]] };
    let mut place = || {
        let turn = rotation(random);
        sliver.placed(turn, random.inside(DVec3::splat(-1.0), DVec3::splat(1.0))).triangles
    };
    Mesh { triangles: (0..COUNT).flat_map(|_| place()).collect() }
}
