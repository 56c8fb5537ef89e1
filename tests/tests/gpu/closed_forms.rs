//! Scenes whose radiance is known in closed form.

use std::f64::consts::PI;

use glam::{DVec3, Vec3, dvec3, vec3};
use glimpse::{Camera, LinearImage, Method, Scene, Settings};
use glimpse_tests::{
    TestScene,
    builder::{Builder, front_camera, glass, matte, mirror, unlit},
    full, pixel_ray,
};

/// Compares all pixels for which `expected` gives a radiance; the others must be few.
fn compare(image: &LinearImage, tolerance: f64, expected: impl Fn(u32, u32) -> Option<DVec3>) {
    let (mut known, mut worst, mut bad) = (0, 0.0_f64, Vec::new());
    for (x, y, pixel) in image.enumerate_pixels() {
        let Some(expected) = expected(x, y) else { continue };
        known += 1;
        let found = DVec3::from_array(pixel.0.map(f64::from));
        let error = (found - expected).abs().max_element();
        worst = worst.max(error);
        if !found.is_finite() || error > tolerance * expected.max_element().max(0.05) {
            bad.push(format!("({x}, {y}): {found}, expected {expected}"));
        }
    }
    let total = (image.width() * image.height()) as usize;
    assert!(known * 10 >= total * 9, "only {known} of {total} pixels are compared");
    bad.truncate(bad.len().min(8));
    assert!(bad.is_empty(), "largest error {worst:.2e}; the first wrong pixels:\n{}", bad.join("\n"));
}

/// At this size no pass has workgroups that divide evenly, but each has several: an untreated tile would stay
/// black, however workgroups are distributed.
#[test]
fn a_furnace_is_one_everywhere() {
    let test_scene = TestScene::builtin("furnace");
    for method in [Method::Full, Method::Adaptive, Method::Checkerboard] {
        let image = test_scene.frame([621, 523], &Settings { method, ..Settings::default() });
        for (x, y, pixel) in image.enumerate_pixels() {
            for channel in pixel.0 {
                assert!((channel - 1.0).abs() <= 1e-5, "{method:?} ({x}, {y}): {:?}", pixel.0);
            }
        }
    }
}

/// A matte sphere and one light: radiance = albedo / pi x intensity / d^2 x cos.
#[test]
fn a_lit_sphere() {
    let (albedo, intensity, light) = (vec3(0.8, 0.5, 0.2), vec3(10.0, 20.0, 30.0), vec3(1.0, 2.0, 3.0));
    let mut builder = Builder::new();
    let object = builder.object(matte(albedo));
    builder.sphere(object, Vec3::ZERO, 0.75);
    builder.point_light(light, intensity);
    let camera = front_camera();
    let test_scene = TestScene::new(builder.seen_by(camera));
    let size = [64, 64];
    compare(&test_scene.full(size), 1e-4, |x, y| {
        let (origin, direction) = pixel_ray(&camera, size, x, y);
        let b = -direction.dot(origin);
        let u = b * b - origin.length_squared() + 0.75 * 0.75;
        if u.abs() < 1e-3 {
            return None; // the outline, where rounding decides and the normal is ill-conditioned
        }
        if u < 0.0 {
            return Some(DVec3::ZERO);
        }
        let point = origin + (b - u.sqrt()) * direction;
        let normal = point / 0.75;
        let to_light = light.as_dvec3() - point;
        let cos = normal.dot(to_light.normalize());
        if cos.abs() < 1e-4 {
            return None; // the terminator
        }
        Some(albedo.as_dvec3() / PI * intensity.as_dvec3() / to_light.length_squared() * cos.max(0.0))
    });
}

/// A wall lit only by ambient light: the light is behind the wall, or an opaque object blocks it.
fn dark_wall(ambient: Vec3, blocked: bool) -> Scene {
    let mut builder = Builder::new();
    let wall = builder.object(matte(vec3(0.5, 0.25, 0.125)));
    builder.quad(wall, vec3(-2.0, -2.0, 0.0), 4.0 * Vec3::X, 4.0 * Vec3::Y);
    if blocked {
        // Behind the camera.
        let screen = builder.object(matte(Vec3::ONE));
        builder.quad(screen, vec3(-4.0, -4.0, 3.0), 8.0 * Vec3::X, 8.0 * Vec3::Y);
    }
    builder.point_light(vec3(0.1, 0.2, if blocked { 4.0 } else { -1.0 }), Vec3::splat(5.0));
    builder.environment(Vec3::ONE, ambient);
    builder.seen_by(front_camera())
}

