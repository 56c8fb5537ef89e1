//! Methods that reuse the previous frame, along paths of the camera.

use glam::{Vec3, vec3};
use glimpse::{
    Camera, DisplayImage, Inspection, Method, Origin, Renderer, Scene, Settings,
    metrics::{psnr_db, rmse},
};
use glimpse_tests::{
    TestScene,
    builder::{Builder, front_camera, mirror, unlit},
    gpu, note,
};

/// Size of the frame in pixels; neither side is a multiple of a tile's.
const SIZE: [u32; 2] = [150, 90];

fn settings(method: Method, share: f32) -> Settings {
    Settings { method, refresh_fraction: share, ..Settings::default() }
}

/// A sequence of frames, and the same frames by `full`.
struct Pair {
    renderer: Renderer,
    full: Renderer,
}

impl Pair {
    fn new(test_scene: &TestScene, method: Method, share: f32) -> Self {
        let make = |settings| Renderer::new(gpu(), &test_scene.scene, SIZE, &settings).expect("a renderer");
        Self { renderer: make(settings(method, share)), full: make(settings(Method::Full, share)) }
    }

    /// Renders the next frame; returns its picture and that of `full`.
    fn frame(&mut self, camera: &Camera) -> [DisplayImage; 2] {
        [&mut self.renderer, &mut self.full].map(|renderer| {
            renderer.render(camera).expect("a frame");
            renderer.display_image().expect("a picture")
        })
    }

    fn counted(&mut self, camera: &Camera) -> Inspection {
        self.renderer.inspect(camera).expect("counts")
    }
}

fn db([found, right]: &[DisplayImage; 2]) -> f64 {
    psnr_db(rmse(found, right).expect("of one size")).unwrap_or(f64::INFINITY)
}

fn traced(inspection: &Inspection) -> Vec<bool> {
    inspection.pixels.iter().map(|pixel| pixel.origin == Origin::Base).collect()
}

fn equal_pixels(a: &DisplayImage, b: &DisplayImage) -> Vec<bool> {
    a.pixels().zip(b.pixels()).map(|(a, b)| a == b).collect()
}

fn share_of(traced: &[bool]) -> f64 {
    traced.iter().filter(|traced| **traced).count() as f64 / traced.len() as f64
}

/// Unlit quads: every pixel shows the colour of its surface.
fn wall_and_post(post: Option<[f32; 2]>) -> Scene {
    let mut builder = Builder::new();
    let wall = builder.object(unlit(vec3(0.1, 0.2, 0.8)));
    builder.quad(wall, vec3(-6.0, -4.0, -4.0), 12.0 * Vec3::X, 8.0 * Vec3::Y);
    if let Some([left, width]) = post {
        let post = builder.object(unlit(vec3(0.9, 0.3, 0.1)));
        builder.quad(post, vec3(left, -0.5, 0.0), width * Vec3::X, Vec3::Y);
    }
    builder.seen_by(front_camera())
}

fn moved(camera: &Camera, by: Vec3) -> Camera {
    Camera { origin: camera.origin + by, ..*camera }
}

#[test]
fn the_first_frame_is_full() {
    for scene in ["room", "cornell"] {
        let test_scene = TestScene::builtin(scene);
        for method in [Method::Frameless, Method::Reproject] {
            let mut pair = Pair::new(&test_scene, method, 0.1);
            let [found, right] = pair.frame(&test_scene.camera);
            assert!(found == right, "{scene} {method:?}");
            let counts = pair.counted(&test_scene.camera).counts;
            assert_eq!(counts.rt_ratio(), 1.0, "{scene} {method:?}");
            assert_eq!(counts.rays, pair.full.inspect(&test_scene.camera).expect("counts").counts.rays);
        }
    }
}

