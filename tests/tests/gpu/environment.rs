//! Environment maps, exposure and the tone curve.

use glam::{DVec3, Vec3, dvec3, vec3};
use glimpse::{
    DirectLight, Method, Renderer, Scene, Settings, Tonemap,
    scene::{EnvironmentMap, Light, LightKind, Material, Weights, builtin},
};
use glimpse_tests::{TestScene, assert_same, full, gpu, pixel_ray};

/// A ball at the origin that the camera looks at from +Z.
fn ball(material: Material) -> Scene {
    let mut scene = Scene::default();
    let material = scene.add_material(material);
    scene.add_sphere("ball", material, Vec3::ZERO, 1.0);
    let camera = glimpse::Camera::look_at(Vec3::new(0.0, 0.0, 4.0), Vec3::ZERO, 0.7).expect("a camera");
    scene.cameras.push(("front".to_owned(), camera));
    scene
}

/// Radiance 1 above the horizon and `below` underneath.
fn two_colours(below: f32) -> EnvironmentMap {
    let image =
        glimpse::LinearImage::from_fn(512, 256, |_, y| image::Rgb([if y < 128 { 1.0 } else { below }; 3]));
    EnvironmentMap::from_equirectangular(&image).expect("a map")
}

/// Unit normal of the unit ball where a pixel shows it.
fn seen(scene: &TestScene, size: [u32; 2], x: u32, y: u32) -> Option<(DVec3, DVec3)> {
    let (origin, direction) = pixel_ray(&scene.camera, size, x, y);
    let half = origin.dot(direction);
    let root = half * half - origin.length_squared() + 1.0;
    (root > 0.0).then(|| ((origin - (half + root.sqrt()) * direction).normalize(), direction))
}

const SIZE: [u32; 2] = [48, 48];

#[test]
fn a_matte_ball_under_a_sky_of_two_colours_has_its_integral() {
    let diffuse = Weights { diffuse: 1.0, mirror: 0.0, refraction: 0.0 };
    let mut scene =
        ball(Material { base_color: Vec3::splat(0.5), weights: Some(diffuse), ..Material::default() });
    scene.surround(two_colours(0.0));
    let scene = TestScene::new(scene);
    for (x, y, pixel) in scene.full(SIZE).enumerate_pixels() {
        let Some((normal, _)) = seen(&scene, SIZE, x, y) else { continue };
        // The map of irradiance is interpolated.
        let expected = 0.5 * 0.5 * (1.0 + normal.y);
        assert!((f64::from(pixel.0[0]) - expected).abs() < 0.006, "{x}, {y}: {pixel:?}, {expected}");
    }
}

#[test]
fn a_mirror_and_a_miss_show_the_map() {
    let mirror = Weights { diffuse: 0.0, mirror: 1.0, refraction: 0.0 };
    let mut scene = ball(Material { weights: Some(mirror), roughness: 0.0, ..Material::default() });
    let map = EnvironmentMap::studio().rotated(1.1);
    scene.surround(map.clone());
    let scene = TestScene::new(scene);
    let frame = scene.full(SIZE);
    let mut balls = 0;
    for (x, y, pixel) in frame.enumerate_pixels() {
        let direction = match seen(&scene, SIZE, x, y) {
            Some((normal, direction)) => {
                balls += 1;
                direction - 2.0 * normal.dot(direction) * normal
            }
            None => pixel_ray(&scene.camera, SIZE, x, y).1,
        };
        let expected = map.radiance(direction);
        let found = Vec3::from(pixel.0).as_dvec3();
        // Near the silhouette the reflected direction is more sensitive than a step of f32.
        assert!(
            (found - expected).abs().max_element() < 2e-3 * (1.0 + expected.x),
            "{x}, {y}: {found}, {expected}"
        );
    }
    assert!(balls > 300);
}

