//! Heckbert's minimal ray tracer (Graphics Gems IV, 1994), after its rules, in f64. Simple and slow; it
//! shares no code with the renderer.
//!
//! World space: x right, y forward, z up; the eye is at the origin.

use glam::{DVec3, dvec3};

/// Side of the square frame in pixels.
pub const SIZE: u32 = 32;

/// Number of ray levels.
pub const LEVELS: u32 = 3;

/// Ambient radiance, and the radiance of rays that hit nothing.
pub const AMBIENT: DVec3 = DVec3::splat(0.02);

const NEAREST: f64 = 1e-7;
const HALF_FOV_DEGREES: f64 = 12.5;

/// One of the five spheres of minray.
struct Sphere {
    center: DVec3,
    color: DVec3,
    radius: f64,
    diffuse: f64,
    mirror: f64,
    transparent: f64,
    luminous: f64,
    index: f64,
}

#[rustfmt::skip]
const SPHERES: [Sphere; 5] = [
    Sphere { center: dvec3( 0.0,  6.0,  0.5), color: dvec3(1.0, 1.0, 1.0), radius: 0.9, diffuse: 0.05, mirror: 0.2, transparent: 0.85, luminous: 0.0,  index: 1.7 },
    Sphere { center: dvec3(-1.0,  8.0, -0.5), color: dvec3(1.0, 0.5, 0.2), radius: 1.0, diffuse: 0.7,  mirror: 0.3, transparent: 0.0,  luminous: 0.05, index: 1.2 },
    Sphere { center: dvec3( 1.0,  8.0, -0.5), color: dvec3(0.1, 0.8, 0.8), radius: 1.0, diffuse: 0.3,  mirror: 0.7, transparent: 0.0,  luminous: 0.0,  index: 1.2 },
    Sphere { center: dvec3( 3.0, -6.0, 15.0), color: dvec3(1.0, 0.8, 1.0), radius: 7.0, diffuse: 0.0,  mirror: 0.0, transparent: 0.0,  luminous: 0.6,  index: 1.5 },
    Sphere { center: dvec3(-3.0, -3.0, 12.0), color: dvec3(0.8, 1.0, 1.0), radius: 5.0, diffuse: 0.0,  mirror: 0.0, transparent: 0.0,  luminous: 0.5,  index: 1.5 },
];

/// Radiance of a pixel and a hash of the surfaces that its rays hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// Linear RGB radiance.
    pub radiance: DVec3,
    /// Sphere hit by the primary ray.
    pub object: Option<usize>,
    /// Hash of all surfaces that the tree of rays hit: if it differs between neighbours, an edge (a
    /// silhouette, a shadow, a mirrored or refracted one) runs between them.
    pub trail: u64,
}

/// The picture, row by row from the top left.
#[must_use]
pub fn picture() -> Vec<Pixel> {
    (0..SIZE).flat_map(|j| (0..SIZE).map(move |i| pixel(i, j, LEVELS))).collect()
}

/// Pixel `i` from the left and `j` from the top, with `levels` levels of rays.
#[must_use]
pub fn pixel(i: u32, j: u32, levels: u32) -> Pixel {
    let half = f64::from(SIZE / 2);
    let distance = half / HALF_FOV_DEGREES.to_radians().tan();
    let direction = dvec3(f64::from(i) - half, distance, half - f64::from(j)).normalize();
    let mut trail = 0;
    let radiance = trace(DVec3::ZERO, direction, levels, &mut trail);
    Pixel { radiance, object: nearest(DVec3::ZERO, direction).map(|(s, _)| s), trail }
}

/// Whether an edge runs between pixel `(i, j)` and one of its eight neighbours.
#[must_use]
pub fn at_edge(picture: &[Pixel], i: u32, j: u32) -> bool {
    let size = SIZE as usize;
    let (i, j) = (i as usize, j as usize);
    let around = |k: usize| k.saturating_sub(1)..=(k + 1).min(size - 1);
    around(j).any(|y| around(i).any(|x| picture[y * size + x].trail != picture[j * size + i].trail))
}

fn nearest(origin: DVec3, direction: DVec3) -> Option<(usize, f64)> {
    let mut best: Option<(usize, f64)> = None;
    for (index, sphere) in SPHERES.iter().enumerate() {
        let to_center = sphere.center - origin;
        let b = direction.dot(to_center);
        let u = b * b - to_center.length_squared() + sphere.radius * sphere.radius;
        if u <= 0.0 {
            continue;
        }
        let root = u.sqrt();
        let t = if b - root > NEAREST { b - root } else { b + root };
        if t >= NEAREST && best.is_none_or(|(_, nearest)| t < nearest) {
            best = Some((index, t));
        }
    }
    best
}

fn trace(origin: DVec3, direction: DVec3, level: u32, trail: &mut u64) -> DVec3 {
    if level == 0 {
        return DVec3::ZERO;
    }
    let hit = nearest(origin, direction);
    remember(trail, hit.map_or(9, |(index, _)| index as u64));
    let Some((index, t)) = hit else { return AMBIENT };
    let sphere = &SPHERES[index];
    let point = origin + t * direction;

    // The normal faces the viewer; eta is the index on the viewer's side over the other.
    let mut normal = (sphere.center - point).normalize();
    let mut d = -direction.dot(normal);
    let mut eta = sphere.index;
    if d < 0.0 {
        normal = -normal;
        eta = 1.0 / eta;
        d = -d;
    }

    let mut local = AMBIENT;
    for (number, light) in SPHERES.iter().enumerate() {
        let towards = (light.center - point).normalize();
        let strength = light.luminous * normal.dot(towards);
        if strength > 0.0 {
            let seen = nearest(point, towards).is_some_and(|(first, _)| first == number);
            remember(trail, 10 + u64::from(seen));
            if seen {
                local += strength * light.color;
            }
        }
    }
    local *= sphere.color;

    let mut radiance = sphere.diffuse * local + sphere.luminous * sphere.color;
    if sphere.transparent > 0.0 {
        let e = 1.0 - eta * eta * (1.0 - d * d);
        remember(trail, 12 + u64::from(e > 0.0));
        if e > 0.0 {
            let refracted = eta * direction + (eta * d - e.sqrt()) * normal;
            radiance += sphere.transparent * trace(point, refracted, level - 1, trail);
        }
    }
    if sphere.mirror > 0.0 {
        radiance += sphere.mirror * trace(point, direction + 2.0 * d * normal, level - 1, trail);
    }
    radiance
}

/// Mixes a word into an FNV-1a hash.
fn remember(trail: &mut u64, what: u64) {
    *trail = (*trail ^ (what + 1)).wrapping_mul(0x0000_0100_0000_01b3);
}
