//! Denoising of path tracing, against the reference, and on pixels that must not change.

use glam::{DVec3, Vec3, vec3};
use glimpse::{
    Camera, Denoise, DirectLight, Foveation, LinearImage, Method, Renderer, Settings,
    metrics::linear_rmse,
    reference::{Denoiser, GBufferPixel, Reference, ReferenceFrame, Rounding, Way},
    scene::{Material, builtin},
};
use glimpse_tests::{
    TestScene,
    builder::{Builder, front_camera, matte, unlit},
    gpu, note,
};

use super::agreement::srgb;

/// Size of the frame in pixels; neither side is a multiple of a tile's, and both are longer than the filter's
/// steps.
const SIZE: [u32; 2] = [75, 42];

fn settings(denoise: Denoise) -> Settings {
    let mut settings =
        Settings { method: Method::Path, depth: Method::Path.usual_depth(), ..Settings::default() };
    (settings.paths.denoise, settings.paths.foveation) = (denoise, Foveation::Paper);
    settings.paths.gaze = [0.2, 0.9];
    settings
}

/// A picture of `samples` samples, and the G-buffer that guides its denoising.
fn picture(test_scene: &TestScene, settings: &Settings, samples: u32) -> (LinearImage, Vec<GBufferPixel>) {
    let mut renderer = Renderer::new(gpu(), &test_scene.scene, SIZE, settings).expect("a renderer");
    for _ in 0..samples {
        renderer.render(&test_scene.camera).expect("a frame");
    }
    let image = renderer.linear_image(&test_scene.camera).expect("a picture");
    let gbuffer = renderer.gbuffer().expect("a G-buffer").into_iter().map(GBufferPixel::unpacked).collect();
    (image, gbuffer)
}

pub fn colors(image: &LinearImage) -> Vec<DVec3> {
    image.pixels().map(|pixel| DVec3::from(pixel.0.map(f64::from))).collect()
}

fn pixels() -> impl Iterator<Item = [u32; 2]> {
    (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]))
}

/// The scene with an orthographic camera in the same place.
fn orthographic(test_scene: TestScene) -> TestScene {
    let Camera { right, up, .. } = test_scene.camera;
    let camera = Camera { right: 2.0 * right, up: 2.0 * up, orthographic: true, ..test_scene.camera };
    TestScene { camera, ..test_scene }
}

/// If a decision differs between f32 and f64, a path may hit another surface; all other pixels have the same
/// guides.
#[test]
fn guides_are_those_of_the_reference() {
    const SAMPLES: u32 = 3;
    for name in ["cornell", "room"] {
        let scene = builtin(name).expect("built in");
        let (reference, test_scene) = (Reference::new(&scene).with_srgb(*srgb()), TestScene::new(scene));
        let settings = settings(Denoise::Median);
        let (_, found) = picture(&test_scene, &settings, SAMPLES);
        let frame = ReferenceFrame { reference: &reference, camera: test_scene.camera, size: SIZE, settings };
        let rights = pixels().map(|pixel| {
            let gbuffer_pixel = |sample| frame.path(pixel, sample, &mut Rounding::none()).gbuffer_pixel;
            (1..SAMPLES)
                .fold(gbuffer_pixel(0), |before, sample| before.followed(&gbuffer_pixel(sample), sample))
        });
        let pairs: Vec<_> = found.iter().zip(rights).collect();
        assert_eq!(pairs.len(), pixels().count());
        let ways = [Way::None, Way::DirectlySeen, Way::Mirrored];
        let counts = ways.map(|way| pairs.iter().filter(|(_, right)| right.way == way).count());
        let smoothed = pairs.iter().filter(|(_, right)| right.smoothed).count();
        assert!(counts.iter().chain([&smoothed]).all(|n| *n > 50), "{name}: {counts:?} {smoothed}");
        let differs = |(found, right): &&(&GBufferPixel, GBufferPixel)| {
            let filtered = right.way != Way::None;
            found.way != right.way
                || found.smoothed != right.smoothed
                || filtered && (found.normal - right.normal).length() > 1e-3
                || filtered && (found.depth - right.depth).abs() > 1e-4 * right.depth
                // Half a quantisation step per sample.
                || filtered && (found.albedo - right.albedo).abs().max_element() > 2e-3
        };
        let share = pairs.iter().filter(differs).count() as f64 / pairs.len() as f64;
        note(&format!("{name}: {share:.4} of the guides are others, ways {counts:?}, smoothed {smoothed}"));
        assert!(share < 0.02, "{name}: {share}");
    }
}

/// Filters applied to the device's own input, pixel by pixel.
#[test]
fn filters_are_those_of_the_reference() {
    let cornell = TestScene::builtin("cornell");
    let flat = orthographic(TestScene::builtin("cornell"));
    for (name, test_scene, samples) in
        [("cornell", &cornell, 1), ("orthographic", &flat, 1), ("room", &TestScene::builtin("room"), 5)]
    {
        let scene = builtin(if name == "room" { name } else { "cornell" }).expect("built in");
        let reference = Reference::new(&scene);
        let means = colors(&picture(test_scene, &settings(Denoise::Off), samples).0);
        for denoise in [Denoise::Median, Denoise::Atrous] {
            let settings = settings(denoise);
            let (image, gbuffer) = picture(test_scene, &settings, samples);
            let frame =
                ReferenceFrame { reference: &reference, camera: test_scene.camera, size: SIZE, settings };
            let noise = Denoiser { frame: &frame, samples, means: &means, gbuffer: &gbuffer };
            let right = match denoise {
                Denoise::Median => pixels().map(|pixel| noise.median(pixel)).collect(),
                _ => noise.atrous(),
            };
            let off = |(found, right): (DVec3, &DVec3)| (found - right).length() / (right.length() + 0.01);
            let worst = colors(&image).into_iter().zip(&right).map(off).fold(0.0, f64::max);
            let changed = right.iter().zip(&means).filter(|(a, b)| a != b).count();
            note(&format!("{name}, {denoise:?}: worst {worst:.2e}, {changed} pixels changed"));
            assert!(changed > 300, "{name} {denoise:?}: {changed}");
            let tolerance = if denoise == Denoise::Median { 0.0 } else { 1e-3 };
            assert!(worst <= tolerance, "{name} {denoise:?}: {worst}");
        }
    }
}

