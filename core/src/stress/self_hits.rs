//! Rays that leave a surface neither meet it again nor miss what stands close to it (after pbrt-v4's `Reintersect`).

use glam::{DVec3, Vec3};

use super::{
    Bench, Case, Outcome, Random, answer, matte,
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
    construction: "random triangles with coordinates 1e-8 to 1e8, each with a twin beside it in its plane and a parallel copy \
                   of both at a gap of 1e-5 of their size; hits everywhere and close to the common edge; from each spawned \
                   shadow, reflection and refraction rays: at random, grazing, and at the copy",
    rule: "no ray meets the face that it leaves, nor, if it rises by 1e-3 and the triangle is at least 1e-2 \
           of its length wide, the twin; every copy that the reference sees is met",
    run,
};

/// Each with a twin, and the copies of both: objects 4 i to 4 i + 3.
const TRIANGLES: usize = 12;
const TWIN: u32 = 1;
const COPY: u32 = 2;
const GAP: f64 = 1.0e-5;
/// The height of a triangle over its longest side, in its length, below which it is a needle.
const NEEDLE: f64 = 1.0e-2;
/// Number of rays that leave each side of each hit.
const LEAVING: usize = 8;

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let scenes = (bench.rays / 50_000).clamp(4, 64);
    // Some of the first rays miss, and some directions leave nothing.
    let first = (5 * bench.rays).div_ceil(4 * scenes * 2 * LEAVING as u64).max(16);
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
            let met = (hit.primitive != ProbeHit::MISS).then_some(hit.object);
            if met == Some(*from) {
                outcome.fail(|| replay("meets it again"));
            } else if met == Some(from ^ TWIN) && rises(&mesh, ray, *from) {
                outcome.fail(|| replay("meets its twin"));
            } else {
                judge_copy(&mut outcome, &tracer, ray, hit, from ^ COPY, replay);
            }
        }
    }
    Ok(outcome)
}

/// The copy, where the exact ray meets it first.
fn judge_copy(
    outcome: &mut Outcome,
    tracer: &Tracer,
    ray: &ProbeRay,
    hit: &ProbeHit,
    copy: u32,
    replay: impl Fn(&str) -> String,
) {
    let (along, length) = ray.exact();
    let expected = tracer.nearest(&along).filter(|h| h.object == copy);
    match (expected, hit.primitive != ProbeHit::MISS && hit.object == copy) {
        (None, _) | (Some(_), true) => outcome.pass(),
        (Some(expected), false) => match tracer.judge(&along, answer(hit, length)) {
            Verdict::Wrong(_) => {
                outcome.fail(|| replay(&format!("loses its copy at {:e} of a length", expected.t)));
            }
            _ => outcome
                .explain("the copy is met at its edge, or behind a needle whose distance f32 does not tell"),
        },
    }
}

/// Triangles whose corners' coordinates have magnitudes from 1e-8 to 1e8, their twins and the copies.
fn pairs(random: &mut Random) -> Mesh {
    let mut triangles = Vec::new();
    while triangles.len() < 4 * TRIANGLES {
        let mut coordinate =
            || (2.0 * random.unit() - 1.0).signum() * 10_f64.powf(16.0 * random.unit() - 8.0);
        let mut corner = || DVec3::new(coordinate(), coordinate(), coordinate()).as_vec3().as_dvec3();
        let triangle = [corner(), corner(), corner()];
        let [a, b, c] = triangle;
        let size = triangle.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let (Some(normal), true) = ((b - a).cross(c - a).try_normalize(), size > 0.0) else { continue };
        let twin = [c, b, (b + c - a).as_vec3().as_dvec3()];
        let copied = |p: DVec3| (p + GAP * size * normal).as_vec3().as_dvec3();
        triangles.extend([triangle, twin, triangle.map(copied), twin.map(copied)]);
    }
    Mesh { triangles }
}

/// A half of them close to the edge b c, which a triangle has in common with its twin.
fn inside_of([a, b, c]: [DVec3; 3], random: &mut Random) -> DVec3 {
    let on_edge = b.lerp(c, random.unit());
    let share =
        if random.below(2) == 0 { random.unit().sqrt() } else { 1.0 - 10_f64.powf(-8.0 * random.unit()) };
    a.lerp(on_edge, share)
}

/// Whether a ray goes up from both faces of a plane, which are one up to rounding; and they are no needles, whose
/// distance f32 does not tell that well.
fn rises(mesh: &Mesh, ray: &ProbeRay, from: u32) -> bool {
    let direction = Vec3::from(ray.direction).as_dvec3();
    let area = |object: u32| {
        let [a, b, c] = mesh.triangles[object as usize];
        ((b - a).cross(c - a), (b - a).length().max((c - a).length()).max((c - b).length()))
    };
    let ((own, length), (other, _)) = (area(from), area(from ^ TWIN));
    if own.length() < NEEDLE * length * length {
        return false;
    }
    let (own, other) = (own.normalize_or_zero(), other.normalize_or_zero());
    let lift = direction.dot(own);
    own.dot(other) > 1.0 - 1e-12 && lift.abs() > 1e-3 && (direction.dot(other) - lift).abs() < 1e-5
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
    let copy = mesh.triangles[(spawn.object ^ COPY) as usize];
    let mut rays = Vec::new();
    for (origin, out) in sides {
        let origin = Vec3::from(origin).as_dvec3();
        for i in 0..LEAVING {
            let along = random.direction();
            let along = along - along.dot(out) * out;
            let lift = match i {
                0 => 1.0e-7,
                1 => 1.0e-5,
                2 => 2.0e-3,
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
