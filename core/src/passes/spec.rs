//! The resolved specification of a frame, from which the plan and the kernels follow.

use crate::{
    Features, GpuScene, Method, Mip, Postcorrect, Robustness, Scene, Settings, Specialize,
    acceleration::MAX_STACK,
    device::Tier,
    device::gpu_scene::SceneFacts,
    scene::{Emitters, Thinness},
};

/// Where kernels write the colours of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// The display image: sRGB-encoded, 8 bits per channel.
    Display,
    /// An image of linear radiance, 32-bit floating point.
    Linear,
    /// The buffer of samples, as linear radiance; a later pass makes pixels of them.
    Samples,
    /// Nowhere, as in counting kernels of frames with several samples per pixel.
    Nowhere,
}

/// Whether the frame of an interpolating method needs a channel.
type Needed = fn(&FrameSpec) -> bool;

/// The possible channels of the attribute buffer, in order, and which interpolated frames need them.
pub(super) const CHANNELS: &[(&str, Needed)] = &[
    ("DEPTH", |_| true),
    ("OBJECT", |_| true),
    ("NORMAL", |_| true),
    ("SHADOW", |spec| spec.shadow_shift().is_none()),
    ("FACE", |spec| spec.features.smooth_normals),
    ("GCOL", |spec| spec.features.secondary_rays()),
    ("TEXCOORD", |spec| spec.features.textures),
    ("COLOR", |spec| spec.features.vertex_colors),
    ("COLOR_BLUE", |spec| spec.features.vertex_colors),
    ("FOOTPRINT", FrameSpec::averages_textures),
    ("TANGENT", |spec| spec.features.tangents),
    ("FIRST_S", |spec| spec.features.slot_coordinates),
    ("FIRST_T", |spec| spec.features.slot_coordinates),
    ("SECOND_S", |spec| spec.features.slot_coordinates),
    ("SECOND_T", |spec| spec.features.slot_coordinates),
    ("SECOND_FOOTPRINT", |spec| spec.features.slot_coordinates),
    ("OBJECT_BETWEEN", FrameSpec::postcorrects),
    ("SHADOW_BETWEEN", |spec| spec.postcorrects() && spec.shadow_shift().is_none()),
];

/// A resolved frame: settings without `auto`, facts of the scene, the device's tier and the outputs. Kernel
/// sources, plans and targets follow from it alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameSpec {
    /// The settings, with `auto` resolved.
    pub settings: Settings,
    /// The features that are linked.
    pub features: Features,
    /// Other facts of the scene that sources depend on.
    pub scene: SceneFacts,
    /// Whether light passes straight through some surfaces of the scene, independent of the linked features.
    pub has_panes: bool,
    /// The kind of device that kernels are made for.
    pub tier: Tier,
    /// Whether kernels count rays, samples and traversal work.
    pub inspect: bool,
    /// Whether counting kernels also write a record per pixel.
    pub records: bool,
    /// Where kernels write colours.
    pub output: Output,
    /// Whether the supersampling test also compares the secondary hit.
    pub secondary: bool,
    /// Whether surfaces are lit from the eye instead of by the scene's lights.
    pub preview: bool,
    /// Which measures against rounding errors are active.
    pub robustness: Robustness,
}

impl FrameSpec {
    /// Frames of an uploaded scene with kernels without counters, by settings without `auto`.
    #[must_use]
    pub fn new(scene: &GpuScene, settings: &Settings) -> Self {
        Self::linked(scene.features(), scene.facts(), scene.tier, settings)
    }

    /// Frames of a scene that is not on a device, as a GPU would render them; assumes the deepest traversal
    /// stack.
    pub(crate) fn of_scene(scene: &Scene, thinness: &Thinness, settings: &Settings) -> Self {
        let facts = SceneFacts {
            has_texcoords: !scene.texcoords.is_empty(),
            has_colors: !scene.colors.is_empty(),
            emits: !Emitters::of(scene).primitives.is_empty(),
            bvh_stack: MAX_STACK,
            lights: scene.lights.len() as u32,
            objects: scene.objects.len() as u32,
            probe_points: thinness.probe_points().len() as u32,
        };
        Self::linked(Features::of(scene), facts, Tier::Gpu, settings)
    }

