//! Scenes of materials with every lobe.

use glam::{Vec2, Vec3, vec2, vec3};
use glimpse::{
    Camera, Scene,
    scene::{EnvironmentMap, Image8, Material, Texture, TextureSlot, Wrap},
};

use crate::builder::{Builder, glass, matte, mirror};

/// Materials of the balls of [`lobes`], by row.
fn balls() -> Vec<Vec<Material>> {
    let metal = |roughness| Material { roughness, ..mirror(vec3(0.9, 0.6, 0.3)) };
    let plastic = |roughness| Material { roughness, ior: 1.5, ..matte(vec3(0.2, 0.4, 0.8)) };
    let frosted = |roughness| Material { roughness, ..glass(1.4) };
    let lacquer = |clearcoat_roughness| Material { clearcoat: 0.9, clearcoat_roughness, ..metal(0.5) };
    let velvet =
        |sheen_roughness| Material { sheen_color: vec3(0.9, 0.4, 0.6), sheen_roughness, ..plastic(0.7) };
    vec![
        vec![metal(0.08), metal(0.3), metal(0.6), metal(1.0), Material { metallic: 0.5, ..metal(0.4) }],
        vec![plastic(0.1), plastic(0.5), frosted(0.3), lacquer(0.0), lacquer(0.3)],
        vec![velvet(0.3), velvet(0.8), Material { clearcoat: 0.7, ..velvet(0.5) }],
    ]
}

/// Balls of metal, plastic, glass, lacquer and velvet at several roughnesses, with a frosted pane, a lamp and punctual lights, in
/// a studio.
///
/// # Panics
/// Never.
#[must_use]
pub fn lobes() -> Scene {
    let mut b = Builder::new();
    for (row, materials) in balls().into_iter().enumerate() {
        for (column, material) in materials.into_iter().enumerate() {
            let ball = b.object(material);
            b.sphere(ball, vec3(-1.2 + 0.6 * column as f32, 0.3 + 0.6 * row as f32, 0.0), 0.27);
        }
    }
    let pane = b.object(Material { thin: true, roughness: 0.4, ..glass(1.5) });
    b.quad(pane, vec3(-0.9, 0.05, 0.5), vec3(0.7, 0.0, 0.1), 0.8 * Vec3::Y);
    let floor = b.object(Material { roughness: 0.6, ior: 1.5, ..matte(Vec3::splat(0.5)) });
    b.quad(floor, vec3(-2.0, 0.0, 2.0), 4.0 * Vec3::X, -4.0 * Vec3::Z);
    let lamp = b.object(Material { emission: vec3(9.0, 7.0, 5.0), ..matte(Vec3::ZERO) });
    b.quad(lamp, vec3(-0.4, 2.6, 0.6), 0.8 * Vec3::X, 0.6 * Vec3::Z);
    b.point_light(vec3(1.5, 2.0, 2.0), vec3(3.0, 4.0, 5.0));
    let camera = Camera::look_at(vec3(0.4, 1.1, 4.0), vec3(0.0, 0.7, 0.0), 0.7).expect("a valid camera");
    let mut scene = b.seen_by(camera);
    scene.surround(EnvironmentMap::studio().rotated(0.4));
    scene
}

