//! Selective and adaptive supersampling, and quincunx: frames that must be equal, and differences that must
//! be detected.

use glam::{Vec3, vec3};
use glimpse::{
    Filter, Focus, Inspection, Jitter, LinearImage, Method, Preset, Refine, Scene, Settings, THRESHOLD_NAMES,
    Thresholds, Tolerances, Unsampled,
};
use glimpse_tests::{
    TestScene, assert_same,
    builder::{Builder, front_camera, matte, mirror},
};

const SIZE: [u32; 2] = [123, 77];

fn supersample(thresholds: Thresholds) -> Settings {
    Settings { method: Method::Supersample, thresholds, ..Settings::default() }
}

#[test]
fn all_quarters_active_is_sixteen_samples_a_pixel() {
    for (name, jitters) in [("room", &[Jitter::On][..]), ("cornell", &[Jitter::On, Jitter::Off])] {
        let test_scene = TestScene::builtin(name);
        for &jitter in jitters {
            let fixed = Settings { method: Method::Full, sampling: 4, jitter, ..Settings::default() };
            let fixed = test_scene.frame(SIZE, &fixed);
            for refine in [Refine::Off, Refine::On] {
                let ours = Settings { jitter, refine, ..supersample(Thresholds::uniform(0.0)) };
                assert_same(
                    &test_scene.frame(SIZE, &ours),
                    &fixed,
                    &format!("{name}, {jitter:?}, {refine:?}"),
                );
            }
        }
    }
}

#[test]
fn no_quarter_active_is_one_sample_a_pixel() {
    let test_scene = TestScene::builtin("cornell");
    let full = Settings { method: Method::Full, ..Settings::default() };
    let adaptive = Settings::default();
    for refine in [Refine::Off, Refine::On] {
        let never = Settings { refine, ..supersample(Thresholds::uniform(1.0)) };
        assert_same(
            &test_scene.frame(SIZE, &never),
            &test_scene.frame(SIZE, &full),
            &format!("supersample, {refine:?}"),
        );
        assert_eq!(test_scene.inspect(SIZE, &never).counts.samples.extra, 0);
        let never = Settings { supersample: true, refine, thresholds: Thresholds::uniform(1.0), ..adaptive };
        let (found, expected) = (test_scene.frame(SIZE, &never), test_scene.frame(SIZE, &adaptive));
        assert_same(&found, &expected, &format!("adaptive with supersampling, {refine:?}"));
    }
}

/// A tolerance of 0 traces every sample: what remains is the test and the extra samples.
#[test]
fn supersampling_of_a_traced_adaptive_frame_is_supersampling() {
    let test_scene = TestScene::builtin("room");
    let tolerances = Tolerances { pos: 0.0, ..Tolerances::default() };
    for refine in [Refine::Off, Refine::On] {
        let combined = Settings { supersample: true, refine, tolerances, ..Settings::default() };
        let alone = Settings { refine, ..supersample(Thresholds::default()) };
        let (found, expected) = (test_scene.frame(SIZE, &combined), test_scene.frame(SIZE, &alone));
        assert_same(&found, &expected, &format!("combined, {refine:?}"));
        let [combined, alone] = [combined, alone].map(|settings| test_scene.inspect(SIZE, &settings));
        let edges = |i: &Inspection| i.pixels.iter().map(|p| (p.active, p.differing)).collect::<Vec<_>>();
        assert_eq!(edges(&combined), edges(&alone));
        assert!(alone.counts.samples.extra > 1000, "{:?}", alone.counts.samples);
    }
}

/// Weights sum to one: if all samples are 1, so are all pixels.
#[test]
fn the_furnace_stays_what_it_is() {
    let test_scene = TestScene::builtin("furnace");
    let unsampled = Unsampled::Bilinear;
    for settings in [
        supersample(Thresholds::default()),
        supersample(Thresholds::uniform(0.0)),
        Settings { unsampled, ..supersample(Thresholds { poid: 0.0, ..Thresholds::uniform(1.0) }) },
        Settings { supersample: true, refine: Refine::Off, ..Settings::default() },
        Settings { supersample: true, refine: Refine::On, ..Settings::default() },
        Settings { refine: Refine::On, ..supersample(Thresholds { poid: 0.0, ..Thresholds::uniform(1.0) }) },
        Settings { method: Method::Quincunx, ..Settings::default() },
        Settings { method: Method::Quincunx, quincunx_threshold: 0.0, ..Settings::default() },
    ] {
        let image = test_scene.frame([101, 63], &settings);
        let worst = image.as_raw().iter().map(|c| (c - 1.0).abs()).fold(0.0, f32::max);
        assert!(worst <= 1e-5, "{settings:?}: off by {worst:e}");
    }
}

