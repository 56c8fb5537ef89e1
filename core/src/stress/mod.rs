//! Stiff and extreme cases against [`crate::reference`]: what `glimpse stress` runs.
//!
//! A [`Case`] is one row of its table: a construction, a number of rays, what must hold. Its [`Outcome`] counts every
//! answer that is not the reference's: as a failure, or under the cause that explains it. Nothing is masked.

mod camera;
mod coplanar;
mod critical;
mod directions;
mod grazing;
mod lights;
mod mesh;
mod recursion;
mod scale_mix;
mod self_hits;
mod slivers;
mod time;
mod tolerances;
mod touching;
mod trees;
mod vertices;
mod watertight;

pub use crate::random::Random;

use glam::{DVec3, Vec3};

use crate::{
    Gpu, GpuScene, Result, Robustness, Scene, Settings,
    probe::{Probe, ProbeHit, ProbeRay},
    reference::{Hit, Tracer, Verdict},
    scene::Material,
};

/// The device and the parameters of a run of stress cases.
pub struct Bench<'a> {
    /// The device under test.
    pub gpu: &'a Gpu,
    /// About as many rays (samples, evaluations) as the case shall use.
    pub rays: u64,
    /// Seed of the random rays.
    pub seed: u64,
    /// The measures that are linked; all of them, unless it is to be seen what one is good for.
    pub robustness: Robustness,
}

/// A stress case: a row of the table.
pub struct Case {
    /// The name that selects the case.
    pub name: &'static str,
    /// How the inputs of the case are constructed.
    pub construction: &'static str,
    /// The condition under which the case passes.
    pub rule: &'static str,
    /// Runs the case.
    pub run: fn(&Bench<'_>) -> Result<Outcome>,
}

/// The result of a case.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Outcome {
    /// Rays (samples, evaluations) that were judged.
    pub rays: u64,
    /// Number of differences from the reference that rounding does not explain.
    pub failures: u64,
    /// Answers that differ from the reference for a known cause, by cause.
    pub explained: Vec<Explained>,
    /// The first failure, with all that is needed to repeat it.
    pub worst: Option<String>,
    /// A hash of the answers, where they are the same on every adapter.
    pub digest: Option<String>,
}

/// Differences that have the same explanation.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Explained {
    /// The explanation.
    pub cause: &'static str,
    /// Number of differences.
    pub count: u64,
}

impl Outcome {
    /// Counts a judged answer that is right.
    pub fn pass(&mut self) {
        self.rays += 1;
    }

    /// Counts an answer that is not the reference's for a known cause.
    pub fn explain(&mut self, cause: &'static str) {
        self.rays += 1;
        match self.explained.iter_mut().find(|e| e.cause == cause) {
            Some(known) => known.count += 1,
            None => self.explained.push(Explained { cause, count: 1 }),
        }
    }

    /// Counts a wrong answer; `replay` says how to get it again.
    pub fn fail(&mut self, replay: impl FnOnce() -> String) {
        self.rays += 1;
        self.failures += 1;
        self.worst.get_or_insert_with(replay);
    }

    /// Counts one answer, and keeps the first wrong one for replay.
    pub fn check(&mut self, right: bool, replay: impl FnOnce() -> String) {
        if right { self.pass() } else { self.fail(replay) }
    }
}

/// Every case, in the order of the table.
pub const CASES: [Case; 16] = [
    watertight::CASE,
    vertices::CASE,
    slivers::CASE,
    scale_mix::CASE,
    self_hits::CASE,
    grazing::CASE,
    critical::CASE,
    coplanar::CASE,
    directions::CASE,
    recursion::CASE,
    touching::CASE,
    camera::CASE,
    trees::CASE,
    tolerances::CASE,
    lights::CASE,
    time::CASE,
];

impl Bench<'_> {
    fn upload(&self, scene: Scene) -> Result<GpuScene> {
        GpuScene::upload(self.gpu, scene)
    }

    fn probe<'a>(&'a self, scene: &'a GpuScene) -> Probe<'a> {
        Probe::new(self.gpu, scene, self.robustness)
    }
}

/// A ray through two points, both rounded to f32 first.
fn ray_through(eye: DVec3, target: DVec3) -> ProbeRay {
    let eye = eye.as_vec3();
    ray(eye.as_dvec3(), target.as_vec3().as_dvec3() - eye.as_dvec3())
}

/// A ray of unlimited length, rounded to f32.
fn ray(origin: DVec3, direction: DVec3) -> ProbeRay {
    let (origin, direction) = (origin.as_vec3(), direction.as_vec3());
    ProbeRay { origin: origin.into(), t_max: 3.0e38, direction: direction.into(), ..ProbeRay::default() }
}

/// Settings under which strong lights are not exposed: cases know the radiance that their scenes emit.
fn unexposed() -> Settings {
    Settings { exposure: Some(0.0), ..Settings::default() }
}

fn matte() -> Material {
    Material::default()
}

/// Half of the light passes straight on, the other half is lost.
fn thin_pane() -> Material {
    Material {
        base_color: Vec3::splat(0.5),
        metallic: 0.0,
        roughness: 0.0,
        transmission: 1.0,
        ior: 1.0,
        thin: true,
        casts_shadow: false,
        ..Material::default()
    }
}

/// The attributes of a hit that are compared with the reference.
fn answer(hit: &ProbeHit, length: f64) -> Option<Hit> {
    (hit.primitive != ProbeHit::MISS).then(|| Hit { object: hit.object, t: f64::from(hit.t) * length })
}

/// In how many units in the last place of its distance an answer that is not the reference's is right.
const WITHIN: [f64; 4] = [1.0, 2.0, 4.0, 8.0];
const TIES: [&str; 4] = [
    "two surfaces within 1 ulp of their distance",
    "two surfaces within 2 ulp of their distance",
    "two surfaces within 4 ulp of their distance",
    "two surfaces within 8 ulp of their distance",
];
const EDGES: [&str; 4] = [
    "an edge within 1 ulp of its distance from the ray",
    "an edge within 2 ulp of its distance from the ray",
    "an edge within 4 ulp of its distance from the ray",
    "an edge within 8 ulp of its distance from the ray",
];

/// Compares the shader's hits with those of the reference.
fn judge(
    outcome: &mut Outcome,
    tracer: &Tracer,
    rays: &[ProbeRay],
    hits: &[ProbeHit],
    replay: impl Fn() -> String,
) {
    for (ray, hit) in rays.iter().zip(hits) {
        let (along, length) = ray.exact();
        let said = answer(hit, length);
        if said.is_some_and(|s| s.t.is_infinite()) {
            let first = tracer.nearest(&along);
            let beyond = first.is_some_and(|f| f.object == hit.object && f.t / length > f64::from(f32::MAX));
            match beyond {
                true => outcome.explain("the hit's parameter is beyond f32"),
                false => outcome.fail(|| format!("{}: {ray:?}: {hit:?}", replay())),
            }
            continue;
        }
        let verdict = tracer.judge(&along, said);
        let tier = || {
            let right = |ulps: &f64| tracer.judge_within(&along, said, *ulps) == verdict;
            WITHIN.iter().position(right).unwrap_or(WITHIN.len() - 1)
        };
        match &verdict {
            Verdict::Same => outcome.pass(),
            Verdict::Tie => outcome.explain(TIES[tier()]),
            Verdict::Explained => outcome.explain(EDGES[tier()]),
            Verdict::Wrong(line) => outcome.fail(|| format!("{}: {ray:?}: {line}", replay())),
        }
    }
}