/// Brushed metal and plastic at several directions and strengths, of factors, of a texture and with a normal map, seen from
/// both sides and in a mirror; anisotropic glass under a coat.
///
/// # Panics
/// Never.
#[must_use]
pub fn brushed() -> Scene {
    let mut b = Builder::new();
    let byte = |i: u32| (i.wrapping_mul(2_654_435_761) >> 24) as u8;
    let image = b.image(Image8 { width: 8, height: 8, rgba: (0..256).map(byte).collect() });
    let grain = b.texture(Texture { image, wrap: [Wrap::Repeat; 2], nearest: false });
    let steel = |roughness: f32, anisotropy: f32, anisotropy_rotation: f32| Material {
        roughness,
        anisotropy,
        anisotropy_rotation,
        ..mirror(vec3(0.8, 0.7, 0.6))
    };
    let looks = [
        steel(0.3, 0.6, 0.0),
        steel(0.1, 0.3, 1.2),
        Material { maps: [(TextureSlot::Anisotropy, grain)].into(), ..steel(0.4, 1.0, 0.4) },
        Material { metallic: 0.0, ior: 1.5, base_color: vec3(0.2, 0.4, 0.7), ..steel(0.5, 0.8, -0.7) },
        Material {
            maps: [(TextureSlot::Normal, grain)].into(),
            normal_scale: 0.2,
            metallic: 0.6,
            ..steel(0.6, 0.5, 2.0)
        },
        steel(0.25, 0.9, 0.9),
    ];
    for (i, look) in looks.into_iter().enumerate() {
        let object = b.object(look);
        let corner = vec3(-1.3 + 0.9 * (i % 3) as f32, 0.1 + 0.75 * (i / 3) as f32, -0.2 * i as f32);
        let (u, v) = (vec3(0.8, 0.0, 0.3 - 0.15 * i as f32), 0.7 * Vec3::Y);
        let [from, along] = if i == 5 { [corner + u, -u] } else { [corner, u] };
        b.textured_quad(object, [from, along, v], [Vec2::ZERO, vec2(1.1, 0.9)]);
    }
    let ball = b.object(steel(0.2, 0.7, 0.5));
    b.sphere(ball, vec3(-0.5, 0.35, 0.7), 0.3);
    let vase = b.object(Material {
        roughness: 0.3,
        anisotropy: 0.6,
        clearcoat: 0.5,
        clearcoat_roughness: 0.1,
        ..glass(1.4)
    });
    b.sphere(vase, vec3(0.5, 0.3, 0.8), 0.25);
    let floor = b.object(mirror(Vec3::splat(0.6)));
    b.quad(floor, vec3(-3.0, 0.0, 2.0), 6.0 * Vec3::X, -5.0 * Vec3::Z);
    b.point_light(vec3(0.8, 2.0, 1.6), vec3(5.0, 4.5, 4.0));
    b.point_light(vec3(-1.9, 0.9, 1.4), vec3(1.5, 1.8, 2.0));
    b.environment(vec3(0.2, 0.3, 0.5), vec3(0.2, 0.25, 0.3));
    b.seen_by(Camera::look_at(vec3(0.2, 1.1, 3.2), vec3(0.0, 0.7, 0.0), 0.7).expect("a valid camera"))
}

/// Thin films over metal and dielectrics, mirroring and rough, with textures, over a pane and a ball of glass.
///
/// # Panics
/// Never.
#[must_use]
pub fn films() -> Scene {
    let mut b = Builder::new();
    let byte = |i: u32| (i.wrapping_mul(2_654_435_761) >> 24) as u8;
    let image = b.image(Image8 { width: 8, height: 8, rgba: (0..256).map(byte).collect() });
    let stains = b.texture(Texture { image, wrap: [Wrap::Repeat; 2], nearest: false });
    let film = |material: Material, iridescence_ior: f32, thickness: f32| Material {
        iridescence: 1.0,
        iridescence_ior,
        iridescence_thickness: [100.0, thickness],
        ..material
    };
    let plastic = |roughness: f32| Material { roughness, ior: 1.5, ..matte(vec3(0.1, 0.15, 0.3)) };
    let metal = |roughness: f32| Material { roughness, ..mirror(vec3(0.9, 0.6, 0.3)) };
    let looks = [
        film(metal(0.1), 1.3, 400.0),
        film(metal(0.6), 1.8, 550.0),
        film(plastic(0.2), 1.7, 320.0),
        Material {
            maps: [(TextureSlot::Iridescence, stains), (TextureSlot::IridescenceThickness, stains)].into(),
            ..film(plastic(0.5), 2.0, 900.0)
        },
        Material { metallic: 0.5, iridescence: 0.6, clearcoat: 0.3, ..film(metal(0.3), 1.4, 480.0) },
        Material { thin: true, ..film(glass(1.5), 1.9, 420.0) },
    ];
    for (i, look) in looks.into_iter().enumerate() {
        let object = b.object(look);
        let corner = vec3(-1.3 + 0.9 * (i % 3) as f32, 0.1 + 0.75 * (i / 3) as f32, -0.2 * i as f32);
        let (u, v) = (vec3(0.8, 0.0, 0.3 - 0.15 * i as f32), 0.7 * Vec3::Y);
        b.textured_quad(object, [corner, u, v], [Vec2::ZERO, vec2(1.1, 0.9)]);
    }
    for (x, look) in [(-0.6, film(metal(0.35), 1.5, 380.0)), (0.6, film(glass(1.4), 1.8, 500.0))] {
        let ball = b.object(look);
        b.sphere(ball, vec3(x, 0.32, 0.8), 0.3);
    }
    let floor = b.object(Material { roughness: 0.2, ior: 1.5, ..matte(vec3(0.5, 0.45, 0.4)) });
    b.quad(floor, vec3(-3.0, 0.0, 2.0), 6.0 * Vec3::X, -5.0 * Vec3::Z);
    b.point_light(vec3(0.8, 2.0, 1.6), vec3(5.0, 4.5, 4.0));
    b.environment(vec3(0.4, 0.5, 0.6), vec3(0.2, 0.25, 0.3));
    b.seen_by(Camera::look_at(vec3(0.2, 1.1, 3.2), vec3(0.0, 0.7, 0.0), 0.7).expect("a valid camera"))
}