/// After a jump of the camera and the promised number of frames, no pixel is older than that.
#[test]
fn no_pixel_is_older_than_the_share_promises() {
    let test_scene = TestScene::builtin("room");
    let other = moved(&test_scene.camera, vec3(0.5, 0.3, -0.4)).panned(20.0);
    for share in [0.1_f32, 0.3] {
        let mut pair = Pair::new(&test_scene, Method::Frameless, share);
        let [before, _] = pair.frame(&test_scene.camera);
        let promised = (1.0 / share).ceil() as usize;
        let mut refreshed = vec![false; before.pixels().len()];
        for frame in 1..=promised {
            let [found, right] = pair.frame(&other);
            let inspection = pair.counted(&other);
            let traced = traced(&inspection);
            let [new, old] = [equal_pixels(&found, &right), equal_pixels(&found, &before)];
            let mut again = 0;
            for (index, traced) in traced.iter().enumerate() {
                again += u32::from(refreshed[index] && *traced);
                refreshed[index] |= traced;
                // Both views may happen to have the same colour.
                assert!(if refreshed[index] { new[index] } else { old[index] }, "{share} {frame} {index}");
            }
            assert!(frame == promised || again == 0, "{share} {frame}: {again} pixels twice");
            let samples = inspection.counts.samples;
            assert_eq!(samples.base + samples.interpolated, samples.total);
            assert!((share_of(&traced) - f64::from(share)).abs() < 0.02, "{share} {frame}");
            assert_eq!(pair.renderer.is_settled(), frame == promised, "{share} {frame}");
            if frame == promised {
                assert!(found == right, "{share}");
            }
        }
    }
}

/// Counting repeats the last frame without affecting the following ones.
#[test]
fn counting_changes_nothing() {
    let test_scene = TestScene::builtin("cornell");
    for method in [Method::Frameless, Method::Reproject] {
        let mut counted = Pair::new(&test_scene, method, 0.2);
        let mut plain = Pair::new(&test_scene, method, 0.2);
        for frame in 0..4 {
            let camera = test_scene.camera.panned(0.4 * f64::from(frame));
            let [found, _] = counted.frame(&camera);
            let once = counted.counted(&camera);
            assert_eq!(once.counts, counted.counted(&camera).counts, "{method:?} {frame}");
            assert!(counted.renderer.display_image().expect("a picture") == found, "{method:?} {frame}");
            assert!(plain.frame(&camera)[0] == found, "{method:?} {frame}");
        }
    }
}

#[test]
fn at_rest_reprojection_shows_the_same_and_traces_its_share() {
    for scene in ["room", "cornell"] {
        let test_scene = TestScene::builtin(scene);
        let mut pair = Pair::new(&test_scene, Method::Reproject, 0.1);
        for frame in 0..14 {
            let [found, right] = pair.frame(&test_scene.camera);
            assert!(found == right, "{scene} {frame}");
            if frame > 0 {
                let share = pair.counted(&test_scene.camera).counts.rt_ratio();
                assert!((0.09..0.12).contains(&share), "{scene} {frame}: {share}");
            }
        }
    }
}

/// Reprojected samples lie beside the pixel centres; frames of a resting camera replace them.
#[test]
fn after_a_pan_reprojection_becomes_full() {
    let test_scene = TestScene::builtin("room");
    let mut pair = Pair::new(&test_scene, Method::Reproject, 0.25);
    for frame in 0..5 {
        pair.frame(&test_scene.camera.panned(0.3 * f64::from(frame)));
    }
    let resting = test_scene.camera.panned(1.2);
    assert!(db(&pair.frame(&resting)).is_finite(), "the pan leaves no trace");
    assert!(!pair.renderer.is_settled());
    for _ in 0..3 {
        pair.frame(&resting);
    }
    assert!(pair.renderer.is_settled());
    let [found, right] = pair.frame(&resting);
    assert!(found == right);
}

/// The bound on reprojection's error: PSNR in dB against full ray tracing of the same frame.
const SLOW_PAN_DB: f64 = 27.0;

#[test]
fn a_slow_pan_stays_below_the_bound() {
    for scene in ["room", "cornell"] {
        let test_scene = TestScene::builtin(scene);
        let mut pair = Pair::new(&test_scene, Method::Reproject, 0.1);
        let mut worst = f64::INFINITY;
        let mut shares = Vec::new();
        for frame in 0..24 {
            let camera = test_scene.camera.panned(0.25 * f64::from(frame));
            worst = worst.min(db(&pair.frame(&camera)));
            if frame > 0 {
                shares.push(pair.counted(&camera).counts.rt_ratio());
            }
        }
        let share = shares.iter().sum::<f64>() / shares.len() as f64;
        note(&format!("{scene}: worst frame of a slow pan {worst:.2} dB, {share:.3} of the pixels traced"));
        assert!(worst > SLOW_PAN_DB, "{scene}: {worst}");
        assert!(share < 0.65, "{scene}: {share}");
    }
}

