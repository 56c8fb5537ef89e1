//! Scenes that combine all features of materials, textures and lights.

mod glass;
mod lobes;

use glam::{Affine2, Vec2, Vec3, Vec4, vec2, vec3};
use glimpse::{
    Camera, Scene,
    scene::{
        Environment, Image8, Light, LightKind, Material, SlotCoordinates, SpecularGlossiness, Texture,
        TextureSlot, WHITE, Wrap, octahedral_encode,
    },
};

use crate::builder::{Builder, front_camera, glass, matte, mirror, unlit};

pub use glass::{glasshouse, lenses, media};

use glass::cuboid;
pub use lobes::{brushed, cloth, films, lacquer, leaves, lobes, prisms};

const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge];

/// Random texels, with random alpha.
fn noise(width: u32, height: u32, seed: u32) -> Image8 {
    let byte = |i: u32| (i.wrapping_add(seed).wrapping_mul(2_654_435_761) >> 24) as u8;
    Image8 { width, height, rgba: (0..4 * width * height).map(byte).collect() }
}

/// All wrap modes and filters, textures of every kind, vertex colours, alpha cutouts, bent normals, and every
/// kind of light.
///
/// # Panics
/// Never.
#[must_use]
pub fn textures() -> Scene {
    let mut b = Builder::new();
    let images = [noise(5, 3, 1), noise(16, 16, 2), noise(8, 8, 3)].map(|image| b.image(image));
    for (i, wrap_s) in WRAPS.into_iter().enumerate() {
        for (j, nearest) in [false, true].into_iter().enumerate() {
            let wrap = [wrap_s, WRAPS[(i + 1 + j) % 3]];
            let texture = b.texture(Texture { image: images[0], wrap, nearest });
            let tile = b.object(Material { base_color_texture: Some(texture), ..matte(Vec3::ONE) });
            let corner = vec3(-2.4 + 0.82 * i as f32, 0.1 + 0.82 * j as f32, -1.0);
            b.textured_quad(
                tile,
                [corner, 0.8 * Vec3::X, 0.8 * Vec3::Y],
                [vec2(-1.33, -0.71), vec2(2.41, 1.9)],
            );
        }
    }
    let plain =
        |image: u32, nearest: bool| Texture { image, wrap: [Wrap::Repeat, Wrap::MirroredRepeat], nearest };
    let base = b.texture(plain(images[1], false));
    let rough = b.texture(plain(images[2], false));
    let glow = b.texture(plain(images[2], true));
    let pillow = b.object(Material { roughness: 0.45, ..matte(vec3(0.7, 0.8, 0.9)) });
    b.quad(pillow, vec3(0.1, 0.1, -0.9), 0.7 * Vec3::X, 0.7 * Vec3::Y);
    let painted = b.object(Material {
        base_color_texture: Some(base),
        metallic_roughness_texture: Some(rough),
        metallic: 0.8,
        roughness: 0.9,
        ior: 1.5,
        ..matte(vec3(0.9, 0.8, 0.7))
    });
    b.textured_quad(
        painted,
        [vec3(0.9, 0.1, -1.0), vec3(0.9, 0.0, 0.4), 0.8 * Vec3::Y],
        [vec2(-0.2, 0.1), vec2(1.4, 1.2)],
    );
    let shining = b.object(Material {
        emission: vec3(0.9, 0.5, 0.2),
        emissive_texture: Some(glow),
        roughness: 0.15,
        metallic: 1.0,
        ..matte(vec3(0.4, 0.6, 0.9))
    });
    b.textured_quad(
        shining,
        [vec3(0.1, 0.95, -1.0), 0.8 * Vec3::X, 0.7 * Vec3::Y],
        [vec2(0.05, 0.03), vec2(2.2, 1.7)],
    );
    for (i, nearest) in [false, true].into_iter().enumerate() {
        let holes = b.texture(plain(images[1], nearest));
        let fence = b.object(Material {
            base_color_texture: Some(holes),
            alpha_cutoff: Some(0.45),
            alpha: 0.9,
            ..matte(Vec3::ONE)
        });
        let corner = vec3(1.0 + 0.35 * i as f32, 0.95, -0.6);
        b.textured_quad(
            fence,
            [corner, 0.3 * Vec3::X, 0.7 * Vec3::Y],
            [Vec2::ZERO, vec2(0.6 + i as f32, 1.3)],
        );
    }
    let ball = b.object(Material { base_color_texture: Some(base), roughness: 0.3, ..matte(Vec3::ONE) });
    b.sphere(ball, vec3(-0.7, 0.35, 0.1), 0.3);
    let sign = b.object(unlit(vec3(0.2, 0.9, 0.4)));
    b.quad(sign, vec3(-1.9, 0.02, 0.2), 0.5 * Vec3::X, 0.3 * Vec3::Y);
    let floor = b.object(Material { roughness: 0.3, ..matte(vec3(0.5, 0.45, 0.4)) });
    b.quad(floor, vec3(-3.0, 0.0, 2.0), 6.0 * Vec3::X, -4.0 * Vec3::Z);
    lamps(&mut b);
    b.environment(vec3(0.2, 0.3, 0.5), vec3(0.06, 0.07, 0.08));
    let camera = Camera::look_at(vec3(0.1, 1.2, 3.4), vec3(-0.2, 0.85, 0.0), 0.72).expect("a valid camera");
    let mut scene = b.seen_by(camera);
    bend_normals(&mut scene, pillow);
    paint_corners(&mut scene);
    scene
}

