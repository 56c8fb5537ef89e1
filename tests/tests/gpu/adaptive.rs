//! Adaptive undersampling against full ray tracing, and its counters.

use glimpse::{
    Gpu, Inspection, LinearImage, Method, Origin, Postcorrect, Renderer, Scene, Settings, Specialize,
    Tolerances, encode_display, scene::builtin,
};
use glimpse_tests::{TestScene, assert_same, gallery, gpu, shared_scene};

const SCENES: [&str; 4] = ["room", "cornell", "minray", "furnace"];
const ODD_SIZES: [[u32; 2]; 9] =
    [[1, 1], [1, 7], [8, 1], [2, 1], [2, 2], [3, 5], [17, 31], [64, 33], [127, 65]];

/// Sides of base blocks, in pixels.
const BLOCKS: [u32; 3] = [2, 4, 8];

fn strict() -> Settings {
    Settings { tolerances: Tolerances { pos: 0.0, ..Tolerances::default() }, ..Settings::default() }
}

fn full() -> Settings {
    Settings { method: Method::Full, ..Settings::default() }
}

#[test]
fn strictest_tolerances_give_the_full_frame_bit_for_bit() {
    for scene in SCENES {
        let test_scene = TestScene::builtin(scene);
        let size = [127, 65];
        let full = test_scene.frame(size, &full());
        for block in BLOCKS {
            let strict = Settings { block, ..strict() };
            assert_same(&test_scene.frame(size, &strict), &full, &format!("{scene}, blocks of {block}"));
            assert_eq!(test_scene.inspect(size, &strict).counts.samples.interpolated, 0, "{scene}");
        }
    }
}

fn assert_leaving_out_changes_nothing(name: &str, test_scene: &TestScene, size: [u32; 2], method: Method) {
    let auto = Settings { method, postcorrect: Postcorrect::On, ..Settings::default() };
    let all = Settings { specialize: Specialize::All, ..auto };
    assert_same(
        &test_scene.frame(size, &all),
        &test_scene.frame(size, &auto),
        &format!("{name}, {method:?}"),
    );
}

/// All methods use the same tracing code; specialization differs most between scenes with all features and
/// with none.
#[test]
fn leaving_out_changes_nothing() {
    let scenes = [
        ("room", built_in("room")),
        ("wires", built_in("wires")),
        ("minray", built_in("minray")),
        ("textures", gallery::textures()),
        ("extended", gallery::extended()),
        ("layers", gallery::layers()),
        ("glasshouse", gallery::glasshouse()),
        ("orthographic", gallery::orthographic()),
    ];
    for (name, scene) in scenes {
        let test_scene = TestScene::new(scene);
        assert_leaving_out_changes_nothing(name, &test_scene, [128, 96], Method::Full);
        if ["room", "wires"].contains(&name) {
            assert_leaving_out_changes_nothing(name, &test_scene, [128, 96], Method::Adaptive);
            assert_leaving_out_changes_nothing(name, &test_scene, [128, 96], Method::Checkerboard);
        }
    }
}

fn built_in(name: &str) -> Scene {
    builtin(name).expect("a built-in scene")
}

/// Each of the shared scenes lacks another feature.
#[test]
fn leaving_out_changes_nothing_in_shared_scenes() {
    for file in ["vr_bunny.glb", "coffee_maker.glb", "wooden_staircase.glb", "contemporary_bathroom.glb"] {
        let Some(scene) = shared_scene(file) else { continue };
        assert_leaving_out_changes_nothing(file, &TestScene::new(scene), [96, 54], Method::Full);
    }
}

#[test]
fn a_frame_comes_out_the_same_twice() {
    for scene in SCENES {
        let test_scene = TestScene::builtin(scene);
        let frame = || test_scene.frame([128, 96], &Settings::default());
        assert_same(&frame(), &frame(), scene);
    }
}

/// The displayed frame is the linear frame encoded, for every method; one level of difference is allowed for
/// the precision of drivers' `pow`.
#[test]
fn a_frame_is_shown_as_it_is_computed() {
    let test_scene = TestScene::builtin("cornell");
    for method in Method::ALL.into_iter().filter(|method| !method.has_history()) {
        let settings = Settings { method, ..Settings::default() };
        for size in ODD_SIZES {
            let shown = test_scene.shown(size, &settings);
            let expected = encode_display(&test_scene.frame(size, &settings));
            let apart = shown.as_raw().iter().zip(expected.as_raw()).map(|(a, b)| a.abs_diff(*b)).max();
            assert!(apart <= Some(1), "{method:?}, {size:?}: {apart:?}");
            assert!(shown.pixels().all(|p| p[3] == 255), "{method:?}, {size:?}: opaque");
        }
    }
}