#[test]
fn shadow_is_exactly_black() {
    for blocked in [false, true] {
        let image = TestScene::new(dark_wall(Vec3::ZERO, blocked)).full([33, 25]);
        assert!(image.pixels().all(|p| p.0 == [0.0; 3]), "blocked: {blocked}");
    }
}

#[test]
fn shadow_leaves_the_ambient_light() {
    let expected = dvec3(0.5, 0.25, 0.125) * 0.4;
    for blocked in [false, true] {
        let image = TestScene::new(dark_wall(Vec3::splat(0.4), blocked)).full([33, 25]);
        compare(&image, 1e-6, |_, _| Some(expected));
    }
}

/// Without the object between, the wall is lit: the shadow above is caused by it.
#[test]
fn light_from_the_front_arrives() {
    let mut scene = dark_wall(Vec3::ZERO, true);
    let camera = *scene.camera(None).unwrap();
    scene.lights[0].kind = glimpse::scene::LightKind::Point {
        position: vec3(0.1, 0.2, 1.0),
        range: f32::INFINITY,
        falloff: true,
    };
    let size = [33, 25];
    compare(&TestScene::new(scene).full(size), 1e-4, |x, y| {
        let (origin, direction) = pixel_ray(&camera, size, x, y);
        let point = origin - origin.z / direction.z * direction;
        let to_light = vec3(0.1, 0.2, 1.0).as_dvec3() - point;
        let cos = to_light.normalize().z;
        Some(dvec3(0.5, 0.25, 0.125) / PI * 5.0 / to_light.length_squared() * cos)
    });
}

/// Schlick's approximation of the reflectance of a metal.
fn schlick(color: DVec3, cos: f64) -> DVec3 {
    color + (1.0 - color) * (1.0 - cos).powi(5)
}

/// A metal floor under a background and a coloured panel.
#[test]
fn a_mirror_shows_what_is_there() {
    let (metal, panel, background) = (vec3(0.9, 0.5, 0.2), vec3(0.1, 0.7, 0.4), vec3(0.3, 0.6, 1.0));
    let mut builder = Builder::new();
    let floor = builder.object(mirror(metal));
    builder.quad(floor, vec3(-20.0, 0.0, 20.0), 40.0 * Vec3::X, -40.0 * Vec3::Z);
    let screen = builder.object(unlit(panel));
    builder.quad(screen, vec3(-0.7, 0.5, -3.0), 1.4 * Vec3::X, Vec3::Y);
    builder.environment(background, Vec3::ZERO);
    let camera = Camera::look_at(vec3(0.0, 1.0, 2.0), vec3(0.0, 0.0, -0.6), 0.7).unwrap();
    let test_scene = TestScene::new(builder.seen_by(camera));
    let size = [64, 48];
    let at_panel = |origin: DVec3, direction: DVec3| {
        let t = (-3.0 - origin.z) / direction.z;
        let point = origin + t * direction;
        let inside = (0.7 - point.x.abs()).min(0.5 - (point.y - 1.0).abs());
        (t <= 0.0 || inside.abs() > 1e-4).then_some(t > 0.0 && inside > 0.0)
    };
    compare(&test_scene.full(size), 1e-4, |x, y| {
        let (origin, direction) = pixel_ray(&camera, size, x, y);
        if at_panel(origin, direction)? {
            return Some(panel.as_dvec3());
        }
        if direction.y > -1e-3 {
            return None;
        }
        let point = origin - origin.y / direction.y * direction;
        let inside = 20.0 - point.x.abs().max(point.z.abs());
        if inside < 1e-3 {
            return (inside < -1e-3).then_some(background.as_dvec3());
        }
        let mirrored = dvec3(direction.x, -direction.y, direction.z);
        let seen = if at_panel(point, mirrored)? { panel } else { background };
        Some(schlick(metal.as_dvec3(), -direction.y) * seen.as_dvec3())
    });
}