/// There are four extra samples per active quarter, and pixels with each number of active quarters.
#[test]
fn four_samples_for_each_active_quarter() {
    let test_scene = TestScene::builtin("room");
    let inspection = test_scene.inspect(SIZE, &supersample(Thresholds::default()));
    let active: u32 = inspection.pixels.iter().map(|p| p.active.count_ones()).sum();
    let samples = inspection.counts.samples;
    assert_eq!(samples.extra, 4 * u64::from(active));
    assert_eq!(samples.base, samples.total);
    let by_number: Vec<_> =
        (0..5).map(|n| inspection.pixels.iter().filter(|p| p.active.count_ones() == n).count()).collect();
    assert!(by_number.iter().all(|count| *count > 20), "every number of quarters is there: {by_number:?}");
}

/// The number of samples is the sum over the pixels, and pixels stop after different numbers of them.
#[test]
fn refined_pixels_get_as_many_samples_as_they_differ() {
    let test_scene = TestScene::builtin("room");
    let thresholds = Preset::Refined.thresholds();
    let settings = Settings { refine: Refine::On, ..supersample(thresholds) };
    let inspection = test_scene.inspect(SIZE, &settings);
    let samples: u32 = inspection.pixels.iter().map(|p| p.refined()).sum();
    assert_eq!(inspection.counts.samples.extra, u64::from(samples));
    for number in [0, 4, 8, 16] {
        let count = inspection.pixels.iter().filter(|p| p.refined() == number).count();
        assert!(count > 20, "{count} pixels of {number} samples");
    }
}

/// A wire a subpixel wide that rises by a pixel in 30 is hit at few pixel centres. From these on it is
/// followed along the row, for as many pixels as there are rounds.
#[test]
fn a_wire_is_followed_where_no_centre_hits_it() {
    let mut builder = Builder::new();
    builder.environment(Vec3::ZERO, Vec3::ONE);
    let object = builder.object(matte(Vec3::ONE));
    // A pixel of the view, which is 2 units high at that distance.
    let pixel = 2.0 / SIZE[1] as f32;
    let rise = vec3(SIZE[0] as f32, SIZE[0] as f32 / 30.0, 0.0) * pixel;
    builder.quad(object, -rise / 2.0, rise, vec3(0.0, pixel / 4.0, 0.0));
    let test_scene = TestScene::new(builder.seen_by(front_camera()));
    let thresholds = Preset::Refined.thresholds();
    let refined = test_scene.inspect(SIZE, &Settings { refine: Refine::On, ..supersample(thresholds) });
    let seen = |round: std::ops::Range<u32>| {
        refined.pixels.iter().filter(|p| p.round().is_some_and(|r| round.contains(&r))).count()
    };
    let (found, followed) = (seen(0..1), seen(1..16));
    assert!(found > 50 && followed > 50, "{found} found, {followed} followed");
    let show = |settings: &Settings| test_scene.shown(SIZE, settings);
    let many = show(&Settings { method: Method::Full, sampling: 12, ..Settings::default() });
    let error = |refine| {
        let picture = show(&Settings { refine, ..supersample(thresholds) });
        glimpse::metrics::compare(&picture, &many).expect("of one size").rmse
    };
    let (subpixels, pixels) = (error(Refine::Off), error(Refine::On));
    assert!(pixels < 0.5 * subpixels, "{pixels} with it, {subpixels} without");
}

/// Along a clean edge, cells away from the edge are skipped, and the result is about as good as with all
/// sixteen.
#[test]
fn cells_follow_an_edge() {
    let mut builder = Builder::new();
    builder.environment(Vec3::ZERO, Vec3::ONE);
    let object = builder.object(matte(Vec3::ONE));
    builder.quad(object, vec3(-0.9, -0.7, 0.0), vec3(1.5, 0.2, 0.0), vec3(-0.3, 1.3, 0.0));
    let test_scene = TestScene::new(builder.seen_by(front_camera()));
    let refined = Settings { refine: Refine::On, ..supersample(Preset::Refined.thresholds()) };
    let numbers: Vec<_> = test_scene
        .inspect(SIZE, &refined)
        .pixels
        .iter()
        .map(|p| p.refined())
        .filter(|number| *number > 0)
        .collect();
    let mean = f64::from(numbers.iter().sum::<u32>()) / numbers.len() as f64;
    let show = |settings: &Settings| test_scene.shown(SIZE, settings);
    let full = Settings { method: Method::Full, ..Settings::default() };
    let many = show(&Settings { sampling: 12, ..full });
    let error = |settings| glimpse::metrics::compare(&show(&settings), &many).expect("of one size").rmse;
    let [ours, nine, sixteen] =
        [refined, Settings { sampling: 3, ..full }, Settings { sampling: 4, jitter: Jitter::On, ..full }]
            .map(error);
    println!("{mean} samples, {ours} with them, {nine} with nine, {sixteen} with sixteen");
    assert!(mean < 10.0 && numbers.len() > 100, "{mean} samples for {} pixels", numbers.len());
    assert!(ours < 1.2 * sixteen && ours < nine, "{ours}, {nine} with nine, {sixteen} with sixteen");
}

