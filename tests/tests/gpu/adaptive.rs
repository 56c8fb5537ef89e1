//! Adaptive undersampling against full tracing, and its bookkeeping.

use glimpse::{
    DisplayImage, Gpu, Inspection, LinearImage, Linking, Method, Origin, Renderer, Settings, Tolerances,
};
use glimpse_tests::{Frame, Stage, gpu, turn};

const SCENES: [&str; 4] = ["room", "cornell", "minray", "furnace"];
const ODD_SIZES: [[u32; 2]; 9] =
    [[1, 1], [1, 7], [8, 1], [2, 1], [2, 2], [3, 5], [17, 31], [64, 33], [127, 65]];

fn strict() -> Settings {
    Settings { tolerances: Tolerances { pos: 0.0, ..Tolerances::default() }, ..Settings::default() }
}

fn bits(image: &LinearImage) -> Vec<u32> {
    image.as_raw().iter().map(|v| v.to_bits()).collect()
}

fn assert_same(a: &Frame, b: &Frame, what: &str) {
    let differ =
        |a: &DisplayImage, b: &DisplayImage| a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count();
    assert_eq!(differ(&a.display, &b.display), 0, "{what}: pixels of the display image differ");
    assert!(bits(&a.linear) == bits(&b.linear), "{what}: the linear image differs");
    assert!(a.linear.as_raw().iter().all(|v| v.is_finite() && *v >= 0.0), "{what}: radiance is finite");
}

#[test]
fn strictest_tolerances_give_the_full_frame_bit_for_bit() {
    for scene in SCENES {
        let stage = Stage::builtin(scene);
        let size = [127, 65];
        let full = stage.frame(size, &Settings { method: Method::Full, ..Settings::default() });
        assert_same(&stage.frame(size, &strict()), &full, scene);
        assert_eq!(stage.inspect(size, &strict()).counts.samples.interpolated, 0, "{scene}");
    }
}

#[test]
fn leaving_out_changes_nothing() {
    for scene in SCENES {
        let stage = Stage::builtin(scene);
        for method in [Method::Full, Method::Adaptive] {
            let settings = Settings { method, ..Settings::default() };
            let all = Settings { features: Linking::All, ..settings };
            let what = format!("{scene}, {method:?}");
            assert_same(&stage.frame([128, 96], &all), &stage.frame([128, 96], &settings), &what);
        }
    }
}

#[test]
fn a_frame_comes_out_the_same_twice() {
    for scene in SCENES {
        let stage = Stage::builtin(scene);
        let frame = || stage.frame([128, 96], &Settings::default());
        assert_same(&frame(), &frame(), scene);
    }
}

/// Counting kernels, timed kernels and those that write radiance make the same picture, in any order.
#[test]
fn looking_at_a_frame_does_not_change_it() {
    let stage = Stage::builtin("room");
    let settings = Settings::default();
    let _turn = turn();
    let mut renderer = Renderer::new(gpu(), &stage.scene, [96, 64], &settings).unwrap();
    renderer.render(&stage.camera).unwrap();
    let before = renderer.display_image().unwrap();
    renderer.inspect(&stage.camera).unwrap();
    assert_eq!(renderer.display_image().unwrap(), before, "after inspect");
    renderer.linear_image(&stage.camera).unwrap();
    renderer.render(&stage.camera).unwrap();
    assert_eq!(renderer.display_image().unwrap(), before, "after linear_image and render");
}

/// Which step a pixel belongs to (Kim 2016, Figure 2).
fn expected_step(x: u32, y: u32) -> Origin {
    match (x % 2, y % 2) {
        (0, 0) => Origin::Base,
        (_, 0) => Origin::TracedA1,
        _ => Origin::TracedA2,
    }
}

fn check_books(inspection: &Inspection, [width, height]: [u32; 2], what: &str) {
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
            let step = expected_step(x, y);
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
    let (room, furnace) = (Stage::builtin("room"), Stage::builtin("furnace"));
    for size in ODD_SIZES {
        let what = format!("{size:?}");
        check_books(&room.inspect(size, &Settings::default()), size, &what);
        let frame = room.frame(size, &Settings::default());
        assert!(frame.display.pixels().all(|p| p[3] == 255), "{what}: opaque");
        let full = room.frame(size, &Settings { method: Method::Full, ..Settings::default() });
        assert_same(&room.frame(size, &strict()), &full, &what);
        // Every pixel of the furnace is known, so a pixel that nobody wrote shows.
        let known = furnace.frame(size, &Settings::default()).linear;
        assert!(known.as_raw().iter().all(|v| (v - 1.0).abs() <= 1e-5), "{what}: {:?}", known.as_raw());
    }
}

#[test]
fn full_tracing_traces_every_sample() {
    let size = [33, 17];
    let settings = Settings { method: Method::Full, ..Settings::default() };
    let counts = Stage::builtin("room").inspect(size, &settings).counts;
    assert_eq!((counts.rays.primary, counts.samples.interpolated), (33 * 17, 0));
    assert_eq!(counts.rt_ratio(), 1.0);
    assert!(counts.cost.node_visits > 0 && counts.cost.primitive_tests > 0);
}

#[test]
fn most_of_a_room_is_interpolated() {
    let counts = Stage::builtin("room").inspect([512, 288], &Settings::default()).counts;
    let ratio = counts.rt_ratio();
    assert!((0.25..0.75).contains(&ratio), "RT ratio {ratio}");
}

/// The picture of a frame that holds nothing, or too much.
#[test]
fn impossible_sizes_are_refused() {
    let stage = Stage::builtin("furnace");
    let gpu: &Gpu = gpu();
    let _turn = turn();
    for size in [[0, 0], [0, 4], [4, 0], [u32::MAX, u32::MAX], [1_000_000, 1_000_000]] {
        let error = Renderer::new(gpu, &stage.scene, size, &Settings::default()).err();
        let line = error.unwrap_or_else(|| panic!("{size:?} is accepted")).to_string();
        assert!(!line.contains('\n') && !line.is_empty(), "{line}");
    }
}
