//! The reference's path tracer against closed forms, and its direct light strategies against each other.

mod eyes;
mod light;
mod microfacets;

use std::f64::consts::PI;

use glam::{DVec3, Vec3, vec3};
use glimpse::{
    DirectLight, Foveation, LightSelection, Roulette, Sampler, Scene, Settings,
    reference::{PathSample, Reference, ReferenceFrame, Rounding},
    scene::{Light, LightKind, Material, Weights, builtin},
};
use glimpse_tests::{
    builder::{Builder, flattened, front_camera, glass, matte, mirror, unlit},
    gallery,
};

const WAYS: [DirectLight; 3] = [DirectLight::Bsdf, DirectLight::Nee, DirectLight::Mis];

/// Independent random numbers, as standard errors are estimated from samples; no roulette.
fn settings(direct_light: DirectLight, depth: u32) -> Settings {
    let mut settings = Settings { depth, ..Settings::default() };
    (settings.paths.direct_light, settings.paths.sampler) = (direct_light, Sampler::Random);
    settings.paths.roulette = Roulette::Off;
    settings
}

/// Calls `see` for each sample of each pixel.
fn for_each(
    scene: &Scene,
    settings: &Settings,
    size: [u32; 2],
    samples: u32,
    mut see: impl FnMut([u32; 2], PathSample),
) {
    let reference = Reference::new(scene);
    let camera = *scene.camera(None).expect("a camera");
    let frame = ReferenceFrame { reference: &reference, camera, size, settings: *settings };
    for pixel in (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y])) {
        for sample in 0..samples {
            see(pixel, frame.path(pixel, sample, &mut Rounding::none()));
        }
    }
}

/// Accumulates a mean and its squared standard error.
#[derive(Clone, Copy, Default)]
struct Mean {
    count: f64,
    sum: DVec3,
    squares: DVec3,
}

impl Mean {
    fn add(&mut self, x: DVec3) {
        self.count += 1.0;
        self.sum += x;
        self.squares += x * x;
    }

    fn value(&self) -> DVec3 {
        self.sum / self.count
    }

    fn error2(&self) -> DVec3 {
        (self.squares / self.count - self.value() * self.value()).max(DVec3::ZERO) / self.count
    }

    /// Largest difference of a channel in standard errors; rounding does not count.
    fn deviation(&self, value: DVec3, error2: DVec3) -> f64 {
        let difference = (self.value() - value).abs() - 1e-6 * value.abs();
        (difference.max(DVec3::ZERO) / (self.error2() + error2 + 1e-30).map(f64::sqrt)).max_element()
    }
}

fn mean(scene: &Scene, settings: &Settings, samples: u32) -> Mean {
    let mut mean = Mean::default();
    for_each(scene, settings, [5, 5], samples, |_, path| mean.add(path.radiance));
    mean
}

/// A closed box around the origin that emits everywhere and scatters and mirrors the given shares of light.
fn emitting_box([diffuse, mirror]: [f64; 2], emission: f64) -> Scene {
    let mut b = Builder::new();
    let weights = Some(Weights { diffuse: diffuse as f32, mirror: mirror as f32, refraction: 0.0 });
    let emission = Vec3::splat(emission as f32);
    let walls = b.object(Material { emission, weights, ..matte(Vec3::ONE) });
    let (low, high, [x, y, z]) = (Vec3::splat(-3.0), Vec3::splat(3.0), Vec3::AXES.map(|axis| 6.0 * axis));
    for [u, v] in [[x, y], [y, z], [z, x]] {
        b.quad(walls, low, u, v);
        b.quad(walls, high, -v, -u);
    }
    b.seen_by(front_camera())
}

#[test]
fn a_furnace_is_one_in_every_sample() {
    // Flat shading, as bent normals lose light from below the face; and smooth metal, as rough lobes are right only in
    // the mean.
    let mut scene = flattened(builtin("furnace").unwrap());
    scene.materials.iter_mut().for_each(|m| m.roughness = 0.0);
    for roulette in [Roulette::On, Roulette::Off] {
        let mut settings = settings(DirectLight::Bsdf, 64);
        settings.paths.roulette = roulette;
        for_each(&scene, &settings, [48, 32], 2, |pixel, path| {
            // The scene's numbers are f32.
            assert!((path.radiance - 1.0).abs().max_element() < 1e-6, "{pixel:?}: {path:?}");
        });
    }
}

