//! Points and lines. glTF gives them no width: they are spheres, and tubes between spheres, of a radius that is small
//! beside the scene.

use glam::Vec3;

use super::normalized::flushed3;
use crate::scene::{Material, Object, Scene, Sphere, octahedral_encode};

/// Radius in units of the scene's longest side: about a pixel of a picture of 300 pixels.
const RADIUS: f32 = 1.0 / 300.0;

/// Number of sides of a line's tube.
const SIDES: usize = 6;

/// Number of triangles and spheres of a line.
pub(super) const PRIMITIVES_OF_LINE: usize = 2 * SIDES + 2;

/// Points and lines of one object in world space.
pub(super) struct Thin {
    pub name: String,
    /// Index of the material.
    pub material: u32,
    /// Whether the file has normals for them; without, they are not lit (glTF 2.0, section 3.9.7).
    pub lit: bool,
    pub points: Vec<Vec3>,
    pub lines: Vec<[Vec3; 2]>,
}

/// Adds points and lines to a scene that holds everything else, and materials for those that are not lit.
pub(super) fn add(all: Vec<Thin>, materials: &mut Vec<Material>, scene: &mut Scene) {
    let (low, high) = scene.bounds().unwrap_or((Vec3::INFINITY, Vec3::NEG_INFINITY));
    let ends = all.iter().flat_map(|thin| thin.points.iter().chain(thin.lines.as_flattened()));
    let (low, high) = ends.fold((low, high), |(low, high), p| (low.min(*p), high.max(*p)));
    let side = (high - low).max_element();
    let radius = (RADIUS * if side > 0.0 { side } else { 1.0 }).max(f32::MIN_POSITIVE);
    let mut unlit = std::collections::HashMap::new();
    for thin in all {
        let object = scene.objects.len() as u32;
        let lit =
            materials.get(thin.material as usize).filter(|material| !thin.lit && !material.unlit).cloned();
        let material = match lit {
            None => thin.material,
            Some(lit) => *unlit.entry(thin.material).or_insert_with(|| {
                materials.push(Material { unlit: true, ..lit });
                (materials.len() - 1) as u32
            }),
        };
        scene.objects.push(Object { name: thin.name, material });
        let centers = thin.points.iter().chain(thin.lines.as_flattened());
        scene.spheres.extend(centers.map(|center| Sphere { center: *center, radius, object }));
        for line in thin.lines {
            tube(line, radius, object, scene);
        }
    }
}

/// Adds the sides of a tube; none for a line without length.
fn tube([start, end]: [Vec3; 2], radius: f32, object: u32, scene: &mut Scene) {
    let Some(along) = (end.as_dvec3() - start.as_dvec3()).try_normalize() else { return };
    let (u, v) = along.as_vec3().any_orthonormal_pair();
    let normal = |side: usize| {
        let (sin, cos) = libm::sincosf(std::f32::consts::TAU * (side % SIDES) as f32 / SIDES as f32);
        u * cos + v * sin
    };
    for side in 0..SIDES {
        let (n, m) = (normal(side), normal(side + 1));
        let corners = [start + n * radius, start + m * radius, end + n * radius, end + m * radius];
        let [a, b, c, d] = corners.map(flushed3);
        let (n, m) = (octahedral_encode(n), octahedral_encode(m));
        for (corners, normals) in [([a, b, c], [n, m, n]), ([c, b, d], [n, m, m])] {
            scene.positions.push(corners);
            scene.normals.push(normals);
            scene.triangle_objects.push(object);
        }
    }
}
