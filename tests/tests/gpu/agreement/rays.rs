//! Random rays through the shaders' functions, compared with the reference.

use glam::DVec3;
use glimpse::{
    Robustness, Settings,
    probe::{Probe, ProbeHit, ProbeRay, ProbeSample, ProbeSpawn},
    reference::{Limits, Reference, SPAWN_ULPS},
    scene::OCTAHEDRAL_ERROR,
    stress::Random,
};
use glimpse_tests::{
    TestScene,
    agreement::{Answer, DIM, Outcome, RADIANCE, Tally, judge},
    gpu,
};

use super::{EPSILON, Pair};

pub fn shade(test_scene: &TestScene, rays: &[ProbeRay], settings: &Settings) -> Vec<ProbeSample> {
    Probe::new(gpu(), &test_scene.scene, Robustness::default())
        .shade(rays, settings)
        .expect("the rays are shaded")
}

fn spawn(test_scene: &TestScene, rays: &[ProbeRay]) -> Vec<ProbeSpawn> {
    Probe::new(gpu(), &test_scene.scene, Robustness::default()).spawn(rays).expect("the rays arrive")
}

fn random_rays(test_scene: &TestScene, count: usize) -> Vec<ProbeRay> {
    let (low, high) = test_scene.scene.bounds();
    let mut random = Random(5);
    std::iter::repeat_with(|| {
        let origin = random.inside(low.as_dvec3(), high.as_dvec3()).as_vec3();
        let direction = random.direction().as_vec3();
        ProbeRay {
            origin: origin.to_array(),
            t_max: 1e30,
            direction: direction.to_array(),
            width: 0.002,
            growth: 0.01,
            ..ProbeRay::default()
        }
    })
    .take(count)
    .collect()
}

fn vector(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

/// Shading results of random rays: object and shadow bits, radiance, the part of it from secondary rays, and
/// texture coordinates.
pub fn seen(pair: &Pair, reference: &Reference, count: usize) -> Tally {
    let rays = random_rays(&pair.test_scene, count);
    let samples = shade(&pair.test_scene, &rays, &pair.settings);
    let items: Vec<_> = rays.iter().zip(&samples).collect();
    let limits = Limits::of(&pair.settings);
    let answer = |labels, color: DVec3, gcol: DVec3, [s, t]: [f64; 2]| {
        let bright = RADIANCE * color.max_element().max(DIM);
        let (c, g) = (color.to_array(), gcol.to_array());
        let mut tolerances = [bright; 8];
        tolerances[6..].fill(16.0 * EPSILON);
        Answer::<8> { labels, values: [c[0], c[1], c[2], g[0], g[1], g[2], s, t], tolerances }
    };
    Tally::of(&items, |(ray, sample)| {
        let labels = [sample.object, sample.shadow];
        let texcoord = sample.texcoord.map(f64::from);
        let found = answer(labels, vector(sample.color), vector(sample.gcol), texcoord);
        let outcome = judge(&found, |r| {
            let exact = reference.sample(&ray.exact().0, &limits, r);
            let a = exact.attributes;
            answer([a.object.map_or(0, |o| o + 1), a.shadow], exact.color, a.gcol, a.texcoord.to_array())
        });
        named(outcome, ray)
    })
}

fn named(outcome: Outcome, ray: &ProbeRay) -> Outcome {
    match outcome {
        Outcome::Wrong(line) => Outcome::Wrong(format!("{:?} {:?}: {line}", ray.origin, ray.direction)),
        outcome => outcome,
    }
}

/// Hit points of random rays: position, shading normal, face normal and side.
pub fn arrived(pair: &Pair, reference: &Reference, count: usize) -> Tally {
    let rays = random_rays(&pair.test_scene, count);
    let spawned = spawn(&pair.test_scene, &rays);
    let items: Vec<_> = rays.iter().zip(&spawned).collect();
    let side = reference.longest_side();
    let answer = |labels, [position, normal, face]: [DVec3; 3]| {
        let values: Vec<f64> = [position, normal, face].iter().flat_map(|v| v.to_array()).collect();
        // A normal is interpolated over its triangle, which may be small: it has the precision of the stored
        // normals.
        let mut tolerances = [f64::from(OCTAHEDRAL_ERROR); 9];
        tolerances[..3].fill(16.0 * EPSILON * side);
        Answer::<9> { labels, values: values.try_into().expect("nine numbers"), tolerances }
    };
    Tally::of(&items, |(ray, s)| {
        let met = s.primitive != ProbeHit::MISS;
        let labels = [if met { s.object + 1 } else { 0 }, s.inside];
        let found = answer(labels, [s.position, s.normal, s.face].map(vector));
        let outcome = judge(&found, |r| {
            let ray = ray.exact().0;
            match reference.first(&ray, None, false, r) {
                None => answer([0; 2], [DVec3::ZERO; 3]),
                Some(intersection) => {
                    let s = reference.surface(&ray, &intersection, r);
                    answer([s.object + 1, u32::from(s.inside)], [s.position, s.normal, s.face])
                }
            }
        });
        match off_its_surface(s, side) {
            true => named(outcome, ray),
            false => Outcome::Wrong(format!("{s:?} starts rays in the wrong place")),
        }
    })
}

/// Whether spawned rays start on their side of the face, and no farther from it than the reference displaces
/// them.
fn off_its_surface(s: &ProbeSpawn, side: f64) -> bool {
    let (face, position) = (vector(s.face), vector(s.position));
    let [above, below] = [s.above, s.below].map(|o| (vector(o) - position).dot(face));
    let most = SPAWN_ULPS / 2.0 * EPSILON * 4.0 * side;
    s.primitive == ProbeHit::MISS || (0.0 < above && above < most && -most < below && below < 0.0)
}
