//! The furniture of the room. Every piece is built around its foot at the origin of the builder's transform.

use std::f32::consts::{PI, TAU};

use glam::{Affine3A, Vec2, Vec3, vec2, vec3};
use libm::{cosf, sincosf, sinf};

use super::shapes::{Builder, turned};
use super::textures::hash;

/// A wire chair that looks along +z: seat at 0.46 m, legs of 22 mm, spindles of 7 mm.
pub(super) fn chair(b: &mut Builder, name: &str, frame: u32, seat: u32) {
    b.object(format!("{name}, frame"), frame);
    for (x, z) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
        b.tube(&[vec3(x * 0.21, 0.0, z * 0.21), vec3(x * 0.16, 0.45, z * 0.16)], 0.011, 12);
    }
    for side in [-1.0, 1.0] {
        b.tube(&[vec3(side * 0.19, 0.18, -0.19), vec3(side * 0.19, 0.18, 0.19)], 0.006, 8);
        b.tube(&[vec3(side * 0.17, 0.46, -0.18), vec3(side * 0.20, 0.88, -0.27)], 0.010, 12);
    }
    b.tube(&[vec3(-0.19, 0.18, 0.0), vec3(0.19, 0.18, 0.0)], 0.006, 8);
    for i in 0..5 {
        let x = (i as f32 - 2.0) / 2.0;
        b.tube(&[vec3(x * 0.12, 0.47, -0.185), vec3(x * 0.15, 0.87, -0.265)], 0.0035, 8);
    }
    b.object(format!("{name}, seat"), seat);
    b.cuboid(vec3(-0.21, 0.45, -0.21), vec3(0.21, 0.478, 0.21), 2.0);
    let rail: Vec<_> = (0..=8)
        .map(|i| (i as f32 / 4.0) - 1.0)
        .map(|x| vec3(x * 0.21, 0.88, -0.27 + 0.035 * (x * x - 1.0)))
        .collect();
    b.tube(&rail, 0.017, 12);
}

/// A table 1.5 m x 0.9 m, top at 0.75 m.
pub(super) fn table(b: &mut Builder, wood: u32) {
    b.object("table, top", wood);
    b.cuboid(vec3(-0.75, 0.715, -0.45), vec3(0.75, 0.75, 0.45), 0.9);
    b.object("table, legs", wood);
    for (x, z) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
        let foot = vec3(x * 0.68, 0.0, z * 0.38);
        b.lathe(foot, &[vec2(0.014, 0.0), vec2(0.018, 0.3), vec2(0.024, 0.55), vec2(0.028, 0.715)], [16, 8]);
    }
    for side in [-1.0, 1.0] {
        b.cuboid(vec3(-0.66, 0.655, side * 0.38 - 0.01), vec3(0.66, 0.715, side * 0.38 + 0.01), 0.9);
    }
}

/// A lamp with its bulb at the origin, which hangs from a ceiling `ceiling` metres above on a cord and three
/// wires.
pub(super) fn pendant(b: &mut Builder, ceiling: f32, shade: u32, wire: u32, bulb: u32) {
    b.object("pendant lamp, shade", shade);
    let outside =
        [vec2(0.26, -0.05), vec2(0.235, 0.03), vec2(0.15, 0.11), vec2(0.045, 0.15), vec2(0.02, 0.19)];
    b.lathe(Vec3::ZERO, &outside, [48, 16]);
    b.object("pendant lamp, wires", wire);
    b.tube(&[Vec3::Y * 0.04, Vec3::Y * ceiling], 0.003, 8);
    for i in 0..3 {
        let (sin, cos) = sincosf(TAU * (i as f32 / 3.0 + 0.1));
        b.tube(&[vec3(0.235 * sin, 0.03, 0.235 * cos), Vec3::Y * (0.75 * ceiling)], 0.0015, 6);
    }
    b.sphere("pendant lamp, bulb", bulb, Vec3::ZERO, 0.04);
}

/// A floor lamp: thin pole, shade, bulb at a height of 1.5 m.
pub(super) fn floor_lamp(b: &mut Builder, pole: u32, shade: u32, bulb: u32) {
    b.object("floor lamp, pole", pole);
    b.lathe(Vec3::ZERO, &[vec2(0.14, 0.0), vec2(0.138, 0.012), vec2(0.10, 0.022), vec2(0.0, 0.026)], [32, 6]);
    b.tube(&[Vec3::ZERO, Vec3::Y * 1.46], 0.009, 12);
    b.object("floor lamp, shade", shade);
    b.lathe(Vec3::ZERO, &[vec2(0.21, 1.36), vec2(0.185, 1.50), vec2(0.15, 1.66)], [48, 4]);
    b.sphere("floor lamp, bulb", bulb, Vec3::Y * 1.5, 0.04);
}

