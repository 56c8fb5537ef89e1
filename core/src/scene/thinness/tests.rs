//! Tests with objects of known thickness.

use glam::{Mat3, Quat, Vec3, vec3};

use super::*;
use crate::scene::{Sphere, builtin};

/// Longest side of every test scene; a sphere of that diameter is part of it and much too thick to count.
const LONGEST: f32 = 16.0;

/// The twelve triangles of a box in an arbitrary orientation.
fn cuboid(center: Vec3, size: Vec3) -> Vec<[Vec3; 3]> {
    let turn = Mat3::from_quat(Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7));
    let corner = |i: u32| {
        let sign = |bit: u32| if i & bit == 0 { -0.5 } else { 0.5 };
        center + turn * (size * vec3(sign(1), sign(2), sign(4)))
    };
    let faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    faces.iter().flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]).map(|t| t.map(corner)).collect()
}

/// Thickness statistics of the triangles as one object, in a scene of size [`LONGEST`].
fn thinness(triangles: Vec<[Vec3; 3]>) -> Thinness {
    let triangle_objects = vec![0; triangles.len()];
    let spheres = vec![Sphere { center: Vec3::ZERO, radius: 0.5 * LONGEST, object: 1 }];
    Thinness::of(&Scene { positions: triangles, triangle_objects, spheres, ..Scene::default() })
}

/// Total length of things between `low` and `high` thick, all in the scene's unit of length.
fn length_between(thinness: &Thinness, low: f32, high: f32) -> f32 {
    LONGEST * (thinness.length_below(high / LONGEST) - thinness.length_below(low / LONGEST))
}

#[test]
fn a_rod_is_as_thick_as_its_section_and_a_plate_as_its_width() {
    let cases = [
        (vec3(4.0, 0.03, 0.03), 0.03),
        (vec3(0.03, 0.02, 4.0), 0.03),
        (vec3(2.0, 0.001, 1.0), 1.0),
        (Vec3::splat(0.5), 0.5),
    ];
    for (size, thickness) in cases {
        let found = thinness(cuboid(vec3(1.0, -2.0, 0.5), size));
        let length = length_between(&found, 0.7 * thickness, 1.45 * thickness);
        // The principal axes of a cube are arbitrary.
        assert!((0.99..1.75).contains(&(length / size.max_element())), "{size}: {length}, {found:?}");
    }
}

#[test]
fn things_of_one_object_are_told_apart_and_added_up() {
    let rods = (0..10).flat_map(|i| cuboid(vec3(0.0, 0.3 * i as f32, 0.0), vec3(0.02, 3.0, 0.02)));
    let found = thinness(rods.collect());
    assert!((length_between(&found, 0.01, 0.04) - 30.0).abs() < 0.1, "{found:?}");
    assert!(found.is_thin(1000, 8) && !found.is_thin(8000, 8), "0.02 of 16 is a block of 8 in 6400 rows");
    assert!(found.is_thin(1000, 2) && !found.is_thin(2000, 2));
}

#[test]
fn corners_weld_where_their_bits_are_the_same_and_the_object_too() {
    let plate = cuboid(Vec3::ZERO, vec3(2.0, 2.0, 0.0));
    let whole = thinness(plate.clone());
    assert!(length_between(&whole, 0.01, 1.3) < 0.01, "{whole:?}");
    let apart: Vec<_> = plate.iter().enumerate().map(|(i, t)| t.map(|p| p + 1.0e-4 * i as f32)).collect();
    let halves = thinness(apart);
    assert!(length_between(&halves, 1.0, 1.9) > 2.0, "triangles of their own are narrower: {halves:?}");
    let strips: Vec<_> = plate.iter().chain(&plate).copied().collect();
    let mut scene = Scene { triangle_objects: vec![0; strips.len()], positions: strips, ..Scene::default() };
    let once = Thinness::of(&scene);
    scene.triangle_objects[plate.len()..].fill(1);
    let twice = Thinness::of(&scene);
    assert!((twice.length_below(4.0) - 2.0 * once.length_below(4.0)).abs() < 1e-4, "{once:?} {twice:?}");
    let zero = |z: f32| [vec3(0.0, 0.0, z), vec3(1.0, 0.0, z), vec3(0.0, 1.0, z)];
    let zeros = thinness(vec![zero(0.0), zero(-0.0)]);
    assert!(length_between(&zeros, 0.1, 2.0) < 1.5, "-0 is 0: {zeros:?}");
}

