//! Postcorrection (Kim 2016, section 4): it restores what falls between samples, and changes nothing else.

use std::collections::BTreeSet;

use glam::{Vec3, vec3};
use glimpse::{
    DisplayImage, Inspection, Method, Origin, Postcorrect, Scene, Settings, Tolerances,
    reference::{Reference, ReferenceFrame},
};
use glimpse_tests::{
    TestScene,
    builder::{Builder, front_camera, matte, unlit},
};

const SIZE: [u32; 2] = [128, 96];

/// Size of a pixel in the plane z = 0, seen from [`front_camera`].
const PIXEL: f32 = 2.0 * 2.0 * 0.414_213_57 / SIZE[1] as f32;

fn settings(postcorrect: Postcorrect) -> Settings {
    Settings { postcorrect, ..Settings::default() }
}

/// A tilted strip of height `height` in the plane at `z`.
fn strip(builder: &mut Builder, object: u32, z: f32, height: f32) {
    builder.quad(object, vec3(-1.0, -0.21, z), vec3(2.0, 0.3, 0.0), height * Vec3::Y);
}

/// A strip 1.3 pixels wide in front of a wall: wide enough to be connected, narrow enough to pass between
/// base samples.
fn wire() -> Scene {
    let mut builder = Builder::new();
    let wall = builder.object(unlit(Vec3::splat(0.2)));
    let wire = builder.object(unlit(Vec3::ONE));
    builder.quad(wall, vec3(-4.0, -4.0, -0.5), 8.0 * Vec3::X, 8.0 * Vec3::Y);
    strip(&mut builder, wire, 0.0, 1.3 * PIXEL);
    builder.seen_by(front_camera())
}

/// The shadow of such a strip, which itself is behind the camera.
fn thin_shadow() -> Scene {
    let mut builder = Builder::new();
    let wall = builder.object(matte(Vec3::ONE));
    builder.quad(wall, vec3(-4.0, -4.0, 0.0), 8.0 * Vec3::X, 8.0 * Vec3::Y);
    let strip_object = builder.object(matte(Vec3::ONE));
    // Half way to the light, so that its shadow is twice as large.
    strip(&mut builder, strip_object, 3.0, 0.65 * PIXEL);
    builder.point_light(vec3(0.0, 0.0, 6.0), Vec3::splat(60.0));
    builder.seen_by(front_camera())
}

type Pixels = BTreeSet<[u32; 2]>;

fn pixels(is_one: impl Fn([u32; 2]) -> bool) -> Pixels {
    let [width, height] = SIZE;
    (0..height).flat_map(|y| (0..width).map(move |x| [x, y])).filter(|p| is_one(*p)).collect()
}

fn record(inspection: &Inspection, [x, y]: [u32; 2]) -> glimpse::PixelRecord {
    inspection.pixels[(y * SIZE[0] + x) as usize]
}

fn with_object(inspection: &Inspection, object: u32) -> Pixels {
    pixels(|p| record(inspection, p).object == Some(object))
}

fn corrected(inspection: &Inspection) -> Pixels {
    pixels(|p| record(inspection, p).origin == Origin::Postcorrected)
}

fn differing(a: &DisplayImage, b: &DisplayImage) -> usize {
    a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count()
}

/// Pixels of `all` that are connected with `from`, through horizontal and vertical neighbours.
fn connected(all: &Pixels, from: &Pixels) -> Pixels {
    let mut open: Vec<_> = all.intersection(from).copied().collect();
    let mut found: Pixels = open.iter().copied().collect();
    while let Some([x, y]) = open.pop() {
        for next in [[x + 1, y], [x, y + 1], [x.wrapping_sub(1), y], [x, y.wrapping_sub(1)]] {
            if all.contains(&next) && found.insert(next) {
                open.push(next);
            }
        }
    }
    found
}

#[test]
fn a_wire_that_is_lost_in_parts_comes_back() {
    let test_scene = TestScene::new(wire());
    let full =
        with_object(&test_scene.inspect(SIZE, &Settings { method: Method::Full, ..Settings::default() }), 1);
    for block in [2, 4] {
        let seen = |postcorrect| test_scene.inspect(SIZE, &Settings { block, ..settings(postcorrect) });
        let without = with_object(&seen(Postcorrect::Off), 1);
        assert!(10 * without.len() < 9 * full.len(), "block {block}: {} of {}", without.len(), full.len());
        let reachable = connected(&full, &without);
        assert!(20 * reachable.len() > 19 * full.len(), "block {block}: it is in pieces");
        for postcorrect in [Postcorrect::Objects, Postcorrect::On] {
            let with = seen(postcorrect);
            assert_eq!(with_object(&with, 1), reachable, "block {block}, {postcorrect:?}");
            assert_eq!(with.uncorrected, 0);
        }
    }
}

/// Squares little wider than a pixel, each around a pixel whose row and column have no base samples.
fn confetti() -> Scene {
    let mut builder = Builder::new();
    let wall = builder.object(unlit(Vec3::splat(0.2)));
    builder.quad(wall, vec3(-4.0, -4.0, -0.5), 8.0 * Vec3::X, 8.0 * Vec3::Y);
    let object = builder.object(unlit(Vec3::ONE));
    let side = 1.2 * PIXEL;
    for i in 0..20 {
        let center = PIXEL * vec3(-37.5 + 4.0 * i as f32, 2.5 - 4.0 * (i % 3) as f32, 0.0);
        builder.quad(object, center - 0.5 * vec3(side, side, 0.0), side * Vec3::X, side * Vec3::Y);
    }
    builder.seen_by(front_camera())
}

