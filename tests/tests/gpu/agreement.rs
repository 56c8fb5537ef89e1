//! Every pass against the f64 reference: what differs beyond rounding must be explained, and hardly anything may need it.

use std::sync::OnceLock;

use glam::{DVec3, Vec3};
use glimpse::{
    Inspection, LinearImage, Method, PixelRecord, Renderer, Robustness, Scene, Settings,
    probe::{Probe, ProbeHit, ProbeRay, ProbeSample, ProbeSpawn},
    reference::{Attributes, Frame, Limits, Ray, Reference, Rounding, SPAWN_ULPS},
    scene::{OCTAHEDRAL_ERROR, builtin},
    stress::Random,
};
use glimpse_tests::{
    Stage,
    agreement::{Answer, Outcome, Tally, judge},
    gallery, gpu, note, turn,
};

/// Of pixels and rays these shares may be sensitive to rounding, and ties.
const SHARES: [f64; 2] = [0.03, 0.005];
/// Random rays a scene.
const RAYS: usize = 100_000;
/// Two units in the last place.
const EPSILON: f64 = 1.0 / 4_194_304.0;
/// Stored normals are so far off, and computed ones a little more.
const NORMAL: f64 = 1.5 * OCTAHEDRAL_ERROR as f64;

/// A scene on the device and in f64.
struct Pair {
    stage: Stage,
    reference: Reference,
    size: [u32; 2],
    settings: Settings,
}

/// A frame by the device, and the question to the reference what its pixels should be.
struct Frames<'a> {
    frame: Frame<'a>,
    linear: LinearImage,
    inspection: Inspection,
}

impl Pair {
    fn new(scene: Scene, size: [u32; 2], settings: Settings) -> Self {
        let reference = Reference::new(&scene).with_srgb(*srgb());
        Self { stage: Stage::new(scene), reference, size, settings }
    }

    fn frames(&self, method: Method) -> Frames<'_> {
        let settings = Settings { method, ..self.settings };
        let (stage, turn) = (&self.stage, turn());
        let mut renderer =
            Renderer::new(gpu(), &stage.scene, self.size, &settings).expect("the kernels compile");
        let linear = renderer.linear_image(&stage.camera).expect("the frame renders");
        let inspection = renderer.inspect(&stage.camera).expect("the frame is counted");
        drop(turn);
        Frames {
            frame: Frame { reference: &self.reference, camera: self.stage.camera, size: self.size, settings },
            linear,
            inspection,
        }
    }
}

impl Frames<'_> {
    fn pixels(&self) -> Vec<[u32; 2]> {
        let [width, height] = self.frame.size;
        (0..height).flat_map(|y| (0..width).map(move |x| [x, y])).collect()
    }

    fn tally(&self, judge: impl Fn([u32; 2]) -> Outcome + Sync) -> Tally {
        Tally::of(&self.pixels(), |pixel| match judge(*pixel) {
            Outcome::Wrong(line) => Outcome::Wrong(format!("{pixel:?}: {line}")),
            outcome => outcome,
        })
    }

    fn record(&self, [x, y]: [u32; 2]) -> &PixelRecord {
        &self.inspection.pixels[(y * self.frame.size[0] + x) as usize]
    }

    fn found_color(&self, [x, y]: [u32; 2]) -> Answer<3> {
        let pixel = self.linear.get_pixel(x, y).0.map(f64::from);
        Answer::radiance(DVec3::from_array(pixel))
    }

    /// Object, depth and normal of the first hit.
    fn found_hit(&self, pixel: [u32; 2]) -> Answer<4> {
        let record = self.record(pixel);
        let normal = Vec3::from(record.normal).as_dvec3();
        self.hit(pixel, record.object, f64::from(record.depth), normal)
    }

    fn exact_hit(&self, pixel: [u32; 2], a: &Attributes) -> Answer<4> {
        self.hit(pixel, a.object, a.depth, a.normal)
    }

    fn hit(&self, pixel: [u32; 2], object: Option<u32>, depth: f64, normal: DVec3) -> Answer<4> {
        let (ray, length) = self.frame.ray(pixel);
        let span = self.reference_span(&ray) / length;
        Answer {
            labels: [object.map_or(0, |o| o + 1), 0],
            values: [depth, normal.x, normal.y, normal.z],
            tolerances: [8.0 * EPSILON * span, NORMAL, NORMAL, NORMAL],
        }
    }

    /// The size of the numbers that a distance along a ray is computed from.
    fn reference_span(&self, ray: &Ray) -> f64 {
        ray.origin.abs().max_element() + self.frame.reference.longest_side()
    }

    fn traced_colors(&self) -> Tally {
        self.tally(|p| judge(&self.found_color(p), |r| Answer::radiance(self.frame.traced(p, r).color)))
    }

    fn traced_hits(&self) -> Tally {
        self.tally(|p| judge(&self.found_hit(p), |r| self.exact_hit(p, &self.frame.traced(p, r).attributes)))
    }

    /// Which checks fail, given how the pixels of the earlier steps came to be.
    fn decisions(&self) -> Tally {
        self.tally(|p| {
            let bits = |failed| Answer::<0> { labels: [failed, 0], values: [], tolerances: [] };
            judge(&bits(self.record(p).failed), |r| {
                bits(self.frame.adaptive(p, Some(&|q| self.record(q).origin), r).failed)
            })
        })
    }

    fn adaptive_hits(&self) -> Tally {
        self.tally(|p| {
            judge(&self.found_hit(p), |r| {
                self.exact_hit(p, &self.frame.adaptive(p, Some(&|q| self.record(q).origin), r).attributes)
            })
        })
    }

    fn adaptive_colors(&self) -> Tally {
        self.tally(|p| {
            judge(&self.found_color(p), |r| {
                Answer::radiance(self.frame.adaptive(p, Some(&|q| self.record(q).origin), r).color)
            })
        })
    }

    /// The adaptive frame that the reference makes on its own: pixels that came to be in another way.
    fn other_origins(&self) -> usize {
        let other = self.tally(|p| {
            let same = self.frame.adaptive(p, None, &mut Rounding::none()).origin == self.record(p).origin;
            if same { Outcome::Same(0.0) } else { Outcome::Wrong(String::new()) }
        });
        other.wrong.len()
    }
}

