//! Samples of CPU threads merged into frames of the GPU.

use std::collections::BTreeMap;

use glam::DVec3;
use glimpse::{
    Denoise, Error, Foveation, LinearImage, Method, Renderer, Sampler, Settings, StereoReuse,
    cpu_tracer::{Accumulator, SampleCounts, View, Worker},
    encode_display,
    reference::{Denoiser, GBufferPixel, Reference, ReferenceFrame},
    scene::builtin,
};
use glimpse_tests::{TestScene, gpu, note};

use super::{agreement::srgb, denoise::colors};

/// Size of the frame in pixels; neither side is a multiple of a tile's.
const SIZE: [u32; 2] = [45, 26];

fn two_eyes() -> Settings {
    let mut settings = Settings { method: Method::Vr, ..settings() };
    (settings.paths.stereo_reuse, settings.paths.foveation) = (StereoReuse::Weighted, Foveation::Compensated);
    settings
}

fn settings() -> Settings {
    let mut settings = Settings { method: Method::Path, depth: 8, ..Settings::default() };
    settings.paths.samples = 8;
    // Independent random numbers, as standard errors are estimated from samples.
    settings.paths.sampler = Sampler::Random;
    settings
}

struct Fixture {
    reference: Reference,
    test_scene: TestScene,
    settings: Settings,
    view: View,
}

impl Fixture {
    fn new(settings: Settings) -> Self {
        let scene = builtin("cornell").expect("built in");
        let reference = Reference::new(&scene).with_wide_tree().with_srgb(*srgb());
        let test_scene = TestScene::new(scene);
        let view = View::new(&test_scene.camera, SIZE, &settings);
        Self { reference, test_scene, settings, view }
    }

    fn renderer(&self) -> Renderer {
        Renderer::new(gpu(), &self.test_scene.scene, SIZE, &self.settings).expect("a renderer")
    }

    /// Traces samples on a worker; the owner collects after each.
    fn trace(&self, worker: &mut Worker, accumulator: &mut Accumulator, samples: u32) {
        for _ in 0..samples {
            (0..SIZE[1]).for_each(|_| assert!(worker.step(&self.reference)));
            accumulator.collect();
        }
    }
}

/// The picture is the sum of both sides over the number of samples of both, whenever samples arrive; in
/// another view none of them is left.
#[test]
fn merged_is_the_sum_of_both_sides() {
    [settings(), two_eyes()].into_iter().for_each(assert_merged_is_the_sum);
}

fn assert_merged_is_the_sum(settings: Settings) {
    let fixture = Fixture::new(settings);
    let camera = fixture.test_scene.camera;
    let mut renderer = fixture.renderer();
    for _ in 0..4 {
        renderer.render(&camera).expect("a frame");
    }
    let alone = renderer.linear_image(&camera).expect("a picture");

    let (mut accumulator, mut workers) = Accumulator::new(&fixture.view, 1);
    renderer.accumulate(&mut accumulator).expect("nothing to merge yet");
    renderer.render(&camera).expect("a frame");
    assert_eq!(renderer.samples(), 1);
    fixture.trace(&mut workers[0], &mut accumulator, 2);
    let mut kept = Accumulator::new(&fixture.view, 1);
    fixture.trace(&mut kept.1[0], &mut kept.0, 3);
    let cpu_tracer = kept.0.take().expect("three samples").rgb;

    renderer.accumulate(&mut accumulator).expect("two samples");
    assert_eq!((renderer.samples(), renderer.is_settled()), (3, false));
    renderer.render(&camera).expect("a frame");
    renderer.render(&camera).expect("a frame");
    fixture.trace(&mut workers[0], &mut accumulator, 1);
    renderer.accumulate(&mut accumulator).expect("another sample");
    assert_eq!((renderer.samples(), renderer.is_settled()), (6, false));
    renderer.render(&camera).expect("a frame");
    assert_eq!(renderer.samples(), 7);
    let merged = renderer.linear_image(&camera).expect("a picture");
    for (index, both) in merged.as_raw().iter().enumerate() {
        let expected = (4.0 * alone.as_raw()[index] + cpu_tracer[index]) / 7.0;
        // Six roundings of sums and one of the quotient.
        assert!((both - expected).abs() <= 8.0 * f32::EPSILON * expected, "{index}: {both} {expected}");
    }
    // The displayed picture equals it too, also after another merge.
    assert_shown(&renderer, &merged);
    fixture.trace(&mut workers[0], &mut accumulator, 1);
    renderer.accumulate(&mut accumulator).expect("another sample");
    assert_eq!((renderer.samples(), renderer.is_settled()), (8, true));
    let merged = renderer.linear_image(&camera).expect("a picture");
    assert_shown(&renderer, &merged);

    // The camera moves while a sample is on its way.
    fixture.trace(&mut workers[0], &mut accumulator, 1);
    let elsewhere = camera.panned(5.0);
    renderer.render(&elsewhere).expect("a frame");
    renderer.accumulate(&mut accumulator).expect("nothing of this view");
    assert_eq!((renderer.samples(), accumulator.samples()), (1, vec![0]));
    let mut fresh = fixture.renderer();
    fresh.render(&elsewhere).expect("a frame");
    assert!(renderer.display_image().expect("a picture") == fresh.display_image().expect("a picture"));
    assert_eq!(accumulator.sample_counts(), SampleCounts { begun: 5, merged: 4, given_up: 1 });
}

