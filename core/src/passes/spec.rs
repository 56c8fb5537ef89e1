//! Everything that decides what the kernels of a frame are made of and what its plan is.

use crate::{
    Features, GpuScene, Method, Mip, Postcorrect, Robustness, Scene, Settings, Specialize,
    acceleration::MAX_STACK,
    device::Tier,
    device::gpu_scene::SceneFacts,
    scene::{Emitters, Thinness},
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

/// Whether a frame that interpolates needs a channel.
type Needed = fn(&FrameSpec) -> bool;

/// The channels that the attribute buffer may have, in order, and which frames that interpolate need them.
pub(super) const CHANNELS: &[(&str, Needed)] = &[
    ("DEPTH", |_| true),
    ("OBJECT", |_| true),
    ("NORMAL", |_| true),
    ("SHADOW", |spec| spec.shadow_shift().is_none()),
    ("FACE", |spec| spec.features.smooth_normals),
    ("GCOL", |spec| spec.features.reflection || spec.features.refraction),
    ("TEXCOORD", |spec| spec.features.textures),
    ("COLOR", |spec| spec.features.vertex_colors),
    ("FOOTPRINT", FrameSpec::averages_textures),
    ("OBJECT_BETWEEN", FrameSpec::postcorrects),
    ("SHADOW_BETWEEN", |spec| spec.postcorrects() && spec.shadow_shift().is_none()),
];

/// A frame that is resolved: settings without `auto`, facts of the scene, tier of the device, and what is written where.
/// Sources of kernels, plans and targets follow from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameSpec {
    /// With what `auto` has come to.
    pub settings: Settings,
    /// What is linked.
    pub features: Features,
    /// What is known of the scene besides.
    pub scene: SceneFacts,
    /// Light passes straight through some surfaces of the scene, whatever is linked.
    pub has_panes: bool,
    /// What the device gets.
    pub tier: Tier,
    /// Counting kernels.
    pub inspect: bool,
    /// They keep a record of every pixel.
    pub records: bool,
    /// Where colours go.
    pub output: Output,
    /// What differs between neighbours includes the secondary hit.
    pub secondary: bool,
    /// The measures against rounding.
    pub robustness: Robustness,
}

impl FrameSpec {
    /// Timed frames of a scene, by settings without `auto`.
    #[must_use]
    pub fn new(scene: &GpuScene, settings: &Settings) -> Self {
        Self::linked(scene.features(), scene.facts(), scene.tier, settings)
    }

    /// As GPUs have them, of a scene that is not on a device; its tree is not built and may be any.
    pub(crate) fn of_scene(scene: &Scene, settings: &Settings) -> Self {
        let facts = SceneFacts {
            has_texcoords: !scene.texcoords.is_empty(),
            has_colors: !scene.colors.is_empty(),
            emits: !Emitters::of(scene).primitives.is_empty(),
            bvh_stack: MAX_STACK,
            lights: scene.lights.len() as u32,
            objects: scene.objects.len() as u32,
            probe_points: Thinness::of(scene).probe_points().len() as u32,
        };
        Self::linked(Features::of(scene), facts, Tier::Gpu, settings)
    }

    fn linked(needed: Features, scene: SceneFacts, tier: Tier, settings: &Settings) -> Self {
        let (features, scene) = match settings.specialize {
            Specialize::Auto => (needed, scene),
            // Numbers of lights and of words a vertex are read, not known.
            Specialize::All => (Features::all(), SceneFacts { bvh_stack: MAX_STACK, ..scene }),
        };
        Self {
            settings: *settings,
            features,
            scene,
            has_panes: needed.panes,
            tier,
            inspect: false,
            records: false,
            output: Output::Display,
            secondary: settings.supersamples() && (features.reflection || features.refraction),
            robustness: Robustness::default(),
        }
    }

    /// The same with other settings.
    pub(super) fn with(&self, settings: Settings) -> Self {
        Self { settings, ..*self }
    }

    /// For kernels that see pixels of one sample.
    pub(super) fn one_sample(&self) -> Self {
        self.with(Settings { sampling: 1, ..self.settings })
    }

    /// Attributes are kept to interpolate between.
    pub(super) fn interpolates(&self) -> bool {
        self.settings.method == Method::Adaptive
    }

    /// Two eyes are side by side in the picture.
    pub(super) fn two_eyes(&self) -> bool {
        self.settings.method == Method::Vr
    }

    /// Where the shadow bits begin in the word of the object; `None` if they need a word of their own.
    pub(super) fn shadow_shift(&self) -> Option<u32> {
        let object_bits = 32 - self.scene.objects.leading_zeros();
        (self.settings.specialize == Specialize::Auto && object_bits + self.scene.lights < 32)
            .then_some(object_bits)
    }

    /// Is anything traced again?
    pub(super) fn postcorrects(&self) -> bool {
        matches!(self.settings.postcorrect, Postcorrect::Objects | Postcorrect::On | Postcorrect::Scans)
    }

    /// Planes of what supersampling compares, for one row of the frame.
    pub(super) fn pixel_edge_channels(&self) -> u32 {
        self.pixel_edge_round() + u32::from(self.settings.refines())
    }

    /// The plane of them that tells in which round a pixel is refined, behind the others.
    pub(super) fn pixel_edge_round(&self) -> u32 {
        if self.features.reflection || self.features.refraction { 7 } else { 5 }
    }

    /// All planes of the attribute buffer, for two rows of the frame.
    pub fn stored_channels(&self) -> u32 {
        let edges = if self.settings.supersamples() { 2 * self.pixel_edge_channels() } else { 0 };
        self.channels().len() as u32 + edges
    }

    /// Do samples show averages of textures?
    pub(super) fn averages_textures(&self) -> bool {
        self.features.textures && self.settings.mip == Mip::On
    }

    /// The planes of the attribute buffer that interpolation needs, in order.
    #[must_use]
    pub fn channels(&self) -> Vec<&'static str> {
        let needed = CHANNELS.iter().filter(|(_, is_needed)| self.interpolates() && is_needed(self));
        needed.map(|(name, _)| *name).collect()
    }
}
