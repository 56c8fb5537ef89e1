//! Path tracing against the reference: sample by sample with the same numbers, and in the mean with others.

use glam::{DVec3, Vec3, vec3};
use glimpse::{
    Direct, LinearImage, Linking, Method, Renderer, Roulette, Sampler, Settings, Shining, Stopping,
    reference::{Frame, Reference, Rounding},
    scene::builtin,
};
use glimpse_tests::{
    Stage,
    builder::{Builder, flattened, front_camera, matte},
    gpu, note,
};

use super::agreement::srgb;

/// Neither side is a multiple of a tile's.
const SIZE: [u32; 2] = [75, 42];

fn settings() -> Settings {
    Settings { method: Method::Path, depth: Method::Path.usual_depth(), ..Settings::default() }
}

fn with(change: impl FnOnce(&mut glimpse::Paths)) -> Settings {
    let mut settings = settings();
    change(&mut settings.paths);
    settings
}

/// The mean of this many samples of each pixel.
fn mean(stage: &Stage, settings: &Settings, samples: u32) -> LinearImage {
    let mut renderer = Renderer::new(gpu(), &stage.scene, SIZE, settings).expect("a renderer");
    // A picture of nothing yet has one.
    for _ in 0..if samples > 1 { samples } else { 0 } {
        renderer.render(&stage.camera).expect("a frame");
    }
    assert_eq!(renderer.samples(), samples);
    renderer.linear_image(&stage.camera).expect("a picture")
}

fn color(image: &LinearImage, [x, y]: [u32; 2]) -> DVec3 {
    DVec3::from(image.get_pixel(x, y).0.map(f64::from))
}

fn pixels() -> impl Iterator<Item = [u32; 2]> {
    (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]))
}

/// A path is a chain of decisions: where f32 takes another turn than f64, everything behind it differs. Everywhere else one
/// sample is the same but for rounding.
#[test]
fn a_sample_is_that_of_the_reference() {
    let ways = [
        with(|_| {}),
        with(|paths| (paths.direct, paths.sampler) = (Direct::Walk, Sampler::Random)),
        with(|paths| (paths.direct, paths.light_samples) = (Direct::Light, 3)),
        Settings { depth: 6, ..with(|p| (p.shining, p.roulette) = (Shining::Emitters, Roulette::Off)) },
        with(|paths| paths.shining = Shining::Punctual),
        with(|paths| (paths.stopping, paths.gaze) = (Stopping::Compensated, [0.2, 0.9])),
        with(|paths| (paths.stopping, paths.gaze) = (Stopping::Paper, [2.0, -1.0])),
    ];
    // Texels' weights have few bits in f32, and a path meets several.
    for (name, tolerance, ways) in
        [("cornell", 1e-3, &ways[..]), ("room", 1e-2, &ways[..2]), ("minray", 1e-3, &ways[4..5])]
    {
        let scene = builtin(name).expect("built in");
        let (reference, stage) = (Reference::new(&scene).with_srgb(*srgb()), Stage::new(scene));
        for &settings in ways {
            let found = mean(&stage, &settings, 1);
            let frame = Frame { reference: &reference, camera: stage.camera, size: SIZE, settings };
            let differs = |&pixel: &[u32; 2]| {
                let right = frame.path(pixel, 0, &mut Rounding::none()).radiance;
                let found = color(&found, pixel);
                assert!(found.is_finite() && found.min_element() >= 0.0, "{name} {pixel:?}: {found}");
                (found - right).length() > tolerance * (right.length() + 0.01)
            };
            let share = pixels().filter(differs).count() as f64 / pixels().count() as f64;
            note(&format!("{name}: {share:.4} of the paths took another turn, {:?}", settings.paths));
            assert!(share < 0.02, "{name}: {share} {:?}", settings.paths);
        }
    }
}