/// Normal maps on flat and on smooth surfaces, matte, glossy and mirroring, seen from both sides and in a mirror;
/// occlusion and transmission textures; slots with coordinates of their own.
///
/// # Panics
/// Never.
#[must_use]
pub fn extended() -> Scene {
    let mut b = Builder::new();
    let hills = b.image(bumps(16, 5.0));
    let [grain, stains] = [noise(8, 8, 4), noise(4, 4, 9)].map(|image| b.image(image));
    let mut texture =
        |image: u32, wrap_s: Wrap| b.texture(Texture { image, wrap: [wrap_s, Wrap::Repeat], nearest: false });
    let (hills, mirrored) = (texture(hills, Wrap::Repeat), texture(hills, Wrap::MirroredRepeat));
    let (grain, stains) = (texture(grain, Wrap::Repeat), texture(stains, Wrap::Repeat));
    let own = |second: bool, angle: f32| SlotCoordinates {
        second,
        transform: Affine2::from_scale_angle_translation(vec2(1.5, -0.7), angle, vec2(0.2, 0.4)),
    };
    let bumpy = |m: Material| Material { maps: [(TextureSlot::Normal, hills)].into(), ..m };
    let looks = [
        bumpy(matte(vec3(0.8, 0.7, 0.6))),
        Material { normal_scale: 0.4, roughness: 0.3, ..bumpy(matte(vec3(0.3, 0.5, 0.7))) },
        bumpy(mirror(vec3(0.9, 0.8, 0.6))),
        Material {
            base_color_texture: Some(grain),
            coordinates: [(TextureSlot::Normal, own(false, 0.5))].into(),
            ..bumpy(matte(Vec3::ONE))
        },
        Material {
            metallic: 0.5,
            roughness: 0.9,
            metallic_roughness_texture: Some(grain),
            emission: vec3(0.4, 0.3, 0.2),
            emissive_texture: Some(stains),
            maps: [(TextureSlot::Occlusion, stains), (TextureSlot::Normal, mirrored)].into(),
            coordinates: [
                (TextureSlot::Emissive, own(true, 0.3)),
                (TextureSlot::Occlusion, own(false, -0.2)),
            ]
            .into(),
            occlusion_strength: 0.8,
            ..matte(vec3(0.7, 0.8, 0.9))
        },
        Material {
            maps: [(TextureSlot::Transmission, grain)].into(),
            coordinates: [(TextureSlot::Transmission, own(true, 0.0))].into(),
            thin: true,
            ..glass(1.5)
        },
    ];
    let mut pillow = 0;
    for (i, look) in looks.into_iter().enumerate() {
        let object = b.object(look);
        pillow = if i == 1 { object } else { pillow };
        let corner = vec3(-1.3 + 0.9 * (i % 3) as f32, 0.1 + 0.9 * (i / 3) as f32, -0.2 * i as f32);
        // The second row is seen from behind in part.
        let (u, v) = (vec3(0.8, 0.0, 0.1), 0.8 * Vec3::Y);
        let [from, along, up] = if i == 3 { [corner + u, -u, v] } else { [corner, u, v] };
        b.textured_quad(object, [from, along, up], [vec2(-0.3, 0.2), vec2(1.2, 1.4)]);
    }
    let floor = b.object(Material { roughness: 0.2, ior: 1.5, ..matte(vec3(0.5, 0.45, 0.4)) });
    b.quad(floor, vec3(-3.0, 0.0, 2.0), 6.0 * Vec3::X, -5.0 * Vec3::Z);
    lamps(&mut b);
    b.environment(vec3(0.2, 0.3, 0.5), vec3(0.3, 0.25, 0.2));
    let camera = Camera::look_at(vec3(0.2, 1.1, 3.2), vec3(0.0, 0.9, 0.0), 0.7).expect("a valid camera");
    let mut scene = b.seen_by(camera);
    bend_normals(&mut scene, pillow);
    scene
}

