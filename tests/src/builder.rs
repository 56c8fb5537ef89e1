//! A builder of small test scenes.

use glam::{Vec2, Vec2Swizzles as _, Vec3, vec3};
use glimpse::{
    Camera, Scene,
    scene::{
        Environment, Image8, Light, LightKind, Material, Object, Sphere, Texture, Wrap, octahedral_encode,
        tangent_encode,
    },
};

/// A test scene under construction.
pub struct Builder(Scene);

impl Builder {
    /// Starts an empty scene without light.
    #[must_use]
    #[allow(clippy::new_without_default, reason = "a builder is begun, not defaulted")]
    pub fn new() -> Self {
        let black =
            Environment { background: Vec3::ZERO, ambient: Vec3::ZERO, fallback_radiance: Vec3::ZERO };
        Self(Scene { environment: black, ..Scene::default() })
    }

    /// Adds an object with its own material and returns its OID.
    pub fn object(&mut self, material: Material) -> u32 {
        self.0.materials.push(material);
        let material = self.0.materials.len() as u32 - 1;
        self.0.objects.push(Object { name: format!("object {material}"), material });
        self.0.objects.len() as u32 - 1
    }

    /// Adds a flat parallelogram with normal `u x v`; texture coordinates run from (0, 0) along `u` and `v`
    /// to (1, 1).
    pub fn quad(&mut self, object: u32, corner: Vec3, u: Vec3, v: Vec3) {
        self.textured_quad(object, [corner, u, v], [Vec2::ZERO, Vec2::ONE]);
    }

    /// Adds a [`Builder::quad`] with the texture coordinates of the two ends of its diagonal; those of the second
    /// set are the same, swapped.
    pub fn textured_quad(&mut self, object: u32, [corner, u, v]: [Vec3; 3], [low, high]: [Vec2; 2]) {
        let corners = [corner, corner + u, corner + u + v, corner + v];
        let coordinates = [low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)];
        let normal = octahedral_encode(u.cross(v).normalize_or_zero());
        for triangle in [[0, 1, 2], [0, 2, 3]] {
            self.0.positions.push(triangle.map(|i| corners[i]));
            self.0.texcoords.push(triangle.map(|i| coordinates[i]));
            self.0.normals.push([normal; 3]);
            self.0.second_texcoords.push(triangle.map(|i| coordinates[i].yx()));
            // The rows of an image run downwards, here along `v`.
            self.0.tangents.push([tangent_encode(u.normalize_or_zero(), true); 3]);
            self.0.triangle_objects.push(object);
        }
    }

    /// Adds an analytic sphere.
    pub fn sphere(&mut self, object: u32, center: Vec3, radius: f32) {
        self.0.spheres.push(Sphere { center, radius, object });
    }

    /// Adds a point light of unlimited range.
    pub fn point_light(&mut self, position: Vec3, intensity: Vec3) {
        let kind = LightKind::Point { position, range: f32::INFINITY, falloff: true };
        self.light(Light { kind, intensity, radius: 0.0 });
    }

    /// Adds a light.
    pub fn light(&mut self, light: Light) {
        self.0.lights.push(light);
    }

    /// Adds a repeating grey ramp of 8x8 texels and returns the index of its texture.
    pub fn ramp_texture(&mut self) -> u32 {
        let grey = |i: u8| [32 + 3 * i, 32 + 3 * i, 32 + 3 * i, 255];
        let image = self.image(Image8 { width: 8, height: 8, rgba: (0..64).flat_map(grey).collect() });
        self.texture(Texture { image, wrap: [Wrap::Repeat; 2], nearest: false })
    }

    /// Adds an image and returns its index.
    pub fn image(&mut self, image: Image8) -> u32 {
        self.0.images.push(image);
        self.0.images.len() as u32 - 1
    }

    /// Adds a texture and returns its index.
    pub fn texture(&mut self, texture: Texture) -> u32 {
        self.0.textures.push(texture);
        self.0.textures.len() as u32 - 1
    }

    /// Sets the radiance of the background and of ambient light.
    pub fn environment(&mut self, background: Vec3, ambient: Vec3) {
        self.0.environment = Environment { background, ambient, fallback_radiance: ambient };
    }

    /// Finishes the scene with a camera.
    #[must_use]
    pub fn seen_by(mut self, camera: Camera) -> Scene {
        if self.0.materials.iter().all(|m| m.textures().next().is_none()) {
            self.0.texcoords.clear();
        }
        if self.0.materials.iter().all(|m| !m.reads_tangents()) {
            self.0.tangents.clear();
        }
        if self.0.materials.iter().all(|m| m.coordinates.values().all(|c| !c.second)) {
            self.0.second_texcoords.clear();
        }
        self.0.cameras = vec![("camera".to_owned(), camera)];
        self.0
    }
}

/// A camera in front of the origin: at (0, 0, 2), field of view 45 degrees.
///
/// # Panics
/// Never.
#[must_use]
pub fn front_camera() -> Camera {
    Camera::look_at(vec3(0.0, 0.0, 2.0), Vec3::ZERO, 45.0_f32.to_radians()).expect("a valid camera")
}

/// A Lambertian surface: radiance is colour / pi times irradiance. (With index 1 there is no Fresnel
/// reflection, so neither a highlight nor a mirror image.)
#[must_use]
pub fn matte(color: Vec3) -> Material {
    Material { base_color: color, ior: 1.0, ..Material::default() }
}

/// An unlit surface, which shows its colour.
#[must_use]
pub fn unlit(color: Vec3) -> Material {
    Material { base_color: color, unlit: true, ..Material::default() }
}

/// A perfect metal mirror with Schlick's reflectance, `color` at normal incidence.
#[must_use]
pub fn mirror(color: Vec3) -> Material {
    Material { base_color: color, metallic: 1.0, roughness: 0.0, ..Material::default() }
}

/// Clear glass with this index of refraction.
#[must_use]
pub fn glass(ior: f32) -> Material {
    Material { roughness: 0.0, transmission: 1.0, ior, casts_shadow: false, ..Material::default() }
}

/// The scene with flat shading: all normals are those of the faces.
#[must_use]
pub fn flattened(mut scene: Scene) -> Scene {
    for (corners, normals) in scene.positions.iter().zip(&mut scene.normals) {
        let [a, b, c] = corners.map(|corner| corner.as_dvec3());
        *normals = [octahedral_encode((b - a).cross(c - a).normalize().as_vec3()); 3];
    }
    scene
}
