//! Path tracing against the reference: sample by sample with the same random numbers, and in the mean with
//! others.

use glam::{DVec3, Vec3, vec3};
use glimpse::{
    DirectLight, Foveation, LightSelection, LinearImage, Method, Renderer, Roulette, Sampler, Settings,
    Specialize,
    reference::{Reference, ReferenceFrame, Rounding},
    scene::{EnvironmentMap, builtin},
};
use glimpse_tests::{
    TestScene,
    builder::{Builder, flattened, front_camera, matte},
    gallery, gpu, note,
};

use super::agreement::srgb;

/// Size of the frame in pixels; neither side is a multiple of a tile's.
const SIZE: [u32; 2] = [75, 42];

fn settings() -> Settings {
    Settings { method: Method::Path, depth: Method::Path.usual_depth(), ..Settings::default() }
}

fn with(change: impl FnOnce(&mut glimpse::Paths)) -> Settings {
    let mut settings = settings();
    change(&mut settings.paths);
    settings
}

/// Mean of `samples` samples of each pixel.
fn mean(test_scene: &TestScene, settings: &Settings, samples: u32) -> LinearImage {
    let mut renderer = Renderer::new(gpu(), &test_scene.scene, SIZE, settings).expect("a renderer");
    // A renderer without a frame counts one sample, which `linear_image` renders.
    for _ in 0..if samples > 1 { samples } else { 0 } {
        renderer.render(&test_scene.camera).expect("a frame");
    }
    assert_eq!(renderer.samples(), samples);
    renderer.linear_image(&test_scene.camera).expect("a picture")
}

fn color(image: &LinearImage, [x, y]: [u32; 2]) -> DVec3 {
    DVec3::from(image.get_pixel(x, y).0.map(f64::from))
}

fn pixels() -> impl Iterator<Item = [u32; 2]> {
    (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]))
}

