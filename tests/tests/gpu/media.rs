//! Solids of glass that touch, overlap and contain one another.

use glam::{Vec3, vec3};
use glimpse::{
    Camera, Features, LinearImage, Method, Paths, Roulette, Scene, Settings,
    scene::{Material, Object},
};
use glimpse_tests::{
    TestScene,
    builder::{Builder, front_camera, glass, unlit},
    full,
};

const SIZE: [u32; 2] = [48, 48];

fn deep(method: Method) -> Settings {
    let paths = Paths { roulette: Roulette::Off, ..Paths::default() };
    Settings { method, depth: 8, min_weight: 1e-4, paths, ..full() }
}

/// Walls in stripes behind the origin.
fn striped() -> Builder {
    let mut builder = Builder::new();
    for i in 0..16 {
        let wall = builder.object(unlit(vec3(0.06 * i as f32, if i % 2 == 0 { 0.2 } else { 0.9 }, 0.5)));
        builder.quad(wall, vec3(-4.0 + 0.5 * i as f32, -4.0, -1.5), 0.5 * Vec3::X, 8.0 * Vec3::Y);
    }
    builder.environment(Vec3::splat(0.3), Vec3::splat(0.3));
    builder
}

fn cuboid(b: &mut Builder, object: u32, low: Vec3, high: Vec3) {
    let size = high - low;
    let (x, y, z) = (size.x * Vec3::X, size.y * Vec3::Y, size.z * Vec3::Z);
    for (corner, u, v) in
        [(low, y, x), (low, z, y), (low, x, z), (high, -x, -y), (high, -y, -z), (high, -z, -x)]
    {
        b.quad(object, corner, u, v);
    }
}

/// A slab from z = -0.6 to 0 in layers that end at these depths, each with its material, nearest first.
fn layered(layers: &[(f32, Material)]) -> Scene {
    let mut builder = striped();
    let mut near = 0.0;
    for (far, material) in layers {
        let object = builder.object(material.clone());
        cuboid(&mut builder, object, vec3(-0.7, -0.6, *far), vec3(0.6, 0.5, near));
        near = *far;
    }
    builder.seen_by(Camera::look_at(vec3(0.5, 0.4, 2.0), Vec3::ZERO, 0.8).expect("a camera"))
}

/// The largest difference of two images, and the share of their values that differ by more than 1e-4.
fn differences(a: &LinearImage, b: &LinearImage) -> (f32, f32) {
    let differences = a.as_raw().iter().zip(b.as_raw()).map(|(a, b)| (a - b).abs());
    let (most, apart) = differences.fold((0.0_f32, 0), |(most, apart), difference| {
        (most.max(difference), apart + u32::from(difference > 1e-4 || difference.is_nan()))
    });
    (most, apart as f32 / a.as_raw().len() as f32)
}

fn assert_same(a: Scene, b: Scene, what: &str) {
    let [a, b] = [a, b].map(TestScene::new);
    for method in [Method::Full, Method::Adaptive, Method::Path] {
        let [one, other] = [&a, &b].map(|scene| scene.frame(SIZE, &deep(method)));
        let (most, share) = differences(&one, &other);
        assert!(share <= 0.005, "{what}, {method:?}: {share} of the values differ, by up to {most}");
    }
}

#[test]
fn glued_slabs_are_one() {
    let one = || layered(&[(-0.6, glass(1.5))]);
    assert!(!Features::of(&one()).nested_media);
    let two = layered(&[(-0.25, glass(1.5)), (-0.6, glass(1.5))]);
    assert!(Features::of(&two).nested_media);
    assert_same(one(), two, "two slabs");
    assert_same(one(), layered(&[(-0.1, glass(1.5)), (-0.2, glass(1.5)), (-0.6, glass(1.5))]), "three slabs");
    let apart = TestScene::new(layered(&[(-0.25, glass(1.5)), (-0.6, glass(1.8))]));
    let (_, share) = differences(
        &TestScene::new(one()).frame(SIZE, &deep(Method::Full)),
        &apart.frame(SIZE, &deep(Method::Full)),
    );
    assert!(share > 0.2, "another index shows: {share}");
}

fn ball_in_slab(ball: Option<Material>, inside: f32) -> Scene {
    let mut scene = {
        let mut builder = striped();
        let slab = builder.object(glass(1.5));
        cuboid(&mut builder, slab, vec3(-0.7, -0.6, -0.6), vec3(0.6, 0.5, 0.0));
        if let Some(material) = ball {
            let ball = builder.object(material);
            builder.sphere(ball, vec3(0.0, 0.0, inside), 0.2);
        }
        builder.seen_by(Camera::look_at(vec3(0.2, 0.1, 2.0), Vec3::ZERO, 0.8).expect("a camera"))
    };
    scene.environment.fallback_radiance = Vec3::splat(0.3);
    scene
}

