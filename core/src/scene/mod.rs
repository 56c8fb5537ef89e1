//! The scene: flat arrays in world space (right-handed, Y up, in the file's unit of length).
//!
//! An *object* is one mesh primitive of one node; its index is the object identification number (OID) of Kim
//! 2016, section 3.2. Instances are flattened: each has its own triangles.

mod build;
mod builtin;
pub(crate) mod camera;
mod emitters;
mod environment_map;
mod exposure;
mod features;
#[cfg(feature = "gltf")]
mod gltf;
mod lobe_albedos;
pub(crate) mod look_at;
mod material;
mod not_shown;
mod octahedral;
mod solids;
mod tangent;
mod texture_slot;
mod thinness;
mod validate;

use std::ops::Range;

use glam::{DVec3, Vec2, Vec3};

pub use builtin::{BUILTIN_NAMES, builtin};
pub use emitters::Emitters;
pub(crate) use environment_map::bilinear;
pub use environment_map::{
    EnvironmentDistribution, EnvironmentMap, FIRST_FILTERED, FilteredLevel, WIDEST_LOBE,
};
pub use features::Features;
#[cfg(feature = "gltf")]
pub use gltf::ImportOptions;
pub use lobe_albedos::{ALBEDO_SIDE, LEAST_SHEEN_ROUGHNESS, LobeAlbedos};
pub use material::{DISPERSION_STEP, LEAST_ROUGHNESS, Material, SpecularGlossiness, Weights};
pub use not_shown::NotShown;
pub use octahedral::{
    MAX_ERROR as OCTAHEDRAL_ERROR, decode as octahedral_decode, decode_exact as octahedral_decode_exact,
    encode as octahedral_encode,
};
pub(crate) use solids::touching_solids;
pub use tangent::{decode_exact as tangent_decode_exact, encode as tangent_encode};
pub use texture_slot::{SlotCoordinates, TextureSlot};
pub use thinness::Thinness;

use crate::scene::camera::Camera;

/// The most lights a scene may have: one bit each in a pixel's shadow mask (SHDBIT).
pub const MAX_LIGHTS: usize = 32;

/// The largest absolute coordinate; squared lengths of larger ones overflow in f32.
pub const MAX_COORDINATE: f32 = 1.0e18;

/// The largest radiance or intensity of a channel, so that results stay finite in f32 for ordinary materials and
/// distances.
pub const MAX_RADIANCE: f32 = 1.0e30;

/// The largest index of refraction, with a reflectance of 0.9996 at normal incidence.
pub const MAX_IOR: f32 = 1.0e4;
/// The largest dispersion: that of a red index of 1.
pub const MAX_DISPERSION: f32 = 1.0 / DISPERSION_STEP;
/// The largest thickness of a thin film in nanometres: far more than shows any colour.
pub const MAX_THICKNESS: f32 = 1.0e6;

/// The least range of a light; the fourth power of its inverse is finite in f32.
pub const MIN_RANGE: f32 = 1.0e-9;

/// The colour of vertices without one: opaque white.
pub const WHITE: [u16; 4] = [u16::MAX; 4];

/// The most camera names that an error message lists.
const CAMERAS_NAMED: usize = 16;

