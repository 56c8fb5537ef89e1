//! Scenes of glass.

use glam::{Vec3, vec2, vec3};
use glimpse::{
    Camera, Scene,
    scene::{Material, Texture, Weights, Wrap},
};

use super::{bend_normals, noise};
use crate::builder::{Builder, glass, matte, mirror, unlit};

/// A fine pattern behind a glass ball and a pane, and in a mirror ball: it appears magnified and reduced.
///
/// # Panics
/// Never.
#[must_use]
pub fn lenses() -> Scene {
    let mut b = Builder::new();
    let images = [noise(16, 16, 2), noise(7, 13, 1)].map(|image| b.image(image));
    for (image, corner, u) in [
        (images[0], vec3(-4.0, -1.0, -3.0), 8.0 * Vec3::X),
        (images[1], vec3(4.0, -1.0, 5.0), -8.0 * Vec3::X),
    ] {
        let texture =
            b.texture(Texture { image, wrap: [Wrap::MirroredRepeat, Wrap::Repeat], nearest: false });
        let wall = b.object(Material { base_color_texture: Some(texture), ..unlit(Vec3::ONE) });
        b.textured_quad(wall, [corner, u, 4.0 * Vec3::Y], [vec2(-1.1, 0.3), vec2(2.2, 1.9)]);
    }
    let lens = b.object(glass(1.5));
    b.sphere(lens, vec3(-0.8, 0.2, 0.0), 0.35);
    let ball = b.object(mirror(vec3(0.9, 0.8, 0.7)));
    b.sphere(ball, vec3(0.7, 0.2, 0.0), 0.45);
    let pane = b.object(Material { thin: true, ..glass(1.5) });
    b.quad(pane, vec3(-0.3, 0.7, 0.3), 0.8 * Vec3::X, 0.5 * Vec3::Y);
    let pillow = b.object(mirror(Vec3::splat(0.9)));
    b.quad(pillow, vec3(-1.1, -0.8, -0.2), 1.6 * Vec3::X, 0.3 * Vec3::Y);
    b.environment(vec3(0.2, 0.3, 0.5), Vec3::splat(0.05));
    let camera = Camera::look_at(vec3(0.1, 0.4, 3.4), vec3(0.0, 0.2, 0.0), 0.72).expect("a valid camera");
    let mut scene = b.seen_by(camera);
    bend_normals(&mut scene, pillow);
    scene
}

/// Nested glass, panes, mirrors facing each other, and constant weights.
///
/// # Panics
/// Never.
#[must_use]
pub fn glasshouse() -> Scene {
    let mut b = Builder::new();
    let tint = |color: Vec3, m: Material| Material { base_color: color, ..m };
    let outer = b.object(tint(vec3(0.9, 1.0, 0.95), glass(1.5)));
    b.sphere(outer, vec3(-0.9, 0.9, 0.0), 0.8);
    let inner = b.object(tint(vec3(1.0, 0.9, 0.8), glass(1.33)));
    b.sphere(inner, vec3(-0.8, 0.95, 0.1), 0.45);
    let core = b.object(matte(vec3(0.9, 0.2, 0.1)));
    b.sphere(core, vec3(-0.75, 0.9, 0.15), 0.15);
    let block = b.object(tint(vec3(0.8, 0.9, 1.0), glass(2.42)));
    cuboid(&mut b, block, vec3(0.4, 0.05, -0.3), vec3(1.0, 0.9, 0.3));
    let pane = b.object(Material { thin: true, ..tint(vec3(0.95, 1.0, 0.97), glass(1.5)) });
    b.quad(pane, vec3(-0.2, 0.1, 0.9), vec3(0.9, 0.0, 0.2), 1.3 * Vec3::Y);
    for (x, side) in [(-2.0, 1.0), (2.0, -1.0)] {
        let wall = b.object(mirror(vec3(0.9, 0.92, 0.88)));
        b.quad(wall, vec3(x, 0.0, side * 2.0), -4.0 * side * Vec3::Z, 2.5 * Vec3::Y);
    }
    let steel = b.object(Material { roughness: 0.25, ..mirror(vec3(0.8, 0.6, 0.4)) });
    b.sphere(steel, vec3(1.4, 0.3, 0.8), 0.3);
    let shares = Some(Weights { diffuse: 0.4, mirror: 0.3, refraction: 0.2 });
    let heckbert = b.object(Material { weights: shares, ior: 1.2, ..matte(vec3(0.3, 0.5, 1.0)) });
    b.sphere(heckbert, vec3(0.1, 0.25, 1.1), 0.2);
    let floor = b.object(Material { roughness: 0.3, ior: 1.5, ..matte(vec3(0.6, 0.6, 0.55)) });
    b.quad(floor, vec3(-2.0, 0.0, 2.0), 4.0 * Vec3::X, -4.0 * Vec3::Z);
    let back = b.object(Material { roughness: 0.7, ior: 1.5, ..matte(vec3(0.7, 0.5, 0.3)) });
    b.quad(back, vec3(-2.0, 0.0, -2.0), 4.0 * Vec3::X, 2.5 * Vec3::Y);
    b.point_light(vec3(0.3, 2.3, 1.4), vec3(6.0, 5.5, 5.0));
    b.point_light(vec3(-1.5, 1.9, -1.2), vec3(1.0, 2.0, 3.0));
    b.environment(vec3(0.3, 0.5, 0.8), vec3(0.08, 0.08, 0.1));
    b.seen_by(Camera::look_at(vec3(0.3, 1.3, 4.2), vec3(0.0, 0.8, 0.0), 0.75).expect("a valid camera"))
}

