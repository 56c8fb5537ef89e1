//! Lights at the horizon of smooth meshes: shading normals in front of a light and faces behind it.

use std::f64::consts::PI;

use glam::{DVec3, Vec3, vec3};
use glimpse::{
    Camera, Method, Scene, Settings,
    reference::{Reference, ReferenceFrame, Rounding},
    scene::{Light, LightKind, octahedral_encode},
};
use glimpse_tests::{
    TestScene,
    builder::{Builder, front_camera, matte},
    pixel_ray,
};

const SIZE: [u32; 2] = [64, 64];

/// Adds a triangle of an object with the unit normals of its corners.
fn push(scene: &mut Scene, object: u32, corners: [Vec3; 3], normals: [Vec3; 3]) {
    scene.positions.push(corners);
    scene.normals.push(normals.map(octahedral_encode));
    scene.triangle_objects.push(object);
}

/// A scene of a white and a black object without ambient light, under a directional light of irradiance pi.
fn lit_from(towards_light: Vec3, camera: Camera) -> Scene {
    let mut builder = Builder::new();
    builder.object(matte(Vec3::ONE));
    builder.object(matte(Vec3::ZERO));
    builder.light(Light {
        kind: LightKind::Directional { direction: -towards_light.normalize() },
        intensity: Vec3::splat(PI as f32),
        radius: 0.0,
    });
    builder.seen_by(camera)
}

/// An octahedron whose faces are divided twice, with corners on the unit sphere scaled to a radius of 0.75.
fn coarse_ball(scene: &mut Scene) {
    let mut faces = Vec::new();
    for signs in 0..8 {
        let sign = |bit| if signs & 1 << bit == 0 { 1.0 } else { -1.0 };
        faces.push([sign(0) * Vec3::X, sign(1) * Vec3::Y, sign(2) * Vec3::Z]);
    }
    for _ in 0..2 {
        let quarters = |[a, b, c]: [Vec3; 3]| {
            let [ab, bc, ca] = [(a + b).normalize(), (b + c).normalize(), (c + a).normalize()];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        faces = faces.into_iter().flat_map(quarters).collect();
    }
    for face in faces {
        push(scene, 0, face.map(|p| 0.75 * p), face);
    }
}

/// The interpolated unit normal at the nearest triangle that a ray meets, by Cramer's rule.
fn normal_at(scene: &Scene, ball: &[[Vec3; 3]], origin: DVec3, direction: DVec3) -> Option<DVec3> {
    let hit = |(corners, normals): (&[Vec3; 3], &[Vec3; 3])| {
        let [a, b, c] = corners.map(|p| p.as_dvec3());
        let (ab, ac, from) = (b - a, c - a, origin - a);
        let (p, q) = (direction.cross(ac), from.cross(ab));
        let determinant = ab.dot(p);
        let (u, v, t) = (from.dot(p) / determinant, direction.dot(q) / determinant, ac.dot(q) / determinant);
        let [na, nb, nc] = normals.map(|n| n.as_dvec3());
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| (t, (1.0 - u - v) * na + u * nb + v * nc))
    };
    let hits = scene.positions.iter().zip(ball).filter_map(hit);
    hits.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, normal)| normal.normalize())
}

/// The light ends where the shading normals turn away from it and not at edges of faces.
#[test]
fn a_coarse_ball_is_lit_up_to_its_horizon() {
    let towards_light = vec3(1.0, 0.2, 0.1).normalize();
    let camera = front_camera();
    let mut scene = lit_from(towards_light, camera);
    coarse_ball(&mut scene);
    let normals: Vec<_> = scene.positions.iter().map(|corners| corners.map(|p| p / 0.75)).collect();
    let expected: Vec<_> = (0..SIZE[0] * SIZE[1])
        .map(|i| {
            let (origin, direction) = pixel_ray(&camera, SIZE, i % SIZE[0], i / SIZE[0]);
            normal_at(&scene, &normals, origin, direction).map(|n| n.dot(towards_light.as_dvec3()))
        })
        .collect();
    let image = TestScene::new(scene).full(SIZE);
    let (mut horizon, mut dark) = (0, 0);
    for (pixel, cosine) in image.pixels().zip(&expected) {
        let Some(cosine) = *cosine else { continue };
        let error = (f64::from(pixel.0[0]) - cosine.max(0.0)).abs();
        assert!(error < 2e-3, "radiance {}, expected {cosine}", pixel.0[0]);
        horizon += u32::from(cosine > 2e-3 && cosine < 0.2);
        dark += u32::from(cosine < 0.0);
    }
    assert!(horizon > 100 && dark > 300, "{horizon} pixels at the horizon, {dark} behind it");
}

