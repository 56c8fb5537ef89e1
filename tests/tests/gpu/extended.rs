//! Normal maps, occlusion, and textures with coordinates of their own, whose radiance is known in closed form.

use std::f32::consts::PI;

use glam::{Affine2, Vec2, Vec3, vec2, vec3};
use glimpse::{
    Method, Scene, Settings,
    scene::{Image8, Light, LightKind, Material, SlotCoordinates, Texture, TextureSlot, Wrap},
};
use glimpse_tests::{
    TestScene,
    builder::{Builder, front_camera, matte, mirror, unlit},
};

const SIZE: [u32; 2] = [48, 36];

fn texels(b: &mut Builder, width: u32, rgba: &[[u8; 4]]) -> u32 {
    let height = rgba.len() as u32 / width;
    let image = b.image(Image8 { width, height, rgba: rgba.concat() });
    b.texture(Texture { image, wrap: [Wrap::Repeat; 2], nearest: true })
}

/// A wall that fills the picture.
fn wall(b: &mut Builder, material: Material) {
    let object = b.object(material);
    b.quad(object, vec3(-2.0, -2.0, 0.0), 4.0 * Vec3::X, 4.0 * Vec3::Y);
}

fn directional(b: &mut Builder, to_light: Vec3) {
    let kind = LightKind::Directional { direction: -to_light };
    b.light(Light { kind, intensity: Vec3::splat(PI), radius: 0.0 });
}

fn everywhere(scene: Scene, expected: impl Fn(Vec2) -> Option<Vec3>, tolerance: f32) {
    let camera = *scene.camera(None).expect("a camera");
    let test_scene = TestScene::new(scene);
    for method in [Method::Full, Method::Adaptive, Method::Checkerboard] {
        let image = test_scene.frame(SIZE, &Settings { method, ..Settings::default() });
        let mut compared = 0;
        for (x, y, pixel) in image.enumerate_pixels() {
            let (origin, direction) = glimpse_tests::pixel_ray(&camera, SIZE, x, y);
            let at = (origin - origin.z / direction.z * direction).as_vec3();
            let Some(expected) = expected(vec2(at.x, at.y)) else { continue };
            let error = (Vec3::from(pixel.0) - expected).abs().max_element();
            assert!(error < tolerance, "{method:?} ({x}, {y}): {:?}, expected {expected}", pixel.0);
            compared += 1;
        }
        assert!(compared > 1000, "{compared}");
    }
}

/// A wall with one normal everywhere is as bright as a wall that is tilted: right is +x, the image's up is -y, as the
/// rows of the image run along +y here. (A steeper normal would mirror rays below the wall.)
#[test]
fn a_normal_map_tilts_the_surface() {
    for bytes in [[184, 127, 241], [127, 184, 241]] {
        let mut b = Builder::new();
        let [x, y, z] = bytes;
        let map = texels(&mut b, 1, &[[x, y, z, 255]]);
        wall(&mut b, Material { maps: [(TextureSlot::Normal, map)].into(), ..matte(Vec3::splat(0.6)) });
        let to_light = vec3(0.5, -0.3, 0.8).normalize();
        directional(&mut b, to_light);
        let [x, y, z] = bytes.map(|byte| 2.0 * f32::from(byte) / 255.0 - 1.0);
        let expected = 0.6 * vec3(x, -y, z).normalize().dot(to_light);
        everywhere(b.seen_by(front_camera()), |_| Some(Vec3::splat(expected)), 1.0e-3);
    }
}

/// Light that the surface faces but the normal of the map does not, and the other way round.
#[test]
fn light_stays_on_its_side_of_the_face() {
    for (to_light, lit) in
        [(vec3(-0.9, 0.0, 0.2), false), (vec3(0.9, 0.0, -0.2), false), (vec3(0.9, 0.0, 0.2), true)]
    {
        let mut b = Builder::new();
        let map = texels(&mut b, 1, &[[240, 127, 186, 255]]);
        wall(&mut b, Material { maps: [(TextureSlot::Normal, map)].into(), ..matte(Vec3::ONE) });
        directional(&mut b, to_light.normalize());
        let image = TestScene::new(b.seen_by(front_camera())).full(SIZE);
        assert!(image.pixels().all(|p| (p.0[0] > 0.1) == lit && (p.0[0] == 0.0) != lit), "{to_light}");
    }
}

/// However steep the map, a mirror shows what is before it and never what is behind.
#[test]
fn mirrored_rays_leave_on_the_viewers_side() {
    let mut b = Builder::new();
    let map = texels(
        &mut b,
        2,
        &[[255, 127, 140, 255], [0, 127, 140, 255], [127, 255, 130, 255], [127, 0, 100, 255]],
    );
    wall(&mut b, Material { maps: [(TextureSlot::Normal, map)].into(), ..mirror(Vec3::ONE) });
    for (z, color, u) in [(-1.0, Vec3::X, Vec3::X), (4.0, Vec3::Z, -Vec3::X)] {
        let screen = b.object(unlit(color));
        b.quad(screen, vec3(0.0, -1.0e4, z) - 1.0e4 * u, 2.0e4 * u, 2.0e4 * Vec3::Y);
    }
    b.environment(Vec3::Y, Vec3::ZERO);
    let image = TestScene::new(b.seen_by(front_camera())).full(SIZE);
    assert!(image.pixels().all(|p| p.0[0] == 0.0 && p.0[2] > 0.3), "red is behind the mirror");
}

#[test]
fn occlusion_darkens_ambient_light_alone() {
    let mut b = Builder::new();
    let hidden = texels(&mut b, 1, &[[51, 0, 0, 255]]);
    wall(
        &mut b,
        Material {
            maps: [(TextureSlot::Occlusion, hidden)].into(),
            occlusion_strength: 0.5,
            ..matte(Vec3::splat(0.5))
        },
    );
    directional(&mut b, Vec3::Z);
    b.environment(Vec3::ZERO, Vec3::splat(0.4));
    everywhere(b.seen_by(front_camera()), |_| Some(Vec3::splat(0.5 + 0.5 * 0.4 * 0.6)), 1.0e-5);
}

/// A base colour in the first set and emission in the second, whose coordinates are swapped, mapped by a transform.
#[test]
fn every_slot_has_its_own_coordinates() {
    for second in [false, true] {
        let mut b = Builder::new();
        let halves = texels(&mut b, 2, &[[255, 0, 0, 255], [0, 255, 0, 255]]);
        let glow = texels(&mut b, 2, &[[0, 0, 255, 255], [0, 0, 0, 255]]);
        // s of the emission is 0.5 s + 0.25 of its set.
        let transform = Affine2::from_scale_angle_translation(vec2(0.5, 1.0), 0.0, vec2(0.25, 0.0));
        wall(
            &mut b,
            Material {
                base_color_texture: Some(halves),
                emission: Vec3::splat(0.5),
                emissive_texture: Some(glow),
                coordinates: [(TextureSlot::Emissive, SlotCoordinates { second, transform })].into(),
                ..matte(Vec3::ONE)
            },
        );
        b.environment(Vec3::ZERO, Vec3::ONE);
        let expected = |at: Vec2| {
            let along = if second { at.y } else { at.x };
            let near = at.x.abs().min(at.y.abs()) < 0.1;
            let base = if at.x < 0.0 { Vec3::X } else { Vec3::Y };
            // The edge between the texels stays in the middle: 0.5 x 0.5 + 0.25.
            (!near).then_some(base + if along < 0.0 { 0.5 * Vec3::Z } else { Vec3::ZERO })
        };
        everywhere(b.seen_by(front_camera()), expected, 1.0e-5);
    }
}
