//! Texture averages over the footprint of a sample, against many point samples.

use glam::{Vec2, Vec3, vec2, vec3};
use glimpse::{
    Camera, Method, Mip, Scene, Settings,
    metrics::rmse,
    scene::{Image8, Material, Texture, Wrap},
};
use glimpse_tests::{
    TestScene, assert_same,
    builder::{Builder, front_camera, matte, mirror, unlit},
    gallery, note,
};

const SIZE: [u32; 2] = [96, 64];

fn settings(mip: Mip) -> Settings {
    Settings { method: Method::Full, mip, ..Settings::default() }
}

/// An unlit checkerboard, with `repeats` times two cells along each side.
fn checkered(b: &mut Builder, quad: [Vec3; 3], repeats: f32) {
    let side = 32;
    let grey = |i: u32| if i % side / 16 == i / side / 16 { 0 } else { 255 };
    let rgba = (0..side * side).map(grey).flat_map(|grey| [grey, grey, grey, 255]).collect();
    let image = b.image(Image8 { width: side, height: side, rgba });
    let texture = b.texture(Texture { image, wrap: [Wrap::Repeat; 2], nearest: false });
    let board = b.object(Material { base_color_texture: Some(texture), ..unlit(Vec3::ONE) });
    b.textured_quad(board, quad, [Vec2::ZERO, Vec2::splat(repeats)]);
}

/// RMSE against 256 samples per pixel of the texture itself, without and with averages.
fn errors(what: &str, scene: Scene) -> [f64; 2] {
    let test_scene = TestScene::new(scene);
    let truth = test_scene.shown(SIZE, &Settings { sampling: 16, ..settings(Mip::Off) });
    let errors = Mip::ALL.map(|mip| {
        let shown = test_scene.shown(SIZE, &settings(mip));
        rmse(&shown, &truth).expect("the same size")
    });
    note(&format!("{what}: RMSE {:.2} without averages, {:.2} with them", errors[0], errors[1]));
    errors
}

fn floor() -> Scene {
    let mut b = Builder::new();
    checkered(&mut b, [vec3(-30.0, 0.0, 0.0), 60.0 * Vec3::X, -60.0 * Vec3::Z], 80.0);
    let camera = Camera::look_at(vec3(0.0, 1.0, 1.0), vec3(0.3, 0.0, -3.0), 0.8).expect("a valid camera");
    b.seen_by(camera)
}

#[test]
fn a_floor_that_reaches_far_does_not_alias() {
    let [off, on] = errors("floor", floor());
    assert!(3.0 * on < off, "{on} and {off}");
}

/// Far away a pixel covers many cells, half of which are white.
#[test]
fn far_away_a_checkerboard_is_grey() {
    let mut b = Builder::new();
    checkered(&mut b, [vec3(-4.0, -4.0, 0.0), 8.0 * Vec3::X, 8.0 * Vec3::Y], 1501.0);
    let frame = TestScene::new(b.seen_by(front_camera())).frame(SIZE, &settings(Mip::On));
    // sRGB has no nearer level.
    assert!(frame.as_raw().iter().all(|c| (c - 0.5).abs() < 0.004), "{:?}", &frame.as_raw()[..9]);
}

/// A mirror in front of the camera shows a board behind it: its footprints are those of a board behind the
/// mirror.
fn mirrored(ball: bool, repeats: f32) -> Scene {
    let mut b = Builder::new();
    let silver = b.object(mirror(Vec3::ONE));
    if ball {
        b.sphere(silver, Vec3::ZERO, 0.8);
    } else {
        b.quad(silver, vec3(-2.0, -2.0, 0.0), 4.0 * Vec3::X, 4.0 * Vec3::Y);
    }
    checkered(&mut b, [vec3(-20.0, -20.0, 10.0), 40.0 * Vec3::X, 40.0 * Vec3::Y], repeats);
    // As bright as the board on average, so that the silhouette of the ball is no edge.
    b.environment(Vec3::splat(0.5), Vec3::ZERO);
    b.seen_by(front_camera())
}

#[test]
fn what_a_mirror_shows_does_not_alias() {
    let [off, on] = errors("mirror", mirrored(false, 301.0));
    assert!(3.0 * on < off, "{on} and {off}");
}

/// In a flat mirror two pixels cover a cell of this board: only the ball makes it small.
#[test]
fn what_a_ball_shows_small_does_not_alias() {
    let [off, on] = errors("ball", mirrored(true, 60.0));
    assert!(2.0 * on < off, "{on} and {off}");
}

fn assert_unchanged(what: &str, scene: Scene) {
    let test_scene = TestScene::new(scene);
    for method in [Method::Full, Method::Adaptive] {
        let [off, on] = Mip::ALL.map(|mip| test_scene.frame(SIZE, &Settings { method, ..settings(mip) }));
        assert_same(&off, &on, &format!("{what}, {method:?}"));
    }
}

#[test]
fn what_is_magnified_is_the_image_itself() {
    let mut b = Builder::new();
    let texture = b.ramp_texture();
    let wall = b.object(Material { base_color_texture: Some(texture), ..matte(Vec3::ONE) });
    b.textured_quad(
        wall,
        [vec3(-2.0, -2.0, 0.0), 4.0 * Vec3::X, 4.0 * Vec3::Y],
        [Vec2::ZERO, vec2(2.0, 1.0)],
    );
    b.point_light(vec3(0.5, 0.5, 2.0), Vec3::splat(9.0));
    assert_unchanged("ramp", b.seen_by(front_camera()));
}

#[test]
fn without_textures_nothing_changes() {
    for name in ["furnace", "cornell"] {
        assert_unchanged(name, glimpse::scene::builtin(name).expect(name));
    }
}

/// Coordinates without bound and footprints of every size, seen at grazing angles and through a lens.
#[test]
fn every_average_is_a_number() {
    for scene in [gallery::textures(), gallery::lenses(), floor()] {
        let frame = TestScene::new(scene).frame([33, 21], &settings(Mip::On));
        assert!(frame.as_raw().iter().all(|c| c.is_finite() && *c >= 0.0));
    }
}