/// The means of the GPU alone, of the CPU alone and of both differ only by noise: by less than five standard
/// errors of blocks of pixels.
#[test]
fn every_share_of_the_cores_has_the_same_mean() {
    const SAMPLES: u32 = 96;
    const BLOCKS: [u32; 2] = [5, 3];
    let fixture = Fixture::new(settings());
    let camera = fixture.test_scene.camera;
    let (mut accumulator, mut workers) = Accumulator::new(&fixture.view, 1);
    let mut renderer = fixture.renderer();
    for _ in 0..SAMPLES {
        renderer.render(&camera).expect("a frame");
    }
    // Estimates the noise of each pixel from its single samples.
    let mut moments = vec![[0.0_f64; 2]; (SIZE[0] * SIZE[1]) as usize];
    let mut cores = vec![0.0_f32; 3 * moments.len()];
    for _ in 0..SAMPLES {
        fixture.trace(&mut workers[0], &mut accumulator, 1);
        let plane = accumulator.take().expect("a sample").rgb;
        for ([sum, squares], rgb) in moments.iter_mut().zip(plane.chunks_exact(3)) {
            let x: f64 = rgb.iter().copied().map(f64::from).sum();
            (*sum, *squares) = (*sum + x, *squares + x * x);
        }
        cores.iter_mut().zip(&plane).for_each(|(sum, x)| *sum += x / SAMPLES as f32);
    }
    let count = f64::from(SAMPLES);
    let errors2: Vec<f64> =
        moments.iter().map(|[sum, squares]| (squares - sum * sum / count) / (count - 1.0) / count).collect();
    // As many samples again, with independent random numbers.
    for _ in 0..SAMPLES {
        fixture.trace(&mut workers[0], &mut accumulator, 1);
    }
    let gpu_alone = renderer.linear_image(&camera).expect("a picture");
    for _ in 0..SAMPLES {
        renderer.render(&camera).expect("a frame");
    }
    renderer.accumulate(&mut accumulator).expect("the samples of the core");
    assert_eq!(renderer.samples(), 2 * SAMPLES);
    let both = renderer.linear_image(&camera).expect("a picture");
    // The GPU's samples are the same as before; only the CPU's are new.
    let added: Vec<f32> =
        both.as_raw().iter().zip(gpu_alone.as_raw()).map(|(both, gpu)| 2.0 * both - gpu).collect();
    let pairs: [(&str, &[f32], &[f32]); 3] = [
        ("GPU and core", gpu_alone.as_raw(), &cores),
        ("core and both", &cores, &added),
        ("GPU and both", gpu_alone.as_raw(), &added),
    ];
    for (name, one, other) in pairs {
        let mut blocks = BTreeMap::<[u32; 2], [f64; 2]>::new();
        for (index, (a, b)) in one.chunks_exact(3).zip(other.chunks_exact(3)).enumerate() {
            let pixel = [index as u32 % SIZE[0], index as u32 / SIZE[0]];
            let [difference, variance] =
                blocks.entry([0, 1].map(|axis| pixel[axis] * BLOCKS[axis] / SIZE[axis])).or_default();
            *difference += f64::from(a.iter().sum::<f32>() - b.iter().sum::<f32>());
            // Sum of the variances of both means.
            *variance += 2.0 * errors2[index];
        }
        let zs: Vec<f64> = blocks.values().map(|[d, v]| d / v.sqrt().max(1e-6)).collect();
        note(&format!("{name}: z of blocks of pixels {zs:.1?}"));
        assert_eq!(zs.len(), 15);
        assert!(zs.iter().any(|z| z.abs() > 0.5), "{name}: the same samples twice");
        assert!(zs.iter().all(|z| z.abs() < 5.0), "{name}: {zs:?}");
    }
}