/// A post in front of a wall, and a camera that moves sideways: where points of both land, the post is shown;
/// where the post uncovers the wall, which the previous frame did not show, the wall is traced.
#[test]
fn the_nearest_wins_and_what_it_hid_is_traced() {
    let test_scene = TestScene::new(wall_and_post(Some([-0.2, 0.4])));
    let mut pair = Pair::new(&test_scene, Method::Reproject, 1.0 / 256.0);
    let mut right = pair.frame(&test_scene.camera)[1].clone();
    for frame in 1..8 {
        let camera = moved(&test_scene.camera, 0.04 * frame as f32 * Vec3::X);
        let before = right.clone();
        let [found, full] = pair.frame(&camera);
        let traced = traced(&pair.counted(&camera));
        let [same, unchanged] = [equal_pixels(&found, &full), equal_pixels(&before, &full)];
        // The post's edges are exact to a pixel, as a reprojected point lies beside the pixel centre.
        let wrong = same.iter().filter(|same| !**same).count();
        assert!(wrong <= 2 * 40, "{frame}: {wrong} pixels show what is not there");
        let uncovered =
            unchanged.iter().zip(&traced).filter(|(unchanged, traced)| !**unchanged && **traced).count();
        assert!(uncovered >= 20, "{frame}: {uncovered} pixels of what the post hid are traced");
        assert!(share_of(&traced) < 0.25, "{frame}: {}", share_of(&traced));
        right = full;
    }
}

/// Coming closer separates the points of the post, and moving sideways moves the post over points of the
/// wall, which land in the gaps: they must not show through.
#[test]
fn nothing_shows_through_gaps() {
    let test_scene = TestScene::new(wall_and_post(Some([-0.4, 0.8])));
    let mut pair = Pair::new(&test_scene, Method::Reproject, 1.0 / 256.0);
    for trial in 0..24_u16 {
        // Changing the share restarts the sequence.
        let share = f32::from(1 + trial % 2) / 256.0;
        pair.renderer.change(SIZE, &settings(Method::Reproject, share)).expect("a change");
        pair.frame(&test_scene.camera);
        let step = f32::from(trial);
        let camera = moved(&test_scene.camera, vec3(0.35 - 0.011 * step, 0.0, -0.2 - 0.013 * step));
        let [found, full] = pair.frame(&camera);
        let objects = pair.full.inspect(&camera).expect("counts").pixels;
        let [width, height] = SIZE;
        let of_post = |x: u32, y: u32| objects[(y * width + x) as usize].object == Some(1);
        for (x, y) in (2..height - 2).flat_map(|y| (2..width - 2).map(move |x| (x, y))) {
            if (y - 2..=y + 2).all(|y| (x - 2..=x + 2).all(|x| of_post(x, y))) {
                assert_eq!(found.get_pixel(x, y), full.get_pixel(x, y), "{trial}: {x} {y}");
            }
        }
    }
}

/// If no reprojected point lands in the new view, all of it is traced.
#[test]
fn after_a_cut_everything_is_traced() {
    let test_scene = TestScene::builtin("room");
    let mut pair = Pair::new(&test_scene, Method::Reproject, 0.1);
    pair.frame(&test_scene.camera);
    let away = test_scene.camera.panned(180.0);
    let [found, right] = pair.frame(&away);
    assert!(found == right);
    assert_eq!(pair.counted(&away).counts.rt_ratio(), 1.0);
}

/// The background is infinitely far away: it rotates with the camera, and stays when the camera only moves.
#[test]
fn the_background_is_moved_like_what_is_infinitely_far_away() {
    let mut builder = Builder::new();
    let object = builder.object(unlit(Vec3::ONE));
    builder.quad(object, vec3(-0.1, -0.1, 0.0), 0.2 * Vec3::X, 0.2 * Vec3::Y);
    builder.environment(vec3(0.2, 0.4, 0.6), Vec3::ZERO);
    let test_scene = TestScene::new(builder.seen_by(front_camera()));
    let mut pair = Pair::new(&test_scene, Method::Reproject, 1.0 / 256.0);
    pair.frame(&test_scene.camera);
    let aside = moved(&test_scene.camera, 0.1 * Vec3::X);
    let [found, right] = pair.frame(&aside);
    assert!(share_of(&traced(&pair.counted(&aside))) < 0.06);
    assert!(db(&[found, right]) > 30.0);
    let [turned, _] = [aside.panned(1.0), aside];
    pair.frame(&turned);
    let inspection = pair.counted(&turned);
    let [width, height] = SIZE;
    let column = |x: u32| {
        (0..height).filter(|y| inspection.pixels[(y * width + x) as usize].origin == Origin::Base).count()
    };
    // The right border is new; beside it the background is reused.
    assert_eq!(column(width - 1), height as usize);
    assert!(column(width - 6) < height as usize / 4, "{}", column(width - 6));
}

