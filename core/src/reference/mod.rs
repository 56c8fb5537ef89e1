//! The reference implementation: every step of the shaders in f64 on the CPU, without any optimisation.
//!
//! | here | shaders |
//! | --- | --- |
//! | [`Tracer`] | `bvh.wgsl`, `triangle*.wgsl`, `sphere_analytic.wgsl` |
//! | [`Reference::first`], [`Reference::unobstructed`], [`Reference::shadow_bits`] | `any_hit_*.wgsl`, `shadow_rays.wgsl` |
//! | [`Reference::surface`], [`Reference::texture`], [`Reference::material`], [`Reference::arrival`] | `surface.wgsl`, `ray_cone.wgsl`, `texture_*.wgsl`, `material.wgsl`, `lights_punctual.wgsl` |
//! | [`Reference::bumped`] | `surface_maps.wgsl`, `material_maps.wgsl` |
//! | `Reference::environment_*` | `environment_*.wgsl` |
//! | `Reference::boundary` | `media_*.wgsl` |
//! | [`Reference::sample`] | `sample.wgsl`, `scatter_*.wgsl` |
//! | [`ReferenceFrame::ray`], [`ReferenceFrame::traced`], [`ReferenceFrame::adaptive`], [`ReferenceFrame::checkerboard`] | `frame.wgsl`, the passes |
//! | [`ReferenceFrame::failed`], [`ReferenceFrame::interpolated`], [`ReferenceFrame::shaded`], [`Attributes::stored`] | `similarity.wgsl`, `attributes_channels.wgsl` |
//! | [`ReferenceFrame::postcorrection`] | `postcorrect_seed.wgsl`, `postcorrect_probe_points.wgsl`, `postcorrect.wgsl`, `postcorrect_scan.wgsl` |
//! | [`ReferenceFrame::ray_in`], [`ReferenceFrame::presampled`], [`ReferenceFrame::tested`], [`ReferenceFrame::supersampled`] | `jitter_*.wgsl`, `presample.wgsl`, `subpixels.wgsl`, `extra_samples.wgsl` |
//! | [`ReferenceFrame::quincunx`] | `quincunx_*.wgsl` |
//! | [`ReferenceFrame::path`], [`Rng::pair`] | `path.wgsl`, `lobes*.wgsl`, `microfacets.wgsl`, `response_*.wgsl`, `emitters*.wgsl`, `rng*.wgsl` |
//! | [`PathSample::own`], [`PathSample::splat`] | `eyes_stereo.wgsl`, `stereo_*.wgsl` |
//! | [`GBufferPixel::followed`], [`Denoiser::median`], [`Denoiser::atrous`] | `gbuffer_record.wgsl`, `median.wgsl`, `atrous_begin.wgsl`, `atrous.wgsl` |
//! | [`ReferenceFrame::refreshes`], [`ReferenceFrame::reprojected`] | `refresh.wgsl`, `reproject_depth.wgsl`, `reproject_source.wgsl`, `reuse.wgsl` |
//!
//! The reference shares with the renderer that it tests: the [`Scene`] in main memory (with octahedral normals),
//! the [`Camera`](crate::Camera), the [`Settings`](crate::Settings), the Rust functions that encode and decode
//! octahedral words, which the shaders do not use, the bytes of the mip levels, the table of [`LobeAlbedos`], and
//! the distribution of [`Emitters`]. It shares nothing else: no tree, no buffer, no formula. Only [`Reference::with_wide_tree`] uses
//! the tree's builder: it is for images, not for tests.
//!
//! Spawned rays start exactly on the surface and cannot hit the primitive that they leave; the shaders start them
//! at a small offset. Lights and materials follow the formulas of `core/MATERIALS.md` and of the glTF extensions.
//!
//! A differing f32 result is judged in one of two ways. [`Tracer::judge`] bounds the errors of f32 from the
//! geometry of one ray. For everything that follows from a hit, the reference is evaluated again under
//! [`Rounding`]: with numbers displaced by up to [`ULPS`] units in the last place (and origins of spawned rays by
//! [`SPAWN_ULPS`]), for one [`Cause`] after the other. A result that is not among these is wrong.

