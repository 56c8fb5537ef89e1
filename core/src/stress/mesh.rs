//! Closed meshes and how they become scenes.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3, Vec3, dvec3};

use super::Random;
use crate::{
    Scene,
    scene::{Environment, Material, Object, octahedral_encode},
};

/// Triangles with their corners in f64; whoever shares a corner has the same bits.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub triangles: Vec<[DVec3; 3]>,
}

/// How triangles are grouped into objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objects {
    One,
    EachTriangle,
}

impl Mesh {
    /// A tetrahedron whose faces are split into four `levels` times, with its corners on the unit sphere: 4 x 4^levels
    /// triangles.
    pub fn sphere(levels: u32) -> Self {
        let [a, b, c, d] =
            [dvec3(1.0, 1.0, 1.0), dvec3(1.0, -1.0, -1.0), dvec3(-1.0, 1.0, -1.0), dvec3(-1.0, -1.0, 1.0)]
                .map(DVec3::normalize);
        let mut triangles = vec![[a, b, c], [a, d, b], [a, c, d], [b, d, c]];
        for _ in 0..levels {
            triangles = triangles
                .into_iter()
                .flat_map(|[a, b, c]| {
                    // The sum does not depend on the order: neighbours compute the same bits.
                    let [ab, bc, ca] = [a + b, b + c, c + a].map(DVec3::normalize);
                    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
                })
                .collect();
        }
        Self { triangles }
    }

    /// Two fans of `count` / 2 triangles back to back: needles that meet in the poles.
    pub fn fans(count: u32) -> Self {
        let sides = count / 2;
        let rim = |i: u32| {
            let phi = TAU * f64::from(i % sides) / f64::from(sides);
            dvec3(phi.cos(), 0.0, phi.sin())
        };
        let fan = |pole: DVec3, turn: u32| (0..sides).map(move |i| [pole, rim(i + turn), rim(i + 1 - turn)]);
        Self { triangles: fan(dvec3(0.0, 0.7, 0.0), 1).chain(fan(dvec3(0.0, -0.7, 0.0), 0)).collect() }
    }

    /// A torus of radii 1 and 0.4, of 2 x `around` x `tube` triangles.
    pub fn torus(around: u32, tube: u32) -> Self {
        let corner = |i: u32, j: u32| {
            let theta = TAU * f64::from(i % around) / f64::from(around);
            let phi = TAU * f64::from(j % tube) / f64::from(tube);
            let ring = 1.0 + 0.4 * phi.cos();
            dvec3(ring * theta.cos(), 0.4 * phi.sin(), ring * theta.sin())
        };
        let quads = (0..around).flat_map(|i| (0..tube).map(move |j| (i, j)));
        let triangles = quads.flat_map(|(i, j)| {
            let [a, b, c, d] = [corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)];
            [[a, b, c], [a, c, d]]
        });
        Self { triangles: triangles.collect() }
    }

    /// Turned, then moved, then every coordinate rounded to f32, which keeps it closed.
    #[must_use]
    pub fn placed(&self, turn: DMat3, by: DVec3) -> Self {
        let place = |p: DVec3| (turn * p + by).as_vec3().as_dvec3();
        Self { triangles: self.triangles.iter().map(|t| t.map(place)).collect() }
    }

    /// Every coordinate rounded to a multiple of `step`: differences of such points are exact in f32.
    #[must_use]
    pub fn snapped(&self, step: f64) -> Self {
        Self { triangles: self.triangles.iter().map(|t| t.map(|p| (p / step).round() * step)).collect() }
    }

    /// How often the surface winds around a point: the sum of the solid angles of its triangles (Van Oosterom and
    /// Strackee 1983) over that of the sphere. Not an integer where the point lies on the surface.
    pub fn winding(&self, point: DVec3) -> f64 {
        let solid = |corners: &[DVec3; 3]| {
            let [a, b, c] = corners.map(|p| p - point);
            let (la, lb, lc) = (a.length(), b.length(), c.length());
            let volume = a.dot(b.cross(c));
            let around = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
            2.0 * volume.atan2(around)
        };
        self.triangles.iter().map(solid).sum::<f64>() / (2.0 * TAU)
    }

    /// Each edge of a closed mesh has two sides.
    #[cfg(test)]
    pub fn is_closed(&self) -> bool {
        let key = |p: DVec3| p.to_array().map(f64::to_bits);
        let mut balance = std::collections::HashMap::<_, i32>::new();
        for [a, b, c] in &self.triangles {
            for (p, q) in [(a, b), (b, c), (c, a)] {
                *balance.entry((key(*p), key(*q))).or_default() += 1;
                *balance.entry((key(*q), key(*p))).or_default() -= 1;
            }
        }
        balance.values().all(|n| *n == 0)
    }

    /// As a scene; the coordinates must be f32 already.
    pub fn scene(&self, material: Material, objects: Objects) -> Scene {
        let mut scene = bare(material);
        scene.objects.clear();
        self.add_to(&mut scene, objects);
        scene
    }

    /// Adds the triangles, with flat normals and the first material.
    pub fn add_to(&self, scene: &mut Scene, objects: Objects) {
        for (i, triangle) in self.triangles.iter().enumerate() {
            if i == 0 || objects == Objects::EachTriangle {
                let name = format!("object {}", scene.objects.len());
                scene.objects.push(Object { name, material: 0 });
            }
            let [a, b, c] = *triangle;
            let normal = (b - a).cross(c - a).try_normalize().unwrap_or(DVec3::Y);
            scene.positions.push(triangle.map(|p| p.as_vec3()));
            scene.normals.push([octahedral_encode(normal.as_vec3()); 3]);
            scene.triangle_objects.push(scene.objects.len() as u32 - 1);
        }
    }
}

/// A scene with a material and nothing to see, in the dark.
pub fn bare(material: Material) -> Scene {
    let dark = Environment { background: Vec3::ZERO, ambient: Vec3::ZERO, fallback_radiance: Vec3::ZERO };
    Scene { materials: vec![material], environment: dark, ..Scene::default() }
}

/// A uniformly distributed random rotation.
pub fn rotation(random: &mut Random) -> DMat3 {
    let z = random.direction();
    let x = z.any_orthonormal_vector();
    let angle = TAU * random.unit();
    DMat3::from_axis_angle(z, angle) * DMat3::from_cols(x, z.cross(x), z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_meshes_are_closed_and_wind_around_their_inside_once() {
        let meshes = [
            (Mesh::sphere(0), 4, DVec3::ZERO),
            (Mesh::sphere(3), 256, DVec3::splat(0.2)),
            (Mesh::fans(64), 64, DVec3::ZERO),
            (Mesh::torus(12, 8), 192, DVec3::X),
        ];
        for (mesh, count, inside) in meshes {
            assert_eq!(mesh.triangles.len(), count);
            let rounded = [mesh.placed(DMat3::IDENTITY, DVec3::splat(1e6)), mesh.snapped(1.0 / 64.0)];
            for mesh in rounded.iter().chain([&mesh]) {
                assert!(mesh.is_closed());
            }
            assert!((mesh.winding(inside) - 1.0).abs() < 1e-9, "{}", mesh.winding(inside));
            assert!(mesh.winding(DVec3::splat(3.0)).abs() < 1e-9);
        }
    }
}
