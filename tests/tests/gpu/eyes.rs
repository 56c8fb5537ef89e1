//! Pictures for two eyes against the reference, and unusual settings of the eyes.

use glam::{DVec3, Vec3};
use glimpse::{
    Foveation, Method, Renderer, Settings, Specialize, StereoReuse,
    reference::{Reference, ReferenceFrame, Rounding},
    scene::builtin,
};
use glimpse_tests::{
    TestScene,
    gallery::{orthographic, stereo},
    gpu, note, shared_scene,
};

use super::agreement::srgb;

/// Size of both pictures in pixels; the width is odd, so that the right eye has one column less.
const SIZE: [u32; 2] = [121, 40];

fn settings(stereo_reuse: StereoReuse) -> Settings {
    let mut settings = Settings { method: Method::Vr, depth: 6, ..Settings::default() };
    settings.paths.stereo_reuse = stereo_reuse;
    (settings.paths.eye_distance, settings.paths.convergence) = (0.3, Some(2.5));
    settings
}

/// A frame of one sample, in linear radiance.
fn frame(test_scene: &TestScene, settings: &Settings, size: [u32; 2]) -> Vec<DVec3> {
    let mut renderer = Renderer::new(gpu(), &test_scene.scene, size, settings).expect("a renderer");
    let image = renderer.linear_image(&test_scene.camera).expect("a picture");
    image.pixels().map(|pixel| DVec3::from(pixel.0.map(f64::from))).collect()
}

/// The same frame by the f64 reference.
fn expected(frame: &ReferenceFrame<'_>) -> Vec<DVec3> {
    let [width, height] = frame.size;
    let index = |[x, y]: [u32; 2]| (y * width + x) as usize;
    let (mut sums, mut counts) = (vec![DVec3::ZERO; index([0, height])], vec![1.0; index([0, height])]);
    for pixel in (0..height).flat_map(|y| (0..width).map(move |x| [x, y])) {
        let path = frame.path(pixel, 0, &mut Rounding::none());
        sums[index(pixel)] += path.own * path.radiance;
        if let Some(splat) = path.splat {
            sums[index(splat.pixel)] += splat.share * path.radiance;
            counts[index(splat.pixel)] += 1.0;
        }
    }
    match frame.settings.paths.stereo_reuse {
        StereoReuse::Paper => sums.into_iter().zip(counts).map(|(sum, count)| sum / count).collect(),
        StereoReuse::Off | StereoReuse::Weighted => sums,
    }
}

/// If a decision differs between f32 and f64, two pixels differ. All others are the same except for rounding.
#[test]
fn a_sample_is_that_of_the_reference() {
    let scenes = [("stereo", stereo()), ("cornell", builtin("cornell").expect("built in"))];
    for (name, scene) in scenes {
        let (reference, test_scene) = (Reference::new(&scene), TestScene::new(scene));
        for (stereo_reuse, foveation) in [
            (StereoReuse::Weighted, Foveation::Off),
            (StereoReuse::Weighted, Foveation::Compensated),
            (StereoReuse::Paper, Foveation::Off),
        ] {
            let mut settings = settings(stereo_reuse);
            settings.paths.foveation = foveation;
            let found = frame(&test_scene, &settings, SIZE);
            let right = expected(&ReferenceFrame {
                reference: &reference,
                camera: test_scene.camera,
                size: SIZE,
                settings,
            });
            let differs = |(found, right): &(&DVec3, &DVec3)| {
                (**found - **right).length() > 1e-3 * (right.length() + 0.01)
            };
            let wrong = found.iter().zip(&right).filter(differs).count() as f64 / found.len() as f64;
            note(&format!(
                "{name} {stereo_reuse:?}, stopping {foveation:?}: {wrong:.4} of the pixels differ"
            ));
            assert!(wrong < 0.03, "{name} {stereo_reuse:?}, stopping {foveation:?}: {wrong}");
        }
    }
}

#[test]
fn leaving_out_and_counting_change_nothing() {
    let test_scene = TestScene::new(stereo());
    let auto = settings(StereoReuse::Weighted);
    let all = Settings { specialize: Specialize::All, ..auto };
    assert!(frame(&test_scene, &auto, SIZE) == frame(&test_scene, &all, SIZE));
    let make = || Renderer::new(gpu(), &test_scene.scene, SIZE, &auto).expect("a renderer");
    let (mut counting, mut plain) = (make(), make());
    for renderer in [&mut counting, &mut plain] {
        renderer.render(&test_scene.camera).expect("a frame");
    }
    let rays = counting.inspect(&test_scene.camera).expect("counts").counts.rays;
    assert_eq!(rays.primary, u64::from(SIZE[0] * SIZE[1]));
    for renderer in [&mut counting, &mut plain] {
        renderer.render(&test_scene.camera).expect("a frame");
    }
    let shown = |renderer: &Renderer| renderer.display_image().expect("a picture");
    assert!(shown(&counting) == shown(&plain));
}

