//! Two eyes: reusing samples of the other eye changes only the noise.

use glam::DVec3;
use glimpse::{
    Foveation, Method, Sampler, Scene, Settings, StereoReuse,
    reference::{PathSample, Reference, ReferenceFrame, Rounding},
};
use glimpse_tests::gallery::stereo;

/// Size of both pictures in pixels: the left eye has twelve columns, the right eye eleven.
const SIZE: [u32; 2] = [23, 9];

fn settings(stereo_reuse: StereoReuse) -> Settings {
    let mut settings = Settings { method: Method::Vr, depth: 5, ..Settings::default() };
    (settings.paths.stereo_reuse, settings.paths.sampler) = (stereo_reuse, Sampler::Random);
    (settings.paths.eye_distance, settings.paths.convergence) = (0.5, Some(2.5));
    settings
}

fn pixels() -> impl Iterator<Item = [u32; 2]> {
    (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]))
}

/// Sum and sum of squares of each pixel's samples, with the channels summed.
type Sums = Vec<[f64; 2]>;

/// Accumulates the pixels of `samples` frames with one sample per pixel.
fn sums(scene: &Scene, settings: Settings, samples: u32) -> Sums {
    let reference = Reference::new(scene);
    let camera = *scene.camera(None).expect("a camera");
    let frame = ReferenceFrame { reference: &reference, camera, size: SIZE, settings };
    let index = |[x, y]: [u32; 2]| (y * SIZE[0] + x) as usize;
    let mut sums = vec![[0.0; 2]; index([0, SIZE[1]])];
    for sample in 0..samples {
        let mut shown = vec![DVec3::ZERO; sums.len()];
        for pixel in pixels() {
            let PathSample { radiance, own, splat, .. } = frame.path(pixel, sample, &mut Rounding::none());
            shown[index(pixel)] += own * radiance;
            if let Some(splat) = splat {
                shown[index(splat.pixel)] += splat.share * radiance;
            }
        }
        for (sums, shown) in sums.iter_mut().zip(shown) {
            let shown = shown.element_sum();
            sums[0] += shown;
            sums[1] += shown * shown;
        }
    }
    sums
}

/// Difference of the means of each pixel in standard errors.
fn deviations(a: &Sums, b: &Sums, samples: u32) -> Vec<f64> {
    let n = f64::from(samples);
    let error2 = |[sum, squares]: [f64; 2]| (squares / n - (sum / n).powi(2)).max(1e-12) / n;
    a.iter().zip(b).map(|(a, b)| (a[0] - b[0]) / n / (error2(*a) + error2(*b)).sqrt()).collect()
}

fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|z| z * z).sum::<f64>() / values.len() as f64
}

#[test]
fn what_crosses_over_changes_no_mean_unless_it_is_counted_as_in_the_paper() {
    const SAMPLES: u32 = 4000;
    let scene = stereo();
    let alone = sums(&scene, settings(StereoReuse::Off), SAMPLES);
    let with = |stereo_reuse| sums(&scene, Settings { seed: 1, ..settings(stereo_reuse) }, SAMPLES);
    let weighted = with(StereoReuse::Weighted);
    let right = deviations(&alone, &weighted, SAMPLES);
    let largest = right.iter().fold(0.0_f64, |most, z| most.max(z.abs()));
    // 207 pixels: squares of standard normal deviates have mean 1, and the mean of this many an error of 0.1.
    assert!(mean_square(&right) < 1.4, "{}: {right:.1?}", mean_square(&right));
    assert!(largest < 4.5, "{largest}");
    let wrong = deviations(&alone, &with(StereoReuse::Paper), SAMPLES);
    assert!(mean_square(&wrong) > 10.0, "{}", mean_square(&wrong));
    let noise = |sums: &Sums| sums.iter().map(|s| s[1] - s[0] * s[0] / f64::from(SAMPLES)).sum::<f64>();
    assert!(noise(&weighted) < 0.9 * noise(&alone), "{} {}", noise(&weighted), noise(&alone));
}

#[test]
fn what_crosses_over_changes_no_mean_where_paths_stop() {
    const SAMPLES: u32 = 4000;
    let scene = stereo();
    let stopped = |stereo_reuse, seed| {
        let mut settings = Settings { seed, ..settings(stereo_reuse) };
        (settings.paths.foveation, settings.paths.foveation_max) = (Foveation::Compensated, 1.0);
        settings.paths.gaze = [0.1, 0.9];
        sums(&scene, settings, SAMPLES)
    };
    let z = deviations(&stopped(StereoReuse::Off, 0), &stopped(StereoReuse::Weighted, 1), SAMPLES);
    assert!(mean_square(&z) < 1.4, "{}: {z:.1?}", mean_square(&z));
}

#[test]
fn eyes_in_one_place_find_every_point_alike() {
    let mut settings = settings(StereoReuse::Weighted);
    (settings.paths.eye_distance, settings.paths.convergence) = (0.0, None);
    let scene = stereo();
    let reference = Reference::new(&scene);
    let camera = *scene.camera(None).expect("a camera");
    let frame = ReferenceFrame { reference: &reference, camera, size: SIZE, settings };
    let mut landed = 0;
    for [x, y] in pixels() {
        let path = frame.path([x, y], 0, &mut Rounding::none());
        let Some(splat) = path.splat else { continue };
        landed += 1;
        let half = SIZE[0].div_ceil(2);
        let other = if x < half { x + half } else { x - half };
        assert_eq!(splat.pixel, [other, y]);
        assert!((path.own - 0.5).abs() < 1e-9 && (splat.share - 0.5).abs().max_element() < 1e-6, "{splat:?}");
    }
    assert!(landed > 100, "{landed}");
}
