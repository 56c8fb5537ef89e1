//! Methods to build a scene in code.

use glam::{Vec2, Vec3};

use super::{Material, Object, Scene, Sphere, WHITE, octahedral_encode};

impl Scene {
    /// Adds a material; returns its index.
    pub fn add_material(&mut self, material: Material) -> u32 {
        self.materials.push(material);
        (self.materials.len() - 1) as u32
    }

    /// Adds an object of flat triangles; returns its OID. Corners are in world space, counter-clockwise seen from
    /// the front. Triangles without area are left out.
    pub fn add_triangles(&mut self, name: impl Into<String>, material: u32, triangles: &[[Vec3; 3]]) -> u32 {
        let object = self.add_object(name, material);
        let (textured, colored) = (!self.texcoords.is_empty(), !self.colors.is_empty());
        let (twice, mapped) = (!self.second_texcoords.is_empty(), !self.tangents.is_empty());
        for corners in triangles {
            let [a, b, c] = corners.map(|corner| corner.as_dvec3());
            let Some(normal) = (b - a).cross(c - a).try_normalize() else { continue };
            self.positions.push(*corners);
            self.normals.push([octahedral_encode(normal.as_vec3()); 3]);
            self.triangle_objects.push(object);
            // If any triangle has these attributes, all must.
            self.texcoords.extend(textured.then_some([Vec2::ZERO; 3]));
            self.second_texcoords.extend(twice.then_some([Vec2::ZERO; 3]));
            self.tangents.extend(mapped.then_some([0; 3]));
            self.colors.extend(colored.then_some([WHITE; 3]));
        }
        object
    }

    /// Adds an analytic sphere as an object of its own; returns its OID.
    pub fn add_sphere(&mut self, name: impl Into<String>, material: u32, center: Vec3, radius: f32) -> u32 {
        let object = self.add_object(name, material);
        self.spheres.push(Sphere { center, radius, object });
        object
    }

    /// Adds an object that has no primitives yet; returns its OID.
    pub fn add_object(&mut self, name: impl Into<String>, material: u32) -> u32 {
        self.objects.push(Object { name: name.into(), material });
        (self.objects.len() - 1) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_built_in_code_is_valid_with_and_without_texture_coordinates() {
        let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let mut scene = Scene::default();
        let material = scene.add_material(Material::default());
        assert_eq!(scene.add_triangles("flat", material, &[triangle, [Vec3::ONE; 3]]), 0);
        assert_eq!(scene.add_sphere("ball", material, Vec3::ONE, 0.5), 1);
        scene.validate().expect("a valid scene");
        assert_eq!(scene.positions, [triangle], "a triangle without an area is left out");
        assert_eq!(super::super::octahedral_decode(scene.normals[0][0]), Vec3::Z);
        scene.texcoords = vec![Default::default()];
        scene.colors = vec![[[0; 4]; 3]];
        scene.add_triangles("more", material, &[triangle]);
        scene.validate().expect("as many texture coordinates and colours as triangles");
        assert_eq!(scene.triangle_objects, [0, 2]);
    }
}
