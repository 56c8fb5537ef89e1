//! Coplanar faces: several triangles in the same plane.

use std::hash::{DefaultHasher, Hash, Hasher};

use glam::{DVec3, dvec3};

use super::{
    Bench, Case, Outcome, Random, matte,
    mesh::{Mesh, Objects, rotation},
    ray, ray_through,
};
use crate::{Result, Scene, probe::ProbeHit};

pub const CASE: Case = Case {
    name: "coplanar",
    construction: "200 duplicated triangles and 200 pairs of rectangles that overlap in one plane, each triangle an object; \
                   the same scene with its triangles in reverse order, which makes another tree; two runs of each",
    rule: "the same object for each ray, whatever the run and the tree; the digest is the same on every adapter",
    run,
};

const PAIRS: usize = 200;

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut random = Random(bench.seed);
    let mesh = faces(&mut random);
    let forward = mesh.scene(matte(), Objects::EachTriangle);
    let backward = reversed(forward.clone());
    let rays: Vec<_> = (0..bench.rays.div_ceil(4))
        .map(|i| {
            let eye = random.inside(DVec3::splat(-2.0), DVec3::splat(2.0));
            let [a, b, c] = mesh.triangles[random.below(mesh.triangles.len())];
            let target = a + 0.5 * random.unit() * (b - a) + 0.5 * random.unit() * (c - a);
            if i % 4 == 0 { ray(eye, random.direction()) } else { ray_through(eye, target) }
        })
        .collect();
    let mut answers = Vec::new();
    for scene in [forward, backward] {
        let scene = bench.upload(scene)?;
        for _ in 0..2 {
            answers.push(bench.probe(&scene).trace(&rays)?.0);
        }
    }
    let id = |hit: &ProbeHit| (hit.primitive != ProbeHit::MISS).then_some(hit.object);
    let mut hasher = DefaultHasher::new();
    answers[0].iter().map(id).for_each(|answer| answer.hash(&mut hasher));
    let mut outcome = Outcome { digest: Some(format!("{:016x}", hasher.finish())), ..Outcome::default() };
    for (i, ray) in rays.iter().enumerate() {
        let first = id(&answers[0][i]);
        for (which, answer) in answers.iter().enumerate() {
            outcome.check(id(&answer[i]) == first, || {
                let (run, order) = (which % 2 + 1, if which < 2 { "forward" } else { "reverse" });
                format!(
                    "seed {}: ray {i} {ray:?} meets {first:?}, in run {run} in {order} order {:?}",
                    bench.seed,
                    id(&answer[i])
                )
            });
        }
    }
    Ok(outcome)
}

fn faces(random: &mut Random) -> Mesh {
    let mut triangles = Vec::new();
    for _ in 0..PAIRS {
        let corner = || random.inside(DVec3::splat(-1.0), DVec3::splat(1.0)).as_vec3().as_dvec3();
        let triangle: [DVec3; 3] =
            std::iter::repeat_with(corner).take(3).collect::<Vec<_>>().try_into().unwrap_or_default();
        triangles.extend([triangle, triangle]);
    }
    for _ in 0..PAIRS {
        let rectangle = |low: DVec3, high: DVec3| {
            let (b, d) = (dvec3(low.x, 0.0, high.z), dvec3(high.x, 0.0, low.z));
            [[low, b, high], [low, high, d]]
        };
        let first = rectangle(dvec3(-0.3, 0.0, -0.2), dvec3(0.3, 0.0, 0.2));
        let second = rectangle(dvec3(-0.1, 0.0, -0.3), dvec3(0.4, 0.0, 0.1));
        let both = Mesh { triangles: [first, second].concat() };
        let turn = rotation(random);
        triangles.extend(both.placed(turn, random.inside(DVec3::splat(-1.0), DVec3::splat(1.0))).triangles);
    }
    Mesh { triangles }
}

fn reversed(mut scene: Scene) -> Scene {
    scene.positions.reverse();
    scene.normals.reverse();
    scene.triangle_objects.reverse();
    scene
}
