//! Single-sided surfaces: which rays pass through their backs.

use glam::{Vec3, vec3};
use glimpse::{Features, LinearImage, Method, Scene, Settings, scene::Material};
use glimpse_tests::{
    TestScene,
    builder::{Builder, front_camera, glass, matte, mirror, unlit},
    full,
};

const SIZE: [u32; 2] = [32, 32];
const RED: Vec3 = Vec3::X;
const GREEN: Vec3 = Vec3::Y;

fn single(material: Material) -> Material {
    Material { double_sided: false, ..material }
}

fn middle(image: &LinearImage) -> Vec3 {
    Vec3::from(image.get_pixel(SIZE[0] / 2, SIZE[1] / 2).0)
}

/// A green wall behind the origin, and a quad of `material` before it that faces the camera or turns its back.
fn screened(material: Material, faces: bool) -> Scene {
    let mut builder = Builder::new();
    let wall = builder.object(unlit(GREEN));
    builder.quad(wall, vec3(-4.0, -4.0, -1.0), 8.0 * Vec3::X, 8.0 * Vec3::Y);
    let screen = builder.object(material);
    let (u, v) = (2.0 * Vec3::X, 2.0 * Vec3::Y);
    let (u, v) = if faces { (u, v) } else { (v, u) };
    builder.quad(screen, vec3(-1.0, -1.0, 0.0), u, v);
    builder.seen_by(front_camera())
}

#[test]
fn rays_of_the_camera_pass_through_backs() {
    for (material, faces, seen) in [
        (single(unlit(RED)), true, RED),
        (single(unlit(RED)), false, GREEN),
        (unlit(RED), true, RED),
        (unlit(RED), false, RED),
    ] {
        for method in [Method::Full, Method::Adaptive, Method::Path] {
            let scene = TestScene::new(screened(material.clone(), faces));
            let found = middle(&scene.frame(SIZE, &Settings { method, ..full() }));
            assert_eq!(found, seen, "{method:?}, faces {faces}, {material:?}");
        }
    }
}

/// Normals that contradict the winding do not decide, as rasterisers do not read them.
#[test]
fn the_winding_decides_and_not_the_normals() {
    for faces in [false, true] {
        let mut scene = screened(single(unlit(RED)), faces);
        let flipped = glimpse::scene::octahedral_encode(if faces { -Vec3::Z } else { Vec3::Z });
        scene.normals[2..].fill([flipped; 3]);
        let found = middle(&TestScene::new(scene).full(SIZE));
        assert_eq!(found, if faces { RED } else { GREEN });
    }
}

/// A slab of glass refracts on leaving, whatever its material says of its sides.
#[test]
fn glass_keeps_its_backs() {
    let slab = |material: Material| {
        let mut builder = Builder::new();
        let texture = builder.ramp_texture();
        let wall = builder.object(Material { base_color_texture: Some(texture), ..unlit(Vec3::ONE) });
        builder.quad(wall, vec3(-4.0, -4.0, -3.0), 8.0 * Vec3::X, 8.0 * Vec3::Y);
        let slab = builder.object(material);
        builder.quad(slab, vec3(-1.0, -1.0, 0.5), 2.0 * Vec3::X, 2.0 * Vec3::Y);
        builder.quad(slab, vec3(-1.0, -1.0, -0.5), 2.0 * Vec3::Y, 2.0 * Vec3::X);
        builder.seen_by(front_camera())
    };
    assert!(!Features::of(&slab(single(glass(1.5)))).single_sided);
    let [one, two] = [single(glass(1.5)), glass(1.5)].map(|m| TestScene::new(slab(m)).full(SIZE));
    glimpse_tests::assert_same(&one, &two, "glass");
}

/// A mirror shows what is behind a screen that turns its back to the mirror.
#[test]
fn reflected_rays_pass_through_backs() {
    for (faces_mirror, seen) in [(true, RED), (false, GREEN)] {
        let mut builder = Builder::new();
        let wall = builder.object(mirror(Vec3::ONE));
        builder.quad(wall, vec3(-4.0, -4.0, 0.0), 8.0 * Vec3::X, 8.0 * Vec3::Y);
        let behind = builder.object(unlit(GREEN));
        builder.quad(behind, vec3(-9.0, -9.0, 4.0), 18.0 * Vec3::Y, 18.0 * Vec3::X);
        let screen = builder.object(single(unlit(RED)));
        let (u, v) = (8.0 * Vec3::Y, 8.0 * Vec3::X);
        let (u, v) = if faces_mirror { (u, v) } else { (v, u) };
        builder.quad(screen, vec3(-4.0, -4.0, 3.0), u, v);
        let found = middle(&TestScene::new(builder.seen_by(front_camera())).full(SIZE));
        assert_eq!(found, seen, "faces the mirror: {faces_mirror}");
    }
}

/// A light inside of a room with single-sided walls does not shine through them, nor one outside of it into it.
#[test]
fn both_sides_cast_shadows() {
    for faces_light in [false, true] {
        let mut builder = Builder::new();
        let wall = builder.object(matte(Vec3::ONE));
        builder.quad(wall, vec3(-2.0, -2.0, 0.0), 4.0 * Vec3::X, 4.0 * Vec3::Y);
        let screen = builder.object(single(matte(Vec3::ONE)));
        let (u, v) = (4.0 * Vec3::X, 4.0 * Vec3::Y);
        let (u, v) = if faces_light { (u, v) } else { (v, u) };
        builder.quad(screen, vec3(-2.0, -2.0, 3.0), u, v);
        builder.point_light(vec3(0.0, 0.0, 6.0), Vec3::splat(60.0));
        let found = middle(&TestScene::new(builder.seen_by(front_camera())).full(SIZE));
        assert_eq!(found, Vec3::ZERO, "faces the light: {faces_light}");
    }
}
