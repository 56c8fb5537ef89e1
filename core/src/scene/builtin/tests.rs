//! Built-in scenes keep to the invariants, and are what their descriptions say.

use std::f64::consts::PI;

use glam::{Vec3, vec3};

use super::*;
use crate::scene::{Features, LightKind, octahedral_decode};

#[test]
fn every_scene_is_valid_and_finite() {
    for name in BUILTIN_NAMES {
        let scene = builtin(name).expect(name);
        scene.validate().expect(name);
        assert_eq!(scene.cameras[0].0, "main");
        assert!(scene.warnings.is_empty());
        assert!(scene.positions.len() + scene.spheres.len() >= 5, "{name}");
        for normal in scene.normals.iter().flatten() {
            assert!((octahedral_decode(*normal).length() - 1.0).abs() < 1e-6);
        }
    }
    assert!(builtin("attic").is_none());
}

#[test]
fn shading_normals_lie_on_the_side_of_the_face() {
    for name in BUILTIN_NAMES {
        let scene = builtin(name).expect(name);
        for (i, (p, n)) in scene.positions.iter().zip(&scene.normals).enumerate() {
            let face = (p[1] - p[0]).cross(p[2] - p[0]).normalize();
            let mean: Vec3 = n.iter().map(|n| octahedral_decode(*n)).sum();
            let object = &scene.objects[scene.triangle_objects[i] as usize].name;
            assert!(face.dot(mean) > 0.0, "{name}: triangle {i} of {object}");
        }
    }
}

#[test]
fn scenes_are_the_same_every_time() {
    let (a, b) = (builtin("room").expect("room"), builtin("room").expect("room"));
    assert_eq!(a.positions, b.positions);
    assert_eq!(a.images, b.images);
}

#[test]
fn the_room_needs_nearly_everything() {
    let scene = builtin("room").expect("room");
    let expected = Features {
        vertex_colors: false,
        metallic_roughness_textures: false,
        emissive_textures: false,
        ..Features::all()
    };
    assert_eq!(Features::of(&scene), expected);
    assert_eq!(scene.lights.len(), 4);
    assert_eq!(scene.cameras.len(), 2);
    assert!((5_000..100_000).contains(&scene.positions.len()), "{}", scene.positions.len());
}

#[test]
fn minray_looks_where_the_program_looks() {
    let scene = builtin("minray").expect("minray");
    let camera = scene.cameras[0].1;
    for (i, j) in [(0, 0), (16, 16), (31, 5), (7, 31)] {
        let (x, y) = ((i as f32 + 0.5 - 16.0) / 16.0, (16.0 - (j as f32 + 0.5)) / 16.0);
        let ours = (camera.forward + x * camera.right + y * camera.up).normalize();
        let tan = (12.5 * PI / 180.0).tan() as f32;
        let wanted = vec3(i as f32 - 16.0, 16.0 / tan, 16.0 - j as f32).normalize();
        assert!(ours.distance(wanted) < 1e-6, "{i} {j}: {ours} {wanted}");
    }
    assert_eq!(scene.lights.len(), 3);
    let LightKind::Point { position, falloff: false, .. } = scene.lights[1].kind else {
        panic!("{:?}", scene.lights[1])
    };
    assert_eq!((position, scene.lights[1].radius), (vec3(3.0, -6.0, 15.0), 7.0));
}

#[test]
fn the_furnace_is_uniform() {
    let scene = builtin("furnace").expect("furnace");
    let e = scene.environment;
    assert_eq!([e.background, e.ambient, e.truncated], [Vec3::ONE; 3]);
    assert!(scene.lights.is_empty());
}