#[test]
fn the_seed_moves_extra_samples_and_nothing_else_does() {
    let test_scene = TestScene::builtin("room");
    let frame = |seed| test_scene.frame(SIZE, &Settings { seed, ..supersample(Thresholds::default()) });
    let first = frame(1);
    assert_same(&frame(1), &first, "the same seed");
    assert_ne!(frame(2).as_raw(), first.as_raw(), "another seed");
}

/// A wall of one colour whose halves differ in a single attribute.
fn wall(attribute: &str, builder: &mut Builder, [z, facing]: [f32; 2]) {
    let grey = || matte(Vec3::splat(0.5));
    let side = |object, builder: &mut Builder, corner: Vec3, u: Vec3| {
        let v = vec3(0.0, 16.0, 0.0);
        // The normal points in the direction that the wall faces.
        if facing > 0.0 { builder.quad(object, corner, u, v) } else { builder.quad(object, corner, v, u) }
    };
    let corner = vec3(-8.0, -8.0, z);
    let wide = vec3(16.0, 0.0, 0.0);
    match attribute {
        "oid" => {
            let [left, right] = [builder.object(grey()), builder.object(grey())];
            side(left, builder, corner, wide / 2.0);
            side(right, builder, corner + wide / 2.0, wide / 2.0);
        }
        "sn" => {
            let object = builder.object(grey());
            let back = vec3(0.0, 0.0, -5.0 * facing);
            side(object, builder, corner + back, wide / 2.0 - back);
            side(object, builder, corner + wide / 2.0, wide / 2.0 + back);
        }
        "sc" => {
            let object = builder.object(grey());
            side(object, builder, corner, wide);
            // The right half is in the shadow of an object above the view, which shades nothing else.
            let blocker = builder.object(grey());
            let near = z - 1.0;
            builder.quad(blocker, vec3(0.0, 20.0, near), vec3(30.0, 0.0, 0.0), vec3(0.0, 0.0, 2.0));
            builder.point_light(vec3(0.0, 1000.0, z + 2.0 * facing), Vec3::ONE);
        }
        "te" => {
            let texture = builder.ramp_texture();
            let object =
                builder.object(glimpse::scene::Material { base_color_texture: Some(texture), ..grey() });
            side(object, builder, corner, wide);
        }
        _ => unreachable!("{attribute}"),
    }
}

/// The wall, seen directly or in a mirror that fills the view.
fn scene(attribute: &str) -> Scene {
    let mut builder = Builder::new();
    builder.environment(Vec3::ONE, Vec3::ONE);
    let (of_primary, what) = attribute.split_at(1);
    if of_primary == "p" {
        wall(what, &mut builder, [0.0, 1.0]);
    } else {
        let object = builder.object(mirror(Vec3::ONE));
        builder.quad(object, vec3(-4.0, -4.0, 0.0), vec3(8.0, 0.0, 0.0), vec3(0.0, 8.0, 0.0));
        wall(what, &mut builder, [4.0, -1.0]);
    }
    builder.seen_by(front_camera())
}

fn union(inspection: &Inspection) -> u32 {
    inspection.pixels.iter().fold(0, |bits, pixel| bits | pixel.differing) & !1
}

/// Between two walls that look alike only this attribute detects the edge; without its threshold no pixel
/// gets extra samples.
#[test]
fn each_attribute_sees_what_no_other_does() {
    for (index, attribute) in THRESHOLD_NAMES.into_iter().enumerate().skip(1) {
        let test_scene = TestScene::new(scene(attribute));
        let only = |value| {
            let mut thresholds = Thresholds::uniform(1.0);
            let slots = [
                &mut thresholds.col,
                &mut thresholds.poid,
                &mut thresholds.psn,
                &mut thresholds.psc,
                &mut thresholds.pte,
                &mut thresholds.soid,
                &mut thresholds.ssn,
                &mut thresholds.ssc,
                &mut thresholds.ste,
            ];
            *slots.into_iter().nth(index).expect("nine") = value;
            test_scene.inspect(SIZE, &supersample(thresholds))
        };
        let strict = only(0.0);
        assert_eq!(union(&strict), 1 << index, "{attribute}: {:#b}", union(&strict));
        let seen = strict.pixels.iter().filter(|p| p.differing >> index & 1 == 1).count();
        let active = strict.pixels.iter().filter(|p| p.active != 0).count();
        assert!(seen > 70 && active == seen, "{attribute}: {active} active of {seen}");
        assert_eq!(only(1.0).counts.samples.extra, 0, "{attribute}, never");
    }
}

