//! A builder for scenes, and the shapes that they are built from.

use std::f32::consts::TAU;

use glam::{Affine3A, Quat, Vec2, Vec3, vec2};
use libm::sincosf;

use crate::scene::{Image8, Material, Scene, Texture, Wrap, octahedral_encode};

/// Adds shapes to a scene, as parts of the object that was added last.
#[derive(Default)]
pub(super) struct Builder {
    pub scene: Scene,
    /// Transform of added shapes: a rotation and a translation.
    pub place: Affine3A,
}

impl Builder {
    /// Adds an object with this material and returns its OID; the triangles and spheres that follow belong to it.
    pub fn object(&mut self, name: impl Into<String>, material: u32) -> u32 {
        self.scene.add_object(name, material)
    }

    pub fn material(&mut self, name: &str, material: Material) -> u32 {
        self.scene.add_material(Material { name: name.to_owned(), ..material })
    }

    /// Adds a texture that repeats in both directions and is filtered bilinearly; returns its index.
    pub fn texture(&mut self, image: Image8) -> Option<u32> {
        self.scene.images.push(image);
        let image = (self.scene.images.len() - 1) as u32;
        self.scene.textures.push(Texture { image, wrap: [Wrap::Repeat; 2], nearest: false });
        Some((self.scene.textures.len() - 1) as u32)
    }

    /// Adds an analytic sphere as an object of its own.
    pub fn sphere(&mut self, name: impl Into<String>, material: u32, center: Vec3, radius: f32) {
        self.scene.add_sphere(name, material, self.place.transform_point3(center), radius);
    }

    /// Adds a triangle, counter-clockwise. It is flat without normals, or if these face away from the triangle's
    /// front.
    pub fn triangle(&mut self, corners: [Vec3; 3], normals: Option<[Vec3; 3]>, uv: [Vec2; 3]) {
        let corners = corners.map(|p| self.place.transform_point3(p));
        let [a, b, c] = corners.map(|p| p.as_dvec3());
        let face = (b - a).cross(c - a);
        if face == glam::DVec3::ZERO || self.scene.objects.is_empty() {
            return;
        }
        let flat = face.normalize().as_vec3();
        let normals = normals.map_or([flat; 3], |n| {
            n.map(|n| {
                let n = self.place.transform_vector3(n).normalize_or_zero();
                if n.dot(flat) > 0.05 { n } else { flat }
            })
        });
        self.scene.positions.push(corners);
        self.scene.normals.push(normals.map(octahedral_encode));
        self.scene.texcoords.push(uv);
        self.scene.triangle_objects.push((self.scene.objects.len() - 1) as u32);
    }

    /// Adds a parallelogram that faces `u x v`, with `repeats` of the texture along u and v; texture rows run
    /// against v.
    pub fn quad(&mut self, corner: Vec3, u: Vec3, v: Vec3, repeats: Vec2) {
        let p = [corner, corner + u, corner + u + v, corner + v];
        let uv = [vec2(0.0, repeats.y), repeats, vec2(repeats.x, 0.0), Vec2::ZERO];
        self.triangle([p[0], p[1], p[2]], None, [uv[0], uv[1], uv[2]]);
        self.triangle([p[0], p[2], p[3]], None, [uv[0], uv[2], uv[3]]);
    }

    /// Adds an axis-aligned box; the texture repeats `density` times per unit of length.
    pub fn cuboid(&mut self, low: Vec3, high: Vec3, density: f32) {
        let size = high - low;
        let (x, y, z) = (Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z);
        let d = size * density;
        self.quad(low + z, x, y, vec2(d.x, d.y));
        self.quad(low + x, -x, y, vec2(d.x, d.y));
        self.quad(low, z, y, vec2(d.z, d.y));
        self.quad(high - y, -z, y, vec2(d.z, d.y));
        self.quad(high - x, x, -z, vec2(d.x, d.z));
        self.quad(low, x, z, vec2(d.x, d.z));
    }