/// Specular colours and strengths, specular-glossiness factors, clear coats and absorbing glass, with and without
/// textures.
///
/// # Panics
/// Never.
#[must_use]
pub fn layers() -> Scene {
    let mut b = Builder::new();
    let grain = b.image(noise(8, 8, 4));
    let grain = b.texture(Texture { image: grain, wrap: [Wrap::Repeat; 2], nearest: false });
    let maps = |slots: &[TextureSlot]| slots.iter().map(|slot| (*slot, grain)).collect();
    let dielectric = |color: Vec3| Material { roughness: 0.3, ior: 1.5, ..matte(color) };
    let glossy = |specular: Vec3, glossiness: f32| Some(SpecularGlossiness { specular, glossiness });
    let looks = [
        Material { specular: 0.4, specular_color: vec3(8.0, 4.0, 1.0), ..dielectric(vec3(0.3, 0.5, 0.7)) },
        Material {
            specular_color: vec3(3.0, 9.0, 40.0),
            maps: maps(&[TextureSlot::Specular, TextureSlot::SpecularColor]),
            ..dielectric(vec3(0.8, 0.3, 0.2))
        },
        Material {
            specular_glossiness: glossy(vec3(0.7, 0.5, 0.2), 0.9),
            maps: maps(&[TextureSlot::SpecularGlossiness]),
            base_color_texture: Some(grain),
            ..matte(vec3(0.6, 0.7, 0.8))
        },
        Material { specular_glossiness: glossy(Vec3::splat(0.02), 0.2), ..matte(vec3(0.2, 0.8, 0.4)) },
        Material { clearcoat: 0.8, clearcoat_roughness: 0.1, ..matte(vec3(0.7, 0.1, 0.1)) },
        Material {
            clearcoat: 1.0,
            clearcoat_roughness: 0.6,
            metallic: 1.0,
            roughness: 0.2,
            maps: maps(&[TextureSlot::Clearcoat, TextureSlot::ClearcoatRoughness]),
            ..matte(vec3(0.9, 0.7, 0.3))
        },
    ];
    for (i, look) in looks.into_iter().enumerate() {
        let object = b.object(look);
        let corner = vec3(-1.3 + 0.9 * (i % 3) as f32, 0.1 + 0.9 * (i / 3) as f32, -0.2 * i as f32);
        b.textured_quad(
            object,
            [corner, vec3(0.8, 0.0, 0.1), 0.8 * Vec3::Y],
            [vec2(-0.3, 0.2), vec2(1.2, 1.4)],
        );
    }
    let amber = b.object(Material { absorption: vec3(0.5, 1.5, 6.0), ..glass(1.5) });
    b.sphere(amber, vec3(-0.4, 0.4, 0.9), 0.35);
    let tinted =
        b.object(Material { absorption: vec3(4.0, 0.3, 0.8), specular: 0.5, clearcoat: 0.5, ..glass(1.3) });
    cuboid(&mut b, tinted, vec3(0.3, 0.05, 0.6), vec3(0.8, 0.5, 1.0));
    let floor = b.object(Material { roughness: 0.2, ior: 1.5, ..matte(vec3(0.5, 0.45, 0.4)) });
    b.quad(floor, vec3(-3.0, 0.0, 2.0), 6.0 * Vec3::X, -5.0 * Vec3::Z);
    lamps(&mut b);
    b.environment(vec3(0.2, 0.3, 0.5), vec3(0.3, 0.25, 0.2));
    b.seen_by(Camera::look_at(vec3(0.2, 1.1, 3.2), vec3(0.0, 0.9, 0.0), 0.7).expect("a valid camera"))
}

