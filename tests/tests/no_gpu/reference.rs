//! The f64 reference against independently known results.

use std::f64::consts::PI;

use glam::{DVec3, Vec3, dvec3, vec3};
use glimpse::{
    Camera, Check, Features, Method, Origin, Scene, Settings, Tolerances,
    reference::{
        Attributes, Cause, Intersection, Limits, Ray, Reference, ReferenceFrame, Rounding, Tracer,
        fresnel_dielectric,
    },
    scene::{Material, Weights, builtin},
    stress::Random,
};
use glimpse_tests::{
    agreement::{Answer, Outcome, judge},
    builder::{Builder, front_camera, glass, matte, unlit},
    gallery,
};

const ALL: Limits = Limits { depth: 4, min_weight: 0.0 };

fn ray(origin: DVec3, direction: DVec3) -> Ray {
    Ray { origin, direction: direction.normalize(), t_max: f64::INFINITY, width: 0.0, growth: 0.0 }
}

fn seen(scene: &Scene, origin: DVec3, direction: DVec3) -> DVec3 {
    Reference::new(scene).sample(&ray(origin, direction), &ALL, &mut Rounding::none()).color
}

fn frame<'a>(
    reference: &'a Reference,
    camera: Camera,
    size: [u32; 2],
    settings: Settings,
) -> ReferenceFrame<'a> {
    ReferenceFrame { reference, camera, size, settings }
}

#[test]
fn a_furnace_is_one_everywhere() {
    let scene = builtin("furnace").unwrap();
    let camera = *scene.camera(None).unwrap();
    let reference = Reference::new(&scene);
    let frame = frame(&reference, camera, [48, 32], Settings::default());
    for pixel in (0..48).flat_map(|x| (0..32).map(move |y| [x, y])) {
        for color in [
            frame.traced(pixel, &mut Rounding::none()).color,
            frame.adaptive(pixel, None, &mut Rounding::none()).color,
        ] {
            // The scene's numbers are f32.
            assert!((color - 1.0).abs().max_element() < 1e-6, "{pixel:?}: {color}");
        }
    }
}

/// A matte sphere and one light: radiance = albedo / pi x intensity / d^2 x cos.
#[test]
fn a_lit_sphere() {
    let (albedo, intensity, light) = (vec3(0.75, 0.5, 0.25), vec3(10.0, 20.0, 30.0), vec3(1.0, 2.0, 3.0));
    let mut builder = Builder::new();
    let object = builder.object(matte(albedo));
    builder.sphere(object, Vec3::ZERO, 0.75);
    builder.point_light(light, intensity);
    let scene = builder.seen_by(front_camera());
    let point = 0.75 * dvec3(0.2, 0.3, 0.9).normalize();
    let to_light = light.as_dvec3() - point;
    let cos = point.normalize().dot(to_light.normalize());
    let expected = albedo.as_dvec3() / PI * intensity.as_dvec3() / to_light.length_squared() * cos;
    let found = seen(&scene, 3.0 * point, -point);
    assert!((found - expected).abs().max_element() < 1e-12, "{found} {expected}");
    let behind = dvec3(-0.1, -0.2, -0.7);
    assert_eq!(seen(&scene, 3.0 * behind, -behind), DVec3::ZERO, "the far side is dark");
}

/// Hecht, Optics, section 4.6: 4 % at normal incidence on glass, Brewster's angle atan(n) with R_p = 0 and
/// R_s = ((n^2 - 1) / (n^2 + 1))^2, total reflection from within beyond asin(1 / n) = 41.8 degrees.
#[test]
fn fresnel_is_as_in_the_textbook() {
    let n = 1.5_f64;
    assert!((fresnel_dielectric(1.0, 1.0 / n) - 0.04).abs() < 1e-15);
    assert!((fresnel_dielectric(1.0, n) - 0.04).abs() < 1e-15);
    let brewster = 0.5 * ((n * n - 1.0) / (n * n + 1.0)).powi(2);
    assert!((fresnel_dielectric(n.atan().cos(), 1.0 / n) - brewster).abs() < 1e-15);
    assert_eq!(fresnel_dielectric(0.0, 1.0 / n), 1.0);
    let critical = (1.0 / n).asin();
    assert!((critical.to_degrees() - 41.810_314_895_778_6).abs() < 1e-12);
    assert_eq!(fresnel_dielectric((critical + 1e-9).cos(), n), 1.0);
    let below = fresnel_dielectric((critical - 1e-9).cos(), n);
    assert!(below < 1.0 && below > 0.999, "{below}");
    // The same interface from both sides, at corresponding angles (Stokes).
    for angle in [0.1_f64, 0.5, 1.0, 1.5] {
        let inner = (angle.sin() / n).asin();
        let [outside, within] =
            [fresnel_dielectric(angle.cos(), 1.0 / n), fresnel_dielectric(inner.cos(), n)];
        assert!((outside - within).abs() < 1e-12, "{angle}: {outside} {within}");
    }
    assert!(fresnel_dielectric(0.3, 1.0) < 1e-30, "nothing to reflect at");
}