mod anisotropy;
mod attributes;
mod cone;
mod contrast;
mod denoise;
mod emission;
mod environment;
mod frame;
mod gbuffer;
mod intersection;
mod iridescence;
mod jitter;
mod judge;
mod lights;
mod lobes;
mod maps;
mod material;
mod media;
mod microfacets;
mod path;
mod postcorrection;
mod quincunx;
mod refinement;
mod reprojection;
mod rng;
mod rounding;
mod sample;
mod scatter;
mod shadow;
mod shares;
mod sheen;
mod similarity;
mod stereo_reuse;
mod supersampling;
mod surface;
mod texture;
mod traversal;
mod wide;

use std::sync::OnceLock;

use glam::DVec3;

pub use attributes::Attributes;
pub use denoise::Denoiser;
pub use frame::{Pixel, ReferenceFrame};
pub use gbuffer::{GBufferPixel, Way};
pub use intersection::{Intersection, Ray};
pub use judge::Verdict;
pub use lights::Arrival;
pub use maps::Maps;
pub use material::{Material, fresnel_dielectric};
pub use path::PathSample;
pub use quincunx::Quincunx;
pub use refinement::Refinement;
pub use reprojection::Kept;
pub use rng::Rng;
pub use rounding::{Cause, Rounding, SPAWN_ULPS, ULPS};
pub use sample::{Limits, Sample};
pub use similarity::Reached;
pub use stereo_reuse::Splat;
pub use supersampling::Tested;
pub use surface::Surface;
pub use texture::Encoding;
pub use traversal::{Hit, Tracer};

use crate::{
    Features, Scene,
    device::mip::{self, Content},
    scene::{Emitters, Image8, LobeAlbedos, Thinness},
};

/// A scene that is traced and shaded in f64.
pub struct Reference {
    scene: Scene,
    tracer: Tracer,
    features: Features,
    thinness: Thinness,
    emitters: Emitters,
    surroundings: Option<environment::Surroundings>,
    albedos: OnceLock<LobeAlbedos>,
    /// The mip levels of each image, from level 1 on.
    levels: Vec<Vec<Image8>>,
    bounds: (DVec3, DVec3),
    /// The linear value of each byte of sRGB.
    srgb: [f64; 256],
}

impl Reference {
    /// Prepares a [valid](Scene::validate) scene.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        Self::of(scene.clone())
    }

    /// Prepares a [valid](Scene::validate) scene that nobody else needs, without a copy of it.
    #[must_use]
    pub fn of(scene: Scene) -> Self {
        let contents = Content::of_images(&scene);
        let levels = scene.images.iter().zip(contents).map(|(image, content)| mip::levels(image, content));
        let levels = levels.collect();
        let (low, high) = scene.bounds().unwrap_or_default();
        Self {
            tracer: Tracer::new(&scene),
            features: Features::of(&scene),
            thinness: Thinness::of(&scene),
            emitters: Emitters::of(&scene),
            surroundings: environment::Surroundings::of(&scene),
            albedos: OnceLock::new(),
            levels,
            bounds: (low.as_dvec3(), high.as_dvec3()),
            srgb: texture::srgb_table(),
            scene,
        }
    }

    /// Uses an adapter's own decoding of sRGB bytes; graphics APIs tolerate an error of half a byte.
    #[must_use]
    pub fn with_srgb(self, srgb: [f64; 256]) -> Self {
        Self { srgb, ..self }
    }

    /// Traces faster with a tree like the shaders', for images instead of tests.
    #[must_use]
    pub fn with_wide_tree(self) -> Self {
        Self { tracer: self.tracer.with_wide_tree(), ..self }
    }

    /// The traversal of the scene's geometry, without materials.
    #[must_use]
    pub fn tracer(&self) -> &Tracer {
        &self.tracer
    }

    /// Longest side of the scene's bounding box, the unit of the distance tolerance (Kim 2016).
    #[must_use]
    pub fn longest_side(&self) -> f64 {
        (self.bounds.1 - self.bounds.0).max_element()
    }
}