/// A normal map of rounded bumps with slopes up to `1 / flatness` or so.
fn bumps(side: u32, flatness: f32) -> Image8 {
    let texel = |i: u32| {
        let [x, y] = [i % side, i / side].map(|k| std::f32::consts::TAU * (k as f32 + 0.5) / side as f32);
        let normal = vec3(2.0 * x.cos(), (2.0 * y).sin() + x.sin(), flatness).normalize();
        let [r, g, b] = (127.5 * normal + 127.5).round().to_array();
        [r as u8, g as u8, b as u8, 255]
    };
    Image8 { width: side, height: side, rgba: (0..side * side).flat_map(texel).collect() }
}

fn lamps(b: &mut Builder) {
    let direction = vec3(-0.5, -1.2, -2.0).normalize();
    let kinds = [
        (LightKind::Directional { direction: vec3(0.4, -0.7, -0.6).normalize() }, Vec3::splat(0.9), 0.0),
        (
            LightKind::Spot { position: vec3(0.4, 2.2, 1.8), range: 6.0, direction, cone: 0.15..0.4 },
            vec3(9.0, 7.0, 5.0),
            0.02,
        ),
        (
            LightKind::Point { position: vec3(1.2, 1.6, 0.9), range: 2.5, falloff: true },
            vec3(1.0, 1.5, 2.0),
            0.01,
        ),
        (
            LightKind::Point { position: vec3(-2.0, 1.5, 1.5), range: f32::INFINITY, falloff: false },
            vec3(0.3, 0.1, 0.2),
            0.0,
        ),
    ];
    for (kind, intensity, radius) in kinds {
        b.light(Light { kind, intensity, radius });
    }
}

/// Bends the corner normals of a quad outwards.
fn bend_normals(scene: &mut Scene, object: u32) {
    let of_object = |i: &usize| scene.triangle_objects[*i] == object;
    let triangles: Vec<usize> = (0..scene.positions.len()).filter(of_object).collect();
    let corners: Vec<Vec3> = triangles.iter().flat_map(|i| scene.positions[*i]).collect();
    let center = corners.iter().sum::<Vec3>() / corners.len() as f32;
    for i in triangles {
        let bent = |p: Vec3| octahedral_encode((1.2 * (p - center) + Vec3::Z).normalize());
        scene.normals[i] = scene.positions[i].map(bent);
    }
}

/// Sets vertex colours of all triangles, most of them white.
fn paint_corners(scene: &mut Scene) {
    let word = |c: Vec4| c.to_array().map(|x| (65535.0 * x).round() as u16);
    let bright =
        [Vec4::new(1.0, 0.4, 0.3, 1.0), Vec4::new(0.2, 1.0, 0.5, 1.0), Vec4::new(0.3, 0.5, 1.0, 1.0)];
    scene.colors =
        (0..scene.positions.len()).map(|i| if i % 5 == 3 { bright.map(word) } else { [WHITE; 3] }).collect();
}