/// Kim & Sung 2021, Algorithm 5: noise is removed from the sum of both sides, immediately and in the
/// following frames.
#[test]
fn noise_is_removed_from_the_sum_of_both_sides() {
    let one_eye = || Settings { paths: two_eyes().paths, ..settings() };
    for (wish, denoise) in
        [(one_eye(), Denoise::Median), (one_eye(), Denoise::Atrous), (two_eyes(), Denoise::Atrous)]
    {
        let [plain, filtered] = [Denoise::Off, denoise].map(|denoise| {
            let mut settings = wish;
            settings.paths.denoise = denoise;
            Fixture::new(settings)
        });
        let camera = plain.test_scene.camera;
        let mut renderers = [plain.renderer(), filtered.renderer()];
        for renderer in &mut renderers {
            // Both renderers get the same samples.
            let (mut accumulator, mut workers) = Accumulator::new(&plain.view, 1);
            (0..2).for_each(|_| drop(renderer.render(&camera).expect("a frame")));
            plain.trace(&mut workers[0], &mut accumulator, 3);
            renderer.accumulate(&mut accumulator).expect("three samples");
        }
        assert_filtered(&filtered, &mut renderers, denoise, 5);
        for renderer in &mut renderers {
            renderer.render(&camera).expect("a frame");
        }
        assert_filtered(&filtered, &mut renderers, denoise, 6);
    }
}

/// Asserts that the second renderer's picture is that of the first, denoised as by the reference.
fn assert_filtered(fixture: &Fixture, renderers: &mut [Renderer; 2], denoise: Denoise, samples: u32) {
    let (camera, settings) = (fixture.test_scene.camera, fixture.settings);
    assert!(renderers.iter().all(|renderer| renderer.samples() == samples));
    let [means, found] =
        renderers.each_mut().map(|renderer| renderer.linear_image(&camera).expect("a picture"));
    assert_shown(&renderers[1], &found);
    let [means, found] = [means, found].map(|image| colors(&image));
    let gbuffer: Vec<_> =
        renderers[1].gbuffer().expect("a G-buffer").into_iter().map(GBufferPixel::unpacked).collect();
    let frame = ReferenceFrame { reference: &fixture.reference, camera, size: SIZE, settings };
    let noise = Denoiser { frame: &frame, samples, means: &means, gbuffer: &gbuffer };
    let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]));
    let right = match denoise {
        Denoise::Median => pixels.map(|pixel| noise.median(pixel)).collect(),
        _ => noise.atrous(),
    };
    let off = |(found, right): (&DVec3, &DVec3)| (found - right).length() / (right.length() + 0.01);
    let worst = found.iter().zip(&right).map(off).fold(0.0, f64::max);
    let changed = right.iter().zip(&means).filter(|(a, b)| a != b).count();
    note(&format!("{denoise:?}, {samples} samples: worst {worst:.2e}, {changed} pixels changed"));
    assert!(worst <= 1e-3 && changed > 100, "{denoise:?}, {samples} samples: {worst}, {changed}");
}

#[test]
fn methods_that_add_nothing_up_merge_nothing() {
    let fixture = Fixture::new(settings());
    let full = Settings { method: Method::Full, ..Settings::default() };
    let mut renderer = Renderer::new(gpu(), &fixture.test_scene.scene, SIZE, &full).expect("a renderer");
    let (mut accumulator, _workers) = Accumulator::new(&fixture.view, 1);
    let Err(Error::Setting { option, expected, found }) = renderer.accumulate(&mut accumulator) else {
        panic!("no error")
    };
    assert_eq!((option.as_str(), found.as_str()), ("method", "full"));
    assert_eq!(expected, "path or vr where samples are merged, without stereo-reuse paper");
}

/// Asserts that the displayed picture equals the encoded one up to one level.
fn assert_shown(renderer: &Renderer, linear: &LinearImage) {
    let shown = renderer.display_image().expect("a picture");
    let expected = encode_display(linear);
    let off = shown.as_raw().iter().zip(expected.as_raw()).map(|(a, b)| a.abs_diff(*b));
    assert!(off.max() <= Some(1));
}