/// A sky that is mirrored without another ray: only the traced pixels' rays know that nothing is in the way.
#[test]
fn undersampled_mirrors_show_the_map_in_full_detail() {
    let mirror = Weights { diffuse: 0.0, mirror: 1.0, refraction: 0.0 };
    let mut scene = ball(Material { weights: Some(mirror), roughness: 0.0, ..Material::default() });
    let stripes = glimpse::LinearImage::from_fn(1024, 512, |x, y| {
        image::Rgb([0.5 + 0.5 * (0.2 * x as f32).sin(), 0.5 + 0.5 * (0.2 * y as f32).cos(), 0.5])
    });
    scene.surround(EnvironmentMap::from_equirectangular(&stripes).expect("a map"));
    let scene = TestScene::new(scene);
    let size = [96, 96];
    let settings = Settings { postcorrect: glimpse::Postcorrect::Off, ..Settings::default() };
    let (adaptive, full) = (scene.frame(size, &settings), scene.full(size));
    let mut inside = 0;
    for (x, y, pixel) in adaptive.enumerate_pixels() {
        if seen(&scene, size, x, y).is_none_or(|(n, d)| n.dot(d) > -0.5) {
            continue;
        }
        inside += 1;
        let error = (Vec3::from(pixel.0) - Vec3::from(full.get_pixel(x, y).0)).abs().max_element();
        assert!(error < 0.15, "{x}, {y}: {error}");
    }
    assert!(inside > 1500, "{inside}");
    let samples = scene.inspect(size, &settings).counts.samples;
    assert!(samples.interpolated > 96 * 96 / 2, "{samples:?}");
}

#[test]
fn a_constant_map_is_a_constant_environment_to_the_last_digit() {
    let radiance = Vec3::new(0.3, 1.7, 0.9);
    for method in [Method::Full, Method::Adaptive, Method::Path] {
        // Directions drawn from a map are another estimate of the same.
        let mut settings = Settings { method, ..full() };
        settings.paths.direct_light = DirectLight::Bsdf;
        let mut constant = ball(Material::default());
        constant.environment = glimpse::scene::Environment {
            background: radiance,
            ambient: radiance,
            fallback_radiance: radiance,
        };
        let mut mapped = constant.clone();
        mapped.surround(EnvironmentMap::constant(radiance));
        let frame = |scene: Scene| TestScene::new(scene).frame(SIZE, &settings);
        assert_same(&frame(mapped), &frame(constant), method.name());
    }
}

#[test]
fn rough_metal_is_lit_by_the_map_and_by_lights() {
    let metal = Material {
        metallic: 1.0,
        roughness: 1.0,
        base_color: Vec3::new(0.9, 0.6, 0.3),
        ..Material::default()
    };
    let mut surrounded = ball(metal.clone());
    surrounded.surround(EnvironmentMap::constant(Vec3::ONE));
    let mut lit = ball(metal);
    lit.environment = glimpse::scene::Environment::with_background(Vec3::ZERO);
    let kind = LightKind::Directional { direction: Vec3::NEG_Z };
    lit.lights.push(Light { kind, intensity: Vec3::splat(std::f32::consts::PI), radius: 0.0 });
    let middle = |scene| Vec3::from(TestScene::new(scene).full(SIZE).get_pixel(SIZE[0] / 2, SIZE[1] / 2).0);
    let lit = middle(lit);
    assert!(lit.x > 0.85 && (lit.x / lit.y - 1.5).abs() < 0.01, "{lit}");
    // Light that is reflected several times among the microfacets is coloured more than once (Fdez-Aguera 2019).
    let surrounded = middle(surrounded);
    assert!((surrounded - vec3(0.806, 0.408, 0.163)).abs().max_element() < 0.005, "{surrounded}");
}

/// Radiance that a rough mirror reflects of a sky of radiance 1 above the horizon and none underneath: the integral of the
/// GGX lobe with Smith's masking, over its reflectance.
fn reflected_sky(normal: DVec3, view: DVec3, roughness: f64) -> f64 {
    const STEPS: u32 = 160;
    let alpha2 = roughness.powi(4);
    let smith = |a: f64, b: f64| a * (b * b * (1.0 - alpha2) + alpha2).sqrt();
    let n_v = normal.dot(view);
    let (mut sky, mut all) = (0.0, 0.0);
    for i in 0..STEPS * STEPS {
        let y = 2.0 * (f64::from(i / STEPS) + 0.5) / f64::from(STEPS) - 1.0;
        let around = std::f64::consts::TAU * f64::from(i % STEPS) / f64::from(STEPS);
        let across = (1.0 - y * y).sqrt();
        let light = dvec3(across * around.cos(), y, across * around.sin());
        let n_l = normal.dot(light);
        let n_h = normal.dot((light + view).normalize());
        if n_l > 0.0 {
            let lobe = n_l / (n_h * n_h * (alpha2 - 1.0) + 1.0).powi(2) / (smith(n_l, n_v) + smith(n_v, n_l));
            all += lobe;
            sky += if y > 0.0 { lobe } else { 0.0 };
        }
    }
    sky / all
}

