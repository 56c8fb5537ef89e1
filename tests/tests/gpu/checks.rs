//! For each of the similarity checks (Kim 2016, Table 1), a scene in which only that check fails, at
//! the paper's tolerances. In a scene without the difference, or with a wide tolerance, every pixel passes.

use glam::{Vec2, Vec3, vec2, vec3};
use glimpse::{Camera, Check, Inspection, Origin, Scene, Settings, Tolerances};
use glimpse_tests::{
    TestScene,
    builder::{Builder, front_camera, matte, mirror, unlit},
};

const SIZE: [u32; 2] = [96, 64];

/// Offset from the middle, so that no pixel centre lies on the border.
const BORDER: f32 = 0.013;

fn inspect(scene: Scene, tolerances: Tolerances) -> Inspection {
    let inspection = TestScene::new(scene).inspect(SIZE, &Settings { tolerances, ..Settings::default() });
    let sums = Check::ALL.map(|check| {
        let pixels = inspection.pixels.iter().filter(|p| p.failed & check.bit() != 0);
        (check.name(), pixels.count() as u64)
    });
    assert_eq!(sums, inspection.counts.failed_checks.labelled(), "counters and pixels agree");
    for pixel in &inspection.pixels {
        assert!(
            pixel.failed == 0 || matches!(pixel.origin, Origin::TracedA1 | Origin::TracedA2),
            "{pixel:?}"
        );
    }
    inspection
}

/// A scene in which only this check fails.
fn scene_failing(check: Check) -> Scene {
    match check {
        Check::Oid => halves(2),
        Check::Pos => floor(),
        Check::Norm => ridge(),
        Check::Convex => step(0.04),
        Check::Tex => tiled(true),
        Check::Shadow => shadow_edge(true),
        Check::Gcol => mirrored_edge(),
    }
}

fn only(check: Check) {
    let inspection = inspect(scene_failing(check), Tolerances::default());
    let caught = inspection.pixels.iter().filter(|p| p.failed == check.bit()).count();
    let other = inspection.pixels.iter().filter(|p| p.failed & !check.bit() != 0).count();
    assert!(caught > 10, "{check:?} fails on {caught} pixels: {:?}", inspection.counts.failed_checks);
    assert_eq!(other, 0, "other checks fail too: {:?}", inspection.counts.failed_checks);
    assert!(caught < inspection.pixels.len() / 2, "{check:?} fails on {caught} pixels");
}

#[test]
fn each_check_has_a_scene_that_it_alone_catches() {
    Check::ALL.into_iter().for_each(only);
}

fn none(scene: Scene, tolerances: Tolerances) {
    let inspection = inspect(scene, tolerances);
    let failed = inspection.counts.failed_checks;
    assert!(inspection.pixels.iter().all(|p| p.failed == 0), "{failed:?}");
}

/// A plane in two halves, which are two objects or one.
fn halves(objects: u32) -> Scene {
    let mut builder = Builder::new();
    let left = builder.object(matte(Vec3::ONE));
    let right = if objects == 2 { builder.object(matte(Vec3::ONE)) } else { left };
    builder.quad(left, vec3(-2.0, -2.0, 0.0), (2.0 + BORDER) * Vec3::X, 4.0 * Vec3::Y);
    builder.quad(right, vec3(BORDER, -2.0, 0.0), (2.0 - BORDER) * Vec3::X, 4.0 * Vec3::Y);
    builder.seen_by(front_camera())
}

#[test]
fn oid() {
    none(halves(1), Tolerances::default());
}

/// A floor seen near its horizon: rows of pixels are far apart in the same plane.
fn floor() -> Scene {
    let mut builder = Builder::new();
    let floor = builder.object(matte(Vec3::ONE));
    builder.quad(floor, vec3(-10.0, 0.0, 10.0), 20.0 * Vec3::X, -20.0 * Vec3::Z);
    // The view direction of the frame's upper edge is 0.0125 rad below the horizon: it sees the floor 8 units
    // away.
    let fov = 0.35_f32;
    let (sin, cos) = (0.5 * fov + 0.0125).sin_cos();
    let eye = vec3(0.0, 0.1, 9.9);
    builder.seen_by(Camera::look_at(eye, eye + vec3(0.0, -sin, -cos), fov).expect("a valid camera"))
}

#[test]
fn pos() {
    none(floor(), Tolerances { pos: f32::MAX, ..Tolerances::default() });
}

/// A ridge pointing at the viewer, with 45 degrees between the normals.
fn ridge() -> Scene {
    let back = 2.0 * 22.5_f32.to_radians().tan();
    let mut builder = Builder::new();
    let ridge = builder.object(matte(Vec3::ONE));
    builder.quad(ridge, vec3(BORDER - 2.0, -2.0, -back), vec3(2.0, 0.0, back), 4.0 * Vec3::Y);
    builder.quad(ridge, vec3(BORDER, -2.0, 0.0), vec3(2.0, 0.0, -back), 4.0 * Vec3::Y);
    builder.seen_by(front_camera())
}

