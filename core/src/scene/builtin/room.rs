//! The room: 4.8 m x 5.2 m and 2.7 m high, furnished, lit by the sun and three lamps.

use std::f32::consts::FRAC_PI_2;

use glam::{Affine3A, Vec2, Vec3, vec2, vec3};

use super::shapes::{Builder, turned};
use super::{furniture, textures};
use crate::scene::camera::Camera;
use crate::scene::{Environment, Light, LightKind, Material, Scene};

/// The corners of the room's box with the least and the greatest coordinates, in metres.
const LOW: Vec3 = vec3(-2.4, 0.0, -2.6);
const HIGH: Vec3 = vec3(2.4, 2.7, 2.6);
/// Two corners of the window in the wall at x = -2.4, as (z, y) in metres.
const WINDOW: [Vec2; 2] = [vec2(-1.45, 0.85), vec2(0.25, 2.25)];
/// Position of the table's centre on the floor (x, z) and the height of its top (y), in metres.
const TABLE: Vec3 = vec3(-0.15, 0.75, -0.75);
/// The centre of the pendant lamp's bulb, in metres.
const PENDANT: Vec3 = vec3(-0.15, 1.72, -0.75);
/// The centre of the floor lamp's foot, in metres.
const FLOOR_LAMP: Vec3 = vec3(2.12, 0.0, -1.78);

fn at(position: Vec3, turn: f32) -> Affine3A {
    Affine3A::from_translation(position) * turned(Vec3::Y, turn)
}

fn colored(r: f32, g: f32, b: f32, roughness: f32) -> Material {
    Material { base_color: vec3(r, g, b), roughness, ..Material::default() }
}

pub(super) fn scene() -> Option<Scene> {
    let mut b = Builder::default();
    shell(&mut b);
    window(&mut b);
    furnish(&mut b);
    on_the_table(&mut b);
    lights(&mut b);
    let eye = vec3(1.55, 1.42, 2.25);
    let main = Camera::look_at(eye, vec3(-0.33, 0.92, -0.9), 50.0_f32.to_radians()).ok()?;
    let table =
        Camera::look_at(vec3(0.75, 1.22, 0.42), vec3(-0.2, 0.82, -0.8), 42.0_f32.to_radians()).ok()?;
    b.scene.cameras = vec![("main".to_owned(), main), ("table".to_owned(), table)];
    Some(b.finish())
}

/// Floor, ceiling and walls; the wall with the window is built in [`window`].
fn shell(b: &mut Builder) {
    let size = HIGH - LOW;
    let (x, y, z) = (Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z);
    let boards = b.texture(textures::boards());
    let paper = b.texture(textures::wallpaper());
    let floor =
        b.material("oak boards", Material { base_color_texture: boards, ..colored(1.0, 1.0, 1.0, 0.18) });
    let paper =
        b.material("wallpaper", Material { base_color_texture: paper, ..colored(1.0, 1.0, 1.0, 0.9) });
    let plaster = b.material("plaster", colored(0.82, 0.77, 0.69, 1.0));
    let white = b.material("white paint", colored(0.86, 0.86, 0.84, 0.55));

    b.object("floor", floor);
    b.quad(LOW + z, x, -z, vec2(size.x, size.z) / 1.3);
    b.object("ceiling", white);
    b.quad(LOW + y, x, z, Vec2::ONE);
    b.object("back wall", paper);
    b.quad(LOW, x, y, vec2(size.x, size.y) / 1.2);
    b.object("right wall", plaster);
    b.quad(LOW + x, z, y, Vec2::ONE);
    b.object("front wall", plaster);
    b.quad(HIGH - y, -x, y, Vec2::ONE);
    b.object("skirting boards", white);
    b.cuboid(LOW, vec3(HIGH.x, 0.1, LOW.z + 0.018), 1.0);
    b.cuboid(vec3(HIGH.x - 0.018, 0.0, LOW.z), vec3(HIGH.x, 0.1, HIGH.z), 1.0);
    b.cuboid(LOW, vec3(LOW.x + 0.018, 0.1, HIGH.z), 1.0);
}