/// Fresnel's reflectance of unpolarised light passing from index `from` to index `to`.
fn fresnel(cos: f64, from: f64, to: f64) -> f64 {
    let sin = from / to * (1.0 - cos * cos).sqrt();
    if sin >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin * sin).sqrt();
    let s = (from * cos - to * cos_t) / (from * cos + to * cos_t);
    let p = (to * cos - from * cos_t) / (to * cos + from * cos_t);
    0.5 * (s * s + p * p)
}

/// The face of a glass body, seen from inside (`sign` -1) or outside (1): red lies beyond it, blue on the
/// viewer's side. From inside, everything beyond asin(1 / 1.5) = 41.8 degrees is totally reflected.
fn glass_face(sign: f32) {
    const INDEX: f64 = 1.5;
    let mut builder = Builder::new();
    let face = builder.object(glass(INDEX as f32));
    builder.quad(face, vec3(-50.0 * sign, -50.0, 0.0), 100.0 * sign * Vec3::X, 100.0 * Vec3::Y);
    let beyond = builder.object(unlit(Vec3::X));
    builder.quad(beyond, vec3(-5e3, -5e3, -1.0), 1e4 * Vec3::X, 1e4 * Vec3::Y);
    let this_side = builder.object(unlit(Vec3::Z));
    builder.quad(this_side, vec3(-5e3, -5e3, 1.0), 1e4 * Vec3::Y, 1e4 * Vec3::X);
    let camera = Camera::look_at(vec3(0.0, 0.0, 0.5), vec3(0.35, 0.0, 0.0), 1.2).expect("a valid camera");
    let test_scene = TestScene::new(builder.seen_by(camera));
    let size = [64, 48];
    let (from, to) = if sign < 0.0 { (INDEX, 1.0) } else { (1.0, INDEX) };
    let (mut partial, mut total) = (0, 0);
    let mut known = |x: u32, y: u32| {
        let (_, direction) = pixel_ray(&camera, size, x, y);
        let cos = -direction.z;
        let sin = from / to * (1.0 - cos * cos).sqrt();
        if (sin - 1.0).abs() < 1e-3 {
            return None; // at the critical angle the reflectance has an infinite slope
        }
        if sin > 1.0 {
            total += 1
        } else {
            partial += 1
        }
        let reflectance = fresnel(cos, from, to);
        Some(dvec3(1.0 - reflectance, 0.0, reflectance))
    };
    let expected: Vec<_> =
        (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))).map(|(x, y)| known(x, y)).collect();
    assert!(partial > 500 && (total > 500) == (sign < 0.0), "{partial} partial, {total} total reflections");
    compare(&test_scene.full(size), 2e-4, |x, y| expected[(y * size[0] + x) as usize]);
}

#[test]
fn glass_from_outside_follows_fresnel() {
    glass_face(1.0);
}

#[test]
fn glass_from_inside_reflects_totally_beyond_the_critical_angle() {
    glass_face(-1.0);
}

/// The recursion of Whitted's algorithm has exactly `depth` levels: the light between two parallel mirrors
/// counts them.
#[test]
fn recursion_ends_where_it_is_told_to() {
    let mut builder = Builder::new();
    for (z, u) in [(0.0, Vec3::X), (4.0, -Vec3::X)] {
        let wall = builder.object(mirror(Vec3::splat(0.5)));
        builder.quad(wall, vec3(0.0, -50.0, z) - 50.0 * u, 100.0 * u, 100.0 * Vec3::Y);
    }
    builder.environment(Vec3::ZERO, Vec3::ONE);
    // The view is perpendicular to the wall, so that the reflectance is 0.5 to many digits.
    let camera = Camera::look_at(vec3(0.0, 0.0, 2.0), Vec3::ZERO, 0.01).unwrap();
    let test_scene = TestScene::new(builder.seen_by(camera));
    for depth in [1, 2, 3, 5, 12] {
        let settings = Settings { depth, ..full() };
        let image = test_scene.frame([5, 5], &settings);
        compare(&image, 1e-4, |_, _| Some(DVec3::splat(0.5_f64.powi(depth as i32))));
    }
}