/// A block of glass with a hole that is partly filled with water and ice, bodies that touch and overlap, with and
/// without priorities, and a bubble; some of them absorb light.
///
/// # Panics
/// Never.
#[must_use]
pub fn media() -> Scene {
    let mut b = Builder::new();
    let dyed = |absorption: Vec3, m: Material| Material { absorption, ..m };
    let cup = b.object(glass(1.5));
    cuboid(&mut b, cup, vec3(-1.4, 0.1, -0.5), vec3(-0.2, 1.4, 0.5));
    let water = b.object(dyed(vec3(0.6, 0.2, 0.1), glass(1.33)));
    cuboid(&mut b, water, vec3(-1.3, 0.2, -0.4), vec3(-0.3, 1.1, 0.4));
    let air = b.object(Material { priority: -1, ..glass(1.0) });
    cuboid(&mut b, air, vec3(-1.25, 0.9, -0.35), vec3(-0.35, 1.4, 0.35));
    let ice = b.object(Material { priority: 1, ..glass(1.31) });
    b.sphere(ice, vec3(-0.85, 1.1, 0.05), 0.25);
    let red = b.object(dyed(vec3(0.1, 1.5, 1.5), glass(1.6)));
    cuboid(&mut b, red, vec3(0.3, 0.1, -0.2), vec3(0.8, 0.7, 0.3));
    let clear = b.object(glass(1.4));
    cuboid(&mut b, clear, vec3(0.8, 0.1, -0.3), vec3(1.3, 0.9, 0.4));
    let tinted = b.object(Material { base_color: vec3(0.7, 0.9, 1.0), ..glass(1.5) });
    b.sphere(tinted, vec3(0.8, 1.1, 0.0), 0.35);
    let bubble = b.object(glass(1.0));
    b.sphere(bubble, vec3(0.75, 1.15, 0.05), 0.15);
    let stone = b.object(Material { roughness: 0.2, ior: 1.5, ..matte(vec3(0.6, 0.4, 0.3)) });
    b.sphere(stone, vec3(-0.6, 0.45, 0.0), 0.15);
    let floor = b.object(Material { ior: 1.5, ..matte(vec3(0.6, 0.6, 0.55)) });
    b.quad(floor, vec3(-2.0, 0.0, 2.0), 4.0 * Vec3::X, -4.0 * Vec3::Z);
    let back = b.object(matte(vec3(0.7, 0.5, 0.3)));
    b.quad(back, vec3(-2.0, 0.0, -2.0), 4.0 * Vec3::X, 2.5 * Vec3::Y);
    b.point_light(vec3(0.3, 2.3, 1.4), vec3(6.0, 5.5, 5.0));
    b.environment(vec3(0.3, 0.5, 0.8), vec3(0.08, 0.08, 0.1));
    b.seen_by(Camera::look_at(vec3(0.3, 1.6, 3.6), vec3(-0.1, 0.7, 0.0), 0.75).expect("a valid camera"))
}

pub(super) fn cuboid(b: &mut Builder, object: u32, low: Vec3, high: Vec3) {
    let size = high - low;
    let (x, y, z) = (size.x * Vec3::X, size.y * Vec3::Y, size.z * Vec3::Z);
    let faces = [(low, y, x), (low, z, y), (low, x, z), (high, -x, -y), (high, -y, -z), (high, -z, -x)];
    for (corner, u, v) in faces {
        b.quad(object, corner, u, v);
    }
}