    /// Adds a ball of `8 n^2` flat triangles: each face of an octahedron in `n^2` parts, with their corners on
    /// the sphere.
    pub fn ball(&mut self, center: Vec3, radius: f32, n: u32) {
        for octant in 0..8_u32 {
            let signs = Vec3::from_array([1, 2, 4].map(|bit| if octant & bit == 0 { 1.0 } else { -1.0 }));
            let mirrored = octant.count_ones() % 2 == 1;
            let at = |i: u32, j: u32| {
                let direction = signs * Vec3::from_array([i, j, n - i - j].map(|k| k as f32));
                center + radius * direction.normalize()
            };
            for (i, j) in (0..n).flat_map(|i| (0..n - i).map(move |j| (i, j))) {
                let outer = [at(i, j), at(i + 1, j), at(i, j + 1)];
                let inner = (i + j + 2 <= n).then(|| [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                for [a, b, c] in std::iter::once(outer).chain(inner) {
                    let corners = if mirrored { [a, c, b] } else { [a, b, c] };
                    self.triangle(corners, None, [Vec2::ZERO; 3]);
                }
            }
        }
    }

    /// Joins points (i, j) of a grid to a smooth surface that faces the side from which i runs to the right and j
    /// upwards; `point` returns position and normal.
    pub fn surface(&mut self, size: [u32; 2], repeats: Vec2, point: impl Fn(f32, f32) -> (Vec3, Vec3)) {
        let [columns, rows] = size;
        let at = |i: u32, j: u32| {
            let (s, t) = (i as f32 / columns as f32, j as f32 / rows as f32);
            let (position, normal) = point(s, t);
            (position, normal, vec2(s, 1.0 - t) * repeats)
        };
        for j in 0..rows {
            for i in 0..columns {
                let p = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                    let (a, b, c) = (p[a], p[b], p[c]);
                    self.triangle([a.0, b.0, c.0], Some([a.1, b.1, c.1]), [a.2, b.2, c.2]);
                }
            }
        }
    }

    /// Adds a surface of revolution around the vertical through `base`. The profile of (radius, height) runs from
    /// below upwards on the outside and is smoothed by a Catmull-Rom spline.
    pub fn lathe(&mut self, base: Vec3, profile: &[Vec2], segments: [u32; 2]) {
        let spans = (profile.len().saturating_sub(1)).max(1) as f32;
        let at = |k: i32| profile[k.clamp(0, profile.len() as i32 - 1) as usize];
        let curve = |t: f32| {
            let k = (t * spans).floor().min(spans - 1.0);
            let f = t * spans - k;
            let k = k as i32;
            let (a, b, c, d) = (at(k - 1), at(k), at(k + 1), at(k + 2));
            let position = 0.5
                * (2.0 * b
                    + (c - a) * f
                    + (2.0 * a - 5.0 * b + 4.0 * c - d) * f * f
                    + (3.0 * b - a - 3.0 * c + d) * f * f * f);
            position.max(vec2(0.0, f32::MIN))
        };
        let step = 0.5 / segments[1] as f32;
        self.surface(segments, Vec2::ONE, |s, t| {
            let out = around(Vec3::Z, Vec3::X, s);
            let (p, slope) = (curve(t), curve((t + step).min(1.0)) - curve((t - step).max(0.0)));
            (base + out * p.x + Vec3::Y * p.y, out * slope.y - Vec3::Y * slope.x)
        });
    }

    /// Adds a torus around `axis`, a unit vector.
    pub fn torus(&mut self, center: Vec3, axis: Vec3, radii: [f32; 2], segments: [u32; 2]) {
        let (x, z) = frame(axis);
        self.surface(segments, vec2(8.0, 1.0), |s, t| {
            let out = around(x, z, s);
            let normal = -around(out, axis, t);
            (center + out * radii[0] + normal * radii[1], normal)
        });
    }

    /// Adds a round rod along a path, with closed ends.
    pub fn tube(&mut self, path: &[Vec3], radius: f32, sides: u32) {
        for leg in path.windows(2) {
            let along = (leg[1] - leg[0]).normalize_or_zero();
            if along == Vec3::ZERO {
                continue;
            }
            let (x, z) = frame(along);
            self.surface([sides, 1], Vec2::ONE, |s, t| {
                let normal = around(x, z, s);
                (leg[0].lerp(leg[1], t) + normal * radius, normal)
            });
            for (end, out, side) in [(leg[0], -along, -z), (leg[1], along, z)] {
                self.surface([sides, 1], Vec2::ONE, |s, t| {
                    let rim = around(x, side, s) * (1.0 - t);
                    (end + (rim + 0.5 * t * out) * radius, (out + rim).normalize())
                });
            }
        }
    }

    /// Returns the scene; texture coordinates are dropped unless a material has textures.
    pub fn finish(mut self) -> Scene {
        if self.scene.materials.iter().all(|m| m.textures().next().is_none()) {
            self.scene.texcoords.clear();
        }
        self.scene
    }
}

/// Unit vectors x, z for which (x, z, axis) is right-handed.
fn frame(axis: Vec3) -> (Vec3, Vec3) {
    let x = axis.any_orthonormal_vector();
    (x, axis.cross(x))
}

/// The rotation by `angle` radians around `axis`.
pub(super) fn turned(axis: Vec3, angle: f32) -> Affine3A {
    let (sin, cos) = sincosf(0.5 * angle);
    Affine3A::from_quat(Quat::from_vec4((sin * axis).extend(cos)))
}

/// The point of the unit circle from `x` towards `z` at `turn` revolutions; bitwise the same at 0 and 1.
fn around(x: Vec3, z: Vec3, turn: f32) -> Vec3 {
    let (sin, cos) = if turn < 1.0 { sincosf(turn * TAU) } else { (0.0, 1.0) };
    x * cos + z * sin
}
