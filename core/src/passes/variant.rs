//! What decides which pieces a kernel is made of.

use crate::{
    Features, Filter, GpuScene, Inactive, Jitter, Linking, Method, Mip, Paths, Postcorrect, Robustness,
    Scene, Settings, bvh::MAX_STACK, scene::Emitters,
};

/// Where colours go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// sRGB, 8 bits.
    Display,
    /// Linear radiance, 32-bit floating point.
    Linear,
    /// Linear radiance of samples that pixels are made of later.
    Samples,
    /// Nowhere: counting kernels of frames with several samples a pixel.
    Nowhere,
}

/// What decides which pieces a kernel is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variant {
    /// What is linked.
    pub features: Features,
    /// With [`Linking::All`] what the scene has is not known either: numbers of lights and of words a vertex are read.
    pub linking: Linking,
    /// The scene stores texture coordinates.
    pub has_texcoords: bool,
    /// The scene stores vertex colours.
    pub has_colors: bool,
    /// Light passes straight through some surfaces of the scene, whatever is linked.
    pub has_panes: bool,
    /// The device is a CPU, whose cores share a dispatch by ranges and read images faster than buffers.
    pub on_cpu: bool,
    /// Counting kernels.
    pub inspect: bool,
    /// They keep a record of every pixel.
    pub records: bool,
    /// Where colours go.
    pub output: Output,
    /// Samples along a side of a pixel.
    pub sampling: u32,
    /// What is traced again.
    pub postcorrect: Postcorrect,
    /// Attributes are kept to interpolate between.
    pub interpolates: bool,
    /// What differs between neighbours is kept, for extra samples.
    pub supersamples: bool,
    /// They go to whole pixels, step by step.
    pub refines: bool,
    /// The secondary hit is among it.
    pub secondary: bool,
    /// What stands for the rest of a pixel.
    pub inactive: Inactive,
    /// Where samples lie.
    pub jitter: Jitter,
    /// How a pixel follows from several samples.
    pub filter: Filter,
    /// What of a texture a sample shows.
    pub mip: Mip,
    /// What paths do.
    pub paths: Paths,
    /// Two eyes are side by side in the picture.
    pub two_eyes: bool,
    /// Some primitive emits.
    pub emits: bool,
    /// Groups on the traversal stack.
    pub bvh_stack: u32,
    /// Levels of rays.
    pub depth: u32,
    /// Lights of the scene.
    pub lights: u32,
    /// Objects of the scene.
    pub objects: u32,
    /// The measures against rounding.
    pub robustness: Robustness,
}

impl Variant {
    /// Timed frames of a scene.
    #[must_use]
    pub fn new(scene: &GpuScene, settings: &Settings) -> Self {
        Self {
            has_texcoords: scene.has_texcoords,
            has_colors: scene.has_colors,
            on_cpu: scene.on_cpu,
            bvh_stack: scene.bvh_stack,
            lights: scene.light_count,
            objects: scene.object_count,
            emits: scene.emitter_count > 0,
            ..Self::of_settings(scene.features(), settings)
        }
        .linked(settings.features)
    }

    /// Timed frames of a scene that is not on a device; its tree is not built and may be any.
    pub(super) fn of_scene(scene: &Scene, settings: &Settings) -> Self {
        Self {
            has_texcoords: !scene.texcoords.is_empty(),
            has_colors: !scene.colors.is_empty(),
            lights: scene.lights.len() as u32,
            objects: scene.objects.len() as u32,
            emits: !Emitters::of(scene).primitives.is_empty(),
            ..Self::of_settings(Features::of(scene), settings)
        }
        .linked(settings.features)
    }

    /// Timed frames of a scene with these features of which nothing else is known.
    fn of_settings(features: Features, settings: &Settings) -> Self {
        Self {
            features,
            linking: Linking::Auto,
            has_texcoords: false,
            has_colors: false,
            has_panes: features.panes,
            on_cpu: false,
            inspect: false,
            records: false,
            output: Output::Display,
            sampling: settings.sampling,
            postcorrect: settings.postcorrect,
            interpolates: settings.method == Method::Adaptive,
            supersamples: settings.supersamples(),
            refines: settings.refines(),
            secondary: false,
            inactive: settings.inactive,
            jitter: settings.jitter,
            filter: settings.filter,
            mip: settings.mip,
            paths: settings.paths,
            two_eyes: settings.method == Method::Vr,
            emits: false,
            bvh_stack: MAX_STACK,
            depth: settings.depth,
            lights: 0,
            objects: 0,
            robustness: Robustness::default(),
        }
    }

    fn linked(self, linking: Linking) -> Self {
        let linked = match linking {
            Linking::Auto => self,
            Linking::All => Self { features: Features::all(), linking, bvh_stack: MAX_STACK, ..self },
        };
        let bounces = linked.features.reflection || linked.features.refraction;
        Self { secondary: linked.supersamples && bounces, ..linked }
    }

    /// Where the shadow bits begin in the word of the object; `None` if they need a word of their own.
    pub(super) fn shadow_shift(&self) -> Option<u32> {
        let object_bits = 32 - self.objects.leading_zeros();
        (self.linking == Linking::Auto && object_bits + self.lights < 32).then_some(object_bits)
    }

    /// Is anything traced again?
    pub(super) fn postcorrects(&self) -> bool {
        matches!(self.postcorrect, Postcorrect::Objects | Postcorrect::On | Postcorrect::Scans)
    }

    /// Planes of what supersampling compares, for one row of the frame.
    pub(super) fn edge_planes(&self) -> u32 {
        self.edge_round() + u32::from(self.refines)
    }

    /// The plane of them that tells in which round a pixel is refined, behind the others.
    pub(super) fn edge_round(&self) -> u32 {
        if self.features.reflection || self.features.refraction { 7 } else { 5 }
    }

    /// All planes of the attribute buffer, for two rows of the frame.
    pub fn stored_planes(&self) -> u32 {
        let edges = if self.supersamples { 2 * self.edge_planes() } else { 0 };
        self.planes().len() as u32 + edges
    }

    /// Do samples show averages of textures?
    pub(super) fn averages_textures(&self) -> bool {
        self.features.textures && self.mip == Mip::On
    }

    /// The planes of the attribute buffer that interpolation needs, in order.
    #[must_use]
    pub fn planes(&self) -> Vec<&'static str> {
        if !self.interpolates {
            return Vec::new();
        }
        let f = &self.features;
        let optional = [
            ("SHADOW", self.shadow_shift().is_none()),
            ("FACE", f.smooth_normals),
            ("GCOL", f.reflection || f.refraction),
            ("TEXCOORD", f.textures),
            ("COLOR", f.vertex_colors),
            ("FOOTPRINT", self.averages_textures()),
            ("OBJECT_BETWEEN", self.postcorrects()),
            ("SHADOW_BETWEEN", self.postcorrects() && self.shadow_shift().is_none()),
        ];
        let present = optional.into_iter().filter_map(|(name, there)| there.then_some(name));
        ["DEPTH", "OBJECT", "NORMAL"].into_iter().chain(present).collect()
    }
}
