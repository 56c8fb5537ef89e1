//! Microfacet lobes along paths: their energy, their shape, and the ways to find light by them.

use std::f64::consts::PI;

use glam::{DVec3, Vec3, vec3};
use glimpse::{
    Camera, DirectLight, Scene, Settings,
    scene::{EnvironmentMap, Light, LightKind, LobeAlbedos, Material},
};
use glimpse_tests::builder::{Builder, glass, matte};

use super::{Mean, WAYS, for_each, mean, settings};

fn metal(color: Vec3, roughness: f32) -> Material {
    Material { metallic: 1.0, roughness, ..matte(color) }
}

/// Looks at the origin with this cosine to +Z, through so narrow a view that the angle is one.
fn slanted(cosine: f64) -> Camera {
    let sine = (1.0 - cosine * cosine).sqrt();
    let from = 3.0 * vec3(sine as f32, 0.0, cosine as f32);
    Camera::look_at(from, Vec3::ZERO, 1.0e-4).expect("a valid camera")
}

/// A wall of a material around the origin, before a background of radiance 1.
fn wall(material: Material, cosine: f64) -> Scene {
    let mut b = Builder::new();
    let object = b.object(material);
    b.quad(object, vec3(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y);
    b.environment(Vec3::ONE, Vec3::ONE);
    b.seen_by(slanted(cosine))
}

/// White metal and white dielectrics reflect all light, at every roughness and angle; coloured metal what its albedo
/// says.
#[test]
fn rough_surfaces_in_a_furnace_reflect_their_albedo() {
    let albedos = LobeAlbedos::new();
    for cosine in [0.95, 0.5, 0.2] {
        for roughness in [0.1, 0.3, 0.55, 0.8, 0.95] {
            let white = [metal(Vec3::ONE, roughness), Material { ior: 1.5, roughness, ..matte(Vec3::ONE) }];
            for material in white {
                let metallic = material.metallic;
                let found = mean(&wall(material, cosine), &settings(DirectLight::Bsdf, 2), 800);
                let error = found.error2().map(f64::sqrt).max_element();
                let off = (found.value() - 1.0).abs().max_element();
                assert!(error < 0.01, "{cosine} {roughness} {metallic}: {error}");
                assert!(off < 4.0 * error + 0.004, "{cosine} {roughness} {metallic}: {}", found.value());
            }
            let color = vec3(0.9, 0.5, 0.1);
            let found = mean(&wall(metal(color, roughness), cosine), &settings(DirectLight::Bsdf, 2), 800);
            let [all, grazing] = albedos.at(cosine, f64::from(roughness)).to_array();
            let f0 = color.as_dvec3();
            let expected = (1.0 + f0 * (1.0 / all - 1.0)) * (f0 * all + (1.0 - f0) * grazing);
            let error = found.error2().map(f64::sqrt).max_element();
            let off = (found.value() - expected).abs().max_element();
            assert!(off < 4.0 * error + 0.004, "{cosine} {roughness}: {} not {expected}", found.value());
        }
    }
}

/// Coats and rough glass lose light that is scattered more than once, but never add any.
#[test]
fn coats_and_rough_glass_add_no_light() {
    let coated = Material { clearcoat: 1.0, clearcoat_roughness: 0.4, ..metal(Vec3::ONE, 0.3) };
    let solid = Material { roughness: 0.4, ..glass(1.5) };
    let pane = Material { thin: true, ..solid.clone() };
    for (what, material, least) in [("coat", coated, 0.99), ("glass", solid, 0.85), ("pane", pane, 0.85)] {
        for cosine in [0.9, 0.4] {
            let found = mean(&wall(material.clone(), cosine), &settings(DirectLight::Bsdf, 2), 1500);
            let error = 4.0 * found.error2().map(f64::sqrt).max_element();
            let (low, high) = (found.value().min_element(), found.value().max_element());
            assert!(
                error < 0.05 && low > least - error && high < 1.004 + error,
                "{what} {cosine}: {low} {high}"
            );
        }
    }
}

/// A white sheen on white cloth reflects all light, at every roughness and angle, and on black cloth its albedo.
#[test]
fn sheen_keeps_energy() {
    let albedos = LobeAlbedos::new();
    for cosine in [0.9, 0.4, 0.15] {
        for roughness in [0.15, 0.4, 0.9] {
            let [albedo, _] = albedos.sheen(cosine, f64::from(roughness));
            for (base, expected) in [(Vec3::ONE, 1.0), (Vec3::ZERO, albedo)] {
                let material = Material { sheen_color: Vec3::ONE, sheen_roughness: roughness, ..matte(base) };
                let found = mean(&wall(material, cosine), &settings(DirectLight::Bsdf, 2), 2000);
                let error = found.error2().map(f64::sqrt).max_element();
                let off = (found.value() - expected).abs().max_element();
                assert!(error < 0.02, "{cosine} {roughness}: {error}");
                assert!(
                    off < 4.0 * error + 0.01,
                    "{cosine} {roughness} {base}: {} {expected}",
                    found.value()
                );
            }
        }
    }
}

/// A film over white plastic loses no light, smooth and rough: what it does not reflect passes to the plastic. Over metal it
/// adds none.
#[test]
fn films_keep_energy() {
    let film = |material: Material| Material {
        iridescence: 1.0,
        iridescence_ior: 1.8,
        iridescence_thickness: [100.0, 450.0],
        ..material
    };
    for cosine in [0.9, 0.4] {
        for roughness in [0.0, 0.3, 0.8] {
            let plastic = Material { ior: 1.5, roughness, ..matte(Vec3::ONE) };
            let found = mean(&wall(film(plastic), cosine), &settings(DirectLight::Bsdf, 2), 800);
            let error = 4.0 * found.error2().map(f64::sqrt).max_element();
            let off = (found.value() - 1.0).abs().max_element();
            assert!(error < 0.05 && off < error + 0.006, "{cosine} {roughness}: {}", found.value());
            let found = mean(
                &wall(film(metal(Vec3::splat(0.7), roughness)), cosine),
                &settings(DirectLight::Bsdf, 2),
                400,
            );
            let (low, high) = (found.value().min_element(), found.value().max_element());
            assert!(
                low > 0.1 && high < 1.004 + error && high - low > 0.02,
                "{cosine} {roughness}: {}",
                found.value()
            );
        }
    }
}

/// A white leaf in a furnace reflects and transmits all light, whatever the share; a coloured one its colours.
#[test]
fn diffuse_transmission_keeps_energy() {
    for (share, roughness) in [(0.3, 1.0), (1.0, 1.0), (0.6, 0.4), (0.6, 0.0)] {
        let leaf = |base: Vec3, diffuse_transmission_color: Vec3| Material {
            diffuse_transmission: share,
            diffuse_transmission_color,
            roughness,
            ior: 1.5,
            ..matte(base)
        };
        let found = mean(&wall(leaf(Vec3::ONE, Vec3::ONE), 0.7), &settings(DirectLight::Bsdf, 2), 800);
        let error = 4.0 * found.error2().map(f64::sqrt).max_element() + 0.004;
        assert!((found.value() - 1.0).abs().max_element() < error, "{share} {roughness}: {}", found.value());
        if roughness == 1.0 {
            let (base, color) = (vec3(0.8, 0.2, 0.4), vec3(0.1, 0.9, 0.5));
            let found = mean(&wall(leaf(base, color), 0.7), &settings(DirectLight::Bsdf, 2), 800);
            let expected = base.lerp(color, share).as_dvec3();
            let error = 4.0 * found.error2().map(f64::sqrt).max_element() + 0.004;
            assert!((found.value() - expected).abs().max_element() < error, "{share}: {}", found.value());
        }
    }
}

/// Every channel of a dispersive ball is that of a ball with the channel's index of refraction (KHR_materials_dispersion:
/// n - h, n and n + h with h = 0.025 d (n - 1)), as reflection hardly depends on it.
#[test]
fn dispersion_refracts_every_channel_by_its_index() {
    let ball = |ior: f32, dispersion: f32, cosine: f64| {
        let mut b = Builder::new();
        let object = b.object(Material { dispersion, ..glass(ior) });
        b.sphere(object, vec3(0.0, 0.35, 0.0), 0.5);
        for i in 0..9 {
            let stripe = b.object(Material { emission: Vec3::splat(i as f32), ..matte(Vec3::ZERO) });
            b.quad(stripe, vec3(-3.0, -1.8 + 0.4 * i as f32, -1.5), 6.0 * Vec3::X, 0.4 * Vec3::Y);
        }
        mean(&b.seen_by(slanted(cosine)), &settings(DirectLight::Bsdf, 4), 3000)
    };
    let (ior, dispersion) = (1.5, 6.0);
    let mut apart = 0.0_f64;
    for cosine in [1.0, 0.98, 0.95] {
        let found = ball(ior, dispersion, cosine);
        for channel in 0..3 {
            let of_channel = ior + 0.025 * dispersion * (ior - 1.0) * (channel as f32 - 1.0);
            let alone = ball(of_channel, 0.0, cosine);
            let error = (found.error2() + alone.error2()).map(f64::sqrt)[channel];
            let off = (found.value() - alone.value())[channel].abs();
            assert!(off < 4.0 * error + 0.05, "{cosine} {channel}: {} {}", found.value(), alone.value());
        }
        apart = apart.max(found.value().max_element() - found.value().min_element());
    }
    assert!(apart > 0.5, "{apart}");
}

fn brushed(roughness: f32, anisotropy: f32, anisotropy_rotation: f32) -> Material {
    Material { anisotropy, anisotropy_rotation, ..metal(Vec3::ONE, roughness) }
}

/// White brushed metal never reflects more than all light, and at most a little less where its sides are nearly as
/// wide.
#[test]
fn anisotropic_metal_adds_no_light() {
    for cosine in [0.9, 0.4, 0.2] {
        for (roughness, anisotropy, least) in
            [(0.9, 0.6, 0.92), (0.5, 0.3, 0.93), (0.3, 0.6, 0.75), (0.2, 1.0, 0.4)]
        {
            for rotation in [0.0, 0.8, 1.57] {
                let material = brushed(roughness, anisotropy, rotation);
                let found = mean(&wall(material, cosine), &settings(DirectLight::Bsdf, 2), 800);
                let error = found.error2().map(f64::sqrt).max_element();
                let value = found.value().x;
                assert!(
                    error < 0.01 && value < 1.0 + 4.0 * error && value > least - 4.0 * error,
                    "{cosine} {roughness} {anisotropy} {rotation}: {value} {error}"
                );
            }
        }
    }
}

/// What a directional light leaves on brushed metal, by the specification's formulas (KHR_materials_anisotropy,
/// implementation notes): widths of alpha + (1 - alpha) strength^2 along the turned tangent and alpha across.
#[test]
fn a_punctual_light_has_a_stretched_image_in_brushed_metal() {
    let (roughness, strength, rotation, cosine) = (0.4, 0.7, 0.6, 0.8);
    let to_light = DVec3::new(-0.3, 0.4, 0.8).normalize();
    let mut b = Builder::new();
    let object = b.object(brushed(roughness, strength, rotation));
    b.quad(object, vec3(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y);
    let kind = LightKind::Directional { direction: -to_light.as_vec3() };
    b.light(Light { kind, intensity: Vec3::splat(2.0), radius: 0.0 });
    let view = DVec3::new((1.0_f64 - cosine * cosine).sqrt(), 0.0, cosine);
    let across = f64::from(roughness).powi(2);
    let along = across + (1.0 - across) * f64::from(strength).powi(2);
    // The rows of textures run along +Y here, so that the bitangent is -Y.
    let (sin, cos) = f64::from(rotation).sin_cos();
    let t = DVec3::new(cos, -sin, 0.0);
    let sides = |v: DVec3| (v.dot(t), v.dot(DVec3::Z.cross(t)), v.z);
    let h = sides((view + to_light).normalize());
    let slope2 = (h.0 / along).powi(2) + (h.1 / across).powi(2) + h.2.powi(2);
    let d = 1.0 / (PI * along * across * slope2.powi(2));
    let length = |v: DVec3| {
        let (x, y, z) = sides(v);
        ((along * x).powi(2) + (across * y).powi(2) + z * z).sqrt()
    };
    // V of the specification times the cosine of the light. White metal reflects all at every angle.
    let visible = 0.5 / (to_light.z * length(view) + view.z * length(to_light)) * to_light.z;
    let single = 2.0 * d * visible;
    for_each(&b.seen_by(slanted(cosine)), &settings(DirectLight::Mis, 2), [3, 3], 1, |_, path| {
        let found = path.radiance.x / single;
        assert!((1.0..1.35).contains(&found), "{path:?}, not {single}: {found}");
        assert!((path.radiance / path.radiance.x - 1.0).abs().max_element() < 1e-9, "{path:?}");
    });
}

/// What a directional light leaves on rough metal: E F D G / (4 cos), by the textbook's formulas.
#[test]
fn a_punctual_light_has_an_image_in_rough_metal() {
    let (color, roughness, cosine) = (vec3(0.9, 0.6, 0.3), 0.5, 0.8);
    let to_light = DVec3::new(-0.3, 0.4, 0.8).normalize();
    let mut b = Builder::new();
    let object = b.object(metal(color, roughness));
    b.quad(object, vec3(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y);
    let kind = LightKind::Directional { direction: -to_light.as_vec3() };
    b.light(Light { kind, intensity: Vec3::splat(2.0), radius: 0.0 });
    let view = DVec3::new((1.0_f64 - cosine * cosine).sqrt(), 0.0, cosine);
    let h = (view + to_light).normalize();
    let a2 = f64::from(roughness).powi(4);
    let d = a2 / (PI * (h.z * h.z * (a2 - 1.0) + 1.0).powi(2));
    let root = |z: f64| (a2 + (1.0 - a2) * z * z).sqrt();
    // G over 4 cos cos, times the cosine of the light.
    let visible = 0.5 / (to_light.z * root(view.z) + view.z * root(to_light.z)) * to_light.z;
    let f0 = color.as_dvec3();
    let fresnel = f0 + (1.0 - f0) * (1.0 - view.dot(h)).powi(5);
    let all = LobeAlbedos::new().at(cosine, f64::from(roughness)).x;
    let expected = 2.0 * d * visible * fresnel * (1.0 + f0 * (1.0 / all - 1.0));
    for_each(&b.seen_by(slanted(cosine)), &settings(DirectLight::Mis, 2), [3, 3], 1, |_, path| {
        assert!((path.radiance / expected - 1.0).abs().max_element() < 1e-3, "{path:?}, not {expected}");
    });
}

/// Balls of rough metal, plastic, glass and lacquer under a lamp and a map: emitters and map found by the path, by
/// sampling, and by both.
#[test]
fn every_way_to_find_light_finds_the_same_in_rough_surfaces() {
    let mut b = Builder::new();
    let balls = [
        metal(vec3(0.9, 0.7, 0.4), 0.3),
        Material { anisotropy: 0.6, anisotropy_rotation: 0.7, ..metal(vec3(0.5, 0.7, 0.9), 0.4) },
        Material { roughness: 0.4, ior: 1.5, ..matte(vec3(0.3, 0.1, 0.6)) },
        Material { roughness: 0.5, anisotropy: 0.5, ..glass(1.4) },
        Material {
            clearcoat: 0.8,
            clearcoat_roughness: 0.25,
            sheen_color: vec3(0.3, 0.5, 0.9),
            sheen_roughness: 0.4,
            ..metal(vec3(0.6, 0.2, 0.2), 0.5)
        },
    ];
    for (i, material) in balls.into_iter().enumerate() {
        let ball = b.object(material);
        b.sphere(ball, vec3(-1.0 + 0.5 * i as f32, 0.0, 0.0), 0.24);
    }
    let leaf = b.object(Material {
        diffuse_transmission: 0.7,
        diffuse_transmission_color: vec3(0.9, 0.8, 0.3),
        ..matte(vec3(0.3, 0.5, 0.1))
    });
    b.quad(leaf, vec3(-1.3, -0.3, -0.5), 2.6 * Vec3::X, 0.9 * Vec3::Y);
    let lamp = b.object(Material { emission: vec3(8.0, 6.0, 4.0), ..matte(Vec3::ZERO) });
    b.quad(lamp, vec3(-0.5, 1.0, -0.9), Vec3::X, 0.8 * Vec3::Z);
    let camera = Camera::look_at(vec3(0.0, 0.4, 3.0), Vec3::ZERO, 0.55).expect("a valid camera");
    let mut scene = b.seen_by(camera);
    scene.surround(EnvironmentMap::studio());
    let columns = |settings: &Settings, samples: u32| {
        let mut means = [Mean::default(); 5];
        for_each(&scene, settings, [20, 5], samples, |[x, _], path| means[x as usize / 4].add(path.radiance));
        means
    };
    let [walked, ..] = WAYS.map(|way| columns(&settings(way, 4), 1500));
    for way in &WAYS[1..] {
        let found = columns(&Settings { seed: 1, ..settings(*way, 4) }, 1000);
        for (i, (walked, found)) in walked.iter().zip(&found).enumerate() {
            let deviation = found.deviation(walked.value(), walked.error2());
            assert!(deviation < 4.0, "{way:?}, ball {i}: {} {} {deviation}", found.value(), walked.value());
        }
    }
}
