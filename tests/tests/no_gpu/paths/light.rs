//! Light of emitters, found by BSDF sampling, by sampling the emitters, and by both.

use std::f64::consts::PI;

use glam::{DVec3, Vec3, vec3};
use glimpse::{
    Camera, DirectLight, Foveation, Roulette, Sampler, Scene, Settings,
    scene::{Material, octahedral_encode},
};
use glimpse_tests::builder::{Builder, front_camera, glass, matte, mirror};

use super::{Mean, WAYS, for_each, mean, settings};

/// Means of the quarters of a square picture.
fn quarters(scene: &Scene, settings: &Settings, samples: u32) -> [Mean; 4] {
    let mut means = [Mean::default(); 4];
    for_each(scene, settings, [16; 2], samples, |[x, y], path| {
        means[(y / 8 * 2 + x / 8) as usize].add(path.radiance);
    });
    means
}

/// A room with satin walls, a mirror ball and a glass ball; outside the view, where they would only add
/// noise, a glowing ball and a two-sided glowing board with a texture.
fn lit_room() -> Scene {
    let mut b = Builder::new();
    let [white, red, green] = [vec3(0.7, 0.7, 0.7), vec3(0.6, 0.1, 0.1), vec3(0.1, 0.5, 0.1)]
        .map(|color| b.object(Material { roughness: 0.2, ior: 1.8, ..matte(color) }));
    let (low, [x, y, z]) = (Vec3::NEG_ONE, [2.0 * Vec3::X, 2.0 * Vec3::Y, 3.5 * Vec3::Z]);
    b.quad(white, low + z, x, -z);
    b.quad(white, low + y, x, z);
    b.quad(white, low, x, y);
    b.quad(red, low + z, -z, y);
    b.quad(green, low + x, z, y);
    let ball = b.object(mirror(vec3(0.9, 0.8, 0.7)));
    b.sphere(ball, vec3(-0.5, -0.65, -0.4), 0.35);
    let clear = b.object(glass(1.5));
    b.sphere(clear, vec3(0.5, -0.6, 0.1), 0.3);
    let glowing = |emission| Material { emission, ..matte(Vec3::splat(0.2)) };
    let bulb = b.object(glowing(vec3(2.0, 3.0, 4.0)));
    b.sphere(bulb, vec3(-0.65, 0.4, 1.2), 0.25);
    let ramp = b.ramp_texture();
    let board = b.object(Material { emissive_texture: Some(ramp), ..glowing(vec3(60.0, 50.0, 40.0)) });
    b.quad(board, vec3(0.1, 0.75, 0.7), 0.8 * Vec3::X, 0.8 * Vec3::Z);
    b.environment(vec3(0.05, 0.1, 0.15), Vec3::ONE);
    b.seen_by(front_camera())
}