#[test]
fn what_is_out_of_focus_does_not_differ() {
    let test_scene = TestScene::new(scene("poid"));
    let edges = Thresholds { poid: 0.0, ..Thresholds::uniform(1.0) };
    let extra = |focus| {
        let settings = Settings { focus, ..supersample(edges) };
        test_scene.inspect(SIZE, &settings).counts.samples.extra
    };
    let everything = extra(None);
    assert!(everything > 0);
    assert_eq!(extra(Some(Focus { first: 1, last: 1 })), everything, "one of the two objects");
    assert_eq!(extra(Some(Focus { first: 2, last: 7 })), 0, "neither");
}

/// Bilinear reconstruction smooths what nearest leaves unchanged, and does not affect active quarters.
#[test]
fn inactive_quarters_are_bilinear_where_it_is_asked_for() {
    let test_scene = TestScene::builtin("room");
    let frame = |unsampled, tau| {
        test_scene.frame(SIZE, &Settings { unsampled, ..supersample(Thresholds::uniform(tau)) })
    };
    assert_same(&frame(Unsampled::Bilinear, 0.0), &frame(Unsampled::Nearest, 0.0), "all active");
    let (soft, sharp) = (frame(Unsampled::Bilinear, 1.0), frame(Unsampled::Nearest, 1.0));
    let roughness = |image: &LinearImage| -> f64 {
        let steps = image.as_raw().windows(4).map(|w| f64::from(w[3].min(1.0) - w[0].min(1.0)).abs());
        steps.sum()
    };
    assert!(roughness(&soft) < 0.9 * roughness(&sharp), "{} {}", roughness(&soft), roughness(&sharp));
}

/// The recursion's limit: every quad of both levels is divided, and every sample is traced once.
#[test]
fn a_quincunx_that_is_divided_everywhere_traces_each_sample_once() {
    let test_scene = TestScene::builtin("room");
    let [width, height] = SIZE.map(u64::from);
    let settings = Settings { method: Method::Quincunx, quincunx_threshold: 0.0, ..Settings::default() };
    let samples = test_scene.inspect(SIZE, &settings).counts.samples;
    let lattice = (4 * width + 1) * (4 * height + 1);
    assert_eq!(samples.base + samples.extra, lattice + 16 * width * height);
    let never = Settings { quincunx_threshold: 1.0, ..settings };
    let samples = test_scene.inspect(SIZE, &never).counts.samples;
    assert_eq!(samples.base + samples.extra, width * height + (width + 1) * (height + 1));
}

/// The more quads are divided, the nearer the picture is to one with many samples.
#[test]
fn a_quincunx_comes_nearer_to_many_samples_the_more_it_divides() {
    let test_scene = TestScene::builtin("room");
    let frame = |settings: Settings| test_scene.shown(SIZE, &settings);
    let many = frame(Settings { method: Method::Full, sampling: 12, ..Settings::default() });
    let error = |quincunx_threshold| {
        let picture = frame(Settings { method: Method::Quincunx, quincunx_threshold, ..Settings::default() });
        glimpse::metrics::compare(&picture, &many).expect("of one size").rmse
    };
    let [never, default, often] = [1.0, Settings::default().quincunx_threshold, 0.02].map(error);
    assert!(never > 1.5 * default && default > often, "{never} {default} {often}");
}

/// The tent filter by its formula, over a frame with one pixel per sample, in bands of rows and in one piece.
#[test]
fn a_tent_is_the_weighted_mean_of_the_samples_around() {
    let test_scene = TestScene::builtin("room");
    let [width, height] = [41, 37];
    for sampling in [2, 3] {
        let full = Settings { method: Method::Full, ..Settings::default() };
        let samples = test_scene.frame([width * sampling, height * sampling], &full);
        let tent = Settings { sampling, filter: Filter::Tent, ..full };
        let found = test_scene.frame([width, height], &tent);
        let n = f64::from(sampling);
        for (x, y, pixel) in found.enumerate_pixels() {
            let (mut sum, mut weights) = ([0.0; 3], 0.0);
            for (i, j, sample) in samples.enumerate_pixels() {
                let away = |sample: u32, pixel: u32| (f64::from(sample) + 0.5) / n - f64::from(pixel) - 0.5;
                let near = |d: f64| (1.0 - d.abs()).max(0.0);
                let weight = near(away(i, x)) * near(away(j, y));
                weights += weight;
                (0..3).for_each(|c| sum[c] += weight * f64::from(sample.0[c]));
            }
            for (found, sum) in pixel.0.into_iter().zip(sum) {
                let (found, expected) = (f64::from(found), sum / weights);
                let error = (found - expected).abs();
                assert!(error <= 1e-5 * expected.max(0.1), "{sampling} ({x}, {y}): {found} {expected}");
            }
        }
    }
}