/// The brick wall around the window, its frame, bars and curtains.
fn window(b: &mut Builder) {
    let bricks = b.texture(textures::bricks());
    let bricks =
        b.material("bricks", Material { base_color_texture: bricks, ..colored(1.0, 1.0, 1.0, 0.95) });
    let paint = b.material("window paint", colored(0.9, 0.9, 0.88, 0.3));
    let cloth = b.material("linen", colored(0.80, 0.74, 0.62, 1.0));
    let brass = b.material("curtain rod", Material { metallic: 1.0, ..colored(0.78, 0.62, 0.34, 0.25) });
    let [low, high] = WINDOW;
    let mut wall = |z0: f32, z1: f32, y0: f32, y1: f32| {
        b.object(format!("brick wall {z0} {y0}"), bricks);
        let (u, v) = (Vec3::NEG_Z * (z1 - z0), Vec3::Y * (y1 - y0));
        b.quad(vec3(LOW.x, y0, z1), u, v, vec2(z1 - z0, y1 - y0) / vec2(1.0, 0.6));
    };
    wall(LOW.z, low.x, 0.0, HIGH.y);
    wall(high.x, HIGH.z, 0.0, HIGH.y);
    wall(low.x, high.x, 0.0, low.y);
    wall(low.x, high.x, high.y, HIGH.y);

    // The reveal is 0.25 m deep.
    let (x0, x1, t) = (LOW.x - 0.25, LOW.x + 0.01, 0.03);
    b.object("window reveal", paint);
    b.cuboid(vec3(x0, low.y - t, low.x - t), vec3(x1 + 0.08, low.y, high.x + t), 1.0);
    b.cuboid(vec3(x0, high.y, low.x - t), vec3(x1, high.y + t, high.x + t), 1.0);
    b.cuboid(vec3(x0, low.y, low.x - t), vec3(x1, high.y, low.x), 1.0);
    b.cuboid(vec3(x0, low.y, high.x), vec3(x1, high.y, high.x + t), 1.0);
    b.object("window bars", paint);
    let (x0, x1) = (LOW.x - 0.17, LOW.x - 0.13);
    for i in 0..=3 {
        let z = low.x + (high.x - low.x) * i as f32 / 3.0;
        let half = if i == 0 || i == 3 { 0.035 } else { 0.016 };
        b.cuboid(vec3(x0, low.y, z - half), vec3(x1, high.y, z + half), 1.0);
    }
    for i in 0..=2 {
        let y = low.y + (high.y - low.y) * i as f32 / 2.0;
        let half = if i == 1 { 0.014 } else { 0.035 };
        b.cuboid(vec3(x0 + 0.004, y - half, low.x), vec3(x1 - 0.004, y + half, high.x), 1.0);
    }
    for (name, z) in [("left curtain", high.x + 0.42), ("right curtain", low.x + 0.02)] {
        b.place = at(vec3(LOW.x + 0.10, 0.02, z), FRAC_PI_2);
        furniture::curtain(b, name, cloth, 0.42, 2.4);
    }
    b.place = Affine3A::IDENTITY;
    b.object("curtain rod", brass);
    b.tube(&[vec3(LOW.x + 0.10, 2.44, low.x - 0.5), vec3(LOW.x + 0.10, 2.44, high.x + 0.5)], 0.012, 12);
}