#[test]
fn rough_metal_shows_the_sky_that_its_lobe_reflects() {
    for roughness in [0.5, 0.6, 0.8, 1.0] {
        let mut scene = ball(Material { metallic: 1.0, roughness, ..Material::default() });
        scene.surround(two_colours(0.0));
        let scene = TestScene::new(scene);
        let (mut sum, mut pixels) = (0.0, 0.0);
        for (x, y, pixel) in scene.full(SIZE).enumerate_pixels().filter(|(x, y, _)| x % 3 == 0 && y % 3 == 0)
        {
            let Some((normal, d)) = seen(&scene, SIZE, x, y).filter(|(n, d)| n.dot(*d) < -0.3) else {
                continue;
            };
            sum += (f64::from(pixel.0[0]) - reflected_sky(normal, -d, f64::from(roughness))).abs();
            pixels += 1.0;
        }
        assert!(pixels > 50.0 && sum / pixels < 0.03, "roughness {roughness}: mean error {}", sum / pixels);
    }
}

/// The mirrored ray of a dielectric weighs less than the least weight where it is not seen at a grazing angle.
#[test]
fn a_mirrored_ray_that_is_cut_off_sees_the_map() {
    let mut scene = ball(Material { base_color: Vec3::ZERO, roughness: 0.0, ..Material::default() });
    scene.surround(two_colours(0.0));
    let scene = TestScene::new(scene);
    let frame = |min_weight| scene.frame(SIZE, &Settings { min_weight, ..full() });
    assert_same(&frame(0.05), &frame(0.0), "nothing is in the way of mirrored rays");
}

#[test]
fn white_surfaces_between_dielectric_and_metal_reflect_all_light() {
    for roughness in [0.0, 0.25, 0.6, 1.0] {
        for metallic in [0.0, 0.3, 0.7, 1.0] {
            let mut scene = ball(Material { metallic, roughness, ..Material::default() });
            scene.surround(EnvironmentMap::constant(Vec3::ONE));
            let frame = TestScene::new(scene).full(SIZE);
            let middle = frame.get_pixel(SIZE[0] / 2, SIZE[1] / 2).0[0];
            assert!((middle - 1.0).abs() < 0.02, "roughness {roughness}, metallic {metallic}: {middle}");
        }
    }
}

/// The directional albedo of a GGX lobe with alpha 1 and a reflectance of 0.04 at normal incidence is 0.012 there and
/// 0.021 at 60 degrees.
#[test]
fn a_matte_dielectric_reflects_a_map_specularly() {
    let middle = |specular, specular_color| {
        let black = Material { base_color: Vec3::ZERO, specular, specular_color, ..Material::default() };
        let mut scene = ball(black);
        scene.surround(EnvironmentMap::constant(Vec3::ONE));
        Vec3::from(TestScene::new(scene).full(SIZE).get_pixel(SIZE[0] / 2, SIZE[1] / 2).0)
    };
    let plain = middle(1.0, Vec3::ONE);
    assert!((0.010..0.020).contains(&plain.x) && plain.x == plain.y, "{plain}");
    let tinted = middle(1.0, vec3(1.0, 0.5, 0.5));
    assert!((tinted.x - plain.x).abs() < 1e-6 && (0.002..0.010).contains(&tinted.y), "{tinted}");
    assert_eq!(middle(0.0, Vec3::ONE), Vec3::ZERO);
}

#[test]
fn one_stop_of_exposure_doubles_all_radiance() {
    for scene in ["room", "cornell"] {
        let mut scene = builtin(scene).expect("a scene");
        scene.surround(EnvironmentMap::studio());
        let scene = TestScene::new(scene);
        let frame = |exposure| scene.frame(SIZE, &Settings { exposure, min_weight: 0.0, ..full() });
        let (plain, double) = (frame(Some(0.0)), frame(Some(1.0)));
        assert_same(&frame(None), &plain, "no light is photometric");
        for (plain, double) in plain.as_raw().iter().zip(double.as_raw()) {
            assert!((2.0 * plain - double).abs() <= 1e-5 * double, "{plain}, {double}");
        }
    }
}

