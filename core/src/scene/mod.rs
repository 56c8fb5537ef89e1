//! The scene: flat arrays of what is there, in world space (right-handed, Y up, the file's unit of length).
//!
//! One mesh primitive of one node is one *object*; its index is the object identification number (OID) of
//! Kim 2016, section 3.2. Instances are flattened: every triangle is stored where it stands.

mod build;
mod builtin;
pub(crate) mod camera;
mod emitters;
mod features;
#[cfg(feature = "gltf")]
mod gltf;
pub(crate) mod look_at;
mod material;
mod octahedral;
mod thinness;
mod validate;

use std::ops::Range;

use glam::{Vec2, Vec3};

pub use builtin::{BUILTIN_NAMES, builtin};
pub use emitters::Emitters;
pub use features::Features;
pub use material::{Material, Weights};
pub use octahedral::{
    MAX_ERROR as OCTAHEDRAL_ERROR, decode as octahedral_decode, decode_exact as octahedral_decode_exact,
    encode as octahedral_encode,
};
pub use thinness::Thinness;

use crate::scene::camera::Camera;

/// The most lights a scene may have: one bit each in a pixel's shadow mask (SHDBIT).
pub const MAX_LIGHTS: usize = 32;

/// The largest absolute coordinate: beyond it squared lengths overflow f32.
pub const MAX_COORDINATE: f32 = 1.0e18;

/// The largest radiance or intensity of a channel: what materials and distances of ordinary size make of it stays
/// finite in f32.
pub const MAX_RADIANCE: f32 = 1.0e30;

/// The largest index of refraction: it reflects 0.9996 of the light at normal incidence.
pub const MAX_IOR: f32 = 1.0e4;

/// The least range of a light: the fourth power of its inverse is finite in f32.
pub const MIN_RANGE: f32 = 1.0e-9;

/// The most camera names that an error message lists.
const CAMERAS_NAMED: usize = 16;

/// A scene in main memory. [`crate::GpuScene::upload`] consumes it.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// World-space corner positions of each triangle.
    pub positions: Vec<[Vec3; 3]>,
    /// Unit shading normals of each triangle's corners, [`octahedral_encode`]d; flat triangles repeat the face normal.
    pub normals: Vec<[u32; 3]>,
    /// Texture coordinates of each triangle's corners; empty where no object is textured.
    pub texcoords: Vec<[Vec2; 3]>,
    /// Vertex colours (linear RGBA, 8 bits a channel, red lowest); empty where no object has them.
    pub colors: Vec<[u32; 3]>,
    /// OID of each triangle: index into [`Scene::objects`].
    pub triangle_objects: Vec<u32>,
    /// Analytic spheres, behind the triangles in the numbering of primitives.
    pub spheres: Vec<Sphere>,
    /// Objects, indexed by their OID.
    pub objects: Vec<Object>,
    /// Materials, indexed by [`Object::material`].
    pub materials: Vec<Material>,
    /// Textures, indexed by the texture slots of [`Material`].
    pub textures: Vec<Texture>,
    /// Images that textures show, by index.
    pub images: Vec<Image8>,
    /// Punctual lights, at most [`MAX_LIGHTS`].
    pub lights: Vec<Light>,
    /// Cameras of the file with their names; never empty after import.
    pub cameras: Vec<(String, Camera)>,
    /// Radiance of rays without a hit, and of light that is not traced.
    pub environment: Environment,
    /// Parts of the file that the import left out: one sentence each that names the element.
    pub warnings: Vec<String>,
}

/// One mesh primitive of one node, or one sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// `node/mesh[primitive]` or a name of the built-in scene.
    pub name: String,
    /// Index into [`Scene::materials`].
    pub material: u32,
}

/// A sphere that is intersected analytically, not tessellated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre in world space.
    pub center: Vec3,
    /// Radius in world units, greater than zero.
    pub radius: f32,
    /// OID: index into [`Scene::objects`].
    pub object: u32,
}

/// How coordinates outside [0, 1) are read (glTF 2.0, section 3.8.4.5).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// Tiles the image: the fraction of the coordinate is used.
    #[default]
    Repeat,
    /// Every second repetition is mirrored.
    MirroredRepeat,
    /// Repeats the texels of the image's border.
    ClampToEdge,
}

/// An image with wrap modes and filtering: what glTF calls a texture with its sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Texture {
    /// Index into [`Scene::images`].
    pub image: u32,
    /// Wrap modes along s and t.
    pub wrap: [Wrap; 2],
    /// Nearest instead of bilinear filtering.
    pub nearest: bool,
}