fn furnish(b: &mut Builder) {
    let walnut = b.texture(textures::walnut());
    let wood = b.material("walnut", Material { base_color_texture: walnut, ..colored(1.0, 1.0, 1.0, 0.3) });
    let black = b.material("black steel", Material { metallic: 0.0, ..colored(0.03, 0.03, 0.035, 0.35) });
    let carpet = b.texture(textures::carpet());
    let carpet = b.material("carpet", Material { base_color_texture: carpet, ..colored(1.0, 1.0, 1.0, 1.0) });
    let gold = b.material("gilt", Material { metallic: 1.0, ..colored(0.83, 0.64, 0.30, 0.3) });
    let mirror = b.material("mirror", Material { metallic: 1.0, ..colored(0.93, 0.94, 0.94, 0.0) });
    let picture = b.texture(textures::painting());
    let picture =
        b.material("painting", Material { base_color_texture: picture, ..colored(1.0, 1.0, 1.0, 0.8) });
    let books =
        [(0.55, 0.12, 0.10), (0.10, 0.22, 0.38), (0.72, 0.58, 0.24), (0.13, 0.32, 0.22), (0.80, 0.76, 0.66)];
    let books = books.map(|(r, g, bl)| b.material("book", colored(r, g, bl, 0.7)));

    b.object("carpet", carpet);
    b.cuboid(vec3(-1.35, 0.0, -1.65), vec3(1.05, 0.008, 0.15), 0.0);
    b.quad(vec3(-1.35, 0.0085, 0.15), Vec3::X * 2.4, Vec3::NEG_Z * 1.8, Vec2::ONE);
    b.place = at(TABLE.with_y(0.0), 0.0);
    furniture::table(b, wood);
    let seats = [
        ("chair 1", vec3(0.38, 0.0, 0.12), 3.3, (0.80, 0.49, 0.10)),
        ("chair 2", vec3(-0.62, 0.0, 0.02), 2.9, (0.08, 0.33, 0.36)),
        ("chair 3", vec3(-0.45, 0.0, -1.42), 0.1, (0.80, 0.49, 0.10)),
        ("chair 4", vec3(0.35, 0.0, -1.40), -0.25, (0.08, 0.33, 0.36)),
    ];
    for (name, position, turn, (r, g, bl)) in seats {
        let seat = b.material("lacquer", colored(r, g, bl, 0.22));
        b.place = at(position, turn);
        furniture::chair(b, name, black, seat);
    }
    b.place = at(vec3(-0.25, 0.0, LOW.z + 0.02), 0.0);
    furniture::sideboard(b, wood, gold, &books);
    b.place = at(vec3(-0.25, 1.62, LOW.z), 0.0);
    furniture::framed(b, "painting", vec2(1.15, 0.8), gold, picture);
    b.place = at(vec3(1.42, 0.93, -2.22), -0.55);
    furniture::framed(b, "standing mirror", vec2(0.78, 1.76), gold, mirror);

    let clay = b.material("clay", colored(0.62, 0.30, 0.19, 0.8));
    let soil = b.material("soil", colored(0.09, 0.06, 0.04, 1.0));
    let stem = b.material("stem", colored(0.20, 0.34, 0.10, 0.7));
    let leaf = b.texture(textures::leaf());
    let leaf = b.material(
        "leaf",
        Material { base_color_texture: leaf, alpha_cutoff: Some(0.5), ..colored(1.0, 1.0, 1.0, 0.6) },
    );
    b.place = at(vec3(-1.78, 0.0, -2.02), 0.4);
    furniture::plant(b, clay, soil, stem, leaf);
    b.place = Affine3A::IDENTITY;
}