/// One column, one pixel, eyes in one place, inside the surface they look at, or farther apart than the scene
/// is wide.
#[test]
fn unusual_eyes_see_something_defined() {
    let test_scene = TestScene::new(stereo());
    let usual = settings(StereoReuse::Weighted);
    let eyes = |distance, convergence| {
        let mut settings = usual;
        (settings.paths.eye_distance, settings.paths.convergence) = (distance, convergence);
        settings
    };
    for (size, settings) in [
        ([1, 7], usual),
        ([2, 1], usual),
        (SIZE, eyes(0.0, None)),
        (SIZE, eyes(0.8, Some(0.1))),
        (SIZE, eyes(1e4, None)),
        (SIZE, eyes(1e-30, Some(1e-20))),
    ] {
        let found = frame(&test_scene, &settings, size);
        assert!(
            found.iter().all(|c| c.is_finite() && c.min_element() >= 0.0),
            "{size:?} {:?}",
            settings.paths
        );
    }
    let inside = test_scene.camera;
    let inside = glimpse::Camera { origin: Vec3::new(0.0, -0.32, 0.2), ..inside };
    let test_scene = TestScene { camera: inside, ..test_scene };
    let found = frame(&test_scene, &usual, SIZE);
    assert!(found.iter().all(|c| c.is_finite() && c.min_element() >= 0.0));
}

#[test]
fn an_orthographic_camera_has_no_eyes() {
    let test_scene = TestScene::new(orthographic());
    let mut renderer =
        Renderer::new(gpu(), &test_scene.scene, SIZE, &settings(StereoReuse::Weighted)).expect("a renderer");
    let error = renderer.render(&test_scene.camera).expect_err("no eyes").to_string();
    assert!(error.contains("method vr") && error.contains("orthographic"), "{error}");
}

/// Statistics over pictures with independent random numbers: for each pixel the sum of its values (channels
/// summed) and of their squares.
struct Batches {
    count: u32,
    sums: Vec<[f64; 2]>,
}

impl Batches {
    fn of(count: u32, mut picture: impl FnMut(u32) -> Vec<DVec3>) -> Self {
        let mut sums = Vec::new();
        for batch in 0..count {
            let picture = picture(batch);
            sums.resize(picture.len(), [0.0; 2]);
            for (sums, radiance) in sums.iter_mut().zip(picture) {
                let value = radiance.element_sum();
                sums[0] += value;
                sums[1] += value * value;
            }
        }
        Self { count, sums }
    }

    /// Mean and squared standard error of each pixel; the variance has a lower bound for pixels without
    /// noise.
    fn means(&self) -> impl Iterator<Item = [f64; 2]> {
        let n = f64::from(self.count);
        self.sums.iter().map(move |[sum, squares]| {
            let mean = sum / n;
            [mean, (squares / n - mean * mean).max(1e-9) / (n - 1.0)]
        })
    }
}

/// The unbiased techniques on the GPU against plain path tracing in the reference, with independent random
/// numbers: a z-test of every pixel.
#[test]
fn means_of_the_paper_s_scenes_are_the_reference_s() {
    const SIZE: [u32; 2] = [48, 18];
    const BATCHES: u32 = 32;
    const SAMPLES: u32 = 8;
    for name in ["teapot", "ant", "bunny", "monkey", "knot"] {
        let Some(scene) = shared_scene(&format!("vr_{name}.glb")) else { continue };
        let mut settings = Settings { method: Method::Vr, depth: 6, ..Settings::default() };
        settings.paths.samples = SAMPLES;
        let reference = Reference::new(&scene).with_wide_tree().with_srgb(*srgb());
        let test_scene = TestScene::new(scene);
        let pixels: Vec<_> = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y])).collect();
        let expected = Batches::of(BATCHES, |batch| {
            let settings = Settings { seed: BATCHES + batch, ..settings };
            let frame =
                ReferenceFrame { reference: &reference, camera: test_scene.camera, size: SIZE, settings };
            let path = |pixel, sample| frame.path(pixel, sample, &mut Rounding::none()).radiance;
            let mean = |pixel: &[u32; 2]| (0..SAMPLES).map(|sample| path(*pixel, sample)).sum::<DVec3>();
            pixels.iter().map(|pixel| mean(pixel) / f64::from(SAMPLES)).collect()
        });

        settings.paths.stereo_reuse = StereoReuse::Weighted;
        (settings.paths.foveation, settings.paths.gaze) = (Foveation::Compensated, [0.3, 0.6]);
        let mut renderer = Renderer::new(gpu(), &test_scene.scene, SIZE, &settings).expect("a renderer");
        let found = Batches::of(BATCHES, |seed| {
            renderer.change(SIZE, &Settings { seed, ..settings }).expect("the same kernels");
            (0..SAMPLES).for_each(|_| drop(renderer.render(&test_scene.camera).expect("a frame")));
            let image = renderer.linear_image(&test_scene.camera).expect("a picture");
            image.pixels().map(|pixel| DVec3::from(pixel.0.map(f64::from))).collect()
        });
        let pairs = found.means().zip(expected.means());
        let z: Vec<_> = pairs.map(|([a, a2], [b, b2])| (a - b) / (a2 + b2).sqrt()).collect();
        let square = z.iter().map(|z| z * z).sum::<f64>() / z.len() as f64;
        let largest = z.iter().fold(0.0_f64, |most, z| most.max(z.abs()));
        note(&format!("{name}: z^2 has mean {square:.3}, the largest |z| is {largest:.2}"));
        // Student's t with 62 degrees of freedom has a mean square of 1.03; the mean of 864 of them, pairs of
        // which share samples, has a standard error of 0.07.
        assert!((0.75..1.3).contains(&square) && largest < 5.0, "{name}: {square} {largest}");
    }
}