/// Mirror images must not be reprojected at the depth of the mirror.
#[test]
fn mirrors_are_traced() {
    let mut builder = Builder::new();
    let glass = builder.object(mirror(Vec3::splat(0.9)));
    let wall = builder.object(unlit(vec3(0.8, 0.1, 0.1)));
    builder.quad(glass, vec3(-0.6, -0.6, 0.0), 0.6 * Vec3::X, 1.2 * Vec3::Y);
    builder.quad(wall, vec3(0.0, -0.6, 0.0), 0.6 * Vec3::X, 1.2 * Vec3::Y);
    let test_scene = TestScene::new(builder.seen_by(front_camera()));
    let mut pair = Pair::new(&test_scene, Method::Reproject, 1.0 / 256.0);
    pair.frame(&test_scene.camera);
    let turned = test_scene.camera.panned(0.3);
    pair.frame(&turned);
    let inspection = pair.counted(&turned);
    let mirrors: Vec<_> = pair
        .full
        .inspect(&turned)
        .expect("counts")
        .pixels
        .iter()
        .zip(&inspection.pixels)
        .filter(|(right, _)| right.object == Some(0))
        .map(|(_, found)| found.origin == Origin::Base)
        .collect();
    assert!(mirrors.len() > 1000 && mirrors.iter().all(|traced| *traced), "{}", share_of(&mirrors));
    assert!(share_of(&traced(&inspection)) < 0.5);
}

/// A change of size or settings, or a frame read in linear radiance, drops the previous frame.
#[test]
fn what_begins_anew_keeps_nothing() {
    let test_scene = TestScene::builtin("cornell");
    let other = test_scene.camera.panned(5.0);
    for method in [Method::Frameless, Method::Reproject] {
        let mut pair = Pair::new(&test_scene, method, 0.1);
        let whole = |pair: &mut Pair, what: &str| {
            let [found, right] = pair.frame(&other);
            assert!(found == right, "{method:?}: {what}");
            pair.frame(&test_scene.camera);
        };
        pair.frame(&test_scene.camera);
        pair.renderer.linear_image(&test_scene.camera).expect("an image");
        whole(&mut pair, "linear");
        let changed = Settings { refresh_fraction: 0.2, ..*pair.renderer.settings() };
        pair.renderer.change(SIZE, &changed).expect("a change");
        whole(&mut pair, "share");
        let changed = Settings { min_weight: 0.01, ..changed };
        pair.renderer.change(SIZE, &changed).expect("a change");
        pair.full.change(SIZE, &Settings { method: Method::Full, ..changed }).expect("a change");
        whole(&mut pair, "least weight");
        pair.renderer.change([64, 48], &changed).expect("a change");
        pair.renderer.render(&test_scene.camera).expect("a frame");
        pair.renderer.change(SIZE, &changed).expect("a change");
        whole(&mut pair, "size");
    }
}

/// Orthographic cameras: after a motion of the camera the same points appear elsewhere.
#[test]
fn parallel_rays_are_reprojected_too() {
    let mut scene = wall_and_post(Some([-0.2, 0.4]));
    for (_, camera) in &mut scene.cameras {
        *camera = Camera { orthographic: true, ..*camera };
    }
    let test_scene = TestScene::new(scene);
    let mut pair = Pair::new(&test_scene, Method::Reproject, 1.0 / 256.0);
    pair.frame(&test_scene.camera);
    let aside = moved(&test_scene.camera, 0.031 * Vec3::X);
    let pictures = pair.frame(&aside);
    assert!(share_of(&traced(&pair.counted(&aside))) < 0.1);
    assert!(db(&pictures) > 25.0, "{}", db(&pictures));
}
