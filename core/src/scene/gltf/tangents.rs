//! Tangents of objects whose file has none, as glTF 2.0 demands (section 3.7.2.1): by MikkTSpace.

use std::ops::Range;

use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::{Vec2, Vec3};

use crate::scene::{Scene, SlotCoordinates, octahedral_decode, tangent_encode};
use crate::{Error, Result};

/// The triangles of an object, with texture coordinates as its normal map reads them.
struct Object<'a> {
    scene: &'a Scene,
    triangles: Range<usize>,
    coordinates: Option<SlotCoordinates>,
    tangents: Vec<[u32; 3]>,
}

impl Geometry for Object<'_> {
    fn num_faces(&self) -> usize {
        self.triangles.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.scene.positions[self.triangles.start + face][corner].to_array()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        octahedral_decode(self.scene.normals[self.triangles.start + face][corner]).to_array()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        let of = |set: &[[Vec2; 3]]| {
            set.get(self.triangles.start + face).map_or(Vec2::ZERO, |corners| corners[corner])
        };
        match &self.coordinates {
            None => of(&self.scene.texcoords).to_array(),
            Some(c) => {
                let set = if c.second { &self.scene.second_texcoords } else { &self.scene.texcoords };
                c.transform.transform_point2(of(set)).to_array()
            }
        }
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        let Some(space) = space else { return };
        let tangent = Vec3::from(space.tangent());
        if tangent.is_finite() && tangent != Vec3::ZERO {
            // The library's textures have v upwards, glTF's downwards.
            let flipped = space.is_orientation_preserving();
            self.tangents[face][corner] = tangent_encode(tangent.normalize(), flipped);
        }
    }
}

/// The most triangles that may meet in a point: the library compares each of them with each other.
const MAX_VALENCE: usize = 256;

impl Object<'_> {
    /// The most triangles that meet in a point.
    fn valence(&self) -> usize {
        let corners = self.scene.positions[self.triangles.clone()].iter().flatten();
        let mut corners: Vec<_> = corners.map(|p| p.to_array().map(f32::to_bits)).collect();
        corners.sort_unstable();
        corners.chunk_by(|a, b| a == b).map(<[_]>::len).max().unwrap_or(0)
    }

    /// The tangent of a triangle's face along u, and whether the bitangent is flipped; `None` where texture
    /// coordinates define none.
    fn of_face(&self, face: usize) -> Option<(Vec3, bool)> {
        let [a, b, c] = [0, 1, 2].map(|corner| Vec3::from(self.position(face, corner)).as_dvec3());
        let [p, q, r] = [0, 1, 2].map(|corner| Vec2::from(self.tex_coord(face, corner)).as_dvec2());
        let (pq, pr) = (q - p, r - p);
        let area = pq.perp_dot(pr);
        let along = ((b - a) * pr.y - (c - a) * pq.y) * area.signum();
        Some((along.try_normalize()?.as_vec3(), area > 0.0))
    }
}

/// The encoded tangents of these triangles of the scene; some tangent where texture coordinates define none. Where
/// more than [`MAX_VALENCE`] triangles meet, those of the faces.
pub(super) fn computed(
    scene: &Scene,
    triangles: Range<usize>,
    coordinates: Option<SlotCoordinates>,
) -> Result<Vec<[u32; 3]>> {
    let any = |normal: u32| tangent_encode(octahedral_decode(normal).any_orthonormal_vector(), false);
    let tangents = scene.normals[triangles.clone()].iter().map(|normals| normals.map(any)).collect();
    let mut object = Object { scene, triangles, coordinates, tangents };
    if object.valence() > MAX_VALENCE {
        for face in 0..object.num_faces() {
            if let Some((tangent, flipped)) = object.of_face(face) {
                object.tangents[face] = [tangent_encode(tangent, flipped); 3];
            }
        }
        return Ok(object.tangents);
    }
    generate_tangents(&mut object).map_err(|e| Error::scene("tangents", e.to_string()))?;
    Ok(object.tangents)
}

#[cfg(test)]
mod tests {
    use glam::{vec2, vec3};

    use super::*;
    use crate::scene::{octahedral_encode, tangent_decode_exact};

    /// A fan of triangles around the origin, whose texture coordinates are their positions.
    fn fan(count: usize) -> Scene {
        let corner = |i: usize| {
            let angle = std::f32::consts::TAU * i as f32 / count as f32;
            vec3(angle.cos(), angle.sin(), 0.0)
        };
        let mut scene = Scene::default();
        for i in 0..count {
            let corners = [Vec3::ZERO, corner(i), corner(i + 1)];
            scene.positions.push(corners);
            scene.normals.push([octahedral_encode(Vec3::Z); 3]);
            scene.texcoords.push(corners.map(|p| vec2(2.0 * p.x, 3.0 * p.y)));
        }
        scene
    }

    /// The library's recursion and its time grow with the number of triangles that meet.
    #[test]
    fn fans_of_any_size_have_tangents() {
        for count in [3, MAX_VALENCE, 200_000] {
            let scene = fan(count);
            for tangent in computed(&scene, 0..count, None).expect("tangents").as_flattened() {
                let (tangent, sign) = tangent_decode_exact(*tangent);
                assert!(tangent.x > 0.999 && sign == -1.0, "{count}: {tangent} {sign}");
            }
        }
    }

    #[test]
    fn coordinates_without_area_give_some_tangent() {
        let mut scene = fan(3);
        scene.texcoords = vec![[Vec2::ZERO; 3]; 3];
        for tangent in computed(&scene, 0..3, None).expect("tangents").as_flattened() {
            assert!(tangent_decode_exact(*tangent).0.z.abs() < 1e-3);
        }
    }
}
