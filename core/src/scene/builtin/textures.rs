//! Procedural textures of sRGB colour and alpha.

use std::f32::consts::PI;

use glam::{Vec2, Vec3, vec2, vec3};
use libm::{atan2f, cosf, powf, sinf};

use crate::scene::Image8;

/// Side of the square images, in texels.
const SIZE: u32 = 512;

/// Evaluates `color(x, y)` at every texel; x runs to the right and y down, both in [0, 1).
fn paint(color: impl Fn(Vec2) -> (Vec3, f32)) -> Image8 {
    let mut rgba = Vec::with_capacity((SIZE * SIZE * 4) as usize);
    for j in 0..SIZE {
        for i in 0..SIZE {
            let (color, alpha) = color(vec2(i as f32 + 0.5, j as f32 + 0.5) / SIZE as f32);
            let texel = color.extend(alpha).clamp(glam::Vec4::ZERO, glam::Vec4::ONE) * 255.0;
            rgba.extend(texel.to_array().map(|c| c.round() as u8));
        }
    }
    Image8 { width: SIZE, height: SIZE, rgba }
}

/// A pseudo-random number in [0, 1) for a lattice point (the PCG hash of Jarzynski & Olano 2020).
pub(super) fn hash(x: i32, y: i32) -> f32 {
    let mut v = (x as u32).wrapping_mul(0x9e37_79b1) ^ (y as u32).wrapping_mul(0x85eb_ca77);
    v = v.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    v = ((v >> ((v >> 28) + 4)) ^ v).wrapping_mul(277_803_737);
    ((v >> 22 ^ v) >> 8) as f32 / (1 << 24) as f32
}

/// Value noise that repeats after `period` lattice cells.
fn noise(p: Vec2, period: Vec2) -> f32 {
    let cell = p.floor();
    let f = p - cell;
    let f = f * f * (3.0 - 2.0 * f);
    let (x, y) = (cell.x as i32, cell.y as i32);
    let (columns, rows) = (period.x as i32, period.y as i32);
    let at = |dx: i32, dy: i32| hash((x + dx).rem_euclid(columns), (y + dy).rem_euclid(rows));
    let (a, b) = (at(0, 0) * (1.0 - f.x) + at(1, 0) * f.x, at(0, 1) * (1.0 - f.x) + at(1, 1) * f.x);
    a * (1.0 - f.y) + b * f.y
}

/// Four octaves of noise with `cells` lattice cells in the image, in [0, 1].
fn fractal(p: Vec2, cells: Vec2) -> f32 {
    (0..4)
        .map(|octave| {
            let scale = (1 << octave) as f32;
            noise(p * cells * scale, cells * scale) / (2.0 * scale)
        })
        .sum::<f32>()
        / 0.9375
}

/// A smooth line: 1 at distance 0, falling to 0 at a distance of `width`.
fn line(distance: f32, width: f32) -> f32 {
    1.0 - (distance.abs() / width).clamp(0.0, 1.0).powi(4)
}

/// Oak boards that run along x, eight to the image.
pub(super) fn boards() -> Image8 {
    paint(|p| {
        let row = (p.y * 8.0).floor();
        let along = (p.x + 0.37 * row).rem_euclid(1.0);
        let board = (along * 2.0).floor();
        let tone = hash(row as i32, board as i32);
        let shift = vec2(tone, 0.7 * tone);
        let grain = fractal(p + shift, vec2(4.0, 96.0));
        let wave = fractal(p + shift, vec2(3.0, 16.0));
        let rings = 0.5 + 0.5 * sinf((wave * 9.0 + grain * 1.5) * 2.0 * PI);
        let color = vec3(0.60, 0.41, 0.25)
            .lerp(vec3(0.74, 0.55, 0.36), 0.55 * grain + 0.25 * rings + 0.2 * tone)
            * (0.78 + 0.3 * tone);
        let across = (p.y * 8.0).fract();
        let gap = line(across.min(1.0 - across), 0.022)
            .max(line((along * 2.0).fract().min(1.0 - (along * 2.0).fract()), 0.006));
        (color * (1.0 - 0.72 * gap), 1.0)
    })
}

/// Dark wood without joints, for furniture.
pub(super) fn walnut() -> Image8 {
    paint(|p| {
        let grain = fractal(p, vec2(3.0, 64.0));
        let rings = 0.5 + 0.5 * sinf((fractal(p, vec2(2.0, 6.0)) * 8.0 + grain) * 2.0 * PI);
        (vec3(0.33, 0.20, 0.13).lerp(vec3(0.52, 0.34, 0.22), 0.6 * grain + 0.4 * rings), 1.0)
    })
}

