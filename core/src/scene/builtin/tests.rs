//! Tests that built-in scenes are valid and match their descriptions.

use std::f64::consts::PI;

use glam::{Vec2, Vec3, vec2, vec3};

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
        coverage: false,
        vertex_alpha: false,
        single_sided: false,
        panes: false,
        extended_materials: false,
        normal_maps: false,
        coat_normals: false,
        tangents: false,
        anisotropy: false,
        iridescence: false,
        translucency: false,
        dispersion: false,
        slot_coordinates: false,
        layers: false,
        microfacets: true,
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
    assert_eq!([e.background, e.ambient, e.fallback_radiance], [Vec3::ONE; 3]);
    assert!(scene.lights.is_empty());
}

/// Every thing is an object of its own inside the frame, and none is thinner than a pixel.
#[test]
fn wires_are_two_thousand_plain_things() {
    let scene = builtin("wires").expect("wires");
    let nothing_but_a_light = Features::of(&scene).list().into_iter().filter(|(_, needed)| *needed);
    assert_eq!(nothing_but_a_light.map(|(name, _)| name).collect::<Vec<_>>(), ["lights"]);
    assert_eq!(scene.lights.len(), 1);
    assert_eq!(scene.objects.len(), 2 + 2000);
    let camera = scene.cameras[0].1;
    let (height, right) = (camera.up.length(), camera.right.normalize());
    let project = |p: Vec3| {
        let offset = p - camera.origin;
        let depth = offset.dot(camera.forward);
        // Position in pixels of a frame of 1440 rows, from the centre.
        vec2(offset.dot(right), offset.dot(camera.up / height)) / depth / height * 720.0
    };
    let mut points = vec![Vec::new(); scene.objects.len()];
    for (corners, object) in scene.positions.iter().zip(&scene.triangle_objects) {
        points[*object as usize].extend(corners.map(project));
    }
    let mut narrow = 0;
    for (object, points) in scene.objects.iter().zip(&points).skip(2) {
        let inside = points.iter().any(|p| p.x.abs() < 1280.0 && p.y.abs() < 720.0);
        assert!(inside, "{} is out of the frame", object.name);
        // The least width over many directions.
        let width = (0..180).map(|i| Vec2::from_angle(i as f32 / 180.0 * PI as f32)).map(|across| {
            let along = points.iter().map(|p| p.dot(across));
            along.clone().fold(f32::MIN, f32::max) - along.fold(f32::MAX, f32::min)
        });
        let width = width.fold(f32::MAX, f32::min);
        assert!((0.99..60.0).contains(&width), "{} is {width} pixels wide", object.name);
        narrow += usize::from(width < 2.0);
    }
    assert!((300..1000).contains(&narrow), "{narrow} are narrower than two pixels");
}