/// An 8-bit RGBA image, row by row from the top left.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Image8 {
    /// Width in texels.
    pub width: u32,
    /// Height in texels.
    pub height: u32,
    /// RGBA, 8 bits a channel, rows from the top: `width * height * 4` bytes.
    pub rgba: Vec<u8>,
}

/// A punctual light (KHR_lights_punctual), without exposure: reflected radiance is albedo / pi x E x cos.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// The light's geometry.
    pub kind: LightKind,
    /// Linear RGB; W/sr for point and spot lights, W/m^2 for directional ones.
    pub intensity: Vec3,
    /// Shadow rays stop at this distance before the light: an emitter's own body does not shadow it. No meaning
    /// for directional lights. Lights of a file get a hundredth of the scene's longest side.
    pub radius: f32,
}

/// The kind of a punctual light with its geometry.
#[derive(Clone, Debug, PartialEq)]
pub enum LightKind {
    /// Shines in all directions from `position`; E = intensity / d^2, windowed to zero at `range` if that is finite.
    Point {
        /// Position in world space.
        position: Vec3,
        /// Where the light ends; infinite without limit.
        range: f32,
        /// False for lights whose E does not fall with distance (Heckbert's minray).
        falloff: bool,
    },
    /// A point light that shines inside of a cone.
    Spot {
        /// Position in world space.
        position: Vec3,
        /// Where the light ends; infinite without limit.
        range: f32,
        /// Unit vector of the cone's axis, away from the light.
        direction: Vec3,
        /// Half angles in radians, `inner <= outer <= pi/2`; full inside `inner`, none outside `outer`.
        cone: Range<f32>,
    },
    /// A light at infinity: parallel rays.
    Directional {
        /// Unit vector in which the light travels.
        direction: Vec3,
    },
}

/// Constant radiance around the scene, linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Environment {
    /// Radiance of a ray that meets nothing.
    pub background: Vec3,
    /// Radiance that reaches every surface from everywhere (Whitted's ambient term).
    pub ambient: Vec3,
    /// Radiance that stands for a ray which the recursion does not follow any more.
    pub fallback_radiance: Vec3,
}

impl Default for Environment {
    fn default() -> Self {
        Self::with_background(Vec3::ZERO)
    }
}

impl Environment {
    /// The environment of a file that states a background alone: a quarter of it, and no less than 0.05,
    /// is taken as ambient radiance and stands for rays that are not followed.
    #[must_use]
    pub fn with_background(background: Vec3) -> Self {
        let ambient = (0.25 * background).max(Vec3::splat(0.05));
        Self { background, ambient, fallback_radiance: ambient }
    }
}

impl Scene {
    /// Reads glTF 2.0: `.glb`, or `.gltf` with embedded data; `resolve` gives the bytes of an external URI.
    ///
    /// # Errors
    /// [`crate::Error::Scene`] names the element of the file, what was expected and what was found.
    #[cfg(feature = "gltf")]
    pub fn from_gltf(
        bytes: &[u8],
        resolve: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
    ) -> crate::Result<Self> {
        gltf::read(bytes, resolve)
    }

    /// The axis-aligned box around everything, `(low, high)`; `None` for an empty scene.
    #[must_use]
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let corners = self.positions.iter().flatten().map(|p| (*p, *p));
        let spheres = self.spheres.iter().map(|s| (s.center - s.radius, s.center + s.radius));
        corners.chain(spheres).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }

    /// The camera of that name or index; `None` gives the first.
    ///
    /// # Errors
    /// [`crate::Error::Setting`] lists the cameras that are there.
    pub fn camera(&self, wanted: Option<&str>) -> crate::Result<&Camera> {
        let found = match wanted {
            None => self.cameras.first(),
            Some(name) => self
                .cameras
                .iter()
                .find(|(n, _)| n == name)
                .or_else(|| name.parse().ok().and_then(|i: usize| self.cameras.get(i))),
        };
        found.map(|(_, camera)| camera).ok_or_else(|| {
            let mut names: Vec<_> = self
                .cameras
                .iter()
                .map(|(name, _)| name)
                .enumerate()
                .take(CAMERAS_NAMED)
                .map(|(i, name)| format!("{i} ({name})"))
                .collect();
            if self.cameras.len() > names.len() {
                names.push(format!("{} more", self.cameras.len() - names.len()));
            }
            let expected = format!("a camera of the scene, which has {}", names.join(", "));
            crate::Error::setting("camera", expected, wanted.unwrap_or("0"))
        })
    }
}