/// A potted plant with leaves cut out by alpha.
pub(super) fn plant(b: &mut Builder, clay: u32, soil: u32, stem: u32, leaf: u32) {
    b.object("plant, pot", clay);
    let pot = [
        vec2(0.0, 0.0),
        vec2(0.13, 0.0),
        vec2(0.16, 0.14),
        vec2(0.185, 0.29),
        vec2(0.20, 0.30),
        vec2(0.175, 0.31),
    ];
    b.lathe(Vec3::ZERO, &pot, [40, 20]);
    b.object("plant, soil", soil);
    b.lathe(Vec3::ZERO, &[vec2(0.18, 0.28), vec2(0.09, 0.30), vec2(0.0, 0.295)], [24, 2]);
    let leaves: Vec<_> = (0..19)
        .map(|i| {
            let r = |k| hash(i, k);
            let turn = i as f32 * 2.4 + 0.5 * r(1);
            let out = vec3(sinf(turn), 0.0, cosf(turn));
            (out, 0.38 + 0.62 * r(2), 0.42 + 0.25 * r(3), 0.35 + 0.75 * r(4))
        })
        .collect();
    let foot = |out: Vec3, height: f32| out * (0.05 + 0.14 * height) + Vec3::Y * (0.30 + 0.62 * height);
    b.object("plant, stems", stem);
    for (out, height, _, _) in &leaves {
        b.tube(&[*out * 0.04 + Vec3::Y * 0.28, foot(*out, *height)], 0.005, 6);
    }
    b.object("plant, leaves", leaf);
    for (out, height, length, bend) in &leaves {
        let foot = foot(*out, *height);
        let side = Vec3::Y.cross(*out);
        b.surface([1, 6], Vec2::ONE, |s, t| {
            // A circular arc that starts steeply and bends outwards.
            let angle = 1.15 - 2.0 * bend * t;
            let mean = 1.15 - bend * t;
            let along = *out * cosf(mean) + Vec3::Y * sinf(mean);
            let normal = (Vec3::Y * cosf(angle) - *out * sinf(angle)).normalize();
            (foot + along * (length * t) - side * ((s - 0.5) * 0.42 * length), normal)
        });
    }
}

/// A low cupboard 1.7 m wide with two doors and books on it; its back is at z = 0.
pub(super) fn sideboard(b: &mut Builder, wood: u32, metal: u32, books: &[u32]) {
    b.object("sideboard", wood);
    b.cuboid(vec3(-0.85, 0.14, 0.02), vec3(0.85, 0.66, 0.42), 1.2);
    b.cuboid(vec3(-0.88, 0.66, 0.0), vec3(0.88, 0.69, 0.45), 1.2);
    for i in 0..3 {
        let x = -0.84 + 0.565 * i as f32;
        b.cuboid(vec3(x, 0.155, 0.42), vec3(x + 0.55, 0.645, 0.435), 0.9);
    }
    b.object("sideboard, legs and knobs", metal);
    for (x, z) in [(-0.8, 0.06), (0.8, 0.06), (-0.8, 0.37), (0.8, 0.37)] {
        b.tube(&[vec3(x, 0.0, z), vec3(x, 0.14, z)], 0.012, 12);
    }
    for i in 0..3 {
        let x = -0.84 + 0.565 * i as f32 + 0.275;
        b.torus(vec3(x, 0.57, 0.445), Vec3::Z, [0.022, 0.004], [24, 8]);
    }
    let place = b.place;
    let mut x = -0.80;
    for i in 0..13 {
        let (width, height) = (0.022 + 0.03 * hash(i, 11), 0.20 + 0.08 * hash(i, 12));
        let lean = if i == 12 { -0.22 } else { 0.0 };
        let foot = vec3(x + if i == 12 { 0.07 } else { 0.0 }, 0.69, 0.10);
        b.place = place * Affine3A::from_translation(foot) * turned(Vec3::Z, -lean);
        b.object(format!("book {i}"), books[(hash(i, 13) * books.len() as f32) as usize % books.len()]);
        b.cuboid(Vec3::ZERO, vec3(width, height, 0.16 + 0.03 * hash(i, 14)), 1.0);
        x += width + 0.002;
    }
    b.place = place;
}

/// A painting or mirror of `size` with its centre at the origin, in a frame, facing +z.
pub(super) fn framed(b: &mut Builder, name: &str, size: Vec2, frame: u32, face: u32) {
    let h = 0.5 * size;
    b.object(name, face);
    b.quad(vec3(-h.x, -h.y, 0.012), Vec3::X * size.x, Vec3::Y * size.y, Vec2::ONE);
    b.object(format!("{name}, frame"), frame);
    let w = 0.045;
    b.cuboid(vec3(-h.x - w, -h.y - w, 0.0), vec3(h.x + w, -h.y, 0.03), 2.0);
    b.cuboid(vec3(-h.x - w, h.y, 0.0), vec3(h.x + w, h.y + w, 0.03), 2.0);
    b.cuboid(vec3(-h.x - w, -h.y, 0.0), vec3(-h.x, h.y, 0.03), 2.0);
    b.cuboid(vec3(h.x, -h.y, 0.0), vec3(h.x + w, h.y, 0.03), 2.0);
}

/// A pleated curtain from the floor to `height`, along +x from the origin, facing +z.
pub(super) fn curtain(b: &mut Builder, name: &str, cloth: u32, width: f32, height: f32) {
    b.object(name, cloth);
    let folds = (width / 0.09).round();
    b.surface([(folds * 12.0) as u32, 1], Vec2::ONE, |s, t| {
        let phase = s * folds * TAU;
        let depth = 0.028 * (0.8 + 0.2 * sinf(s * 3.0 * PI));
        let slope = depth * cosf(phase) * folds * TAU / width;
        (vec3(s * width, t * height, depth * sinf(phase)), vec3(-slope, 0.0, 1.0).normalize())
    });
}
