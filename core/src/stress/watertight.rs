//! The eye inside closed meshes, near the origin and far from it: no ray gets out (the construction of Embree's
//! `WatertightTest` and of Vulkan's conformance tests, at more distances).

use glam::{DVec3, dvec3};

use super::{
    Bench, Case, Outcome, Random, matte,
    mesh::{Mesh, Objects, rotation},
    ray, ray_through,
};
use crate::{
    Result,
    probe::{ProbeHit, ProbeRay},
};

pub const CASE: Case = Case {
    name: "watertight",
    construction: "eye inside closed meshes (spheres of 4 to 65,536 triangles, double fans, tori) at 1e0 to 1e7 times \
                   their size from the origin; a half of the rays at random, a quarter at corners, a quarter at edges",
    rule: "no ray gets out",
    run,
};

/// Where Embree's tests put their spheres.
const AWAY: DVec3 = dvec3(148_376.0, 1_234.0, -223_423.0);
const DECADES: u32 = 8;
/// How far an eye is from the surface.
const CLEARANCE: f64 = 0.02;
/// Rays of one mesh at one distance, at least.
const SHARE: u64 = 1_000;

fn meshes() -> Vec<(String, Mesh)> {
    let spheres = (0..8).map(|levels| (format!("sphere {}", 4 << (2 * levels)), Mesh::sphere(levels)));
    let fans = [4, 64, 1_024, 65_536].map(|count| (format!("fans {count}"), Mesh::fans(count)));
    let tori = [(16, 8), (128, 64)].map(|(a, t)| (format!("torus {a} x {t}"), Mesh::torus(a, t)));
    spheres.chain(fans).chain(tori).collect()
}

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let meshes = meshes();
    let places: Vec<_> = (0..DECADES).flat_map(|d| (0..meshes.len()).map(move |m| (d, m))).collect();
    let stride = (places.len() as u64 * SHARE / bench.rays.max(1)).clamp(1, 11) as usize;
    let chosen: Vec<_> = places.iter().step_by(stride).collect();
    // Some meshes drop out.
    let share = (5 * bench.rays).div_ceil(4 * chosen.len() as u64);
    for &&(decade, index) in &chosen {
        let (name, mesh) = &meshes[index];
        let mut random = Random(bench.seed ^ (u64::from(decade) << 32 | index as u64));
        let away = AWAY.normalize() * 10_f64.powi(decade as i32);
        let mesh = mesh.placed(rotation(&mut random), away);
        let Some(eye) = inside(&mesh, away, &mut random) else {
            outcome.explain("rounding to f32 left the mesh without an inside");
            continue;
        };
        let rays: Vec<_> = (0..share).map(|i| aimed(&mesh, eye, i, &mut random)).collect();
        let scene = bench.upload(mesh.scene(matte(), Objects::One))?;
        let (hits, _) = bench.probe(&scene).trace(&rays)?;
        for (i, (ray, hit)) in rays.iter().zip(&hits).enumerate() {
            outcome.check(hit.primitive != ProbeHit::MISS, || {
                format!("{name} at 1e{decade}, seed {}: ray {i} {ray:?} leaks", bench.seed)
            });
        }
    }
    Ok(outcome)
}

/// A point that the rounded mesh still encloses: the centre, or one near it.
fn inside(mesh: &Mesh, center: DVec3, random: &mut Random) -> Option<DVec3> {
    let near = std::iter::repeat_with(|| center + 0.3 * random.direction()).take(8);
    // A torus has its centre outside, and its tube around (1, 0, 0) and the like: any corner's way to the centre.
    let tube = mesh.triangles.first().map(|[a, b, c]| (*a + *b + *c) / 3.0);
    let tube = tube.into_iter().flat_map(|p| [0.02, 0.1, 0.25].map(|step| p.lerp(center, step)));
    let mut points = [center].into_iter().chain(near).chain(tube).map(|p| p.as_vec3().as_dvec3());
    points.find(|p| clearly_inside(mesh, *p))
}

/// The point and the corners of a small cube around it: far from the origin rounding folds surfaces through points
/// that they seem to wind around.
fn clearly_inside(mesh: &Mesh, point: DVec3) -> bool {
    let corner =
        |i: u32| CLEARANCE * DVec3::from_array([0, 1, 2].map(|axis| f64::from(i >> axis & 1) * 2.0 - 1.0));
    let mut around = std::iter::once(point).chain((0..8).map(|i| point + corner(i)));
    around.all(|p| (mesh.winding(p).abs() - 1.0).abs() < 1e-6)
}

fn aimed(mesh: &Mesh, eye: DVec3, index: u64, random: &mut Random) -> ProbeRay {
    let [a, b, _] = mesh.triangles[random.below(mesh.triangles.len())];
    let target = match index % 4 {
        0 => a,
        1 => a.lerp(b, random.unit()),
        _ => eye,
    };
    // Far from the origin an edge may run through the eye.
    let aimed = ray_through(eye, target);
    if aimed.direction == [0.0; 3] { ray(eye, random.direction()) } else { aimed }
}