/// Layers that cover in part, by factor, texture and vertices, matte and reflecting, seen directly, in a mirror and
/// through glass, with shadows through them; single-sided surfaces, and an emitter behind a layer.
///
/// # Panics
/// Never.
#[must_use]
pub fn coverage() -> Scene {
    let mut b = Builder::new();
    let image = b.image(noise(8, 8, 5));
    let texture = b.texture(Texture { image, wrap: [Wrap::Repeat, Wrap::MirroredRepeat], nearest: false });
    let floor = b.object(Material { roughness: 0.4, ..matte(vec3(0.6, 0.55, 0.5)) });
    b.quad(floor, vec3(-3.0, 0.0, 2.0), 6.0 * Vec3::X, -5.0 * Vec3::Z);
    let back = b.object(matte(vec3(0.3, 0.5, 0.8)));
    b.quad(back, vec3(-3.0, 0.0, -2.0), 6.0 * Vec3::X, 3.0 * Vec3::Y);
    let layer = |alpha: f32, m: Material| Material { blends: true, alpha, ..m };
    let leaf = b.object(layer(0.9, Material { base_color_texture: Some(texture), ..matte(Vec3::ONE) }));
    b.textured_quad(
        leaf,
        [vec3(-1.6, 0.2, 0.3), vec3(1.0, 0.0, -0.2), vec3(0.0, 1.2, -0.1)],
        [vec2(-0.2, 0.1), vec2(0.7, 0.8)],
    );
    let tinted = b.object(layer(0.35, Material { roughness: 0.2, ..matte(vec3(0.9, 0.2, 0.1)) }));
    b.quad(tinted, vec3(-0.9, 0.1, 0.6), vec3(1.1, 0.0, 0.3), 0.9 * Vec3::Y);
    let faded = b.object(layer(1.0, matte(vec3(0.2, 0.8, 0.3))));
    b.quad(faded, vec3(-0.3, 0.3, -0.4), vec3(1.3, 0.0, 0.2), 1.1 * Vec3::Y);
    let bubble = b.object(layer(0.3, Material { roughness: 0.1, ..matte(vec3(0.4, 0.4, 0.9)) }));
    b.sphere(bubble, vec3(1.4, 0.6, 0.4), 0.45);
    let silver = b.object(mirror(vec3(0.9, 0.9, 0.85)));
    b.quad(silver, vec3(2.2, 0.1, -1.8), vec3(0.0, 0.0, 3.0), 2.0 * Vec3::Y);
    let pane = b.object(Material { thin: true, ..glass(1.5) });
    b.quad(pane, vec3(-2.2, 0.1, 1.2), 0.9 * Vec3::X, 1.3 * Vec3::Y);
    for (i, (u, v)) in
        [(0.5 * Vec3::X, 0.7 * Vec3::Y), (0.7 * Vec3::Y, 0.5 * Vec3::X)].into_iter().enumerate()
    {
        let screen = b.object(Material { double_sided: false, ..matte(vec3(0.9, 0.8, 0.2)) });
        b.quad(screen, vec3(-2.6 + 0.7 * i as f32, 0.9, -1.2), u, v);
    }
    let glow = b.object(Material { emission: vec3(3.0, 2.5, 2.0), ..matte(Vec3::ZERO) });
    b.quad(glow, vec3(-0.6, 1.9, -1.2), 0.8 * Vec3::X, 0.4 * Vec3::Z);
    let gauze = b.object(layer(0.5, matte(vec3(0.8, 0.8, 0.8))));
    b.quad(gauze, vec3(-1.0, 1.7, -1.5), 1.6 * Vec3::X, 1.0 * Vec3::Z);
    b.point_light(vec3(0.2, 2.6, 1.4), vec3(7.0, 6.5, 6.0));
    b.point_light(vec3(-1.5, 2.4, -0.4), vec3(2.0, 2.5, 3.0));
    b.environment(vec3(0.2, 0.3, 0.4), vec3(0.06, 0.06, 0.07));
    let camera = Camera::look_at(vec3(0.1, 1.1, 3.8), vec3(-0.1, 0.8, 0.0), 0.8).expect("a valid camera");
    let mut scene = b.seen_by(camera);
    let fading = |p: Vec3| [u16::MAX, 40_000, 50_000, (65_535.0 * (p.y - 0.3).clamp(0.0, 1.0)) as u16];
    let corners = scene.positions.iter().zip(&scene.triangle_objects);
    scene.colors = corners
        .map(|(corners, object)| if *object == faded { corners.map(fading) } else { [WHITE; 3] })
        .collect();
    scene
}