    fn linked(needed: Features, scene: SceneFacts, tier: Tier, settings: &Settings) -> Self {
        let (features, scene) = match settings.specialize {
            Specialize::Auto => (needed, scene),
            // Shaders read the number of lights and the vertex layout instead of having them as constants.
            Specialize::All => (Features::all_beside(&needed), SceneFacts { bvh_stack: MAX_STACK, ..scene }),
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
            secondary: settings.supersamples() && features.secondary_rays(),
            preview: false,
            robustness: Robustness::default(),
        }
    }

    /// Previews of an uploaded scene: base colours by primary rays alone.
    #[must_use]
    pub fn preview(scene: &GpuScene) -> Self {
        let settings = Settings { method: Method::Full, mip: Mip::Off, ..Settings::default() };
        let spec = Self::new(scene, &settings);
        Self { features: spec.features.of_preview(), preview: true, ..spec }
    }

    /// These frames with other settings, without `auto`; previews keep theirs.
    #[must_use]
    pub fn changed(&self, scene: &GpuScene, settings: &Settings) -> Self {
        if self.preview { *self } else { Self::new(scene, settings) }
    }

    /// This frame with other settings.
    pub(super) fn with(&self, settings: Settings) -> Self {
        Self { settings, ..*self }
    }

    /// This frame with one sample per pixel, for kernels that process whole pixels.
    pub(super) fn one_sample(&self) -> Self {
        self.with(Settings { sampling: 1, ..self.settings })
    }

    /// Whether the method interpolates between stored attributes.
    pub(super) fn interpolates(&self) -> bool {
        self.settings.method == Method::Adaptive
    }

    /// Whether the image holds the views of two eyes side by side.
    pub(super) fn two_eyes(&self) -> bool {
        self.settings.method == Method::Vr
    }

    /// Whether samples tell that their mirrored ray met nothing, where it would see an environment map.
    pub(super) fn mirrors_environment(&self) -> bool {
        self.features.environment_map && self.features.reflection
    }

    /// Whether kernels read the table of the albedos of lobes.
    pub(crate) fn reads_lobe_albedos(&self) -> bool {
        self.features.sheen || self.features.microfacets && self.settings.method.is_path_traced()
    }

    /// First bit of the shadow mask in the object's word; `None` if the mask has a word of its own.
    pub(super) fn shadow_shift(&self) -> Option<u32> {
        let object_bits = 32 - self.scene.objects.leading_zeros();
        let flags = 1 + u32::from(self.mirrors_environment());
        (self.settings.specialize == Specialize::Auto && object_bits + self.scene.lights + flags <= 32)
            .then_some(object_bits)
    }

    /// Whether postcorrection runs.
    pub(super) fn postcorrects(&self) -> bool {
        matches!(self.settings.postcorrect, Postcorrect::Objects | Postcorrect::On | Postcorrect::Scans)
    }

    /// Number of attribute planes that supersampling compares, per row of samples.
    pub(super) fn pixel_edge_channels(&self) -> u32 {
        self.pixel_edge_round() + u32::from(self.settings.refines())
    }

    /// Index of the plane with a pixel's refinement round; it comes after the compared ones.
    pub(super) fn pixel_edge_round(&self) -> u32 {
        if self.features.secondary_rays() { 7 } else { 5 }
    }

    /// Number of all planes of the attribute buffer, per two rows of samples.
    pub fn stored_channels(&self) -> u32 {
        let edges = if self.settings.supersamples() { 2 * self.pixel_edge_channels() } else { 0 };
        self.channels().len() as u32 + edges
    }

    /// Whether textures are averaged over the ray's footprint.
    pub(super) fn averages_textures(&self) -> bool {
        self.features.textures && self.settings.mip == Mip::On
    }

    /// The names of the attribute planes that interpolation needs, in order.
    #[must_use]
    pub fn channels(&self) -> Vec<&'static str> {
        let needed = CHANNELS.iter().filter(|(_, is_needed)| self.interpolates() && is_needed(self));
        needed.map(|(name, _)| *name).collect()
    }
}
