//! The shaders' arithmetic at its edges: corners hit head-on, rays that leave a surface, boundaries of glass.

use glam::{DVec3, Vec3, vec3};
use glimpse::{
    GpuScene, Robustness, Scene,
    probe::{Probe, ProbeBoundary, ProbeHit, ProbeRay, fresnel},
    scene::{Object, octahedral_encode},
    stress::Random,
};
use glimpse_tests::{gpu, turn};

const ALL: Robustness = Robustness { watertight: true, boxes: true, offset: true };

fn scene(positions: Vec<[Vec3; 3]>) -> Scene {
    let normal = |[a, b, c]: &[Vec3; 3]| octahedral_encode((b - a).cross(c - a).normalize_or(Vec3::Z));
    Scene {
        normals: positions.iter().map(|t| [normal(t); 3]).collect(),
        triangle_objects: (0..positions.len() as u32).collect(),
        materials: vec![Default::default()],
        objects: positions.iter().map(|_| Object { name: String::new(), material: 0 }).collect(),
        positions,
        ..Scene::default()
    }
}

fn ray(origin: Vec3, direction: Vec3) -> ProbeRay {
    ProbeRay { origin: origin.into(), t_max: 3e38, direction: direction.into(), ..ProbeRay::default() }
}

/// An octahedron whose faces are split into `4^levels`, with corners moved at random.
fn ball(levels: u32, center: Vec3) -> Vec<[Vec3; 3]> {
    let corner = |i: u32| [Vec3::X, Vec3::Y, Vec3::Z][i as usize];
    let mut faces: Vec<[Vec3; 3]> = (0..8_u32)
        .map(|bits| {
            let face = [0, 1, 2].map(|i| if bits >> i & 1 == 0 { corner(i) } else { -corner(i) });
            if bits.count_ones() % 2 == 0 { face } else { [face[0], face[2], face[1]] }
        })
        .collect();
    for _ in 0..levels {
        faces = faces
            .iter()
            .flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(p, q)| (p + q).normalize());
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    let bump = |p: Vec3| center + p * (1.0 + 0.3 * (7.0 * p.x).sin() * (5.0 * p.y).cos());
    faces.into_iter().map(|f| f.map(bump)).collect()
}

/// Rays at corners and along edges of a closed mesh, which is star-shaped around the eye.
#[test]
fn every_ray_crosses_a_closed_mesh_once() {
    let (mut right, mut leaks) = (0, 0);
    for center in [Vec3::ZERO, vec3(0.3, -7.0, 100.0), Vec3::splat(4e4)] {
        let faces = ball(5, center);
        let mut random = Random(5);
        let mut rays = Vec::new();
        for face in &faces {
            let inside = random.unit() as f32;
            let targets = [face[0], 0.5 * (face[0] + face[1]), face[1].lerp(face[2], inside)];
            let eye = center + 0.1 * random.direction().as_vec3();
            rays.extend(targets.map(|target| ray(eye, target - eye)));
            // Along the axes edges are met exactly.
            rays.push(ray(center, face[0] - center));
        }
        let _turn = turn();
        let uploaded = GpuScene::upload(gpu(), scene(faces)).expect("the scene fits");
        let counts = |robustness| Probe::new(gpu(), &uploaded, robustness).count(&rays).expect("counted");
        let wrong = counts(ALL).iter().zip(&rays).filter(|(n, _)| **n != 1).count();
        assert_eq!(wrong, 0, "{center}: {wrong} of {} rays do not cross once", rays.len());
        right += rays.len();
        leaks += counts(Robustness { watertight: false, ..ALL }).iter().filter(|n| **n == 0).count();
    }
    assert!(
        leaks > right / 1000,
        "without exact edges only {leaks} of {right} leak: these rays test nothing"
    );
}

/// Triangles of any size anywhere, each seen from a random side; how many rays that leave it meet it again, and how many
/// lose a parallel neighbour at a gap of 1e-5.
fn self_hits(robustness: Robustness, count: usize) -> (usize, usize, usize) {
    let mut random = Random(11);
    let log_uniform = |random: &mut Random| 10_f64.powf(16.0 * random.unit() - 8.0);
    let (mut spawned, mut again, mut lost) = (0, 0, 0);
    for _ in 0..count {
        let size = log_uniform(&mut random);
        let place = size * 10_f64.powf(3.0 * random.unit() - 1.0) * random.direction();
        let corners = [0; 3].map(|_| place + size * random.direction());
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        let gap = 1e-5 * corners.iter().map(|c| c.abs().max_element()).fold(size, f64::max);
        let neighbour = corners.map(|c| c + gap * normal);
        let positions = [corners, neighbour].map(|t| t.map(|c| c.as_vec3()));
        let rays: Vec<_> = (0..64)
            .map(|_| {
                let (u, v) = (random.unit(), random.unit());
                let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                let target = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
                let away = random.direction();
                let from = target - size * away * (away.dot(normal)).signum();
                ray(from.as_vec3(), (target - from).as_vec3())
            })
            .collect();
        let alone = GpuScene::upload(gpu(), scene(vec![positions[0]])).expect("fits");
        let spawns = Probe::new(gpu(), &alone, robustness).spawn(&rays).expect("spawned");
        let (mut leaving, mut crossing) = (Vec::new(), Vec::new());
        for spawn in spawns.iter().filter(|s| s.primitive != ProbeHit::MISS) {
            let face = DVec3::from_array(spawn.face.map(f64::from));
            for (origin, side) in [(spawn.above, 1.0), (spawn.below, -1.0)] {
                let near = random.direction() + (1.0 - random.unit().powi(8)) * face;
                let away =
                    if near.dot(face) * side > 0.0 { near } else { near - 2.0 * near.dot(face) * face };
                leaving.push(ray(Vec3::from(origin), away.as_vec3()));
            }
            let over = if face.dot(normal) > 0.0 { spawn.above } else { spawn.below };
            crossing.push(ray(Vec3::from(over), normal.as_vec3()));
        }
        if leaving.is_empty() {
            continue;
        }
        let hits = Probe::new(gpu(), &alone, robustness).trace(&leaving).expect("traced").0;
        again += hits.iter().filter(|h| h.primitive != ProbeHit::MISS).count();
        spawned += hits.len();
        let beside = GpuScene::upload(gpu(), scene(vec![positions[1]])).expect("fits");
        let found = Probe::new(gpu(), &beside, robustness).trace(&crossing).expect("traced").0;
        lost += found.iter().filter(|h| h.primitive == ProbeHit::MISS).count();
    }
    (spawned, again, lost)
}