#[test]
fn what_lies_between_the_samples_as_a_whole_is_found_by_its_probe_points() {
    let test_scene = TestScene::new(confetti());
    let seen = |settings: &Settings| with_object(&test_scene.inspect(SIZE, settings), 1);
    let full = seen(&Settings { method: Method::Full, ..Settings::default() });
    assert_eq!(full.len(), 20, "each is one pixel");
    for block in [2, 8] {
        let by = |postcorrect| seen(&Settings { block, ..settings(postcorrect) });
        assert_eq!(by(Postcorrect::On), full, "block {block}");
        assert!(by(Postcorrect::Scans).is_empty(), "block {block}: no traced pixel is beside them");
    }
}

#[test]
fn a_missing_shadow_is_found_by_its_bits_alone() {
    let test_scene = TestScene::new(thin_shadow());
    let full = test_scene.full(SIZE);
    let full = glimpse::encode_display(&full);
    let picture = |postcorrect| test_scene.shown(SIZE, &settings(postcorrect));
    let [off, objects, on] = [Postcorrect::Off, Postcorrect::Objects, Postcorrect::On].map(picture);
    let lost = differing(&off, &full);
    assert!(lost > 20, "{lost} pixels of the shadow are lost");
    assert_eq!(differing(&objects, &off), 0, "there is no other object");
    let left = differing(&on, &full);
    assert!(20 * left < lost, "{left} of {lost} pixels are still lost");
}

#[test]
fn where_everything_is_traced_nothing_is_corrected() {
    let strict = Tolerances { pos: 0.0, ..Tolerances::default() };
    for scene in [wire(), thin_shadow()] {
        let test_scene = TestScene::new(scene);
        let frame =
            |postcorrect| test_scene.frame(SIZE, &Settings { tolerances: strict, ..settings(postcorrect) });
        let full = test_scene.frame(SIZE, &Settings { method: Method::Full, ..Settings::default() });
        for postcorrect in [Postcorrect::On, Postcorrect::Scans] {
            assert!(frame(postcorrect).as_raw() == full.as_raw(), "{postcorrect:?}");
        }
    }
}

/// The device and the reference retrace the same pixels, in any order; scans retrace a subset.
#[test]
fn it_is_the_least_set_that_is_closed() {
    for scene in [wire(), thin_shadow()] {
        let reference = Reference::new(&scene);
        let test_scene = TestScene::new(scene);
        for block in [2, 4, 8] {
            let settings = |postcorrect| Settings { block, ..settings(postcorrect) };
            let before = test_scene.inspect(SIZE, &settings(Postcorrect::Off));
            let again = |postcorrect| corrected(&test_scene.inspect(SIZE, &settings(postcorrect)));
            let found = again(Postcorrect::On);
            let frame = ReferenceFrame {
                reference: &reference,
                camera: test_scene.camera,
                size: SIZE,
                settings: settings(Postcorrect::On),
            };
            let expected = frame.postcorrection(&|p| record(&before, p).origin);
            assert!(expected.len() > 50, "{} pixels", expected.len());
            assert_eq!(found, expected, "block {block}");
            assert_eq!(again(Postcorrect::On), found, "the same twice");
            let scanned = again(Postcorrect::Scans);
            assert!(scanned.is_subset(&found) && scanned.len() > 50, "scans: {}", scanned.len());
        }
    }
}

/// The numbers of rounds and steps suffice in every scene.
#[test]
fn nothing_is_left_behind() {
    for name in ["room", "cornell", "minray", "wires"] {
        let test_scene = TestScene::builtin(name);
        for block in [2, 8] {
            let inspection = test_scene.inspect([256, 160], &Settings { block, ..settings(Postcorrect::On) });
            assert_eq!(inspection.uncorrected, 0, "{name}, block {block}");
            assert!(inspection.counts.samples.postcorrected > 0, "{name}, block {block}");
        }
    }
}

/// A wire between two rows of base samples that is detected at one end and followed to the other.
#[test]
fn a_long_way_is_followed_to_its_end() {
    let mut builder = Builder::new();
    let wall = builder.object(unlit(Vec3::splat(0.2)));
    let wire = builder.object(unlit(Vec3::ONE));
    builder.quad(wall, vec3(-40.0, -4.0, -0.5), 80.0 * Vec3::X, 8.0 * Vec3::Y);
    let row = |y: f32| (0.5 * SIZE[1] as f32 - y) * PIXEL;
    let size = [2048, SIZE[1]];
    let half = 0.5 * size[0] as f32 * PIXEL;
    builder.quad(wire, vec3(-half, row(34.0), 0.0), vec3(2.0 * half, 0.0, 0.0), 0.9 * PIXEL * Vec3::Y);
    builder.quad(
        wire,
        vec3(half - 4.0 * PIXEL, row(35.0), 0.0),
        vec3(4.0 * PIXEL, 0.0, 0.0),
        1.9 * PIXEL * Vec3::Y,
    );
    let test_scene = TestScene::new(builder.seen_by(front_camera()));
    let count = |settings: Settings| {
        let inspection = test_scene.inspect(size, &settings);
        assert_eq!(inspection.uncorrected, 0);
        inspection.pixels.iter().filter(|p| p.object == Some(wire)).count()
    };
    let full = count(Settings { method: Method::Full, ..Settings::default() });
    assert!(count(settings(Postcorrect::Off)) < 100, "it is seen at its end alone");
    assert_eq!(count(settings(Postcorrect::On)), full);
}
