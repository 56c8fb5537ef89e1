//! Rays that leave a surface neither meet it again nor miss what stands close to it (after pbrt-v4's `Reintersect`).

use glam::{DVec3, Vec3};

use super::{
    Bench, Case, Outcome, Random, answer, exact, matte,
    mesh::{Mesh, Objects},
    ray, ray_through,
};
use crate::{
    Result,
    probe::{ProbeHit, ProbeRay, ProbeSpawn},
    reference::{Tracer, Verdict},
};

pub const CASE: Case = Case {
    name: "self_hits",
    construction: "random triangles with coordinates 1e-8 to 1e8, each with a parallel copy at a gap of 1e-5 of its size; \
                   from each hit spawned shadow, reflection and refraction rays: at random, grazing, and at the copy",
    rule: "no ray meets the face that it leaves; every copy that the reference sees is met",
    run,
};

const TRIANGLES: usize = 24;
const GAP: f64 = 1.0e-5;
/// Rays from each side of each hit.
const LEAVING: usize = 8;

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let scenes = (bench.rays / 50_000).clamp(4, 64);
    // A quarter of the first rays is aimed at nothing's edge and may miss; each that hits spawns two sides of rays.
    let first = bench.rays.div_ceil(scenes * 2 * LEAVING as u64).max(16);
    for index in 0..scenes {
        let mut random = Random(bench.seed ^ index << 16);
        let mesh = pairs(&mut random);
        let scene = mesh.scene(matte(), Objects::EachTriangle);
        let tracer = Tracer::new(&scene);
        let scene = bench.upload(scene)?;
        let probe = bench.probe(&scene);
        let rays: Vec<_> = (0..first).map(|_| towards(&mesh, &mut random)).collect();
        let spawned = probe.spawn(&rays)?;
        let hits = spawned.iter().filter(|s| s.primitive != ProbeHit::MISS);
        let leaving: Vec<_> = hits.flat_map(|s| leaving(&mesh, s, &mut random)).collect();
        let rays: Vec<_> = leaving.iter().map(|(ray, _)| *ray).collect();
        if rays.is_empty() {
            continue;
        }
        let (hits, _) = probe.trace(&rays)?;
        for ((ray, from), hit) in leaving.iter().zip(&hits) {
            let replay = |what: &str| {
                format!("scene {index}, seed {}: {ray:?} from triangle {from} {what}: {hit:?}", bench.seed)
            };
            if hit.primitive != ProbeHit::MISS && hit.object == *from {
                outcome.fail(|| replay("meets it again"));
                continue;
            }
            judge_neighbour(&mut outcome, &tracer, ray, hit, *from ^ 1, replay);
        }
    }
    Ok(outcome)
}

/// The copy, where the exact ray meets it first.
fn judge_neighbour(
    outcome: &mut Outcome,
    tracer: &Tracer,
    ray: &ProbeRay,
    hit: &ProbeHit,
    copy: u32,
    replay: impl Fn(&str) -> String,
) {
    let (along, length) = exact(ray);
    let expected = tracer.nearest(&along).filter(|h| h.object == copy);
    match (expected, hit.primitive != ProbeHit::MISS && hit.object == copy) {
        (None, _) | (Some(_), true) => outcome.pass(),
        (Some(expected), false) => match tracer.judge(&along, answer(hit, length)) {
            Verdict::Wrong(_) => {
                outcome.fail(|| replay(&format!("loses its copy at {:e} of a length", expected.t)));
            }
            _ => outcome.explain("the copy is met at its edge"),
        },
    }
}

/// A triangle whose corners' coordinates have magnitudes from 1e-8 to 1e8, and its copy beside it: objects 2 i, 2 i + 1.
fn pairs(random: &mut Random) -> Mesh {
    let mut triangles = Vec::new();
    while triangles.len() < 2 * TRIANGLES {
        let mut coordinate =
            || (2.0 * random.unit() - 1.0).signum() * 10_f64.powf(16.0 * random.unit() - 8.0);
        let mut corner = || DVec3::new(coordinate(), coordinate(), coordinate()).as_vec3().as_dvec3();
        let triangle = [corner(), corner(), corner()];
        let [a, b, c] = triangle;
        let size = triangle.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let (Some(normal), true) = ((b - a).cross(c - a).try_normalize(), size > 0.0) else { continue };
        let copy = triangle.map(|p| (p + GAP * size * normal).as_vec3().as_dvec3());
        triangles.extend([triangle, copy]);
    }
    Mesh { triangles }
}

fn inside_of([a, b, c]: [DVec3; 3], random: &mut Random) -> DVec3 {
    let (u, v) = (random.unit(), random.unit());
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    a + u * (b - a) + v * (c - a)
}

/// At a random point of a random triangle, from about as far as it is large.
fn towards(mesh: &Mesh, random: &mut Random) -> ProbeRay {
    let triangle = mesh.triangles[random.below(mesh.triangles.len())];
    let target = inside_of(triangle, random);
    let size = triangle.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    ray_through(target + size * 10_f64.powf(2.0 * random.unit() - 1.0) * random.direction(), target)
}

/// Rays to both sides of the hit, with the object that they leave.
fn leaving(mesh: &Mesh, spawn: &ProbeSpawn, random: &mut Random) -> Vec<(ProbeRay, u32)> {
    let face = Vec3::from(spawn.face).as_dvec3();
    let sides = [(spawn.above, face), (spawn.below, -face)];
    let copy = mesh.triangles[(spawn.object ^ 1) as usize];
    let mut rays = Vec::new();
    for (origin, out) in sides {
        let origin = Vec3::from(origin).as_dvec3();
        for i in 0..LEAVING {
            let along = random.direction();
            let along = along - along.dot(out) * out;
            let lift = match i {
                0 => 1.0e-7,
                1 => 1.0e-5,
                2 => 1.0e-3,
                _ => random.unit(),
            };
            let direction = match i {
                6 | 7 => inside_of(copy, random) - origin,
                _ => along + lift * out,
            };
            // A direction that rounding turns into the surface does not leave it.
            let direction = direction.normalize_or_zero().as_vec3().as_dvec3();
            if direction.dot(out) > 0.0 {
                rays.push((ProbeRay { left: spawn.primitive + 1, ..ray(origin, direction) }, spawn.object));
            }
        }
    }
    rays
}