/// A scene in main memory. [`crate::GpuScene::upload`] consumes it.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// World-space corner positions of each triangle.
    pub positions: Vec<[Vec3; 3]>,
    /// Unit shading normals of each triangle's corners, [`octahedral_encode`]d; flat triangles repeat the face normal.
    pub normals: Vec<[u32; 3]>,
    /// Texture coordinates of each triangle's corners; empty if no object is textured.
    pub texcoords: Vec<[Vec2; 3]>,
    /// A second set of texture coordinates, which slots with [`SlotCoordinates::second`] read; empty if none does.
    pub second_texcoords: Vec<[Vec2; 3]>,
    /// Tangents of each triangle's corners, [`tangent_encode`]d; empty if no material has a normal map.
    pub tangents: Vec<[u32; 3]>,
    /// Vertex colours of each triangle's corners (linear RGBA, 16 bits a channel); empty if no object has any.
    pub colors: Vec<[[u16; 4]; 3]>,
    /// OID of each triangle: index into [`Scene::objects`].
    pub triangle_objects: Vec<u32>,
    /// Analytic spheres; primitives are numbered with the triangles first, then the spheres.
    pub spheres: Vec<Sphere>,
    /// Objects, indexed by their OID.
    pub objects: Vec<Object>,
    /// Materials, indexed by [`Object::material`].
    pub materials: Vec<Material>,
    /// Textures, indexed by the texture slots of [`Material`].
    pub textures: Vec<Texture>,
    /// Images, indexed by [`Texture::image`].
    pub images: Vec<Image8>,
    /// Punctual lights, at most [`MAX_LIGHTS`].
    pub lights: Vec<Light>,
    /// Cameras of the file with their names; never empty after import.
    pub cameras: Vec<(String, Camera)>,
    /// Radiance of rays that hit nothing, ambient radiance, and radiance of rays that are not traced.
    pub environment: Environment,
    /// Names of the file's variants of materials (KHR_materials_variants).
    pub variants: Vec<String>,
    /// Radiance by direction in place of the environment's background and ambient radiance; set by
    /// [`Scene::surround`].
    pub environment_map: Option<EnvironmentMap>,
    /// Whether the map is [`EnvironmentMap::studio`] because the file brings neither a light nor surroundings,
    /// whatever else glows in it.
    pub is_lit_by_studio: bool,
    /// Parts of the file that the import left out: one sentence each that names the element.
    pub warnings: Vec<String>,
    /// The point of the file's coordinates where the scene's are zero. An import moves scenes that lie far from the
    /// origin of their file, where f32 would not resolve them; it is zero for all others.
    pub origin: DVec3,
    /// Features of the file that the scene does not show as the file's specification has it.
    pub not_shown: Vec<NotShown>,
}

/// One mesh primitive of one node, or one sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Name: `node/mesh[primitive]` for files, descriptive for built-in scenes.
    pub name: String,
    /// Index of the material in [`Scene::materials`].
    pub material: u32,
}

/// An analytic sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre in world space.
    pub center: Vec3,
    /// Radius in world units, greater than zero.
    pub radius: f32,
    /// OID: index into [`Scene::objects`].
    pub object: u32,
}

/// Wrap mode of texture coordinates outside [0, 1) (glTF 2.0, section 3.8.4.5).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// Repeats the image: uses the fraction of the coordinate.
    #[default]
    Repeat,
    /// Repeats the image, every second time mirrored.
    MirroredRepeat,
    /// Extends the texels at the image's border.
    ClampToEdge,
}

/// A texture: an image with wrap modes and filtering (texture and sampler in glTF).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Texture {
    /// Index of the image in [`Scene::images`].
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
    /// RGBA, 8 bits per channel, rows from the top: `width * height * 4` bytes.
    pub rgba: Vec<u8>,
}

/// A punctual light (KHR_lights_punctual) without exposure: reflected radiance is albedo / pi x E x cos.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// The light's geometry.
    pub kind: LightKind,
    /// Linear RGB: radiant intensity in W/sr for point and spot lights, irradiance in W/m^2 for directional ones.
    pub intensity: Vec3,
    /// Shadow rays end at this distance from the light, so that the body of a lamp does not shadow it. Unused for
    /// directional lights. Lights of a file get a hundredth of the scene's longest side.
    pub radius: f32,
}