#[test]
fn equal_indices_have_no_boundary() {
    assert_same(ball_in_slab(None, -0.3), ball_in_slab(Some(glass(1.5)), -0.3), "a ball of the same glass");
    let [none, bubble] = [None, Some(glass(1.0))]
        .map(|ball| TestScene::new(ball_in_slab(ball, -0.3)).frame(SIZE, &deep(Method::Full)));
    let (_, share) = differences(&none, &bubble);
    assert!(share > 0.03, "a bubble shows: {share}");
}

/// A ball that sticks out of the front of a slab.
#[test]
fn the_higher_priority_fills_an_overlap() {
    let frame = |ball: i8, slab: i8| {
        let mut scene = ball_in_slab(Some(Material { priority: ball, ..glass(1.2) }), 0.0);
        scene.materials[16].priority = slab;
        TestScene::new(scene).frame(SIZE, &deep(Method::Full))
    };
    let (ball, slab) = (frame(1, 0), frame(0, 1));
    assert_eq!(differences(&frame(-100, 100), &slab).0, 0.0);
    assert_eq!(differences(&frame(-4, -5), &ball).0, 0.0);
    assert!(differences(&ball, &slab).1 > 0.02);
}

/// Beer-Lambert through layers of index 1, seen straight on: the innermost medium absorbs.
#[test]
fn the_innermost_medium_absorbs() {
    let dye = |absorption: Vec3, priority: i8| Material { absorption, priority, ..glass(1.0) };
    let (outer, inner) = (vec3(0.5, 1.0, 2.0), vec3(2.0, 0.0, 1.0));
    for (priority, lengths) in [(0, (0.7, 0.3)), (1, (0.7, 0.3)), (-1, (1.0, 0.0))] {
        let mut builder = Builder::new();
        let wall = builder.object(unlit(Vec3::ONE));
        builder.quad(wall, vec3(-4.0, -4.0, -2.0), 8.0 * Vec3::X, 8.0 * Vec3::Y);
        for (absorption, depth, priority) in [(outer, 0.5, 0), (inner, 0.15, priority)] {
            let object = builder.object(dye(absorption, priority));
            cuboid(&mut builder, object, vec3(-2.0, -2.0, -depth), vec3(2.0, 2.0, depth));
        }
        let expected = (-(lengths.0 * outer + lengths.1 * inner)).exp();
        // Straight rays, outside and inside of the outer solid, which is left undimmed for as much.
        let mut scene = builder.seen_by(front_camera());
        for (eye, share) in [(2.0, Vec3::ONE), (0.3, (0.2 * outer).exp())] {
            let narrow = Camera::look_at(vec3(0.0, 0.0, eye), Vec3::ZERO, 0.01).expect("a camera");
            scene.cameras[0].1 = narrow;
            let test_scene = TestScene::new(scene.clone());
            for method in [Method::Full, Method::Adaptive, Method::Path] {
                let found = Vec3::from(test_scene.frame(SIZE, &deep(method)).get_pixel(24, 24).0);
                let expected = share * expected;
                assert!(
                    (found - expected).abs().max_element() < 1e-4,
                    "{method:?} {eye}: {found}, not {expected}"
                );
            }
        }
    }
}

/// An opaque wall that touches the back of glued slabs is seen through them.
#[test]
fn what_touches_glass_is_seen_through_it() {
    let mut scene = layered(&[(-0.25, glass(1.5)), (-0.6, glass(1.5))]);
    scene.materials.push(unlit(vec3(0.0, 0.0, 1.0)));
    scene.objects.push(Object { name: "label".into(), material: scene.materials.len() as u32 - 1 });
    let label = scene.objects.len() as u32 - 1;
    // The face at the back of the farther slab, over again.
    let back: Vec<_> =
        (0..scene.positions.len()).filter(|i| scene.positions[*i].iter().all(|p| p.z == -0.6)).collect();
    assert_eq!(back.len(), 2);
    for i in back {
        scene.positions.push(scene.positions[i]);
        scene.normals.push(scene.normals[i]);
        scene.triangle_objects.push(label);
    }
    let test_scene = TestScene::new(scene);
    for method in [Method::Full, Method::Adaptive] {
        let [red, green, blue] = test_scene.frame(SIZE, &deep(method)).get_pixel(24, 24).0;
        // What the front face reflects is grey.
        assert!(blue > 0.9 && red < 0.05 && green < 0.05, "{method:?}: {red} {green} {blue}");
    }
}