/// A slab of glass with red behind it and blue in front, seen at normal incidence: all orders of 4 % at each
/// face, up to the depth limit.
#[test]
fn a_slab_reflects_all_orders() {
    let mut builder = Builder::new();
    let slab = builder.object(glass(1.5));
    builder.quad(slab, vec3(-9.0, -9.0, 0.0), 18.0 * Vec3::X, 18.0 * Vec3::Y);
    builder.quad(slab, vec3(-9.0, -9.0, -1.0), 18.0 * Vec3::Y, 18.0 * Vec3::X);
    let red = builder.object(unlit(Vec3::X));
    builder.quad(red, vec3(-9.0, -9.0, -2.0), 18.0 * Vec3::X, 18.0 * Vec3::Y);
    builder.environment(Vec3::Z, Vec3::ZERO);
    let scene = builder.seen_by(front_camera());
    let limits = Limits { depth: 40, min_weight: 0.0 };
    let found = Reference::new(&scene)
        .sample(&ray(dvec3(0.1, 0.2, 1.0), DVec3::NEG_Z), &limits, &mut Rounding::none())
        .color;
    // Incoherent multiple reflection of two faces: T = (1 - R) / (1 + R).
    let r = 0.04;
    let expected = dvec3((1.0 - r) / (1.0 + r), 0.0, 2.0 * r / (1.0 + r));
    assert!((found - expected).abs().max_element() < 1e-12, "{found} {expected}");
}

/// A mirror shows the mirror image of the scene.
#[test]
fn a_mirror_is_a_window_into_the_mirrored_scene() {
    let world = |mirrored: bool| {
        let side = if mirrored { -1.0 } else { 1.0 };
        let mut builder = Builder::new();
        if !mirrored {
            // A pure mirror: a metal would show highlights of the lights as well.
            let all = Weights { diffuse: 0.0, mirror: 1.0, refraction: 0.0 };
            let wall = builder.object(Material { weights: Some(all), ..Material::default() });
            builder.quad(wall, vec3(-50.0, -50.0, 0.0), 100.0 * Vec3::X, 100.0 * Vec3::Y);
        }
        let ball = builder.object(matte(vec3(0.9, 0.5, 0.3)));
        builder.sphere(ball, vec3(0.4, 0.1, side * 2.0), 0.7);
        builder.point_light(vec3(-2.0, 3.0, side * 4.0), vec3(20.0, 30.0, 40.0));
        builder.environment(vec3(0.2, 0.4, 0.8), Vec3::splat(0.05));
        builder.seen_by(front_camera())
    };
    let (scene, mirrored) = (world(false), world(true));
    let mut random = Random(3);
    for _ in 0..500 {
        let toward = dvec3(2.0 * random.unit() - 1.0, 2.0 * random.unit() - 1.0, -1.0);
        let origin = dvec3(-1.2, 0.4, 1.5);
        let [a, b] = [&scene, &mirrored].map(|scene| seen(scene, origin, toward));
        assert!((a - b).abs().max_element() < 1e-6, "{toward}: {a} {b}");
    }
}

#[test]
fn the_tree_finds_the_first_of_all_crossings() {
    let scene = gallery::glasshouse();
    let tracer = Tracer::new(&scene);
    let mut random = Random(9);
    for i in 0..5_000 {
        let origin = random.inside(dvec3(-2.0, 0.0, -2.0), dvec3(2.0, 2.5, 2.0));
        let ray = ray(origin, random.direction());
        let all = tracer.intersections(&ray, None);
        assert!(all.is_sorted_by_key(|c| c.t), "{all:?}");
        assert_eq!(tracer.first(&ray, None, |_| true), all.first().copied());
        let odd = |c: &Intersection| c.primitive % 2 == 1;
        assert_eq!(tracer.first(&ray, None, odd), all.iter().copied().find(odd), "{i}");
        // Starting on the first surface, the other intersections remain; a sphere is left through its other
        // side.
        let Some(first) = all.first() else { continue };
        let on = Ray { origin: ray.origin + first.t * ray.direction, ..ray };
        let rest = tracer.intersections(&on, Some(first.primitive));
        let triangle = first.primitive < scene.positions.len();
        let again = rest.iter().any(|c| c.primitive == first.primitive);
        assert!(!(triangle && again), "a flat triangle is met once: {rest:?}");
        let expected = all.iter().skip(1).filter(|c| c.primitive < scene.positions.len());
        for intersection in expected {
            let found = rest.iter().find(|c| c.primitive == intersection.primitive);
            assert!(
                found.is_some_and(|c| (c.t + first.t - intersection.t).abs() < 1e-9),
                "{intersection:?} {rest:?}"
            );
        }
    }
}