/// Leaves and lamp shades that transmit light diffusely, by factors and by textures, glossy, with a normal map, a coat and
/// partial coverage, lit from both sides.
///
/// # Panics
/// Never.
#[must_use]
pub fn leaves() -> Scene {
    let mut b = Builder::new();
    let byte = |i: u32| (i.wrapping_mul(2_654_435_761) >> 24) as u8;
    let image = b.image(Image8 { width: 8, height: 8, rgba: (0..256).map(byte).collect() });
    let veins = b.texture(Texture { image, wrap: [Wrap::Repeat; 2], nearest: false });
    let leaf = |diffuse_transmission: f32, diffuse_transmission_color: Vec3| Material {
        diffuse_transmission,
        diffuse_transmission_color,
        ..matte(vec3(0.2, 0.5, 0.1))
    };
    let looks = [
        leaf(0.5, vec3(0.8, 0.9, 0.2)),
        Material { roughness: 0.3, ior: 1.5, ..leaf(1.0, vec3(0.9, 0.4, 0.2)) },
        Material {
            maps: [(TextureSlot::DiffuseTransmission, veins), (TextureSlot::DiffuseTransmissionColor, veins)]
                .into(),
            ..leaf(0.9, Vec3::ONE)
        },
        Material {
            maps: [(TextureSlot::Normal, veins)].into(),
            normal_scale: 0.1,
            clearcoat: 0.5,
            ..leaf(0.7, vec3(0.3, 0.8, 0.6))
        },
        Material { blends: true, alpha: 0.6, ..leaf(0.6, vec3(0.9, 0.7, 0.3)) },
        Material { metallic: 0.5, roughness: 0.6, double_sided: false, ..leaf(0.8, vec3(0.9, 0.8, 0.7)) },
    ];
    for (i, look) in looks.into_iter().enumerate() {
        let object = b.object(look);
        let corner = vec3(-1.3 + 0.9 * (i % 3) as f32, 0.1 + 0.75 * (i / 3) as f32, -0.2 * i as f32);
        let (u, v) = (vec3(0.8, 0.0, 0.5 - 0.2 * i as f32), 0.7 * Vec3::Y);
        let [from, along] = if i == 5 { [corner + u, -u] } else { [corner, u] };
        b.textured_quad(object, [from, along, v], [Vec2::ZERO, vec2(1.1, 0.9)]);
    }
    let shade = b.object(leaf(0.8, vec3(1.0, 0.9, 0.7)));
    b.sphere(shade, vec3(-0.5, 0.35, 0.9), 0.25);
    let lamp = b.object(Material { emission: vec3(3.0, 2.5, 2.0), ..matte(Vec3::ZERO) });
    b.quad(lamp, vec3(0.3, 0.05, -1.8), 0.8 * Vec3::X, 0.8 * Vec3::Y);
    let floor = b.object(Material { roughness: 0.2, ior: 1.5, ..matte(vec3(0.5, 0.45, 0.4)) });
    b.quad(floor, vec3(-3.0, 0.0, 2.0), 6.0 * Vec3::X, -5.0 * Vec3::Z);
    b.point_light(vec3(0.3, 1.8, -2.2), vec3(5.0, 4.5, 4.0));
    b.point_light(vec3(-1.2, 1.6, 1.9), vec3(1.5, 2.0, 2.5));
    b.environment(vec3(0.4, 0.5, 0.6), vec3(0.2, 0.25, 0.3));
    b.seen_by(Camera::look_at(vec3(0.2, 1.1, 3.2), vec3(0.0, 0.7, 0.0), 0.7).expect("a valid camera"))
}