#[test]
fn norm() {
    none(ridge(), Tolerances { norm: -1.0, ..Tolerances::default() });
}

/// Two parallel halves of one object, one a hundredth of the scene behind the other: near and alike, but not
/// smooth.
fn step(height: f32) -> Scene {
    let mut builder = Builder::new();
    let wall = builder.object(matte(Vec3::ONE));
    builder.quad(wall, vec3(-2.0, -2.0, 0.0), (2.0 + BORDER) * Vec3::X, 4.0 * Vec3::Y);
    builder.quad(wall, vec3(BORDER - 0.5 * height, -2.0, -height), 2.0 * Vec3::X, 4.0 * Vec3::Y);
    builder.seen_by(front_camera())
}

#[test]
fn convex() {
    none(halves(1), Tolerances::default());
}

/// A texture that repeats at the middle of a plane.
fn tiled(repeats: bool) -> Scene {
    let mut builder = Builder::new();
    let texture = builder.ramp_texture();
    let wall =
        builder.object(glimpse::scene::Material { base_color_texture: Some(texture), ..matte(Vec3::ONE) });
    let s = if repeats { 2.0 } else { 1.0 };
    builder.textured_quad(
        wall,
        [vec3(-2.0, -2.0, 0.0), 4.0 * Vec3::X, 4.0 * Vec3::Y],
        [vec2(0.0, 0.4), Vec2::new(s, 0.6)],
    );
    builder.seen_by(front_camera())
}

#[test]
fn tex() {
    none(tiled(false), Tolerances::default());
    none(tiled(true), Tolerances { tex: 0.0, ..Tolerances::default() });
}

/// A wall half in the hard shadow of an object behind the camera.
fn shadow_edge(casts: bool) -> Scene {
    let mut builder = Builder::new();
    let wall = builder.object(matte(Vec3::ONE));
    builder.quad(wall, vec3(-2.0, -2.0, 0.0), 4.0 * Vec3::X, 4.0 * Vec3::Y);
    let screen = builder.object(glimpse::scene::Material { casts_shadow: casts, ..matte(Vec3::ONE) });
    builder.quad(screen, vec3(-2.0, -2.0, 3.0), (2.0 + 0.5 * BORDER) * Vec3::X, 4.0 * Vec3::Y);
    builder.point_light(vec3(0.0, 0.0, 6.0), Vec3::splat(60.0));
    builder.seen_by(front_camera())
}

#[test]
fn shadow() {
    none(shadow_edge(false), Tolerances::default());
}

/// A mirror showing the edge of a bright panel behind the camera.
fn mirrored_edge() -> Scene {
    let mut builder = Builder::new();
    let wall = builder.object(mirror(Vec3::splat(0.95)));
    builder.quad(wall, vec3(-2.0, -2.0, 0.0), 4.0 * Vec3::X, 4.0 * Vec3::Y);
    let panel = builder.object(unlit(Vec3::ONE));
    // The eye's mirror image is at z = -2, so that the panel at z = 3 is 5/2 times as large as its image on
    // the mirror.
    builder.quad(panel, vec3(-4.0, 3.0, 3.0), (4.0 + 2.5 * BORDER) * Vec3::X, -6.0 * Vec3::Y);
    builder.seen_by(front_camera())
}

#[test]
fn gcol() {
    none(mirrored_edge(), Tolerances { gcol: f32::MAX, ..Tolerances::default() });
}

/// A pane whose coverage has a dent between samples, before a wall.
fn dented(alpha: u8) -> Scene {
    let mut builder = Builder::new();
    let wall = builder.object(unlit(Vec3::Y));
    builder.quad(wall, vec3(-4.0, -4.0, -1.0), 8.0 * Vec3::X, 8.0 * Vec3::Y);
    let rgba = (0..32).flat_map(|x| [255, 255, 255, if x == 16 { alpha } else { 128 }]).collect();
    let image = builder.image(glimpse::scene::Image8 { width: 32, height: 1, rgba });
    let texture = builder.texture(glimpse::scene::Texture {
        image,
        wrap: [glimpse::scene::Wrap::ClampToEdge; 2],
        nearest: true,
    });
    let material =
        glimpse::scene::Material { base_color_texture: Some(texture), blends: true, ..unlit(Vec3::Y) };
    let pane = builder.object(material);
    builder.quad(pane, vec3(-1.5, -1.5, 0.0), 3.0 * Vec3::X, 3.0 * Vec3::Y);
    builder.seen_by(front_camera())
}

/// Coverage weights the radiance of what is behind: where it bends, that is not interpolated.
#[test]
fn coverage_is_compared_with_that_between() {
    let caught = |alpha, gcol| {
        let tolerances = Tolerances { gcol, tex: 0.0, ..Tolerances::default() };
        let inspection = inspect(dented(alpha), tolerances);
        inspection.pixels.iter().filter(|p| p.failed == Check::Gcol.bit()).count()
    };
    let none = caught(128, 0.15);
    assert_eq!(none, 0);
    assert!(caught(255, 0.15) > 10);
    assert_eq!(caught(255, f32::MAX), 0);
}