/// Paths see the lights by the same shadow rays, in the shaders and in the reference.
#[test]
fn paths_light_a_coarse_ball_up_to_its_horizon() {
    let towards_light = vec3(1.0, 0.2, 0.1).normalize();
    let camera = front_camera();
    let mut scene = lit_from(towards_light, camera);
    coarse_ball(&mut scene);
    let normals: Vec<_> = scene.positions.iter().map(|corners| corners.map(|p| p / 0.75)).collect();
    let settings = Settings { method: Method::Path, depth: 2, ..Settings::default() };
    let reference = Reference::new(&scene);
    let frame = ReferenceFrame { reference: &reference, camera, size: SIZE, settings };
    // Paths start anywhere in a pixel: its neighbours are on the band as well.
    let near = |x: u32, y: u32| {
        let (origin, direction) = pixel_ray(&camera, SIZE, x, y);
        let cosine = normal_at(&scene, &normals, origin, direction)?.dot(towards_light.as_dvec3());
        (cosine > 0.1 && cosine < 0.25).then_some(cosine)
    };
    let image = TestScene::new(scene.clone()).frame(SIZE, &settings);
    let mut band = 0;
    for (x, y, pixel) in image.enumerate_pixels() {
        let inside = (1..SIZE[0] - 1).contains(&x) && (1..SIZE[1] - 1).contains(&y);
        let around = || [(x, y), (x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)];
        if !inside || around().into_iter().any(|(x, y)| near(x, y).is_none()) {
            continue;
        }
        let exact = frame.path([x, y], 0, &mut Rounding::none()).radiance.x;
        assert!(pixel.0[0] > 0.05 && exact > 0.05, "({x}, {y}): {}, in the reference {exact}", pixel.0[0]);
        band += 1;
    }
    assert!(band > 50, "{band} pixels on the band");
}

/// Sets a square of half size 1 at z = 0 that the camera sees, with normals that lean towards +x by this slope.
fn leaning_square(scene: &mut Scene, slope: impl Fn(Vec3) -> f32) {
    let corners = [vec3(-1.0, -1.0, 0.0), vec3(1.0, -1.0, 0.0), vec3(1.0, 1.0, 0.0), vec3(-1.0, 1.0, 0.0)];
    for triangle in [[0, 1, 2], [0, 2, 3]] {
        let corners = triangle.map(|i| corners[i]);
        push(scene, 0, corners, corners.map(|p| vec3(slope(p), 0.0, 1.0).normalize()));
    }
}

/// A light behind a single sheet does not shine through it, however its normals are bent.
#[test]
fn light_does_not_leak_through_a_sheet() {
    let mut scene = lit_from(vec3(1.0, 0.0, -0.5), front_camera());
    leaning_square(&mut scene, |_| 4.0);
    let image = TestScene::new(scene).full(SIZE);
    // Seen from z = 2 under 45 degrees, half the picture's width is 0.83. The ray from the curved surface passes the
    // edge at x = 1 from a part of the sheet next to it.
    for (x, _, pixel) in image.enumerate_pixels().filter(|(x, ..)| *x < SIZE[0] / 2) {
        assert_eq!(pixel.0, [0.0; 3], "column {x}");
    }
}

/// A bulging square seen from the side, with or without a black plate between it and the curved surface above.
fn bulge(plate: bool) -> TestScene {
    let camera =
        Camera::look_at(vec3(3.0, 0.0, 0.04), Vec3::ZERO, 4.0_f32.to_radians()).expect("a valid camera");
    let mut scene = lit_from(vec3(1.0, 0.0, -0.1), camera);
    leaning_square(&mut scene, |p| p.x);
    if plate {
        let corners =
            [vec3(-1.0, -1.0, 0.06), vec3(1.0, -1.0, 0.06), vec3(1.0, 1.0, 0.06), vec3(-1.0, 1.0, 0.06)];
        for triangle in [[0, 1, 2], [0, 2, 3]] {
            push(&mut scene, 1, triangle.map(|i| corners[i]), [Vec3::Z; 3]);
        }
    }
    TestScene::new(scene)
}

/// What lies between a face and the curved surface above it keeps its shadow.
#[test]
fn light_does_not_leak_past_a_near_surface() {
    let lit = |plate| bulge(plate).full(SIZE).pixels().filter(|p| p.0[0] > 0.0).count();
    assert!(lit(false) > 20, "{} pixels are lit without the plate", lit(false));
    assert_eq!(lit(true), 0);
}