/// Matte objects under an orthographic camera.
///
/// # Panics
/// Never.
#[must_use]
pub fn orthographic() -> Scene {
    let mut b = Builder::new();
    for i in 0..4 {
        let ball = b.object(matte(vec3(0.9, 0.2 + 0.2 * i as f32, 0.3)));
        b.sphere(ball, vec3(-1.2 + 0.8 * i as f32, 0.3 + 0.1 * i as f32, -0.5), 0.35);
    }
    let block = b.object(Material { roughness: 0.6, ior: 1.5, ..matte(vec3(0.4, 0.6, 0.8)) });
    cuboid(&mut b, block, vec3(-0.4, -0.6, -0.2), vec3(0.5, 0.1, 0.6));
    let floor = b.object(matte(Vec3::splat(0.7)));
    b.quad(floor, vec3(-2.0, -0.6, 2.0), 4.0 * Vec3::X, -4.0 * Vec3::Z);
    b.point_light(vec3(1.0, 2.0, 1.5), Vec3::splat(8.0));
    b.environment(vec3(0.1, 0.2, 0.4), Vec3::splat(0.05));
    // Half the height of the orthographic picture is the tangent of half the field of view.
    let camera = Camera::look_at(vec3(1.5, 1.2, 2.5), Vec3::ZERO, 2.0 * 1.1_f32.atan());
    b.seen_by(Camera { orthographic: true, ..camera.expect("a valid camera") })
}

/// An unlit wall with the 256 sRGB greys as texels, at z = 0 and from x = 0 to 256.
///
/// # Panics
/// Never.
#[must_use]
pub fn greys() -> Scene {
    let mut b = Builder::new();
    let rgba = (0..=255).flat_map(|byte| [byte, byte, byte, 255]).collect();
    let image = b.image(Image8 { width: 256, height: 1, rgba });
    let texture = b.texture(Texture { image, wrap: [Wrap::ClampToEdge; 2], nearest: true });
    let wall = b.object(Material { base_color_texture: Some(texture), ..unlit(Vec3::ONE) });
    b.textured_quad(wall, [Vec3::ZERO, 256.0 * Vec3::X, Vec3::Y], [Vec2::ZERO, Vec2::ONE]);
    let dark = Environment { background: Vec3::ZERO, ambient: Vec3::ZERO, fallback_radiance: Vec3::ZERO };
    let camera = Camera::look_at(vec3(128.0, 0.5, 300.0), vec3(128.0, 0.5, 0.0), 0.8).expect("a camera");
    Scene { environment: dark, ..b.seen_by(camera) }
}

/// Slanted walls, an object in front of them and a mirror, so close that two eyes see different sides.
#[must_use]
pub fn stereo() -> Scene {
    let mut b = Builder::new();
    b.environment(Vec3::splat(0.1), Vec3::ZERO);
    let floor = b.object(matte(vec3(0.8, 0.6, 0.4)));
    b.quad(floor, vec3(-3.0, -0.6, 1.5), 6.0 * Vec3::X, vec3(0.0, 0.4, -5.0));
    let wall = b.object(matte(vec3(0.5, 0.7, 0.5)));
    b.quad(wall, vec3(-1.0, -1.0, 1.0), vec3(0.5, 0.0, -3.0), 3.0 * Vec3::Y);
    let box_ = b.object(matte(vec3(0.3, 0.3, 0.8)));
    b.quad(box_, vec3(-0.15, -0.4, 0.6), vec3(0.25, 0.0, 0.1), 0.5 * Vec3::Y);
    let glass = b.object(mirror(vec3(0.9, 0.8, 0.7)));
    b.quad(glass, vec3(0.2, -0.5, -1.0), vec3(0.7, 0.0, 0.9), 1.2 * Vec3::Y);
    let lamp = b.object(Material { emission: Vec3::splat(6.0), ..matte(Vec3::ZERO) });
    b.quad(lamp, vec3(-0.5, 1.2, 0.0), Vec3::X, -Vec3::Z);
    b.seen_by(front_camera())
}