#[test]
fn photometric_lights_are_exposed() {
    let corners = [Vec3::new(-3.0, -3.0, 0.0), Vec3::new(3.0, -3.0, 0.0), Vec3::new(0.0, 3.0, 0.0)];
    let mut triangle = ball(Material::default());
    triangle.spheres.clear();
    triangle.add_triangles("triangle", 0, &[corners]);
    for mut scene in [ball(Material::default()), triangle] {
        let kind = LightKind::Directional { direction: Vec3::NEG_Z };
        let intensity = Vec3::splat(100_000.0);
        scene.lights.push(Light { kind, intensity, radius: 0.0 });
        let frame = TestScene::new(scene).full(SIZE);
        let brightest = frame.as_raw().iter().copied().fold(0.0, f32::max);
        assert!((brightest - 1.0).abs() < 0.01, "{brightest}");
    }
}

#[test]
fn paths_find_a_map_by_every_way_with_the_same_mean() {
    let mut scene = ball(Material { base_color: Vec3::splat(0.5), ..Material::default() });
    scene.surround(two_colours(0.25));
    let scene = TestScene::new(scene);
    let mean = |direct_light| {
        let mut settings = Settings::for_method(Method::Path);
        settings.paths.direct_light = direct_light;
        let mut renderer = Renderer::new(gpu(), &scene.scene, SIZE, &settings).expect("a renderer");
        for _ in 0..64 {
            renderer.render(&scene.camera).expect("a frame");
        }
        renderer.linear_image(&scene.camera).expect("a picture")
    };
    for direct_light in DirectLight::ALL {
        let mut rows = [[0.0; 2]; 3];
        for (x, y, pixel) in mean(direct_light).enumerate_pixels() {
            // Paths cross a pixel anywhere: those at the silhouette see the sky as well.
            let Some((normal, _)) = seen(&scene, SIZE, x, y).filter(|(n, d)| n.dot(*d) < -0.4) else {
                continue;
            };
            let [found, expected] = &mut rows[(3 * y / SIZE[1]) as usize];
            *found += f64::from(pixel.0[0]);
            *expected += 0.5 * (0.25 + 0.75 * 0.5 * (1.0 + normal.y));
        }
        for [found, expected] in rows {
            // Three standard errors of the darkest third by next-event estimation alone.
            assert!((found / expected - 1.0).abs() < 0.02, "{direct_light:?}: {rows:?}");
        }
    }
}

/// The curve's formula, in f64.
fn neutral(color: DVec3) -> DVec3 {
    let least = color.min_element();
    let color = color - if least < 0.08 { least - 6.25 * least * least } else { 0.04 };
    let peak = color.max_element();
    if peak < 0.76 {
        return color;
    }
    let compressed = 1.0 - 0.24 * 0.24 / (peak + 0.24 - 0.76);
    let share = 1.0 - 1.0 / (0.15 * (peak - compressed) + 1.0);
    (color * (compressed / peak)).lerp(DVec3::splat(compressed), share)
}

#[test]
fn the_tone_curve_is_khronos_pbr_neutral() {
    assert_eq!(neutral(dvec3(0.0, 0.0, 0.0)), DVec3::ZERO);
    let mut scene = ball(Material { roughness: 0.3, metallic: 1.0, ..Material::default() });
    scene.surround(EnvironmentMap::studio());
    let scene = TestScene::new(scene);
    let curved = Settings { tonemap: Tonemap::Neutral, ..full() };
    let (linear, shown) = (scene.full(SIZE), scene.shown(SIZE, &curved));
    let encode = |c: f64| if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
    for (linear, shown) in linear.pixels().zip(shown.pixels()) {
        let expected =
            neutral(Vec3::from(linear.0).as_dvec3()).to_array().map(|c| 255.0 * encode(c.clamp(0.0, 1.0)));
        for (expected, found) in expected.iter().zip(shown.0) {
            assert!((expected - f64::from(found)).abs() < 0.7, "{linear:?}: {expected}, {found}");
        }
    }
    assert!(linear.as_raw().iter().any(|radiance| *radiance > 1.5), "something is compressed");
    assert_ne!(shown, scene.shown(SIZE, &full()), "the default has no curve");
}