fn on_the_table(b: &mut Builder) {
    let glass = b.material(
        "glass",
        Material { transmission: 1.0, casts_shadow: false, ..colored(0.98, 1.0, 0.99, 0.0) },
    );
    let silver = b.material("silver", Material { metallic: 1.0, ..colored(0.95, 0.94, 0.92, 0.0) });
    let brass = b.material("brass", Material { metallic: 1.0, ..colored(0.98, 0.76, 0.33, 0.15) });
    let glaze = b.material("glaze", colored(0.05, 0.16, 0.42, 0.08));
    let china = b.material("china", colored(0.88, 0.87, 0.83, 0.12));
    let orange = b.material("orange", colored(0.90, 0.36, 0.04, 0.4));
    b.place = Affine3A::from_translation(TABLE);

    b.sphere("glass sphere", glass, vec3(0.12, 0.13, 0.20), 0.13);
    b.sphere("mirror sphere", silver, vec3(0.46, 0.115, -0.12), 0.115);
    b.object("vase", glaze);
    let profile = [
        vec2(0.0, 0.0),
        vec2(0.055, 0.0),
        vec2(0.085, 0.07),
        vec2(0.095, 0.14),
        vec2(0.065, 0.23),
        vec2(0.032, 0.30),
        vec2(0.034, 0.36),
        vec2(0.052, 0.39),
        vec2(0.046, 0.385),
        vec2(0.026, 0.35),
        vec2(0.026, 0.28),
    ];
    b.lathe(vec3(-0.06, 0.0, -0.19), &profile, [56, 60]);
    b.object("ring", brass);
    b.torus(vec3(-0.44, 0.028, 0.24), Vec3::Y, [0.095, 0.028], [64, 24]);
    b.object("bowl", china);
    let bowl = [
        vec2(0.0, 0.0),
        vec2(0.06, 0.0),
        vec2(0.065, 0.012),
        vec2(0.12, 0.045),
        vec2(0.16, 0.095),
        vec2(0.155, 0.098),
        vec2(0.11, 0.05),
        vec2(0.05, 0.022),
        vec2(0.0, 0.02),
    ];
    let center = vec3(-0.42, 0.0, -0.12);
    b.lathe(center, &bowl, [56, 40]);
    for (i, (x, y, z)) in
        [(-0.052, 0.072, 0.02), (0.045, 0.07, 0.045), (0.01, 0.072, -0.05), (0.0, 0.132, 0.005)]
            .into_iter()
            .enumerate()
    {
        b.sphere(format!("orange {i}"), orange, center + vec3(x, y, z), 0.043);
    }
    b.place = Affine3A::IDENTITY;
}

fn lights(b: &mut Builder) {
    let shade = b.material("enamel", colored(0.07, 0.22, 0.20, 0.2));
    let wire = b.material("cord", colored(0.04, 0.04, 0.04, 0.6));
    let steel = b.material("steel", Material { metallic: 1.0, ..colored(0.7, 0.7, 0.7, 0.25) });
    let paper = b.material(
        "lamp paper",
        Material { emission: vec3(0.62, 0.46, 0.26), ..colored(0.8, 0.72, 0.58, 1.0) },
    );
    let bulb = b.material("bulb", Material { emission: vec3(6.0, 5.0, 3.6), ..colored(0.0, 0.0, 0.0, 1.0) });
    b.place = at(PENDANT, 0.0);
    furniture::pendant(b, HIGH.y - PENDANT.y, shade, wire, bulb);
    b.place = at(FLOOR_LAMP, 0.0);
    furniture::floor_lamp(b, steel, paper, bulb);
    b.place = Affine3A::IDENTITY;

    let (from, to) = (vec3(-0.25, 2.62, -1.55), vec3(-0.25, 1.55, LOW.z));
    let direction = (to - from).normalize();
    b.object("spotlight", steel);
    b.tube(&[from - direction * 0.16, from - direction * 0.03], 0.035, 20);
    b.tube(&[from - direction * 0.07, (from - direction * 0.07).with_y(HIGH.y)], 0.008, 8);

    let point = |position: Vec3, intensity: Vec3| Light {
        kind: LightKind::Point { position, range: f32::INFINITY, falloff: true },
        intensity,
        radius: 0.041,
    };
    b.scene.lights = vec![
        Light {
            kind: LightKind::Directional { direction: vec3(0.78, -0.56, 0.16).normalize() },
            intensity: vec3(1.0, 0.88, 0.70) * 10.0,
            radius: 0.0,
        },
        point(PENDANT, vec3(1.0, 0.84, 0.62) * 3.0),
        point(FLOOR_LAMP.with_y(1.5), vec3(1.0, 0.78, 0.52) * 2.4),
        Light {
            kind: LightKind::Spot { position: from, range: f32::INFINITY, direction, cone: 0.22..0.5 },
            intensity: vec3(1.0, 0.93, 0.82) * 9.0,
            radius: 0.0,
        },
    ];
    let ambient = vec3(0.25, 0.26, 0.28);
    b.scene.environment =
        Environment { background: vec3(0.72, 0.86, 1.05), ambient, fallback_radiance: ambient };
}