/// Counting kernels, timed kernels and kernels that write radiance give the same picture, in any order.
#[test]
fn looking_at_a_frame_does_not_change_it() {
    let test_scene = TestScene::builtin("room");
    let settings = Settings::default();
    let mut renderer = Renderer::new(gpu(), &test_scene.scene, [96, 64], &settings).unwrap();
    renderer.render(&test_scene.camera).unwrap();
    let before = renderer.display_image().unwrap();
    renderer.inspect(&test_scene.camera).unwrap();
    assert_eq!(renderer.display_image().unwrap(), before, "after inspect");
    renderer.linear_image(&test_scene.camera).unwrap();
    renderer.render(&test_scene.camera).unwrap();
    assert_eq!(renderer.display_image().unwrap(), before, "after linear_image and render");
}

/// Step to which a pixel belongs (Kim 2016, Figure 2): in the finest level, or recursively in that of every
/// second pixel.
fn expected_step(x: u32, y: u32, block: u32) -> Origin {
    match (x % 2, y % 2) {
        _ if block == 1 => Origin::Base,
        (0, 0) => expected_step(x / 2, y / 2, block / 2),
        (_, 0) => Origin::TracedA1,
        _ => Origin::TracedA2,
    }
}

fn check_books(inspection: &Inspection, [width, height]: [u32; 2], block: u32, what: &str) {
    let count = |origin: Origin| inspection.pixels.iter().filter(|p| p.origin == origin).count() as u64;
    let s = &inspection.counts.samples;
    assert_eq!(s.total, u64::from(width * height), "{what}");
    assert_eq!(
        s.base + s.traced_a1 + s.traced_a2 + s.postcorrected + s.interpolated,
        s.total,
        "{what}: {s:?}"
    );
    assert_eq!(s.base, count(Origin::Base), "{what}");
    assert_eq!(s.traced_a1, count(Origin::TracedA1), "{what}");
    assert_eq!(s.traced_a2, count(Origin::TracedA2), "{what}");
    assert_eq!(s.interpolated, count(Origin::Interpolated), "{what}");
    assert_eq!(s.postcorrected, count(Origin::Postcorrected), "{what}");
    assert_eq!(inspection.uncorrected, 0, "{what}");
    let r = &inspection.counts.rays;
    assert_eq!(r.primary, s.total - s.interpolated, "{what}: one primary ray a traced sample");
    assert_eq!(r.total, r.primary + r.shadow + r.reflection + r.refraction, "{what}: {r:?}");
    for y in 0..height {
        for x in 0..width {
            let pixel = &inspection.pixels[(y * width + x) as usize];
            let step = expected_step(x, y, block);
            let told = matches!(pixel.origin, Origin::Interpolated | Origin::Postcorrected);
            let fits = pixel.origin == step || (told && step != Origin::Base);
            assert!(fits, "{what} ({x}, {y}): {:?} where {step:?} belongs", pixel.origin);
            let checked = pixel.failed == 0 || pixel.origin == step;
            assert!(checked, "{what} ({x}, {y}): interpolated though checks {:#b} fail", pixel.failed);
        }
    }
}

#[test]
fn every_size_is_covered_and_the_counts_add_up() {
    let (room, furnace) = (TestScene::builtin("room"), TestScene::builtin("furnace"));
    for size in ODD_SIZES {
        let what = format!("{size:?}");
        for block in BLOCKS {
            let settings = Settings { block, ..Settings::default() };
            check_books(&room.inspect(size, &settings), size, block, &format!("{what}, blocks of {block}"));
        }
        let full = room.frame(size, &full());
        assert_same(&room.frame(size, &Settings { block: 8, ..strict() }), &full, &what);
        // Every pixel of the furnace has a known value, so that unwritten pixels show.
        let known = furnace.frame(size, &Settings { block: 4, sampling: 2, ..Settings::default() });
        assert!(known.as_raw().iter().all(|v| (v - 1.0).abs() <= 1e-5), "{what}: {:?}", known.as_raw());
    }
}