/// Lacquer: smooth and rough coats with flat and with bumpy normals, over flat and over bumpy surfaces, one of them seen
/// through partial coverage.
///
/// # Panics
/// Never.
#[must_use]
pub fn lacquer() -> Scene {
    let mut b = Builder::new();
    // Normals of shallow waves, as bytes.
    let texel = |i: u32| {
        let wave = |k: u32| (127.5 + 30.0 * (std::f32::consts::TAU * (k as f32 + 0.5) / 8.0).sin()) as u8;
        [wave(i % 8), wave(i / 8), 250, 255]
    };
    let image = b.image(Image8 { width: 8, height: 8, rgba: (0..64).flat_map(texel).collect() });
    let waves = b.texture(Texture { image, wrap: [Wrap::Repeat; 2], nearest: false });
    let paint = |clearcoat_roughness: f32, slots: &[TextureSlot]| Material {
        clearcoat: 0.9,
        clearcoat_roughness,
        roughness: 0.65,
        ior: 1.5,
        maps: slots.iter().map(|slot| (*slot, waves)).collect(),
        ..matte(vec3(0.5, 0.1, 0.1))
    };
    let (base, coat) = (TextureSlot::Normal, TextureSlot::ClearcoatNormal);
    let looks = [
        paint(0.0, &[base]),
        Material { clearcoat_normal_scale: 0.5, ..paint(0.3, &[coat]) },
        Material { normal_scale: 0.4, ..paint(0.1, &[base, coat]) },
        Material { metallic: 1.0, roughness: 0.02, clearcoat: 0.6, ..paint(0.0, &[coat]) },
        Material { metallic: 1.0, roughness: 0.25, normal_scale: 0.3, ..paint(0.2, &[base]) },
        Material { blends: true, alpha: 0.7, ..paint(0.3, &[coat]) },
    ];
    for (i, look) in looks.into_iter().enumerate() {
        let object = b.object(look);
        let corner = vec3(-1.3 + 0.9 * (i % 3) as f32, 0.1 + 0.75 * (i / 3) as f32, -0.2 * i as f32);
        let (u, v) = (vec3(0.8, 0.0, 0.3 - 0.15 * i as f32), 0.7 * Vec3::Y);
        b.textured_quad(object, [corner, u, v], [Vec2::ZERO, vec2(1.1, 0.9)]);
    }
    let ball = b.object(Material { maps: [].into(), ..paint(0.0, &[]) });
    b.sphere(ball, vec3(-0.3, 0.35, 0.8), 0.3);
    let floor = b.object(Material { roughness: 0.2, ior: 1.5, ..matte(vec3(0.5, 0.45, 0.4)) });
    b.quad(floor, vec3(-3.0, 0.0, 2.0), 6.0 * Vec3::X, -5.0 * Vec3::Z);
    b.point_light(vec3(0.8, 2.0, 1.6), vec3(5.0, 4.5, 4.0));
    b.point_light(vec3(-1.9, 0.9, 1.4), vec3(1.5, 1.8, 2.0));
    b.environment(vec3(0.4, 0.5, 0.6), vec3(0.2, 0.25, 0.3));
    b.seen_by(Camera::look_at(vec3(0.2, 1.1, 3.2), vec3(0.0, 0.7, 0.0), 0.7).expect("a valid camera"))
}