/// A path is a chain of decisions: where one differs between f32 and f64, everything after it differs. All
/// other samples are the same except for rounding.
#[test]
fn a_sample_is_that_of_the_reference() {
    let ways = [
        with(|_| {}),
        with(|paths| (paths.direct_light, paths.sampler) = (DirectLight::Bsdf, Sampler::Random)),
        with(|paths| (paths.direct_light, paths.light_samples) = (DirectLight::Nee, 3)),
        Settings { depth: 6, ..with(|p| (p.lights, p.roulette) = (LightSelection::Emitters, Roulette::Off)) },
        with(|paths| paths.lights = LightSelection::Punctual),
        with(|paths| (paths.foveation, paths.gaze) = (Foveation::Compensated, [0.2, 0.9])),
        with(|paths| (paths.foveation, paths.gaze) = (Foveation::Paper, [2.0, -1.0])),
    ];
    // Weights of texels have few bits in f32, and a path meets several.
    for (name, tolerance, ways) in [
        ("cornell", 1e-3, &ways[..]),
        ("room", 1e-2, &ways[..2]),
        ("minray", 1e-3, &ways[4..5]),
        ("furnace", 1e-2, &ways[..3]),
        ("lobes", 1e-2, &ways[..3]),
        ("brushed", 1e-2, &ways[..2]),
        ("films", 1e-2, &ways[..2]),
        ("leaves", 1e-2, &ways[..3]),
        ("lacquer", 1e-2, &ways[..2]),
        ("prisms", 1e-2, &ways[..2]),
    ] {
        let mut scene = match name {
            "lobes" => gallery::lobes(),
            "brushed" => gallery::brushed(),
            "films" => gallery::films(),
            "leaves" => gallery::leaves(),
            "lacquer" => gallery::lacquer(),
            "prisms" => gallery::prisms(),
            name => builtin(name).expect("built in"),
        };
        if name == "furnace" {
            scene.surround(EnvironmentMap::studio().rotated(0.3));
        }
        let (reference, test_scene) = (Reference::new(&scene).with_srgb(*srgb()), TestScene::new(scene));
        for &settings in ways {
            let found = mean(&test_scene, &settings, 1);
            let frame =
                ReferenceFrame { reference: &reference, camera: test_scene.camera, size: SIZE, settings };
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

/// With independent random numbers the means differ only by noise: the means of blocks of pixels, over enough
/// samples to contain rare bright ones, differ by less than five standard errors.
#[test]
fn the_mean_is_that_of_the_reference() {
    const SAMPLES: u32 = 64;
    const BLOCKS: [u32; 2] = [5, 3];
    for name in ["cornell", "room"] {
        let scene = builtin(name).expect("built in");
        let (reference, test_scene) = (Reference::new(&scene).with_srgb(*srgb()), TestScene::new(scene));
        let random = with(|paths| paths.sampler = Sampler::Random);
        let found = mean(&test_scene, &random, SAMPLES);
        let other = Settings { seed: 1, ..random };
        let frame =
            ReferenceFrame { reference: &reference, camera: test_scene.camera, size: SIZE, settings: other };
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
            // Sum of the variances of both means.
            *variance += 2.0 * squares / (count - 1.0) / count;
        }
        let zs = blocks.map(|[difference, variance]| difference / variance.sqrt().max(1e-6));
        note(&format!("{name}: z of blocks of pixels {zs:.1?}"));
        assert!(zs.iter().all(|z| z.abs() < 5.0), "{name}: {zs:?}");
    }
}

/// Flat shading, as bent normals lose light from below the face; smooth metal and no sampling of emitters, as rough
/// lobes and sampled light are right only in the mean.
#[test]
fn in_a_furnace_every_path_brings_the_same() {
    let mut scene = flattened(builtin("furnace").expect("built in"));
    scene.materials.iter_mut().for_each(|m| m.roughness = 0.0);
    let test_scene = TestScene::new(scene);
    for roulette in Roulette::ALL {
        let image =
            mean(&test_scene, &with(|p| (p.direct_light, p.roulette) = (DirectLight::Bsdf, roulette)), 3);
        let off = image.as_raw().iter().map(|v| (v - 1.0).abs()).fold(0.0, f32::max);
        assert!(off <= 1e-5, "{roulette:?}: {off}");
    }
}

#[test]
fn samples_add_up_while_the_camera_rests() {
    let test_scene = TestScene::builtin("cornell");
    let make =
        || Renderer::new(gpu(), &test_scene.scene, SIZE, &with(|p| p.samples = 3)).expect("a renderer");
    let shown = |renderer: &Renderer| renderer.display_image().expect("a picture");
    let mut renderer = make();
    let mut first = Vec::new();
    for samples in 1..=3 {
        assert!(!renderer.is_settled());
        renderer.render(&test_scene.camera).expect("a frame");
        assert_eq!(renderer.samples(), samples);
        first.push(shown(&renderer));
        // Counting does not change the picture.
        let counts = renderer.inspect(&test_scene.camera).expect("counts").counts;
        assert_eq!(counts.rays.primary, u64::from(SIZE[0] * SIZE[1]));
        assert!(counts.rays.diffuse > 0 && counts.rays.total > counts.rays.primary + counts.rays.diffuse);
    }
    assert!(renderer.is_settled());
    assert!(first[0] != first[1] && first[1] != first[2]);
    let elsewhere = test_scene.camera.panned(3.0);
    renderer.render(&elsewhere).expect("a frame");
    assert_eq!((renderer.samples(), renderer.is_settled()), (1, false));
    let mut fresh = make();
    fresh.render(&elsewhere).expect("a frame");
    assert!(shown(&renderer) == shown(&fresh), "nothing of the other view is left");
    renderer.render(&test_scene.camera).expect("a frame");
    assert!(shown(&renderer) == first[0], "the same numbers again");
}

#[test]
fn leaving_out_changes_nothing() {
    let foveation = with(|paths| paths.foveation = Foveation::Compensated);
    for (name, settings) in [("cornell", foveation), ("room", settings()), ("minray", settings())] {
        let test_scene = TestScene::builtin(name);
        let auto = mean(&test_scene, &settings, 1);
        let all = mean(&test_scene, &Settings { specialize: Specialize::All, ..settings }, 1);
        assert!(auto.as_raw() == all.as_raw(), "{name}");
    }
}

/// In a scene without emission every pixel is black, with every direct light strategy.
#[test]
fn without_light_it_is_dark() {
    let mut builder = Builder::new();
    let wall = builder.object(matte(Vec3::splat(0.8)));
    builder.quad(wall, vec3(-6.0, -4.0, -4.0), 12.0 * Vec3::X, 8.0 * Vec3::Y);
    let test_scene = TestScene::new(builder.seen_by(front_camera()));
    for direct_light in DirectLight::ALL {
        for lights in LightSelection::ALL {
            let image = mean(
                &test_scene,
                &with(|paths| (paths.direct_light, paths.lights) = (direct_light, lights)),
                1,
            );
            assert!(image.as_raw().iter().all(|v| *v == 0.0), "{direct_light:?} {lights:?}");
        }
    }
}