/// With rough metal, in the mean of all pixels; the table of albedos is interpolated.
#[test]
fn a_furnace_with_rough_metal_is_one_in_the_mean() {
    let scene = flattened(builtin("furnace").unwrap());
    let mut mean = Mean::default();
    for_each(&scene, &settings(DirectLight::Bsdf, 64), [48, 32], 16, |_, path| mean.add(path.radiance));
    let error = mean.error2().map(f64::sqrt).max_element();
    assert!(error < 1e-3, "{error}");
    assert!((mean.value() - 1.0).abs().max_element() < 4.0 * error + 1e-4, "{} {error}", mean.value());
}

/// Every bounce adds a share of the emission: e (1 + a + a^2 ...) = e / (1 - a), up to the depth limit.
#[test]
fn energy_is_conserved_in_a_closed_box() {
    let (emission, depth) = (2.0, 12);
    for shares in [[0.75, 0.0], [0.5, 0.25]] {
        let scene = emitting_box(shares, emission);
        let albedo: f64 = shares.iter().sum();
        let expected = DVec3::splat(emission * (1.0 - albedo.powi(depth)) / (1.0 - albedo));
        let walk = settings(DirectLight::Bsdf, depth as u32);
        for_each(&scene, &walk, [5, 5], 4, |pixel, path| {
            assert!((path.radiance - expected).abs().max_element() < 1e-6, "{pixel:?}: {path:?}");
            assert!(!path.stopped);
        });
        let both = settings(DirectLight::Mis, depth as u32);
        let (mut roulette, mut four) = (walk, both);
        roulette.paths.roulette = Roulette::On;
        four.paths.light_samples = 4;
        for (name, settings) in [("roulette", roulette), ("both", both), ("four points", four)] {
            let found = mean(&scene, &settings, 1000);
            assert!(found.error2().max_element().sqrt() < 0.01 * expected.x, "{name}");
            let deviation = found.deviation(expected, DVec3::ZERO);
            assert!(deviation < 4.0, "{name} {shares:?}: {} not {expected}, {deviation}", found.value());
        }
    }
}

/// Light that the paper's stopping leaves in a closed box: of the light from beyond k vertices where paths
/// may stop, (1 - P)^k, where P grows with the distance from the gaze, to `foveation_max` in the farthest
/// corner.
#[test]
fn stopped_paths_are_as_dark_as_equation_7_says() {
    let (albedo, emission, depth) = (0.75_f64, 2.0, 12);
    let scene = emitting_box([albedo, 0.0], emission);
    for (foveation, gaze) in
        [(Foveation::Paper, [0.5; 2]), (Foveation::Paper, [-1.0, 0.25]), (Foveation::Compensated, [0.5; 2])]
    {
        let mut settings = settings(DirectLight::Bsdf, depth);
        (settings.paths.foveation, settings.paths.gaze) = (foveation, gaze);
        // A compensated sample has finite variance if albedo^2 < 1 - p, and few samples estimate that
        // variance only if p is far below that bound.
        settings.paths.foveation_max = if foveation == Foveation::Paper { 0.9 } else { 0.3 };
        let size = [5, 3];
        let mut pixels = [[Mean::default(); 5]; 3];
        let mut stopped = [[0; 5]; 3];
        for_each(&scene, &settings, size, 4000, |[x, y], path| {
            pixels[y as usize][x as usize].add(path.radiance);
            stopped[y as usize][x as usize] += u32::from(path.stopped);
        });
        let [gx, gy] = [0, 1].map(|i| f64::from(gaze[i]) * f64::from(size[i]));
        let farthest = (5.0 - gx).max(gx).hypot((3.0 - gy).max(gy));
        for (x, y) in (0..5).flat_map(|x| (0..3).map(move |y| (x, y))) {
            let away = (x as f64 + 0.5 - gx).hypot(y as f64 + 0.5 - gy);
            let stop = if foveation == Foveation::Paper { 0.9 * away / farthest } else { 0.0 };
            let left = |level: i32| (1.0 - stop).powi((level - 2 - 1).max(0));
            let levels = (1..=depth as i32).map(|level| albedo.powi(level - 1) * left(level));
            let expected = DVec3::splat(emission * levels.sum::<f64>());
            let found = &pixels[y][x];
            let deviation = found.deviation(expected, DVec3::ZERO);
            assert!(deviation < 4.0, "{foveation:?} {x},{y}: {} not {expected}", found.value());
            assert_eq!(stopped[y][x] > 0, away > 0.0, "{foveation:?} {x},{y}");
        }
    }
}

