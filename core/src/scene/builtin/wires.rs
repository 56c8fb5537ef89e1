//! Two thousand wires, rods and balls in front of a plain wall, each an object of its own, from clearly visible
//! down to one pixel wide in a frame of [`ROWS`] rows. It shows which objects undersampling misses.
//!
//! It also needs the fewest features of all scenes: flat, matte triangles and one light.

use std::f32::consts::TAU;

use glam::{Affine3A, Quat, Vec2, Vec3, vec3};
use libm::{cosf, powf, sinf, tanf};

use super::shapes::Builder;
use super::textures::hash;
use crate::scene::camera::Camera;
use crate::scene::{Environment, Light, LightKind, Material, Scene};

/// Rows of the frame in which the thinnest things are one pixel wide.
const ROWS: f32 = 1440.0;
/// Things lie in the cells of a grid over a frame of this shape, so that few hide each other.
const CELLS: [i32; 2] = [60, 34];
const ASPECT: f32 = 16.0 / 9.0;
const THINGS: i32 = 2000;
const FIELD_OF_VIEW: f32 = 0.7;
const EYE: Vec3 = vec3(0.0, 1.6, 6.0);
/// Distance of the wall from the camera, in metres.
const WALL: f32 = 10.0;
/// Widths in pixels of a frame of [`ROWS`] rows; half of the things are thinner than the geometric mean.
const WIRE_WIDTHS: [f32; 2] = [1.0, 2.5];
const ROD_WIDTHS: [f32; 2] = [1.0, 14.0];
/// Balls are polyhedra, whose outline lies up to a tenth of the radius inside the sphere's.
const BALL_WIDTHS: [f32; 2] = [1.1, 24.0];

pub(super) fn scene() -> Option<Scene> {
    let mut b = Builder::default();
    let matte = |color: Vec3| Material { base_color: color, ..Material::default() };
    let grey = b.material("stage", matte(Vec3::splat(0.72)));
    let colors = [
        vec3(0.10, 0.10, 0.11),
        vec3(0.62, 0.12, 0.08),
        vec3(0.10, 0.32, 0.55),
        vec3(0.16, 0.42, 0.16),
        vec3(0.80, 0.62, 0.16),
        vec3(0.90, 0.90, 0.88),
    ];
    let paints: Vec<_> = colors
        .iter()
        .enumerate()
        .map(|(i, color)| b.material(&format!("paint {i}"), matte(*color)))
        .collect();
    let wall = vec3(-12.0, 0.0, EYE.z - WALL);
    b.object("floor", grey);
    b.quad(wall + Vec3::Z * (WALL + 2.0), Vec3::X * 24.0, -Vec3::Z * (WALL + 2.0), Vec2::ONE);
    b.object("wall", grey);
    b.quad(wall, Vec3::X * 24.0, Vec3::Y * 9.0, Vec2::ONE);
    for i in 0..THINGS {
        thing(&mut b, i, &paints);
    }
    b.scene.lights.push(Light {
        kind: LightKind::Point { position: vec3(-6.0, 9.0, 9.0), range: f32::INFINITY, falloff: true },
        intensity: vec3(1.0, 0.96, 0.9) * 600.0,
        radius: 0.0,
    });
    b.scene.environment = Environment::with_background(Vec3::splat(0.2));
    let camera = Camera::look_at(EYE, EYE - Vec3::Z, FIELD_OF_VIEW).ok()?;
    b.scene.cameras.push(("main".to_owned(), camera));
    Some(b.finish())
}

/// Adds the thing with this index; kind, place, direction, size and colour are hashes of the index.
fn thing(b: &mut Builder, index: i32, paints: &[u32]) {
    let draw = |what: i32| hash(index, what);
    let paint = paints[(draw(0) * paints.len() as f32) as usize % paints.len()];
    let tangent = tanf(0.5 * FIELD_OF_VIEW);
    let cell = [index % CELLS[0], index / CELLS[0]];
    let place = |axis: usize| 2.0 * (cell[axis] as f32 + draw(1 + axis as i32)) / CELLS[axis] as f32 - 1.0;
    let forward = vec3(place(0) * ASPECT * tangent, place(1) * tangent, -1.0);
    // Depth between the eye and what is behind: the wall or the floor.
    let floor = if forward.y < 0.0 { EYE.y / -forward.y } else { WALL };
    let depth = WALL.min(floor) * (0.6 + 0.35 * draw(3));
    let center = EYE + depth * forward;
    let pixel = 2.0 * tangent * depth / ROWS;
    // Log-uniform: as many thin things as thick ones.
    let between = |[low, high]: [f32; 2]| low * powf(high / low, draw(4));
    let direction = {
        let (height, turn) = (2.0 * draw(5) - 1.0, TAU * draw(6));
        let radius = (1.0 - height * height).sqrt();
        vec3(radius * cosf(turn), height, radius * sinf(turn))
    };
    let kind = draw(8);
    if kind < 0.45 {
        b.object(format!("wire {index}"), paint);
        bar(b, center, direction * (70.0 + 170.0 * draw(7)) * pixel, between(WIRE_WIDTHS) * pixel);
    } else if kind < 0.75 {
        let width = between(ROD_WIDTHS) * pixel;
        b.object(format!("rod {index}"), paint);
        bar(b, center, direction * (4.0 + 6.0 * draw(7)) * width, width);
    } else {
        b.object(format!("ball {index}"), paint);
        b.ball(center, 0.5 * between(BALL_WIDTHS) * pixel, 3);
    }
}

/// A bar of square section along `along`, with its centre at `center`.
fn bar(b: &mut Builder, center: Vec3, along: Vec3, width: f32) {
    let length = along.length();
    let turn = Quat::from_rotation_arc(Vec3::Y, along / length);
    b.place = Affine3A::from_rotation_translation(turn, center);
    let half = 0.5 * vec3(width, length, width);
    b.cuboid(-half, half, 1.0);
    b.place = Affine3A::IDENTITY;
}