/// The kind of a punctual light with its geometry.
#[derive(Clone, Debug, PartialEq)]
pub enum LightKind {
    /// A point light: E = intensity / d^2, windowed to zero at `range` if that is finite.
    Point {
        /// Position in world space.
        position: Vec3,
        /// Distance at which the light ends; infinite if unlimited.
        range: f32,
        /// Whether E falls off with the distance; false for Heckbert's minray.
        falloff: bool,
    },
    /// A point light restricted to a cone.
    Spot {
        /// Position in world space.
        position: Vec3,
        /// Distance at which the light ends; infinite if unlimited.
        range: f32,
        /// Unit vector of the cone's axis, away from the light.
        direction: Vec3,
        /// Half angles of the cone in radians, `inner <= outer <= pi/2`: full intensity inside `inner`, none
        /// outside `outer`.
        cone: Range<f32>,
    },
    /// A light at infinity: parallel rays.
    Directional {
        /// Unit vector in which the light travels.
        direction: Vec3,
    },
}

/// The environment: constant radiances in linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Environment {
    /// Radiance of rays that hit nothing.
    pub background: Vec3,
    /// Ambient radiance that reaches every surface from all directions (Whitted 1980).
    pub ambient: Vec3,
    /// Radiance in place of rays that are not traced because of a limit.
    pub fallback_radiance: Vec3,
}

impl Default for Environment {
    fn default() -> Self {
        Self::with_background(Vec3::ZERO)
    }
}

impl Environment {
    /// The environment of a file that only states a background. A quarter of the background, but at least 0.05,
    /// is the ambient radiance and the radiance of rays that are not traced.
    #[must_use]
    pub fn with_background(background: Vec3) -> Self {
        let ambient = (0.25 * background).max(Vec3::splat(0.05));
        Self { background, ambient, fallback_radiance: ambient }
    }
}

impl Scene {
    /// What people are told of a scene that [`Scene::is_lit_by_studio`].
    pub const STUDIO_LIT: &str =
        "the file brings no light: the built-in studio lights it (option `environment`)";

    /// Reads glTF 2.0: `.glb`, or `.gltf`; `resolve` returns the bytes of an external URI, a relative reference as the
    /// file has it (RFC 3986), or why there are none.
    ///
    /// # Errors
    /// [`crate::Error::Scene`] names the element of the file, what was expected and what was found.
    #[cfg(feature = "gltf")]
    pub fn from_gltf(
        bytes: &[u8],
        resolve: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
    ) -> crate::Result<Self> {
        Self::from_gltf_with(bytes, resolve, &ImportOptions::default())
    }

    /// Reads glTF 2.0 as [`Scene::from_gltf`] does, in a variant of its materials or within a budget of memory.
    ///
    /// # Errors
    /// Those of [`Scene::from_gltf`], also where the file needs more than the budget; [`crate::Error::Setting`] lists the
    /// file's variants if none has the name.
    #[cfg(feature = "gltf")]
    pub fn from_gltf_with(
        bytes: &[u8],
        resolve: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
        options: &ImportOptions<'_>,
    ) -> crate::Result<Self> {
        gltf::read(bytes, resolve, options)
    }

    /// Surrounds the scene by a map instead of what surrounded it; rays that are cut off by a limit have its mean
    /// radiance.
    pub fn surround(&mut self, map: EnvironmentMap) {
        self.is_lit_by_studio = false;
        let mean = map.mean();
        self.environment = Environment { background: mean, ambient: mean, fallback_radiance: mean };
        self.environment_map = Some(map);
    }

    /// Removes the studio of a file without a light, which is left dark but for its ambient radiance.
    pub fn leave_studio(&mut self) {
        if std::mem::take(&mut self.is_lit_by_studio) {
            self.environment_map = None;
            self.environment = Environment::default();
        }
    }

    /// The axis-aligned bounding box of all primitives, `(low, high)`; `None` for an empty scene.
    #[must_use]
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let corners = self.positions.iter().flatten().map(|p| (*p, *p));
        let spheres = self.spheres.iter().map(|s| (s.center - s.radius, s.center + s.radius));
        corners.chain(spheres).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }

    /// A point of the scene in the coordinates of its file.
    #[must_use]
    pub fn in_file(&self, point: Vec3) -> DVec3 {
        self.origin + point.as_dvec3()
    }

    /// Finds a camera by name or index; `None` selects the first.
    ///
    /// # Errors
    /// [`crate::Error::Setting`] lists the scene's cameras.
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