/// The error is smaller after few samples, and the picture is the same after many.
#[test]
fn the_filtered_picture_tends_to_the_mean() {
    let test_scene = TestScene::builtin("cornell");
    let wish = |denoise| {
        let mut settings = settings(denoise);
        settings.paths.foveation = Foveation::Off;
        settings
    };
    let other = Settings { seed: 1, ..wish(Denoise::Off) };
    let (right, _) = picture(&test_scene, &other, 1024);
    let error = |a: &LinearImage, b: &LinearImage| linear_rmse(a, b).expect("of one size");
    let rows = [1, 4, 16, 64, 256].map(|samples| {
        let [plain, filtered] =
            [Denoise::Off, Denoise::Atrous].map(|d| picture(&test_scene, &wish(d), samples).0);
        let row = [error(&plain, &right), error(&filtered, &right), error(&plain, &filtered)];
        note(&format!("{samples} samples: plain, filtered, between {row:.4?}"));
        row
    });
    for [plain, filtered, _] in &rows[..3] {
        assert!(filtered < plain, "{rows:?}");
    }
    let between = rows.map(|[.., between]| between);
    assert!(between.is_sorted_by(|a, b| a > b), "{between:?}");
    assert!(between[4] < 0.1 * between[0], "{between:?}");
}

/// A lamp found only by chance: these paths are by far brighter than all others.
#[test]
fn bright_specks_are_not_spread() {
    let mut builder = Builder::new();
    let wall = builder.object(matte(Vec3::splat(0.7)));
    builder.quad(wall, vec3(-6.0, -4.0, -2.0), 12.0 * Vec3::X, 8.0 * Vec3::Y);
    let lamp = builder.object(Material { emission: Vec3::splat(50.0), ..matte(Vec3::ZERO) });
    builder.sphere(lamp, vec3(-0.5, 0.3, 0.0), 0.1);
    let test_scene = TestScene::new(builder.seen_by(front_camera()));
    let [plain, filtered] = [Denoise::Off, Denoise::Atrous].map(|denoise| {
        let mut settings = settings(denoise);
        settings.paths.direct_light = DirectLight::Bsdf;
        // With this seed no two specks are neighbours, where neither would stand out.
        settings.seed = 3;
        colors(&picture(&test_scene, &settings, 1).0)
    });
    let lamp = |color: &DVec3| color.x > 40.0;
    assert_eq!(plain.iter().filter(|c| lamp(c)).count(), filtered.iter().filter(|c| lamp(c)).count());
    let specks = |image: &[DVec3]| image.iter().filter(|c| !lamp(c) && c.x > 2.0).count();
    let (before, after) = (specks(&plain), specks(&filtered));
    note(&format!("{before} specks, {after} pixels as bright after the filter"));
    assert!(before >= 3 && after == 0, "{before} {after}");
}

/// Pixels without a diffuse surface and emitters are unchanged, and nothing is divided by a black albedo.
#[test]
fn what_is_not_filtered_stays() {
    let mut builder = Builder::new();
    let back = builder.object(unlit(vec3(0.2, 0.4, 0.8)));
    builder.quad(back, vec3(-6.0, -4.0, -4.0), 6.0 * Vec3::X, 8.0 * Vec3::Y);
    let black = builder.object(matte(Vec3::ZERO));
    builder.quad(black, vec3(0.0, 0.0, -2.0), Vec3::X, Vec3::Y);
    let lamp = builder.object(Material { emission: vec3(3.0, 2.0, 1.0), ..matte(Vec3::splat(0.5)) });
    builder.quad(lamp, vec3(0.0, -1.0, -2.0), Vec3::X, Vec3::Y);
    builder.environment(vec3(0.3, 0.2, 0.1), Vec3::ZERO);
    let test_scene = TestScene::new(builder.seen_by(front_camera()));
    for samples in [1, 2] {
        let plain = colors(&picture(&test_scene, &settings(Denoise::Off), samples).0);
        let (filtered, gbuffer) = picture(&test_scene, &settings(Denoise::Atrous), samples);
        let filtered = colors(&filtered);
        assert!(filtered.iter().all(|color| color.is_finite() && color.min_element() >= 0.0));
        let dark = plain.iter().filter(|color| **color == DVec3::ZERO).count();
        assert!(dark > 20, "{dark} black pixels");
        for ((before, after), gbuffer_pixel) in plain.iter().zip(&filtered).zip(&gbuffer) {
            assert!(
                before == after || gbuffer_pixel.way != Way::None && *before == DVec3::ZERO,
                "{before} {after} {gbuffer_pixel:?}"
            );
        }
    }
}