/// A floor with albedo (0.8, 0.5, 0.2), of which the view is a spot so small that the light is uniform on it,
/// and a lamp.
fn spot_and_lamp(center: Vec3, radius: f32, radiance: Vec3) -> Builder {
    let mut b = Builder::new();
    let floor = b.object(matte(vec3(0.8, 0.5, 0.2)));
    b.quad(floor, vec3(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y);
    let lamp = b.object(Material { emission: radiance, ..matte(Vec3::ZERO) });
    b.sphere(lamp, center, radius);
    b
}

fn narrow_camera() -> Camera {
    Camera { right: 1e-4 * Vec3::X, up: 1e-4 * Vec3::Y, ..front_camera() }
}

/// Seen from a point, a sphere of radiance L is a disc: its irradiance is pi L (r / d)^2 cos if it is above
/// the horizon, and pi L within it.
#[test]
fn a_sphere_lights_a_floor() {
    let (albedo, radiance) = (vec3(0.8, 0.5, 0.2), vec3(3.0, 6.0, 9.0));
    let far = PI * (0.5_f64 / 1.25).powi(2) * (1.0 / 1.25);
    for (center, radius, solid_angle) in [(vec3(0.75, 0.0, 1.0), 0.5, far), (Vec3::ZERO, 3.0, PI)] {
        let scene = spot_and_lamp(center, radius, radiance).seen_by(narrow_camera());
        let expected = albedo.as_dvec3() / PI * solid_angle * radiance.as_dvec3();
        for direct_light in WAYS {
            let found = mean(&scene, &settings(direct_light, 2), 2000);
            assert!((found.error2().map(f64::sqrt) / expected).max_element() < 0.02, "{direct_light:?}");
            let deviation = found.deviation(expected, DVec3::ZERO);
            assert!(
                deviation < 4.0,
                "{direct_light:?}: {} instead of {expected}, {deviation}",
                found.value()
            );
        }
    }
}

/// A plate that blocks the lamp, and normals bent so that the lamp is behind them or only behind the face.
#[test]
fn a_lamp_that_cannot_be_seen_leaves_no_light() {
    let lamp = vec3(0.75, 0.0, 1.0);
    let mut b = spot_and_lamp(lamp, 0.5, Vec3::ONE);
    let plate = b.object(matte(Vec3::ONE));
    b.quad(plate, vec3(0.05, -1.0, 0.3), 2.0 * Vec3::X, 2.0 * Vec3::Y);
    let bent = |lamp: Vec3, radius: f32, normal: Vec3| {
        let mut scene = spot_and_lamp(lamp, radius, Vec3::ONE).seen_by(narrow_camera());
        scene.normals.fill([octahedral_encode(normal.normalize()); 3]);
        scene
    };
    let behind = bent(lamp, 0.5, vec3(-1.0, 0.0, 0.2));
    let below = bent(vec3(1.5, 0.0, -0.5), 0.3, vec3(1.0, 0.0, 0.2));
    for scene in [b.seen_by(narrow_camera()), behind, below] {
        for direct_light in WAYS {
            for_each(&scene, &settings(direct_light, 2), [5, 5], 100, |_, path| {
                assert_eq!(path.radiance, DVec3::ZERO, "{direct_light:?}");
            });
        }
    }
}

#[test]
fn every_way_to_find_light_finds_the_same() {
    let scene = lit_room();
    let walk = settings(DirectLight::Bsdf, 8);
    let walked = quarters(&scene, &walk, 1000);
    // Other random numbers than those of the walk, so that errors are independent.
    let both = Settings { seed: 1, ..settings(DirectLight::Mis, 8) };
    let [mut light, mut roulette, mut four, mut sobol, mut foveated] = [both; 5];
    light.paths.direct_light = DirectLight::Nee;
    roulette.paths.roulette = Roulette::On;
    four.paths.light_samples = 4;
    sobol.paths.sampler = Sampler::Sobol;
    foveated.paths.foveation = Foveation::Compensated;
    (foveated.paths.foveation_start, foveated.paths.foveation_max) = (0, 0.5);
    let ways = [
        ("light", light),
        ("both", both),
        ("roulette", roulette),
        ("four points", four),
        ("sobol", sobol),
        ("foveated", foveated),
    ];
    for (name, settings) in ways {
        let found = quarters(&scene, &settings, 400);
        for (i, (walked, found)) in walked.iter().zip(&found).enumerate() {
            let deviation = found.deviation(walked.value(), walked.error2());
            let values = (found.value(), walked.value());
            assert!(deviation < 4.0, "{name}, quarter {i}: {values:?}, {deviation} standard errors");
        }
    }
}

/// With both strategies, what a surface adds to a sample is at most the lamp's own radiance (Veach 1997, 9.2:
/// the balance heuristic's estimate is at most that of the better strategy, and a lobe's weight is at most
/// 1), once by a ray to the lamp and once by the path that hits it. Sampling emitters alone has no such
/// bound, as points may be arbitrarily near to a lamp.
#[test]
fn no_sample_outshines_the_lamps() {
    let brightest = |scene: &Scene, direct_light, depth| {
        let mut brightest = 0.0_f64;
        for_each(scene, &settings(direct_light, depth), [16; 2], 100, |_, path| {
            brightest = brightest.max(path.radiance.max_element());
        });
        brightest
    };
    let mut b = Builder::new();
    let floor = b.object(matte(vec3(0.8, 0.5, 0.2)));
    b.quad(floor, vec3(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y);
    let lamp = b.object(Material { emission: Vec3::ONE, ..matte(Vec3::ZERO) });
    b.quad(lamp, Vec3::NEG_Y, 2.0 * Vec3::Y, Vec3::Z);
    let standing = b.seen_by(front_camera());
    for (scene, emission, depth) in [(&standing, 1.0, 2), (&lit_room(), 60.0, 8)] {
        let most = emission * f64::from(1 + 2 * (depth - 1));
        let found = brightest(scene, DirectLight::Mis, depth);
        assert!(found <= most, "{found} of {most}");
    }
    let alone = brightest(&standing, DirectLight::Nee, 2);
    assert!(alone > 5.0 * 3.0, "{alone}");
}