#[test]
fn rays_leave_their_surface() {
    let _turn = turn();
    let (spawned, again, lost) = self_hits(ALL, 60);
    println!("{spawned} spawned, {again} met their own, {lost} lost a neighbour");
    assert!(spawned > 5000, "{spawned}");
    assert_eq!(again, 0, "of {spawned} rays");
    // A neighbour's rim is not above the triangle's where both are rounded.
    assert!(lost * 1000 <= spawned, "{lost} of {spawned}");
    let (spawned, again, _) = self_hits(Robustness { offset: false, ..ALL }, 10);
    assert!(again * 100 > spawned, "without the offset only {again} of {spawned}: these rays test nothing");
}

/// Fresnel's equations in f64.
fn exact(cosine: f64, ratio: f64) -> Option<(f64, f64)> {
    let square = (1.0 - ratio) * (1.0 + ratio) + (ratio * cosine).powi(2);
    if square <= 0.0 {
        return None;
    }
    let other = square.sqrt();
    let s = (ratio * cosine - other) / (ratio * cosine + other);
    let p = (cosine - ratio * other) / (cosine + ratio * other);
    Some((0.5 * (s * s + p * p), other))
}

#[test]
fn the_critical_angle_is_where_it_belongs() {
    let up = 1_f32.next_up();
    let mut boundaries = Vec::new();
    for ratio in [1.0, up, 1.0003, 1.33, 1.5, 2.42, 2.6].into_iter().flat_map(|r: f32| [r, 1.0 / r]) {
        let critical = (1.0 - (f64::from(ratio)).powi(-2)).max(0.0).sqrt() as f32;
        let steps = (0..=20).flat_map(|k| [1_i32 << k, -(1 << k)]).chain([0]);
        let near = steps.map(|ulps| f32::from_bits(critical.to_bits().saturating_add_signed(ulps)));
        let all = near.chain((0..=1000).map(|i| i as f32 / 1000.0));
        boundaries.extend(all.filter(|c| *c <= 1.0).map(|cosine| ProbeBoundary { cosine, ratio }));
    }
    let found = {
        let _turn = turn();
        fresnel(gpu(), &boundaries).expect("computed")
    };
    for (b, f) in boundaries.iter().zip(&found) {
        let (cosine, ratio) = (f64::from(b.cosine), f64::from(b.ratio));
        let total = |ulps: i32| {
            let bits = b.cosine.to_bits().saturating_add_signed(ulps);
            exact(f64::from(f32::from_bits(bits)), ratio).is_none()
        };
        if total(-4) == total(4) {
            assert_eq!(f.total != 0, total(0), "{b:?} {f:?}");
        }
        assert!((0.0..=1.0).contains(&f.reflectance), "{b:?} {f:?}");
        if f.total != 0 {
            assert!(f.reflectance == 1.0 && f.refracted == [0.0; 3], "{b:?} {f:?}");
            continue;
        }
        let [x, y, z] = f.refracted.map(f64::from);
        assert!(((x * x + y * y + z * z).sqrt() - 1.0).abs() < 1e-6 && z <= 0.0, "{b:?} {f:?}");
        if let Some((reflectance, transmitted)) = exact(cosine, ratio) {
            // At the critical angle the slopes are infinite: what 4 units in the last place of the cosine make.
            let slack = 2.0 * ratio * (4.0 * 1.2e-7 * cosine * cosine).sqrt();
            let slack = slack.min(slack * slack / transmitted);
            assert!(
                (transmitted - f64::from(f.transmitted)).abs() < 2e-6 + slack,
                "{b:?} {f:?} {transmitted}"
            );
            let tolerance = 4e-6 + 8.0 * slack / cosine.max(1e-30);
            assert!((reflectance - f64::from(f.reflectance)).abs() < tolerance, "{b:?} {f:?} {reflectance}");
        }
    }
}