/// The device's linear values of the bytes of sRGB.
fn srgb() -> &'static [f64; 256] {
    static TABLE: OnceLock<[f64; 256]> = OnceLock::new();
    TABLE.get_or_init(|| {
        let stage = Stage::new(gallery::greys());
        let rays: Vec<_> = (0..256)
            .map(|i| ProbeRay {
                origin: [i as f32 + 0.5, 0.5, 1.0],
                t_max: 10.0,
                direction: [0.0, 0.0, -1.0],
                any: 0,
            })
            .collect();
        let seen = shade(&stage, &rays, &Settings::default());
        std::array::from_fn(|i| f64::from(seen[i].color[0]))
    })
}

/// Graphics interfaces grant half a step of the byte.
#[test]
fn srgb_is_decoded_within_half_a_byte() {
    let exact = |byte: f64| {
        let c = byte / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    let mut worst = 0.0_f64;
    for (byte, found) in srgb().iter().enumerate() {
        let byte = byte as f64;
        worst = worst.max((found - exact(byte)).abs());
        let (low, high) = (exact((byte - 0.5).max(0.0)), exact((byte + 0.5).min(255.0)));
        assert!((low..=high).contains(found), "byte {byte} is {found}, exactly {}", exact(byte));
    }
    note(&format!("sRGB: largest error {worst:.1e}"));
}

fn shade(stage: &Stage, rays: &[ProbeRay], settings: &Settings) -> Vec<ProbeSample> {
    let _turn = turn();
    Probe::new(gpu(), &stage.scene, Robustness::default()).shade(rays, settings).expect("the rays are shaded")
}

fn spawn(stage: &Stage, rays: &[ProbeRay]) -> Vec<ProbeSpawn> {
    let _turn = turn();
    Probe::new(gpu(), &stage.scene, Robustness::default()).spawn(rays).expect("the rays arrive")
}

fn random_rays(stage: &Stage) -> Vec<ProbeRay> {
    let (low, high) = stage.scene.bounds();
    let mut random = Random(5);
    std::iter::repeat_with(|| {
        let origin = random.inside(low.as_dvec3(), high.as_dvec3()).as_vec3();
        let direction = random.direction().as_vec3();
        ProbeRay { origin: origin.to_array(), t_max: 1e30, direction: direction.to_array(), any: 0 }
    })
    .take(RAYS)
    .collect()
}

/// The same ray, and the factor from its parameter to a distance.
fn exact(ray: &ProbeRay) -> (Ray, f64) {
    let direction = DVec3::from_array(ray.direction.map(f64::from));
    let origin = DVec3::from_array(ray.origin.map(f64::from));
    (Ray { origin, direction: direction.normalize(), t_max: f64::INFINITY }, direction.length())
}

fn vector(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

/// What random rays see, with everything that follows from them.
fn seen(pair: &Pair) -> Tally {
    let rays = random_rays(&pair.stage);
    let samples = shade(&pair.stage, &rays, &pair.settings);
    let items: Vec<_> = rays.iter().zip(&samples).collect();
    let limits = Limits::of(&pair.settings);
    Tally::of(&items, |(ray, sample)| {
        let found =
            Answer { labels: [sample.object, sample.shadow], ..Answer::radiance(vector(sample.color)) };
        let outcome = judge(&found, |r| {
            let exact = pair.reference.sample(&exact(ray).0, &limits, r);
            let a = exact.attributes;
            Answer { labels: [a.object.map_or(0, |o| o + 1), a.shadow], ..Answer::radiance(exact.color) }
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

/// Where random rays arrive: place, shading normal, normal of the face, side.
fn arrived(pair: &Pair) -> Tally {
    let rays = random_rays(&pair.stage);
    let spawned = spawn(&pair.stage, &rays);
    let items: Vec<_> = rays.iter().zip(&spawned).collect();
    let side = pair.reference.longest_side();
    let answer = |labels, [position, normal, face]: [DVec3; 3]| {
        let values: Vec<f64> = [position, normal, face].iter().flat_map(|v| v.to_array()).collect();
        let mut tolerances = [16.0 * EPSILON; 9];
        tolerances[..3].fill(16.0 * EPSILON * side);
        Answer::<9> { labels, values: values.try_into().expect("nine numbers"), tolerances }
    };
    Tally::of(&items, |(ray, s)| {
        let met = s.primitive != ProbeHit::MISS;
        let labels = [if met { s.object + 1 } else { 0 }, s.inside];
        let found = answer(labels, [s.position, s.normal, s.face].map(vector));
        let outcome = judge(&found, |r| {
            let ray = exact(ray).0;
            match pair.reference.first(&ray, None, false, r) {
                None => answer([0; 2], [DVec3::ZERO; 3]),
                Some(crossing) => {
                    let s = pair.reference.surface(&ray, &crossing, r);
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

/// New rays start on their side of the face, and no farther from it than the reference's displacement of them.
fn off_its_surface(s: &ProbeSpawn, side: f64) -> bool {
    let (face, position) = (vector(s.face), vector(s.position));
    let [above, below] = [s.above, s.below].map(|o| (vector(o) - position).dot(face));
    let most = SPAWN_ULPS / 2.0 * EPSILON * 4.0 * side;
    s.primitive == ProbeHit::MISS || (0.0 < above && above < most && -most < below && below < 0.0)
}

fn agree(name: &str, scene: Scene, size: [u32; 2], settings: Settings) {
    let pair = Pair::new(scene, size, settings);
    let full = pair.frames(Method::Full);
    full.traced_hits().check(&format!("{name}, full, hits"), SHARES);
    full.traced_colors().check(&format!("{name}, full, radiance"), SHARES);
    let adaptive = pair.frames(Method::Adaptive);
    adaptive.decisions().check(&format!("{name}, adaptive, checks"), SHARES);
    adaptive.adaptive_hits().check(&format!("{name}, adaptive, attributes"), SHARES);
    adaptive.adaptive_colors().check(&format!("{name}, adaptive, radiance"), SHARES);
    let other = adaptive.other_origins();
    note(&format!("{name}, adaptive: {other} pixels come to be in another way in f64 alone"));
    arrived(&pair).check(&format!("{name}, rays, surfaces"), SHARES);
    seen(&pair).check(&format!("{name}, rays, radiance"), SHARES);
}

fn built_in(name: &str) -> Scene {
    builtin(name).expect("a built-in scene")
}

#[test]
fn room() {
    agree("room", built_in("room"), [97, 61], Settings::default());
}

/// Of odd height: else the corners of the box lie on the diagonals that pixels lie on.
#[test]
fn cornell() {
    agree("cornell", built_in("cornell"), [96, 61], Settings::default());
}

#[test]
fn minray() {
    agree("minray", built_in("minray"), [65, 64], Settings::default());
}

#[test]
fn furnace() {
    agree("furnace", built_in("furnace"), [95, 63], Settings::default());
}

#[test]
fn textures() {
    agree("textures", gallery::textures(), [128, 85], Settings::default());
}

#[test]
fn glasshouse() {
    let settings = Settings { depth: 6, min_weight: 0.01, ..Settings::default() };
    agree("glasshouse", gallery::glasshouse(), [101, 67], settings);
}

#[test]
fn orthographic() {
    agree("orthographic", gallery::orthographic(), [83, 71], Settings::default());
}
