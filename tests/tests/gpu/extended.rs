//! Normal maps, occlusion, and textures with coordinates of their own, whose radiance is known in closed form.

use std::f32::consts::PI;

use glam::{Affine2, Vec2, Vec3, vec2, vec3};
use glimpse::{
    Method, Scene, Settings,
    scene::{
        Image8, Light, LightKind, LobeAlbedos, Material, SlotCoordinates, SpecularGlossiness, Texture,
        TextureSlot, Wrap,
    },
};
use glimpse_tests::{
    TestScene,
    builder::{Builder, front_camera, glass, matte, mirror, unlit},
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

/// The background through a slab of index 1, along the normal: exp(-absorption x thickness).
#[test]
fn absorption_follows_beer_and_lambert() {
    let mut b = Builder::new();
    let absorption = vec3(0.5, 1.0, 4.0);
    let slab = b.object(Material { absorption, ..glass(1.0) });
    b.quad(slab, vec3(-2.0, -2.0, 0.0), 4.0 * Vec3::X, 4.0 * Vec3::Y);
    b.quad(slab, vec3(-2.0, -2.0, -0.3), 4.0 * Vec3::Y, 4.0 * Vec3::X);
    b.environment(Vec3::ONE, Vec3::ZERO);
    let camera = front_camera();
    let image = TestScene::new(b.seen_by(camera)).full(SIZE);
    for (x, y, pixel) in image.enumerate_pixels() {
        let (_, direction) = glimpse_tests::pixel_ray(&camera, SIZE, x, y);
        let expected = (-absorption * (0.3 / -direction.z) as f32).exp();
        assert!((Vec3::from(pixel.0) - expected).abs().max_element() < 1.0e-4, "({x}, {y}): {:?}", pixel.0);
    }
}

/// A black surface under a clear coat mirrors as glass does, and one without dielectric reflection not at all.
#[test]
fn coats_and_specular_colours_follow_fresnel() {
    let black = || Material { roughness: 0.0, ior: 1.5, ..matte(Vec3::ZERO) };
    let clearcoat = Material { clearcoat: 0.5, specular: 0.0, ..black() };
    let doubled = Material { specular_color: Vec3::splat(2.0), ..black() };
    let none = Material { specular: 0.0, ..black() };
    for (what, material, at_normal) in
        [("coat", clearcoat, 0.02), ("doubled", doubled, 0.08), ("none", none, 0.0)]
    {
        let mut b = Builder::new();
        wall(&mut b, material);
        b.environment(Vec3::ONE, Vec3::ZERO);
        let image = TestScene::new(b.seen_by(front_camera())).full([33, 33]);
        let found = image.get_pixel(16, 16).0[0];
        assert!((found - at_normal).abs() < 1.0e-4, "{what}: {found}, expected {at_normal}");
    }
}

/// Under ambient light, white cloth with a white sheen reflects all of it, and black cloth the sheen's albedo, which grows
/// towards grazing angles.
#[test]
fn sheen_takes_from_the_cloth_what_it_reflects() {
    let picture = |base: Vec3| {
        let mut b = Builder::new();
        wall(&mut b, Material { sheen_color: vec3(1.0, 1.0, 0.5), sheen_roughness: 0.5, ..matte(base) });
        b.environment(Vec3::ZERO, Vec3::ONE);
        TestScene::new(b.seen_by(front_camera())).full(SIZE)
    };
    let albedos = LobeAlbedos::new();
    let camera = front_camera();
    let (white, black) = (picture(Vec3::ONE), picture(Vec3::ZERO));
    for (x, y, pixel) in black.enumerate_pixels() {
        let (_, direction) = glimpse_tests::pixel_ray(&camera, SIZE, x, y);
        let [albedo, _] = albedos.sheen(-direction.z, 0.5);
        let expected = albedo as f32 * vec3(1.0, 1.0, 0.5);
        let sum = expected + (1.0 - albedo as f32);
        assert!((Vec3::from(pixel.0) - expected).abs().max_element() < 1.0e-4, "({x}, {y}): {:?}", pixel.0);
        let whole = Vec3::from(white.get_pixel(x, y).0);
        assert!((whole - sum).abs().max_element() < 1.0e-4, "({x}, {y}): {whole}, not {sum}");
    }
}

/// Light on the back of a wall is seen through it in the colour of its diffuse transmission, what is left of light on its
/// front in the base colour; a shadow on the back darkens the one alone.
#[test]
fn diffuse_transmission_shows_light_from_behind() {
    let (base, color, share) = (vec3(0.8, 0.4, 0.2), vec3(0.2, 0.9, 0.5), 0.75);
    let leaf = || Material { diffuse_transmission: share, diffuse_transmission_color: color, ..matte(base) };
    let slanted = vec3(0.0, 0.6, 0.8);
    for (lights, expected) in [
        (&[Vec3::Z][..], 0.25 * base),
        (&[-Vec3::Z], 0.75 * color),
        (&[slanted, -slanted], 0.8 * (0.25 * base + 0.75 * color)),
    ] {
        let mut b = Builder::new();
        wall(&mut b, leaf());
        lights.iter().for_each(|to_light| directional(&mut b, *to_light));
        everywhere(b.seen_by(front_camera()), |_| Some(expected), 1.0e-5);
    }
    let mut b = Builder::new();
    wall(&mut b, leaf());
    let screen = b.object(matte(Vec3::ONE));
    b.quad(screen, vec3(0.0, -2.0, -0.5), 2.0 * Vec3::X, 4.0 * Vec3::Y);
    directional(&mut b, Vec3::Z);
    directional(&mut b, -Vec3::Z);
    b.environment(Vec3::ZERO, Vec3::splat(0.2));
    let ambient = 0.2 * (0.25 * base + 0.75 * color);
    let expected = |at: Vec2| {
        let lit = if at.x < 0.0 { 0.75 * color } else { Vec3::ZERO };
        (at.x.abs() > 0.1).then_some(0.25 * base + lit + ambient)
    };
    everywhere(b.seen_by(front_camera()), expected, 1.0e-5);
}

/// Over black paint only the coat is seen: bumps of the paint do not change it, those of its own normal map do, as bumps of
/// the surface change a surface.
#[test]
fn a_coat_has_normals_of_its_own() {
    let picture = |slots: &[TextureSlot]| {
        let mut b = Builder::new();
        let tilted = texels(&mut b, 1, &[[184, 127, 241, 255]]);
        let maps = slots.iter().map(|slot| (*slot, tilted)).collect();
        wall(&mut b, Material { clearcoat: 1.0, clearcoat_roughness: 0.4, maps, ..matte(Vec3::ZERO) });
        directional(&mut b, vec3(0.5, 0.1, 0.8).normalize());
        TestScene::new(b.seen_by(front_camera())).full([33, 33])
    };
    let (flat, bumpy) = (picture(&[]), picture(&[TextureSlot::Normal]));
    for (one, other) in flat.pixels().zip(bumpy.pixels()) {
        assert!((Vec3::from(one.0) - Vec3::from(other.0)).abs().max_element() < 1.0e-6, "{one:?}, {other:?}");
    }
    // In the middle; the image's up is -y.
    let tilted = picture(&[TextureSlot::ClearcoatNormal]);
    let [plain, own] = [&flat, &tilted].map(|image| image.get_pixel(16, 16).0[0]);
    let half = (vec3(0.5, 0.1, 0.8).normalize() + Vec3::Z).normalize();
    let normal = (2.0 * vec3(184.0, 128.0, 241.0) / 255.0 - 1.0).normalize();
    let lobe = |normal: Vec3| {
        let light = vec3(0.5, 0.1, 0.8).normalize();
        let exponent = 2.0 / 0.4_f32.powi(4) - 2.0;
        let fresnel = 0.04 + 0.96 * (1.0 - half.z).powi(5);
        let distribution = (exponent + 2.0) / (2.0 * PI) * normal.dot(half).powf(exponent);
        PI * normal.dot(light) * fresnel * 0.6 * distribution / (4.0 * normal.dot(light).max(normal.z))
    };
    for (found, expected) in [(plain, lobe(Vec3::Z)), (own, lobe(normal))] {
        assert!((found / expected - 1.0).abs() < 1.0e-2, "{found}, expected {expected}");
    }
}

/// Specular-glossiness factors of a plain dielectric and of a metal are those of their metallic-roughness twins.
#[test]
fn specular_glossiness_is_metallic_roughness_in_other_words() {
    let glossy = |specular: Vec3| Some(SpecularGlossiness { specular, glossiness: 0.7 });
    let twins = [
        (
            Material { specular_glossiness: glossy(Vec3::splat(0.04)), ..matte(0.96 * vec3(0.2, 0.5, 0.3)) },
            Material { roughness: 0.3, ..matte(0.96 * vec3(0.2, 0.5, 0.3)) },
        ),
        (
            Material { specular_glossiness: glossy(vec3(0.9, 0.7, 0.3)), ..matte(Vec3::ZERO) },
            Material { roughness: 0.3, metallic: 1.0, ..matte(vec3(0.9, 0.7, 0.3)) },
        ),
    ];
    for (i, (one, other)) in twins.into_iter().enumerate() {
        let picture = |material: Material| {
            let mut b = Builder::new();
            wall(&mut b, Material { ior: 1.5, ..material });
            directional(&mut b, vec3(0.3, 0.3, 0.9).normalize());
            b.environment(vec3(0.4, 0.5, 0.6), Vec3::splat(0.2));
            TestScene::new(b.seen_by(front_camera())).full([17, 17])
        };
        let worst = picture(one).pixels().zip(picture(other).pixels()).fold(0.0_f32, |worst, (p, q)| {
            worst.max((Vec3::from(p.0) - Vec3::from(q.0)).abs().max_element())
        });
        assert!(worst < 1.0e-3, "{i}: {worst}");
    }
}