/// A tilted plane: depth and texture coordinates interpolated half way between two pixels equal those traced
/// there.
#[test]
fn interpolation_is_exact_on_planes() {
    let mut builder = Builder::new();
    let texture = builder.ramp_texture();
    let wall = builder.object(Material { base_color_texture: Some(texture), ..matte(Vec3::ONE) });
    builder.quad(wall, vec3(-3.0, -3.0, -2.0), vec3(6.0, 0.0, 2.5), vec3(0.0, 6.0, 1.5));
    let scene = builder.seen_by(front_camera());
    let reference = Reference::new(&scene);
    for orthographic in [false, true] {
        let camera = Camera { orthographic, ..front_camera() };
        let frame = frame(&reference, camera, [31, 21], Settings::default());
        for [x, y] in [[4, 6], [15, 10], [26, 2], [8, 18]] {
            let [a, b, middle] = [[x - 1, y], [x + 1, y], [x, y]]
                .map(|pixel| frame.traced(pixel, &mut Rounding::none()).attributes);
            let between = frame.interpolated(&a, &b);
            assert!((between.depth - middle.depth).abs() < 1e-12, "{} {}", between.depth, middle.depth);
            assert!((between.texcoord - middle.texcoord).length() < 1e-12);
            assert!((between.normal - middle.normal).length() < 1e-12);
        }
    }
}

/// Stored attributes have the errors stated in core/NUMERICS.md.
#[test]
fn attributes_are_stored_as_stated() {
    let scene = gallery::textures();
    let camera = *scene.camera(None).unwrap();
    let features = Features::of(&scene);
    let reference = Reference::new(&scene);
    let frame = frame(&reference, camera, [64, 43], Settings::default());
    for pixel in (0..64).flat_map(|x| (0..43).map(move |y| [x, y])) {
        let exact = frame.traced(pixel, &mut Rounding::none()).attributes;
        let stored = exact.stored(&features, &mut Rounding::none());
        if exact.object.is_none() {
            assert_eq!(stored, Attributes::miss());
            continue;
        }
        assert!((stored.depth / exact.depth - 1.0).abs() <= 0.5_f64.powi(24));
        assert!(stored.normal.angle_between(exact.normal) < 6.5e-5 + 1e-7, "{pixel:?}");
        assert!(stored.face.angle_between(exact.face) < 6.5e-5 + 1e-7, "{pixel:?}");
        let largest = exact.gcol.max_element();
        // The smallest step is that of the smallest exponent.
        let step = (largest / 512.0).max(0.5_f64.powi(25));
        assert!((stored.gcol - exact.gcol).abs().max_element() <= step, "{exact:?} {stored:?}");
        assert!((stored.texcoord - exact.texcoord).abs().max_element() <= 0.5 / 65535.0 + 1e-15);
        assert!((stored.color - exact.color).abs().max_element() <= 0.5 / 255.0 + 1e-15);
    }
}

#[test]
fn the_strictest_tolerance_traces_everything() {
    let scene = gallery::orthographic();
    let camera = *scene.camera(None).unwrap();
    let reference = Reference::new(&scene);
    let tolerances = Tolerances { pos: 0.0, ..Tolerances::default() };
    let settings = Settings { tolerances, method: Method::Adaptive, ..Settings::default() };
    let frame = frame(&reference, camera, [12, 8], settings);
    for pixel in (0..12).flat_map(|x| (0..8).map(move |y| [x, y])) {
        let adaptive = frame.adaptive(pixel, None, &mut Rounding::none());
        assert_ne!(adaptive.origin, Origin::Interpolated);
        assert_eq!(adaptive.color, frame.traced(pixel, &mut Rounding::none()).color);
        let pos = Check::Pos.bit();
        assert!(adaptive.failed == 0 || adaptive.failed & (pos | 1) != 0, "{adaptive:?}");
    }
}

/// Tests of `judge`: it classifies differences correctly.
#[test]
fn the_judge_tells_ties_from_mistakes() {
    let answer = |label, value| Answer::<1> { labels: [label, 0], values: [value], tolerances: [1e-3] };
    let step = |r: &mut Rounding| {
        // The side of an edge on which a ray along it passes.
        let mut builder = Builder::new();
        let wall = builder.object(unlit(Vec3::ONE));
        builder.quad(wall, vec3(-1.0, -1.0, 0.0), Vec3::X, 2.0 * Vec3::Y);
        let reference = Reference::new(&builder.seen_by(front_camera()));
        let ray = ray(dvec3(0.0, 0.0, 1.0), DVec3::NEG_Z);
        answer(u32::from(reference.first(&ray, None, false, r).is_some()), 1.0)
    };
    assert_eq!(judge(&answer(1, 1.0005), step), Outcome::Same(0.000_499_999_999_999_944_9 / 1e-3));
    assert_eq!(judge(&answer(0, 1.0), step), Outcome::Tie(Cause::Silhouette));
    assert!(matches!(judge(&answer(2, 1.0), step), Outcome::Wrong(_)));
    assert!(matches!(judge(&answer(1, 1.0015), step), Outcome::Wrong(_)));
    assert!(matches!(judge(&answer(1, f64::NAN), step), Outcome::Wrong(_)));
    assert!(matches!(judge(&answer(0, f64::INFINITY), step), Outcome::Wrong(_)));
}