/// Prisms and balls of dispersive glass, clear and frosted, before bright stripes.
///
/// # Panics
/// Never.
#[must_use]
pub fn prisms() -> Scene {
    let mut b = Builder::new();
    let flint = |dispersion: f32, ior: f32| Material { dispersion, ..glass(ior) };
    for (i, look) in [
        flint(4.0, 1.6),
        flint(1.0, 2.4),
        Material { roughness: 0.3, ..flint(3.0, 1.5) },
        Material { clearcoat: 0.5, absorption: vec3(0.2, 0.6, 0.1), ..flint(8.0, 1.5) },
    ]
    .into_iter()
    .enumerate()
    {
        let ball = b.object(look);
        b.sphere(ball, vec3(-1.2 + 0.8 * i as f32, 0.4, 0.3 * (i % 2) as f32), 0.36);
    }
    for i in 0..6 {
        let stripe = b.object(Material { emission: Vec3::splat(1.0 + 0.5 * i as f32), ..matte(Vec3::ZERO) });
        b.quad(stripe, vec3(-1.7 + 0.6 * i as f32, 0.1, -1.0), 0.2 * Vec3::X, 1.2 * Vec3::Y);
    }
    let floor = b.object(matte(vec3(0.5, 0.45, 0.4)));
    b.quad(floor, vec3(-3.0, 0.0, 2.0), 6.0 * Vec3::X, -5.0 * Vec3::Z);
    b.point_light(vec3(0.8, 2.0, 1.6), vec3(5.0, 4.5, 4.0));
    b.environment(vec3(0.2, 0.3, 0.4), vec3(0.2, 0.25, 0.3));
    b.seen_by(Camera::look_at(vec3(0.2, 1.0, 3.2), vec3(0.0, 0.5, 0.0), 0.7).expect("a valid camera"))
}

/// Cloth with a sheen over metal and over dielectrics, under a coat, from a texture, and with a normal of its own.
///
/// # Panics
/// Never.
#[must_use]
pub fn cloth() -> Scene {
    let mut b = Builder::new();
    let byte = |i: u32| (i.wrapping_mul(2_654_435_761) >> 24) as u8;
    let image = b.image(Image8 { width: 8, height: 8, rgba: (0..256).map(byte).collect() });
    let grain = b.texture(Texture { image, wrap: [Wrap::Repeat; 2], nearest: false });
    let cloth = |sheen_color: Vec3, sheen_roughness: f32| Material {
        sheen_color,
        sheen_roughness,
        ..matte(vec3(0.5, 0.3, 0.4))
    };
    let looks = [
        cloth(vec3(0.2, 0.4, 0.9), 0.15),
        Material { clearcoat: 0.6, clearcoat_roughness: 0.2, ..cloth(vec3(0.8, 0.7, 0.6), 0.5) },
        Material { metallic: 1.0, roughness: 0.6, ..cloth(vec3(0.3, 0.6, 0.3), 0.8) },
        Material {
            maps: [(TextureSlot::SheenColor, grain), (TextureSlot::SheenRoughness, grain)].into(),
            roughness: 0.3,
            ior: 1.5,
            ..cloth(Vec3::ONE, 1.0)
        },
    ];
    for (i, look) in looks.into_iter().enumerate() {
        let object = b.object(look);
        let corner = vec3(-1.3 + 0.9 * (i % 2) as f32, 0.1 + 0.7 * (i / 2) as f32, -0.2);
        let far = vec3(0.8, 0.0, 0.7 - 0.6 * i as f32);
        b.textured_quad(object, [corner, far, 0.65 * Vec3::Y], [Vec2::ZERO, vec2(1.1, 0.9)]);
    }
    let ball = b.object(cloth(vec3(0.9, 0.8, 0.9), 0.4));
    b.sphere(ball, vec3(0.9, 0.5, 0.2), 0.45);
    let floor = b.object(cloth(vec3(0.1, 0.2, 0.1), 0.3));
    b.quad(floor, vec3(-3.0, 0.0, 2.0), 6.0 * Vec3::X, -4.0 * Vec3::Z);
    b.point_light(vec3(0.8, 2.0, 1.6), vec3(5.0, 4.5, 4.0));
    b.point_light(vec3(-1.9, 0.9, 0.4), vec3(0.5, 0.8, 1.0));
    b.environment(vec3(0.2, 0.3, 0.5), vec3(0.2, 0.25, 0.3));
    b.seen_by(Camera::look_at(vec3(0.2, 1.0, 3.2), vec3(0.0, 0.6, 0.0), 0.7).expect("a valid camera"))
}