/// With other numbers the means differ by noise alone: those of blocks of pixels, over so many samples that rare bright ones
/// are among them, by less than five standard errors.
#[test]
fn the_mean_is_that_of_the_reference() {
    const SAMPLES: u32 = 64;
    const BLOCKS: [u32; 2] = [5, 3];
    for name in ["cornell", "room"] {
        let scene = builtin(name).expect("built in");
        let (reference, stage) = (Reference::new(&scene).with_srgb(*srgb()), Stage::new(scene));
        let random = with(|paths| paths.sampler = Sampler::Random);
        let found = mean(&stage, &random, SAMPLES);
        let other = Settings { seed: 1, ..random };
        let frame = Frame { reference: &reference, camera: stage.camera, size: SIZE, settings: other };
        let mut blocks = [[0.0_f64; 2]; (BLOCKS[0] * BLOCKS[1]) as usize];
        for pixel in pixels() {
            let samples: Vec<f64> = (0..SAMPLES)
                .map(|sample| frame.path(pixel, sample, &mut Rounding::none()).radiance.element_sum())
                .collect();
            let count = f64::from(SAMPLES);
            let right = samples.iter().sum::<f64>() / count;
            let squares: f64 = samples.iter().map(|x| (x - right).powi(2)).sum();
            let [x, y] = [0, 1].map(|axis| pixel[axis] * BLOCKS[axis] / SIZE[axis]);
            let [difference, variance] = &mut blocks[(y * BLOCKS[0] + x) as usize];
            *difference += color(&found, pixel).element_sum() - right;
            // Of both means.
            *variance += 2.0 * squares / (count - 1.0) / count;
        }
        let zs = blocks.map(|[difference, variance]| difference / variance.sqrt().max(1e-6));
        note(&format!("{name}: z of blocks of pixels {zs:.1?}"));
        assert!(zs.iter().all(|z| z.abs() < 5.0), "{name}: {zs:?}");
    }
}

/// Bent normals lose what comes from below the face, and rays to emitters bring as much in the mean alone.
#[test]
fn in_a_furnace_every_path_brings_the_same() {
    let stage = Stage::new(flattened(builtin("furnace").expect("built in")));
    for roulette in Roulette::ALL {
        let image = mean(&stage, &with(|p| (p.direct, p.roulette) = (Direct::Walk, roulette)), 3);
        let off = image.as_raw().iter().map(|v| (v - 1.0).abs()).fold(0.0, f32::max);
        assert!(off <= 1e-5, "{roulette:?}: {off}");
    }
}

#[test]
fn samples_add_up_while_the_camera_rests() {
    let stage = Stage::builtin("cornell");
    let make = || Renderer::new(gpu(), &stage.scene, SIZE, &with(|p| p.samples = 3)).expect("a renderer");
    let shown = |renderer: &Renderer| renderer.display_image().expect("a picture");
    let mut renderer = make();
    let mut first = Vec::new();
    for samples in 1..=3 {
        assert!(!renderer.is_settled());
        renderer.render(&stage.camera).expect("a frame");
        assert_eq!(renderer.samples(), samples);
        first.push(shown(&renderer));
        // Counting changes nothing.
        let counts = renderer.inspect(&stage.camera).expect("counts").counts;
        assert_eq!(counts.rays.primary, u64::from(SIZE[0] * SIZE[1]));
        assert!(counts.rays.diffuse > 0 && counts.rays.total > counts.rays.primary + counts.rays.diffuse);
    }
    assert!(renderer.is_settled());
    assert!(first[0] != first[1] && first[1] != first[2]);
    let elsewhere = stage.camera.panned(3.0);
    renderer.render(&elsewhere).expect("a frame");
    assert_eq!((renderer.samples(), renderer.is_settled()), (1, false));
    let mut fresh = make();
    fresh.render(&elsewhere).expect("a frame");
    assert!(shown(&renderer) == shown(&fresh), "nothing of the other view is left");
    renderer.render(&stage.camera).expect("a frame");
    assert!(shown(&renderer) == first[0], "the same numbers again");
}

#[test]
fn leaving_out_changes_nothing() {
    let stopping = with(|paths| paths.stopping = Stopping::Compensated);
    for (name, settings) in [("cornell", stopping), ("room", settings()), ("minray", settings())] {
        let stage = Stage::builtin(name);
        let auto = mean(&stage, &settings, 1);
        let all = mean(&stage, &Settings { features: Linking::All, ..settings }, 1);
        assert!(auto.as_raw() == all.as_raw(), "{name}");
    }
}

/// Nothing shines: every pixel is black, by every way to find light.
#[test]
fn without_light_it_is_dark() {
    let mut builder = Builder::new();
    let wall = builder.object(matte(Vec3::splat(0.8)));
    builder.quad(wall, vec3(-6.0, -4.0, -4.0), 12.0 * Vec3::X, 8.0 * Vec3::Y);
    let stage = Stage::new(builder.seen_by(front_camera()));
    for direct in Direct::ALL {
        for shining in Shining::ALL {
            let image = mean(&stage, &with(|paths| (paths.direct, paths.shining) = (direct, shining)), 1);
            assert!(image.as_raw().iter().all(|v| *v == 0.0), "{direct:?} {shining:?}");
        }
    }
}
