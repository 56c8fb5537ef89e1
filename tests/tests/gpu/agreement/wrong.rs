//! Tests of the comparisons: each of them fails against a slightly wrong reference.

use glam::Vec2;
use glimpse::{Method, Mip, Scene, Settings, Tolerances, reference::Reference, scene::LightKind};
use glimpse_tests::{agreement::Tally, gallery};

use super::{Pair, built_in, frames::Frames, rays, srgb};

const SIZE: [u32; 2] = [32, 21];

fn changed(scene: &Scene, change: impl Fn(&mut Scene)) -> Reference {
    let mut scene = scene.clone();
    change(&mut scene);
    Reference::new(&scene).with_srgb(*srgb())
}

fn objects(tally: &Tally, least: usize, what: &str) {
    assert!(tally.wrong.len() >= least, "{what}: {} of at least {least} are wrong", tally.wrong.len());
}

fn move_lights(scene: &mut Scene) {
    for light in &mut scene.lights {
        if let LightKind::Point { position, .. } | LightKind::Spot { position, .. } = &mut light.kind {
            *position *= 1.01;
        }
    }
}

#[test]
fn a_light_that_moved_by_a_hundredth_is_seen() {
    let scene = built_in("cornell");
    let wrong = changed(&scene, move_lights);
    let pair = Pair::new(scene, SIZE, Settings::default());
    for method in [Method::Full, Method::Adaptive] {
        let frames = pair.frames(method).against(&wrong, Settings { method, ..pair.settings });
        objects(&frames.adaptive_colors(), 300, "adaptive radiance");
        objects(&frames.traced_colors(), 300, "radiance");
    }
    objects(&rays::seen(&pair, &wrong, 1000), 300, "what rays see");
}

#[test]
fn another_index_of_refraction_is_seen() {
    let scene = gallery::glasshouse();
    let wrong = changed(&scene, |s| s.materials[0].ior = 1.52);
    let pair = Pair::new(scene, SIZE, Settings { depth: 6, min_weight: 0.01, ..Settings::default() });
    let frames = pair.frames(Method::Full).against(&wrong, pair.settings);
    objects(&frames.traced_colors(), 20, "radiance");
}

#[test]
fn textures_shifted_by_half_a_texel_are_seen() {
    let scene = gallery::textures();
    let wrong = changed(&scene, |s| {
        s.texcoords.iter_mut().flatten().for_each(|t| *t += Vec2::splat(0.5 / 16.0));
    });
    let pair = Pair::new(scene, SIZE, Settings::default());
    let frames = pair.frames(Method::Full).against(&wrong, pair.settings);
    objects(&frames.traced_colors(), 50, "radiance");
}

#[test]
fn other_tangents_and_second_coordinates_are_seen() {
    let scene = gallery::extended();
    type Change = fn(&mut Scene);
    let changes: [(&str, Change, usize); 5] = [
        ("tangents", |s| s.tangents.iter_mut().flatten().for_each(|word| *word ^= 1), 30),
        ("slopes", |s| s.materials.iter_mut().for_each(|m| m.normal_scale *= 1.1), 30),
        ("occlusion", |s| s.materials.iter_mut().for_each(|m| m.occlusion_strength *= 0.9), 3),
        ("second set", |s| s.second_texcoords.iter_mut().flatten().for_each(|t| t.x += 0.1), 3),
        (
            "transforms",
            |s| {
                let all = s.materials.iter_mut().flat_map(|m| m.coordinates.values_mut());
                all.for_each(|c| c.transform.translation.y += 0.1);
            },
            10,
        ),
    ];
    let pair = Pair::new(scene.clone(), SIZE, Settings::default());
    for (what, change, least) in changes {
        let wrong = changed(&scene, change);
        for method in [Method::Full, Method::Adaptive] {
            let frames = pair.frames(method).against(&wrong, Settings { method, ..pair.settings });
            objects(&frames.adaptive_colors(), least, what);
        }
    }
}

#[test]
fn other_layers_are_seen() {
    let scene = gallery::layers();
    type Change = fn(&mut Scene);
    let changes: [(&str, Change); 5] = [
        ("specular colour", |s| s.materials.iter_mut().for_each(|m| m.specular_color *= 1.2)),
        ("specular strength", |s| s.materials.iter_mut().for_each(|m| m.specular *= 0.9)),
        ("glossiness", |s| {
            s.materials.iter_mut().flat_map(|m| &mut m.specular_glossiness).for_each(|g| g.glossiness *= 0.9);
        }),
        ("clearcoat", |s| s.materials.iter_mut().for_each(|m| m.clearcoat *= 0.9)),
        ("absorption", |s| s.materials.iter_mut().for_each(|m| m.absorption *= 1.1)),
    ];
    let pair = Pair::new(scene.clone(), SIZE, Settings::default());
    let full = pair.frames(Method::Full);
    for (what, change) in changes {
        objects(&full.against(&changed(&scene, change), pair.settings).traced_colors(), 3, what);
    }
}

/// Textures sampled at a point where averages are expected.
#[test]
fn points_in_place_of_averages_are_seen() {
    let scene = gallery::lenses();
    let reference = changed(&scene, |_| ());
    let pair = Pair::new(scene, SIZE, Settings::default());
    for method in [Method::Full, Method::Adaptive] {
        let points = Settings { method, mip: Mip::Off, ..pair.settings };
        objects(&pair.frames(method).against(&reference, points).adaptive_colors(), 100, "radiance");
    }
}

#[test]
fn geometry_that_moved_by_a_thousandth_is_seen() {
    let scene = built_in("cornell");
    let wrong = changed(&scene, |s| s.positions.iter_mut().flatten().for_each(|p| *p *= 1.001));
    let pair = Pair::new(scene, SIZE, Settings::default());
    let full = pair.frames(Method::Full).against(&wrong, pair.settings);
    objects(&full.traced_hits(), 300, "hits");
    let adaptive = pair.frames(Method::Adaptive).against(&wrong, pair.settings);
    objects(&adaptive.adaptive_hits(), 300, "attributes");
    objects(&rays::arrived(&pair, &wrong, 1000), 300, "where rays arrive");
}

#[test]
fn other_tolerances_are_seen() {
    let scene = gallery::textures();
    let reference = changed(&scene, |_| ());
    let pair = Pair::new(scene, SIZE, Settings::default());
    let frames = pair.frames(Method::Adaptive);
    let decisions =
        |tolerances| -> Frames<'_> { frames.against(&reference, Settings { tolerances, ..pair.settings }) };
    let right = Tolerances::default();
    assert_eq!(decisions(right).decisions().wrong.len(), 0);
    // Each of them, and no other.
    let Tolerances { pos: _, norm: _, tex: _, gcol: _ } = right;
    for (what, tolerances) in [
        ("pos", Tolerances { pos: 1.5 * right.pos, ..right }),
        ("norm", Tolerances { norm: 0.97, ..right }),
        ("tex", Tolerances { tex: 0.4, ..right }),
        ("gcol", Tolerances { gcol: 0.002, ..right }),
    ] {
        objects(&decisions(tolerances).decisions(), 1, what);
    }
}
