//! Partial coverage (glTF's BLEND): closed forms, shadows, and what undersampling makes of it.

use glam::{Vec3, vec3};
use glimpse::{
    Features, LinearImage, Method, Scene, Settings,
    scene::{Image8, Material, Texture, WHITE, Wrap},
};
use glimpse_tests::{
    TestScene,
    builder::{Builder, front_camera, matte, mirror, unlit},
    full,
};

const SIZE: [u32; 2] = [32, 32];

fn pane(color: Vec3, alpha: f32) -> Material {
    Material { blends: true, alpha, ..unlit(color) }
}

fn middle(image: &LinearImage) -> Vec3 {
    Vec3::from(image.get_pixel(SIZE[0] / 2, SIZE[1] / 2).0)
}

fn close(found: Vec3, expected: Vec3, what: &str) {
    assert!((found - expected).abs().max_element() < 2e-6, "{what}: {found}, expected {expected}");
}

/// Panes before a green wall, nearest first, each with a colour and an alpha.
fn panes(layers: &[(Vec3, f32)]) -> Scene {
    let mut builder = Builder::new();
    let wall = builder.object(unlit(Vec3::Y));
    builder.quad(wall, vec3(-4.0, -4.0, -1.0), 8.0 * Vec3::X, 8.0 * Vec3::Y);
    for (i, (color, alpha)) in layers.iter().enumerate() {
        let object = builder.object(pane(*color, *alpha));
        builder.quad(object, vec3(-2.0, -2.0, -0.01 * i as f32), 4.0 * Vec3::X, 4.0 * Vec3::Y);
    }
    builder.seen_by(front_camera())
}

/// The "over" operator (Porter & Duff 1984), layer by layer.
#[test]
fn layers_cover_what_is_behind_them() {
    let stacks: [&[(Vec3, f32)]; 4] = [
        &[(Vec3::Z, 0.4)],
        &[(Vec3::X, 0.3), (Vec3::Z, 0.5)],
        &[(Vec3::X, 0.0), (Vec3::Z, 1.0), (Vec3::X, 0.5)],
        &[(Vec3::X, 0.1); 12],
    ];
    for layers in stacks {
        let expected = layers.iter().rev().fold(Vec3::Y, |behind, (c, a)| behind.lerp(*c, *a));
        let scene = TestScene::new(panes(layers));
        for method in [Method::Full, Method::Adaptive] {
            let found = middle(&scene.frame(SIZE, &Settings { method, ..full() }));
            close(found, expected, &format!("{method:?} {layers:?}"));
        }
    }
}

/// The mean of paths is the expectation, also of those that end at an emitter behind layers.
#[test]
fn paths_meet_layers_as_often_as_they_cover() {
    let layers = [(Vec3::X, 0.3), (Vec3::Z, 0.6)];
    let expected = layers.iter().rev().fold(Vec3::Y, |behind, (c, a)| behind.lerp(*c, *a));
    let scene = TestScene::new(panes(&layers));
    let image = scene.frame([96, 96], &Settings { method: Method::Path, ..full() });
    let inside = image.enumerate_pixels().filter(|(x, y, _)| (24..72).contains(x) && (24..72).contains(y));
    let (sum, count) =
        inside.fold((Vec3::ZERO, 0.0), |(sum, count), (.., p)| (sum + Vec3::from(p.0), count + 1.0));
    // A standard deviation of at most 0.5 / 48 a channel.
    assert!((sum / count - expected).abs().max_element() < 0.04, "{}, expected {expected}", sum / count);
}

/// A wall lit through layers of alpha 0.25 and 0.5, one of which is seen from behind.
fn shaded(alphas: &[f32]) -> Scene {
    let mut builder = Builder::new();
    let wall = builder.object(matte(Vec3::ONE));
    builder.quad(wall, vec3(-2.0, -2.0, 0.0), 4.0 * Vec3::X, 4.0 * Vec3::Y);
    for (i, alpha) in alphas.iter().enumerate() {
        let screen = builder.object(pane(Vec3::X, *alpha));
        let (u, v) = (4.0 * Vec3::X, 4.0 * Vec3::Y);
        let (u, v) = if i % 2 == 0 { (u, v) } else { (v, u) };
        builder.quad(screen, vec3(-2.0, -2.0, 3.0 + 0.1 * i as f32), u, v);
    }
    builder.point_light(vec3(0.0, 0.0, 6.0), Vec3::splat(60.0));
    builder.seen_by(front_camera())
}

#[test]
fn shadows_are_dimmed_by_each_layer() {
    let lit = |alphas: &[f32], method| {
        middle(&TestScene::new(shaded(alphas)).frame(SIZE, &Settings { method, ..full() }))
    };
    for method in [Method::Full, Method::Adaptive, Method::Path] {
        // Paths see another point of the pixel.
        let bare = lit(&[], method);
        assert!(bare.x > 0.1);
        for (alphas, share) in
            [(&[0.25][..], 0.75), (&[0.25, 0.5], 0.375), (&[0.25, 1.0], 0.0), (&[0.0], 1.0)]
        {
            close(lit(alphas, method), share * bare, &format!("{method:?} {alphas:?}"));
        }
    }
}

/// Straight rays are one level together; the rest of what limits cut off has the fallback radiance.
#[test]
fn the_depth_limit_counts_straight_rays_once() {
    let mut scene = panes(&[(Vec3::X, 0.5); 6]);
    scene.environment.fallback_radiance = Vec3::ONE;
    let scene = TestScene::new(scene);
    let seen = |depth| middle(&scene.frame(SIZE, &Settings { depth, ..full() }));
    close(seen(1), vec3(1.0, 0.5, 0.5), "primary rays alone");
    let all = vec3(1.0 - 0.5_f32.powi(6), 0.5_f32.powi(6), 0.0);
    close(seen(2), all, "one level more");
    let cut = Settings { depth: 2, min_weight: 0.2, ..full() };
    // The rays of weight 0.5 and 0.25 are traced, that of 0.125 is not.
    close(middle(&scene.frame(SIZE, &cut)), vec3(1.0, 0.125, 0.125), "least weight");
}