#[test]
fn frames_and_bent_wires_are_as_thin_as_their_bars() {
    let ring = |width: f32| {
        let at = |i: u32, r: f32| r * Vec3::from((glam::Vec2::from_angle(i as f32 * 0.1), 0.0));
        let last = 62;
        (0..last).flat_map(move |i| {
            let (a, b) = (i, (i + 1) % last);
            let [p, q] = [1.0 - 0.5 * width, 1.0 + 0.5 * width];
            [[at(a, p), at(a, q), at(b, q)], [at(a, p), at(b, q), at(b, p)]]
        })
    };
    let found = thinness(ring(0.04).collect());
    let length = length_between(&found, 0.01, 0.08);
    assert!((length - 2.0).abs() < 0.1, "a ring 2 wide of strips 0.04 wide: {length}, {found:?}");
    let disc = thinness(ring(1.9).collect());
    assert!(length_between(&disc, 0.0001, 1.4) < 0.01, "{disc:?}");
}

#[test]
fn spheres_are_as_thick_as_they_are() {
    let sphere = |i: u32| Sphere { center: Vec3::X * i as f32, radius: 0.005, object: 0 };
    let mut scene = Scene { spheres: (0..=10).map(sphere).collect(), ..Scene::default() };
    assert!(!Thinness::of(&scene).is_thin(1000, 2), "eleven of a thousandth");
    scene.spheres.extend((0..2000).map(|i| sphere(i % 11)));
    assert!(Thinness::of(&scene).is_thin(1000, 2) && !Thinness::of(&scene).is_thin(4000, 2));
}

#[test]
fn what_has_no_extent_is_no_reason_for_anything() {
    let point = vec![[Vec3::ONE; 3]; 5];
    let line = vec![[Vec3::ZERO, Vec3::X, 2.0 * Vec3::X]];
    let huge = vec![[Vec3::ZERO, vec3(1.0e18, 0.0, 0.0), vec3(0.0, 1.0e18, 0.0)]];
    let tiny = vec![[Vec3::ZERO, vec3(1.0e-38, 0.0, 0.0), vec3(0.0, 1.0e-40, 0.0)]];
    for positions in [vec![], point, line, huge, tiny] {
        let what = format!("{:?}", positions.first());
        let scene = Scene { triangle_objects: vec![0; positions.len()], positions, ..Scene::default() };
        let found = Thinness::of(&scene);
        assert!(found.lengths.iter().all(|l| l.is_finite() && *l >= 0.0), "{what}: {found:?}");
        assert!(found.length_below(1.0) <= 1.42, "{what}: {found:?}");
    }
    let nothing = Thinness::of(&Scene::default());
    for (rows, block) in [(0, 2), (1, 8), (u32::MAX, 2)] {
        assert!(!nothing.is_thin(rows, block));
    }
}

#[test]
fn built_in_scenes_are_thin_where_they_hold_wires() {
    for (name, thin) in
        [("wires", true), ("room", true), ("cornell", false), ("minray", false), ("furnace", false)]
    {
        let found = Thinness::of(&builtin(name).expect(name));
        for (rows, block) in [(1440, 2), (1440, 8), (1024, 2), (1024, 8)] {
            assert_eq!(found.is_thin(rows, block), thin, "{name}, {rows} rows, block {block}");
        }
    }
}