/// Whitewashed bricks, eight courses of four.
pub(super) fn bricks() -> Image8 {
    paint(|p| {
        let course = (p.y * 8.0).floor();
        let x = p.x * 4.0 + 0.5 * (course % 2.0);
        let tone = hash((x.floor() as i32).rem_euclid(4) + 17, course as i32);
        let rough = fractal(p, Vec2::splat(32.0));
        let edge =
            (x.fract().min(1.0 - x.fract()) * 2.0).min((p.y * 8.0).fract().min(1.0 - (p.y * 8.0).fract()));
        let mortar = 1.0 - ((edge + 0.05 * (rough - 0.5)) / 0.07).clamp(0.0, 1.0).powi(3);
        let brick = vec3(0.66, 0.36, 0.27).lerp(vec3(0.80, 0.52, 0.40), tone) * (0.8 + 0.35 * rough);
        (brick.lerp(vec3(0.84, 0.81, 0.76) * (0.9 + 0.15 * rough), mortar), 1.0)
    })
}

/// Pale stripes with a small ornament.
pub(super) fn wallpaper() -> Image8 {
    paint(|p| {
        let x = (p.x * 4.0).fract();
        let base = if x < 0.5 { vec3(0.66, 0.75, 0.69) } else { vec3(0.71, 0.79, 0.73) };
        let column = (p.x * 4.0).floor();
        let q = vec2(x - 0.25, (p.y * 4.0 + 0.5 * (column % 2.0)).fract() - 0.5);
        let petals = 0.14 * (0.55 + 0.45 * cosf(4.0 * atan2f(q.y, q.x)));
        let inside = ((petals - q.length()) / 0.02).clamp(0.0, 1.0);
        let stripe = line(x - 0.5, 0.012).max(line(x.min(1.0 - x), 0.012));
        let color =
            base.lerp(vec3(0.86, 0.88, 0.80), 0.75 * inside).lerp(vec3(0.78, 0.74, 0.58), 0.6 * stripe);
        (color * (0.97 + 0.06 * fractal(p, Vec2::splat(64.0))), 1.0)
    })
}

/// A woven carpet with a border and lozenges.
pub(super) fn carpet() -> Image8 {
    paint(|p| {
        let edge = p.x.min(1.0 - p.x).min(p.y.min(1.0 - p.y));
        let (ground, cream, navy) = (vec3(0.58, 0.16, 0.14), vec3(0.88, 0.80, 0.66), vec3(0.15, 0.20, 0.34));
        let lozenge = ((p.x * 6.0).fract() - 0.5).abs() + ((p.y * 4.0).fract() - 0.5).abs();
        let field = match lozenge {
            d if d < 0.14 => cream,
            d if d < 0.26 => navy,
            d if d > 0.44 && d < 0.5 => cream,
            _ => ground,
        };
        let teeth = (((p.x + p.y) * 24.0).fract() - 0.5).abs();
        let color = match edge {
            e if e < 0.02 => cream,
            e if e < 0.075 => navy.lerp(cream, if teeth < 0.15 { 0.8 } else { 0.0 }),
            e if e < 0.09 => cream,
            _ => field,
        };
        let weave = 0.88 + 0.12 * sinf(p.x * 512.0 * PI * 0.25) * sinf(p.y * 512.0 * PI * 0.25);
        (color * weave * (0.85 + 0.3 * fractal(p, Vec2::splat(96.0))), 1.0)
    })
}

/// A picture: hills under an evening sun.
pub(super) fn painting() -> Image8 {
    paint(|p| {
        let stroke = fractal(p, vec2(6.0, 40.0)) - 0.5;
        let mut color = vec3(1.0, 0.80, 0.50)
            .lerp(vec3(0.40, 0.60, 0.80), (1.2 - 1.6 * p.y + 0.5 * stroke).clamp(0.0, 1.0));
        let sun = (p - vec2(0.64, 0.42)).length();
        if sun < 0.12 + 0.01 * stroke {
            color = vec3(0.98, 0.90, 0.66);
        }
        let hills = [
            (0.55, 0.06, 5.0, vec3(0.80, 0.60, 0.62)),
            (0.66, 0.05, 7.0, vec3(0.58, 0.52, 0.62)),
            (0.78, 0.06, 4.0, vec3(0.34, 0.50, 0.48)),
            (0.90, 0.03, 9.0, vec3(0.20, 0.34, 0.26)),
        ];
        for (height, swing, waves, tone) in hills {
            if p.y > height + swing * sinf(p.x * waves + 10.0 * height) + 0.015 * stroke {
                color = tone * (1.0 + 0.5 * stroke);
            }
        }
        (color, 1.0)
    })
}

/// One leaf that points up, cut out by alpha.
pub(super) fn leaf() -> Image8 {
    paint(|p| {
        let (x, t) = ((p.x - 0.5) * 2.0, 1.0 - p.y);
        let half = 0.92 * powf(sinf(PI * powf(t, 0.75)).max(0.0), 0.8) * (1.0 - 0.15 * sinf(t * 40.0).abs());
        let stem = x.abs() < 0.03 && t < 0.12;
        let inside = x.abs() < half || stem;
        let vein = line(x, 0.035).max(0.6 * line(((t - 0.45 * x.abs()) * 9.0).fract() - 0.5, 0.07));
        let color = vec3(0.24, 0.48, 0.16).lerp(vec3(0.42, 0.66, 0.24), fractal(p, Vec2::splat(8.0)));
        (color.lerp(vec3(0.66, 0.80, 0.42), 0.6 * vein), if inside { 1.0 } else { 0.0 })
    })
}
