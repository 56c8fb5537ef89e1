//! Scenes that hold tiny objects on huge ones.

use glam::{DMat3, dvec3};

use super::{
    Bench, Case, Outcome, Random, judge, matte,
    mesh::{Mesh, Objects},
    ray, ray_through,
};
use crate::{Result, reference::Tracer};

pub const CASE: Case = Case {
    name: "scale_mix",
    construction: "a sphere of 1,024 triangles of size 1e-6 on a ground of size 1e6; eyes from 1e-6 to 1e5 away; rays at \
                   the sphere, at the ground, at random",
    rule: "object as the reference, but for ties",
    run,
};

const SIZE: f64 = 1.0e-6;
const GROUND: f64 = 0.5e6;

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut random = Random(bench.seed);
    let center = dvec3(3.0, 1.0, -2.0) * SIZE;
    let mut tiny = Mesh::sphere(4);
    tiny.triangles.iter_mut().flatten().for_each(|p| *p *= SIZE);
    let tiny = tiny.placed(DMat3::IDENTITY, center);
    let corner = |x: f64, z: f64| dvec3(GROUND * x, 0.0, GROUND * z);
    let (a, b, c, d) = (corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0));
    let mut scene = Mesh { triangles: vec![[a, b, c], [a, c, d]] }.scene(matte(), Objects::One);
    tiny.add_to(&mut scene, Objects::EachTriangle);
    let tracer = Tracer::new(&scene);
    let scene = bench.upload(scene)?;
    let rays: Vec<_> = (0..bench.rays)
        .map(|i| {
            let distance = 10_f64.powf(-6.0 + 11.0 * random.unit());
            let mut away = random.direction();
            away.y = away.y.abs();
            let eye = center + distance * away;
            match i % 3 {
                0 => ray_through(eye, center + SIZE * random.direction() * random.unit()),
                1 => ray_through(eye, corner(2.0 * random.unit() - 1.0, 2.0 * random.unit() - 1.0)),
                _ => ray(eye, random.direction()),
            }
        })
        .collect();
    let (hits, _) = bench.probe(&scene).trace(&rays)?;
    let mut outcome = Outcome::default();
    judge(&mut outcome, &tracer, &rays, &hits, || format!("seed {}", bench.seed));
    Ok(outcome)
}