/// A mirror is covered like any other surface, and its image too.
#[test]
fn what_covers_may_reflect() {
    let mut builder = Builder::new();
    let wall = builder.object(unlit(Vec3::Y));
    builder.quad(wall, vec3(-4.0, -4.0, -1.0), 8.0 * Vec3::X, 8.0 * Vec3::Y);
    let pane = builder.object(Material { blends: true, alpha: 0.25, ..mirror(Vec3::ONE) });
    builder.quad(pane, vec3(-2.0, -2.0, 0.0), 4.0 * Vec3::X, 4.0 * Vec3::Y);
    let behind = builder.object(unlit(Vec3::X));
    builder.quad(behind, vec3(-9.0, -9.0, 4.0), 18.0 * Vec3::Y, 18.0 * Vec3::X);
    let scene = TestScene::new(builder.seen_by(front_camera()));
    for method in [Method::Full, Method::Adaptive] {
        let found = middle(&scene.frame(SIZE, &Settings { method, ..full() }));
        close(found, vec3(0.25, 0.75, 0.0), &format!("{method:?}"));
    }
}

/// Alpha of vertices cuts holes in MASK and covers in BLEND.
#[test]
fn alpha_of_vertices_counts() {
    for (cutoff, blends, alpha, expected) in [
        (Some(0.5), false, 0x0000, Vec3::Y),
        (Some(0.5), false, 0xc000, Vec3::X),
        (None, true, 0x8000, vec3(0.5, 0.5, 0.0)),
        (None, false, 0x0000, Vec3::X),
    ] {
        let mut scene = panes(&[(Vec3::X, 1.0)]);
        let material = scene.materials.last_mut().expect("the pane's");
        (material.alpha_cutoff, material.blends) = (cutoff, blends);
        let [r, g, b, _] = WHITE;
        scene.colors = vec![[[r, g, b, alpha]; 3]; scene.positions.len()];
        assert_eq!(Features::of(&scene).vertex_alpha, cutoff.is_some() || blends);
        let scene = TestScene::new(scene);
        for method in [Method::Full, Method::Adaptive] {
            let found = middle(&scene.frame(SIZE, &Settings { method, ..full() }));
            let error = (found - expected).abs().max_element();
            assert!(error < 1e-5, "{method:?} {cutoff:?} {blends} {alpha:x}: {found}");
        }
    }
}

/// A dark ramp, of which 8 bits, linear, would show five levels.
#[test]
fn vertex_colours_are_as_fine_as_the_file_has_them() {
    let mut builder = Builder::new();
    let wall = builder.object(unlit(Vec3::ONE));
    builder.quad(wall, vec3(-0.8, -0.8, 0.0), 1.6 * Vec3::X, 1.6 * Vec3::Y);
    let mut scene = builder.seen_by(front_camera());
    let grey = |p: Vec3| {
        let level = (0.015 * (p.x / 1.6 + 0.5) * 65535.0) as u16;
        [level, level, level, u16::MAX]
    };
    scene.colors = scene.positions.iter().map(|corners| corners.map(grey)).collect();
    let scene = TestScene::new(scene);
    for method in [Method::Full, Method::Adaptive] {
        let frame = scene.frame([64, 64], &Settings { method, ..full() });
        let row: Vec<u32> = (2..62).map(|x| frame.get_pixel(x, 32).0[0].to_bits()).collect();
        let levels: std::collections::BTreeSet<_> = row.iter().collect();
        assert!(levels.len() > 40, "{method:?}: {} levels", levels.len());
        let shown = scene.shown([64, 64], &Settings { method, ..full() });
        let shades: std::collections::BTreeSet<_> = (2..62).map(|x| shown.get_pixel(x, 32).0[0]).collect();
        let steps = shades.iter().zip(shades.iter().skip(1)).map(|(a, b)| b - a);
        assert!(shades.len() > 25 && steps.max() == Some(1), "{method:?}: {shades:?}");
    }
}

/// The frame of `adaptive` is that of `full` where coverage changes between its samples.
#[test]
fn interpolation_notices_coverage() {
    let mut builder = Builder::new();
    let wall = builder.object(unlit(Vec3::Y));
    builder.quad(wall, vec3(-4.0, -4.0, -1.0), 8.0 * Vec3::X, 8.0 * Vec3::Y);
    // Stripes, a texel of each is covered in every four.
    let rgba = (0..16).flat_map(|x| [255, 255, 255, if x % 4 == 1 { 255 } else { 0 }]).collect();
    let image = builder.image(Image8 { width: 16, height: 1, rgba });
    let texture = builder.texture(Texture { image, wrap: [Wrap::Repeat; 2], nearest: true });
    let screen =
        builder.object(Material { base_color_texture: Some(texture), ..pane(vec3(1.0, 0.0, 0.0), 1.0) });
    builder.quad(screen, vec3(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y);
    let scene = TestScene::new(builder.seen_by(front_camera()));
    let [full, adaptive] = [Method::Full, Method::Adaptive]
        .map(|method| scene.frame([97, 61], &Settings { method, ..Settings::default() }));
    for (x, y, pixel) in full.enumerate_pixels() {
        let [found, expected] = [&adaptive.get_pixel(x, y).0, &pixel.0].map(|p| Vec3::from(*p));
        assert!((found - expected).abs().max_element() < 0.16, "({x}, {y}): {found}, traced {expected}");
    }
}