/// Averages the samples of each pixel, from a frame `sampling` times as large.
fn averaged(large: &LinearImage, sampling: u32) -> Vec<u32> {
    let [width, height] = [large.width(), large.height()].map(|side| side / sampling);
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [sampling * x, sampling * y]));
    let groups = summed(sampling);
    let average = |[x, y]: [u32; 2]| {
        let mut sum = [0.0_f32; 3];
        for group in &groups {
            let mut part = [0.0_f32; 3];
            for [across, down] in group {
                let radiance = large.get_pixel(x + across, y + down).0;
                part = std::array::from_fn(|i| part[i] + radiance[i]);
            }
            sum = std::array::from_fn(|i| sum[i] + part[i]);
        }
        sum.map(|channel| (channel / (sampling * sampling) as f32).to_bits())
    };
    pixels.flat_map(average).collect()
}

/// Samples of a pixel in the order of summation: sixteen in groups of four, one from each quarter.
fn summed(sampling: u32) -> Vec<Vec<[u32; 2]>> {
    if sampling == 4 {
        return vec![
            vec![[0, 0], [2, 2], [1, 3], [3, 1]],
            vec![[0, 2], [2, 0], [1, 1], [3, 3]],
            vec![[0, 3], [2, 1], [1, 0], [3, 2]],
            vec![[0, 1], [2, 3], [1, 2], [3, 0]],
        ];
    }
    vec![(0..sampling * sampling).map(|i| [i % sampling, i / sampling]).collect()]
}

#[test]
fn a_sampling_grid_is_a_larger_frame_averaged() {
    let room = TestScene::builtin("room");
    let adaptive = |block, postcorrect| Settings { block, postcorrect, ..Settings::default() };
    for (settings, sampling) in [
        (full(), 2),
        (full(), 3),
        (adaptive(2, Postcorrect::Off), 4),
        (adaptive(2, Postcorrect::On), 2),
        (adaptive(8, Postcorrect::On), 2),
    ] {
        let size = [31, 18];
        let large = room.frame(size.map(|side| sampling * side), &settings);
        let frame = room.frame(size, &Settings { sampling, ..settings });
        let bits: Vec<_> = frame.as_raw().iter().map(|v| v.to_bits()).collect();
        assert!(bits == averaged(&large, sampling), "{settings:?}, {sampling}");
    }
}

/// More samples than fit into the device's buffers together.
#[test]
fn frames_in_bands_have_no_seams() {
    let (size, sampling) = ([160, 144], 16);
    let test_scene = TestScene::builtin("minray");
    let full = test_scene.frame(size, &Settings { sampling, ..full() });
    for block in BLOCKS {
        let strict = test_scene.frame(size, &Settings { sampling, block, ..strict() });
        assert_same(&strict, &full, &format!("blocks of {block}"));
    }
    let known = TestScene::builtin("furnace").frame(size, &Settings { sampling, ..Settings::default() });
    assert!(known.as_raw().iter().all(|v| (v - 1.0).abs() <= 1e-5));
    let counts =
        |settings: &Settings| test_scene.inspect(size, &Settings { sampling, ..*settings }).counts.samples;
    let samples = counts(&Settings::default());
    assert_eq!(samples.total, u64::from(size[0] * size[1] * sampling * sampling));
    assert_eq!(samples.base + samples.traced_a1 + samples.traced_a2 + samples.interpolated, samples.total);
    assert!(samples.interpolated > samples.total / 2, "{samples:?}");
}

#[test]
fn full_tracing_traces_every_sample() {
    let size = [33, 17];
    let settings = full();
    let counts = TestScene::builtin("room").inspect(size, &settings).counts;
    assert_eq!((counts.rays.primary, counts.samples.interpolated), (33 * 17, 0));
    assert_eq!(counts.rt_ratio(), 1.0);
    assert!(counts.cost.node_visits > 0 && counts.cost.primitive_tests > 0);
}

#[test]
fn most_of_a_room_is_interpolated() {
    let counts = TestScene::builtin("room").inspect([512, 288], &Settings::default()).counts;
    let ratio = counts.rt_ratio();
    assert!((0.25..0.75).contains(&ratio), "RT ratio {ratio}");
}

/// Frame sizes that are empty or too large.
#[test]
fn impossible_sizes_are_refused() {
    let test_scene = TestScene::builtin("furnace");
    let gpu: &Gpu = gpu();
    for size in [[0, 0], [0, 4], [4, 0], [u32::MAX, u32::MAX], [1_000_000, 1_000_000]] {
        let error = Renderer::new(gpu, &test_scene.scene, size, &Settings::default()).err();
        let line = error.unwrap_or_else(|| panic!("{size:?} is accepted")).to_string();
        assert!(!line.contains('\n') && !line.is_empty(), "{line}");
    }
}