/// A directional light: every sample has radiance albedo / pi x E x cos.
#[test]
fn punctual_lights_shine_where_they_are_wished_and_nothing_is_between() {
    let glow = vec3(0.25, 0.5, 1.0);
    let scene = |shaded: bool| {
        let mut b = Builder::new();
        let floor = b.object(Material { emission: glow, ..matte(Vec3::splat(0.5)) });
        b.quad(floor, vec3(-9.0, -9.0, 0.0), 18.0 * Vec3::X, 18.0 * Vec3::Y);
        let kind = LightKind::Directional { direction: vec3(0.6, 0.0, -0.8) };
        b.light(Light { kind, intensity: Vec3::splat(4.0), radius: 0.0 });
        if shaded {
            let sheet = b.object(matte(Vec3::ZERO));
            b.quad(sheet, vec3(-40.0, -40.0, 9.0), 80.0 * Vec3::X, 80.0 * Vec3::Y);
        }
        b.seen_by(front_camera())
    };
    let (glow, lit) = (glow.as_dvec3(), DVec3::splat(0.5 / PI * 4.0 * 0.8));
    let ways = [
        (false, LightSelection::All, 1, glow),
        (false, LightSelection::All, 2, glow + lit),
        (false, LightSelection::Punctual, 2, glow + lit),
        (false, LightSelection::Emitters, 2, glow),
        (true, LightSelection::All, 2, glow),
    ];
    for (shaded, lights, depth, expected) in ways {
        let mut settings = settings(DirectLight::Mis, depth);
        settings.paths.lights = lights;
        for_each(&scene(shaded), &settings, [3, 3], 2, |pixel, path| {
            let wrong = (path.radiance - expected).abs().max_element();
            assert!(wrong < 1e-6, "{lights:?} {pixel:?}: {path:?} instead of {expected}");
        });
    }
}

#[test]
fn paths_say_whether_they_met_mirrors_or_glass() {
    for (material, diffuse_only) in
        [(mirror(Vec3::ONE), false), (glass(1.5), false), (matte(Vec3::ONE), true), (unlit(Vec3::ONE), true)]
    {
        let mut b = Builder::new();
        let wall = b.object(material);
        b.quad(wall, vec3(-9.0, -9.0, 0.0), 18.0 * Vec3::X, 18.0 * Vec3::Y);
        b.environment(Vec3::ONE, Vec3::ZERO);
        for_each(&b.seen_by(front_camera()), &settings(DirectLight::Mis, 4), [3, 3], 4, |_, path| {
            assert_eq!(path.diffuse_only, diffuse_only);
            assert!((path.radiance - 1.0).abs().max_element() < 1e-6, "{path:?}");
        });
    }
}

/// All kinds of materials, textures and lights, with and without emitters.
#[test]
fn every_sample_is_a_number() {
    for scene in [gallery::textures(), gallery::glasshouse(), builtin("room").unwrap()] {
        for direct_light in WAYS {
            let mut settings = settings(direct_light, 16);
            (settings.paths.roulette, settings.paths.foveation) = (Roulette::On, Foveation::Compensated);
            for_each(&scene, &settings, [24, 16], 2, |pixel, path| {
                let fine = path.radiance.is_finite() && path.radiance.min_element() >= 0.0;
                assert!(fine, "{direct_light:?} {pixel:?}: {path:?}");
            });
        }
    }
}
