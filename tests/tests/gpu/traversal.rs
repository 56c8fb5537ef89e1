//! Random rays through the GPU's traversal, against that in f64.

use std::{num::NonZero, thread};

use glimpse::{
    GpuScene, Robustness, Scene,
    probe::{Probe, ProbeHit, ProbeRay},
    reference::{Hit, Tracer, Verdict},
    stress::Random,
};
use glimpse_tests::{gpu, note, shared_scene};

const RAYS: usize = 1_000_000;

/// One in this many answers may be explained by rounding (rays along edges).
const EXPLAINED: usize = 1_000;

fn random_rays(scene: &Scene, seed: u64) -> Vec<ProbeRay> {
    let (low, high) = scene.bounds().expect("a scene with something in it");
    let (low, high) = (low.as_dvec3(), high.as_dvec3());
    let margin = 0.1 * (high - low).max_element();
    let mut random = Random(seed);
    std::iter::repeat_with(|| {
        let origin = random.inside(low - margin, high + margin).as_vec3();
        let direction = random.direction().as_vec3();
        ProbeRay {
            origin: origin.to_array(),
            t_max: 1e30,
            direction: direction.to_array(),
            ..ProbeRay::default()
        }
    })
    .take(RAYS)
    .collect()
}

fn agree(name: &str, mut scene: Scene) {
    // Alpha cutouts are not part of the geometry.
    scene.materials.iter_mut().for_each(|m| m.alpha_cutoff = None);
    let rays = random_rays(&scene, 1);
    let tracer = Tracer::new(&scene);
    let scene = GpuScene::upload(gpu(), scene).expect("the scene fits the device");
    let (hits, _) =
        Probe::new(gpu(), &scene, Robustness::default()).trace(&rays).expect("the rays are traced");
    assert_eq!(hits.len(), rays.len(), "{name}");

    let judge = &|(ray, hit): (&ProbeRay, &ProbeHit)| {
        let (ray, length) = ray.exact();
        let answer = (hit.primitive != ProbeHit::MISS)
            .then(|| Hit { object: hit.object, t: f64::from(hit.t) * length });
        (answer.is_some(), tracer.judge(&ray, answer))
    };
    let (mut met, mut ties, mut explained, mut wrong) = (0, 0, 0, Vec::new());
    let share = RAYS.div_ceil(thread::available_parallelism().map_or(2, NonZero::get));
    thread::scope(|scope| {
        let workers: Vec<_> = rays
            .chunks(share)
            .zip(hits.chunks(share))
            .map(|(rays, hits)| scope.spawn(move || rays.iter().zip(hits).map(judge).collect::<Vec<_>>()))
            .collect();
        for (hit, verdict) in workers.into_iter().flat_map(|w| w.join().expect("a judge")) {
            met += usize::from(hit);
            match verdict {
                Verdict::Same => {}
                Verdict::Tie => ties += 1,
                Verdict::Explained => explained += 1,
                Verdict::Wrong(line) => wrong.push(line),
            }
        }
    });
    note(&format!(
        "{name}: {RAYS} rays, {met} hit, {ties} ties, {explained} explained by rounding, {} wrong",
        wrong.len()
    ));
    assert!(met > RAYS / 20, "{name}: only {met} rays hit anything");
    let count = wrong.len();
    wrong.truncate(8);
    assert_eq!(count, 0, "{name}: {count} wrong answers, the first:\n{}", wrong.join("\n"));
    assert!(explained * EXPLAINED <= RAYS, "{name}: {explained} answers need an explanation");
}

#[test]
fn built_in_scenes() {
    for name in ["room", "cornell", "minray"] {
        agree(name, glimpse::scene::builtin(name).expect("a built-in scene"));
    }
}

#[test]
fn shared_scenes() {
    for file in ["japanese_classroom.glb", "vr_bunny.glb"] {
        let Some(scene) = shared_scene(file) else { continue };
        agree(file, scene);
    }
}
