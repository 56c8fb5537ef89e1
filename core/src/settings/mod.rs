//! Settings of a frame: the method and its parameters, with their cost and benefit.

/// Declares an enum that is a choice of an option. Each variant has a name, an earlier name after `or`, and a
/// description in one sentence.
macro_rules! choices {
    (
        $(#[$doc:meta])*
        pub enum $kind:ident {
            $($(#[$about:meta])* $variant:ident = $name:literal $(or $old:literal)?: $summary:literal,)+
        }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $kind {
            $($(#[$about])* $variant,)+
        }

        impl $kind {
            /// All variants, in order of declaration.
            pub const ALL: [Self; [$(Self::$variant),+].len()] = [$(Self::$variant),+];

            /// Names and descriptions, in the order of `ALL`.
            pub const CHOICES: &'static [$crate::options::Choice] = &[$($crate::options::Choice {
                name: $name,
                old_name: choices!(@old $($old)?),
                summary: $summary,
            }),+];

            /// Finds a variant by its present or earlier name.
            #[must_use]
            pub fn named(name: &str) -> Option<Self> {
                Self::CHOICES.iter().position(|choice| choice.is(name)).map(|index| Self::ALL[index])
            }

            /// The variant's name as a value of an option.
            #[must_use]
            pub fn name(self) -> &'static str {
                Self::CHOICES[self as usize].name
            }
        }
    };
    (@old) => { None };
    (@old $old:literal) => { Some($old) };
}

pub mod options;
mod paths;
mod supersampling;

pub use paths::{
    Denoise, DirectLight, Foveation, LightSelection, MAX_CPU_THREADS, MAX_GAZE, MAX_LIGHT_SAMPLES, Paths,
    Roulette, Sampler, StereoReuse,
};
pub use supersampling::{Filter, Focus, Jitter, Preset, Refine, THRESHOLD_NAMES, Thresholds, Unsampled};

choices! {
    /// The tone curve, from radiance to what is displayed.
    pub enum Tonemap {
        /// Radiance above 1 is displayed as 1.
        None = "none": "Radiance as it is, cut off above 1",
        /// Khronos PBR Neutral: colours up to 0.8 stay nearly as they are; above, they are compressed and lose
        /// saturation.
        Neutral = "neutral": "Khronos PBR Neutral: highlights are compressed",
    }
}

choices! {
    /// The rendering method of a frame.
    pub enum Method {
        /// Full ray tracing: a ray through every sample. The reference for the other methods.
        Full = "full" or "fixed": "A ray through every sample",
        /// Adaptive undersampling (Kim 2016, section 3): traces samples where a similarity check
        /// fails and interpolates elsewhere.
        Adaptive = "adaptive": "Rays where neighbours differ, interpolation elsewhere (Kim 2016)",
        /// A baseline: traces every second pixel in a checkerboard pattern and averages neighbours in the others.
        /// One sample per pixel.
        Checkerboard = "checkerboard": "A ray through every second sample, averages elsewhere",
        /// Selective supersampling (Jin 2009): a ray through every pixel, and four more through each subpixel
        /// that differs.
        Supersample = "supersample": "A ray through every pixel, extra samples where neighbours differ (Jin 2009)",
        /// Adaptive supersampling (lecture): rays through centres and corners of pixels, and more between those
        /// that differ.
        Quincunx = "quincunx": "Rays through centres and corners of pixels, more between those that differ (lecture)",
        /// Frameless rendering (lecture): traces a fraction of the pixels in a well-distributed order and keeps
        /// the others, even if the view changes. One sample per pixel.
        Frameless = "frameless": "Rays through a share of the pixels; the others stay as they are (lecture)",
        /// Reprojection (lecture): projects the points of the last frame into the current view. Traces pixels
        /// that no point covers, mirrors and transparent surfaces, and a fraction of all pixels. One sample per
        /// pixel.
        Reproject = "reproject": "The last frame moved to where the camera sees it; rays where that leaves gaps (lecture)",
        /// Monte Carlo path tracing (Kajiya 1986): unbiased; each frame adds one sample per pixel while the
        /// camera rests.
        Path = "path": "Path tracing, a sample of every pixel in each frame",
        /// Stereo path tracing (Kim & Sung 2021): the views of two eyes side by side, the left eye's on the left.
        /// Samples of one eye may be reused for the other.
        Vr = "vr": "Path tracing for two eyes side by side, each of the frame's size (Kim & Sung 2021)",
    }
}

impl Method {
    /// Whether frames reuse data of the frames before them.
    #[must_use]
    pub fn has_history(self) -> bool {
        match self {
            Self::Frameless | Self::Reproject | Self::Path | Self::Vr => true,
            Self::Full | Self::Adaptive | Self::Checkerboard | Self::Supersample | Self::Quincunx => false,
        }
    }

    /// Whether frames accumulate one path sample per pixel each.
    #[must_use]
    pub fn is_path_traced(self) -> bool {
        matches!(self, Self::Path | Self::Vr)
    }

    /// Size of the image for eyes with `width` x `height` pixels each; two eyes are side by side.
    #[must_use]
    pub fn picture(self, [width, height]: [u32; 2]) -> [u32; 2] {
        [if self == Self::Vr { width.saturating_mul(2) } else { width }, height]
    }

    /// Size of one eye's view in an image of `width` x `height` pixels.
    #[must_use]
    pub fn eye(self, [width, height]: [u32; 2]) -> [u32; 2] {
        [if self == Self::Vr { width.div_ceil(2) } else { width }, height]
    }

    /// Default ray depth: the maximum for path tracing, where paths end by themselves, else 3.
    #[must_use]
    pub fn usual_depth(self) -> u32 {
        if self.is_path_traced() { MAX_DEPTH } else { 3 }
    }

    /// Why the pixels of its frames have no surfaces, only colours; `None` if they have.
    #[must_use]
    pub fn lacks_surfaces(self) -> Option<&'static str> {
        match self {
            Self::Full | Self::Adaptive | Self::Supersample | Self::Quincunx => None,
            Self::Checkerboard => {
                Some("A checkerboard averages every second pixel: no surface belongs to an average.")
            }
            Self::Frameless | Self::Reproject | Self::Path | Self::Vr => {
                Some("Of pixels that are kept only the colour is known.")
            }
        }
    }

    /// Whether the method supports only one sample per pixel.
    #[must_use]
    pub fn takes_one_sample(self) -> bool {
        !matches!(self, Self::Full | Self::Adaptive)
    }
}

choices! {
    /// Postcorrection after an adaptive frame (Kim 2016, section 4): which interpolated pixels next to differing
    /// traced ones are traced.
    pub enum Postcorrect {
        /// `On` if the scene has objects so thin that they may fall between samples, else `Off`.
        Auto = "auto": "Objects and shadows, where the scene holds things thinner than a block",
        /// No pixel is traced again.
        Off = "off": "Nothing",
        /// Traces interpolated pixels with a different object.
        Objects = "objects": "Where the object differs",
        /// Traces interpolated pixels with a different object or different shadow bits.
        On = "on": "Where the object or the shadow differs",
        /// The pixels of `On`, found by the paper's scans along rows and columns (Kim 2016, section 5).
        Scans = "scans": "As on, by scans along rows and columns",
    }
}

choices! {
    /// Texture filtering of a sample.
    pub enum Mip {
        /// The texture at the hit point, which aliases under minification.
        Off = "off": "The texture at the point that the ray meets",
        /// The average of the texture over the sample's footprint, from mip levels; identical under
        /// magnification.
        On = "on": "Its average over what a sample stands for",
    }
}

choices! {
    /// Which parts of the shaders are linked.
    pub enum Specialize {
        /// Only the parts that the scene needs.
        Auto = "auto": "Only what the scene needs",
        /// All parts. Images must be the same, which tests the specialization.
        All = "all": "Everything",
    }
}

/// Tolerances of the similarity checks (Kim 2016, section 6). Two reference pixels pass a check while their
/// difference is *below* the tolerance; stricter tolerances trace more rays and reduce the error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// G2: distance between the hit points in units of the longest side of the scene's bounding box. 0 traces
    /// every pixel.
    pub pos: f32,
    /// G3: least cosine of the angle between the normals.
    pub norm: f32,
    /// TX: width of the zone at the texture's border, in texture coordinates, 0 to 0.5.
    pub tex: f32,
    /// GC: distance between the secondary radiances in linear RGB.
    pub gcol: f32,
}

impl Tolerances {
    /// The tolerances for references `stride` samples apart; the fields hold those for a distance of 2.
    ///
    /// The error of interpolation is the curvature of a quantity between the references, which grows with the
    /// square of their distance, while the checks measure its change. For normals the bound on 1 - cos (the
    /// square of an angle) shrinks with the square of the distance, so that the angle shrinks linearly. Reflected
    /// and refracted radiance has no shape of its own to interpolate: its bound shrinks with the fourth power, so
    /// that larger blocks interpolate only where it is nearly constant. Distances grow with the stride by
    /// themselves, and the texture border zone is wider than any step: both stay. Chosen by measurement
    /// (desktop/MEASUREMENTS.md, "Larger blocks").
    #[must_use]
    pub fn at(&self, stride: u32) -> Self {
        let nearer = 2.0 / stride as f32;
        Self { norm: 1.0 - (1.0 - self.norm) * nearer.powi(2), gcol: self.gcol * nearer.powi(4), ..*self }
    }

    /// Looser by a factor above 1, which passes more pairs, or stricter by one below. What fails every pair still does.
    #[must_use]
    pub fn relaxed(&self, factor: f32) -> Self {
        let Self { pos, norm, tex, gcol } = *self;
        Self {
            pos: (pos * factor).min(f32::MAX),
            // A bound of a cosine: its distance from 1 is scaled, down to -1. No cosine is above 1.
            norm: if norm > 1.0 { norm } else { (1.0 - (1.0 - norm) * factor).max(norm.min(-1.0)) },
            // The width of the border zone of a texture: narrower is looser.
            tex: (tex / factor).min(0.5),
            gcol: (gcol * factor).min(f32::MAX),
        }
    }
}

impl Default for Tolerances {
    fn default() -> Self {
        Self { pos: 0.03, norm: 0.9, tex: 0.3, gcol: 0.15 }
    }
}

/// All settings of a frame except its size and camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The rendering method.
    pub method: Method,
    /// Tolerances of the adaptive method's similarity checks.
    pub tolerances: Tolerances,
    /// Side of the square of samples of which one is always traced: 2, 4 or 8. Larger blocks trace fewer samples
    /// and miss more small features.
    pub block: u32,
    /// Samples along a side of a pixel, 1 to [`MAX_SAMPLING`]. The method works on this finer grid and the filter
    /// makes pixels of its samples (Kim 2016, "Sampling").
    pub sampling: u32,
    /// Which interpolated pixels postcorrection traces.
    pub postcorrect: Postcorrect,
    /// Texture filtering.
    pub mip: Mip,
    /// Levels of the ray tree, 1 to [`MAX_DEPTH`]; 1 traces primary rays only.
    pub depth: u32,
    /// Rays with a smaller weight in the pixel's radiance are not traced, 0 to 1; 0 traces them all.
    pub min_weight: f32,
    /// Fraction of the pixels that a frame of a method with history traces, above 0 and at most 1. Larger
    /// fractions cost more time, smaller ones keep outdated pixels longer: up to `1 / refresh_fraction` frames.
    pub refresh_fraction: f32,
    /// Exposure in EV: all light is multiplied by 2 to this power; `None` for [`crate::Scene::auto_exposure`].
    pub exposure: Option<f32>,
    /// How radiance is compressed for display.
    pub tonemap: Tonemap,
    /// Which parts of the shaders are linked.
    pub specialize: Specialize,
    /// Whether adaptive frames also get extra samples where pixels differ from their neighbours.
    pub supersample: bool,
    /// Contrast thresholds for extra samples.
    pub thresholds: Thresholds,
    /// The objects whose attributes are compared for extra samples; `None` compares all.
    pub focus: Option<Focus>,
    /// Whether extra samples are given to whole pixels in several steps.
    pub refine: Refine,
    /// The colour of subpixels without extra samples.
    pub unsampled: Unsampled,
    /// Where samples lie within their cells.
    pub jitter: Jitter,
    /// The filter that makes pixels of several samples.
    pub filter: Filter,
    /// Contrast threshold of method quincunx, 0 to 1, as in [`Thresholds`]: samples that differ more are divided.
    pub quincunx_threshold: f32,
    /// Seed of all random numbers; equal seeds give equal samples.
    pub seed: u32,
    /// Settings of path tracing.
    pub paths: Paths,
}

/// Largest ray depth, which the ray stack of the refraction kernels is sized for.
pub const MAX_DEPTH: u32 = 64;

/// Largest absolute exposure in EV.
pub const MAX_EXPOSURE: f32 = 30.0;

/// Largest sampling: 16 x 16 = 256 samples per pixel.
pub const MAX_SAMPLING: u32 = 16;

/// Largest number of rays per sample, shadow rays excluded; nested glass would otherwise trace 2^depth. Further
/// branches have the environment's fallback radiance, like those that other limits cut off.
pub const MAX_RAYS: u32 = 1024;

impl Default for Settings {
    fn default() -> Self {
        Self {
            method: Method::Adaptive,
            tolerances: Tolerances::default(),
            block: 2,
            sampling: 1,
            postcorrect: Postcorrect::Auto,
            mip: Mip::On,
            depth: 3,
            min_weight: 0.05,
            refresh_fraction: 0.1,
            exposure: None,
            tonemap: Tonemap::None,
            specialize: Specialize::Auto,
            supersample: false,
            thresholds: Thresholds::default(),
            focus: None,
            refine: Refine::Auto,
            unsampled: Unsampled::Nearest,
            jitter: Jitter::Auto,
            filter: Filter::Box,
            quincunx_threshold: 0.1,
            seed: 0,
            paths: Paths::default(),
        }
    }
}

impl Settings {
    /// Whether the frame gets extra samples.
    #[must_use]
    pub fn supersamples(&self) -> bool {
        self.method == Method::Supersample || self.supersample
    }

    /// Whether extra samples are given to whole pixels in several steps ([`Refine::On`]).
    #[must_use]
    pub fn refines(&self) -> bool {
        match self.refine {
            Refine::Auto => self.supersample,
            Refine::On => self.supersamples(),
            Refine::Off => false,
        }
    }

    /// Whether [`crate::Renderer::accumulate`] can add CPU samples. Unweighted stereo reuse counts samples per
    /// pixel and cannot.
    #[must_use]
    pub fn accepts_cpu_samples(&self) -> bool {
        let copied = self.reuses_stereo() && self.paths.stereo_reuse == StereoReuse::Paper;
        self.method.is_path_traced() && !copied
    }

    /// The active denoiser; methods other than path tracing have none.
    #[must_use]
    pub fn denoise(&self) -> Denoise {
        if self.method.is_path_traced() { self.paths.denoise } else { Denoise::Off }
    }

    /// Whether samples of one eye contribute to the other.
    #[must_use]
    pub fn reuses_stereo(&self) -> bool {
        self.method == Method::Vr && self.paths.stereo_reuse != StereoReuse::Off
    }
}

/// Measures against rounding errors in traversal and at the origins of secondary rays. All are on in every frame;
/// stress tests leave one out to show its effect and to measure its cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Robustness {
    /// Exact edge tests of triangles (after Woop et al. 2013).
    pub watertight: bool,
    /// Bounding boxes enlarged by the bound of rounding errors (after Ize 2013).
    pub boxes: bool,
    /// Secondary rays start at an offset from their surface.
    pub offset: bool,
}

impl Default for Robustness {
    fn default() -> Self {
        Self { watertight: true, boxes: true, offset: true }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_is_above_0_and_at_most_1() {
        for (share, fits) in
            [(0.0, false), (-0.1, false), (f32::NAN, false), (1.001, false), (1e-9, true), (1.0, true)]
        {
            assert_eq!(
                Settings { refresh_fraction: share, ..Settings::default() }.validate().is_ok(),
                fits,
                "{share}"
            );
        }
    }

    #[test]
    fn tolerances_are_those_of_every_second_sample() {
        let strange = Tolerances { pos: 0.7, norm: -0.5, tex: 0.2, gcol: 3.0 };
        for tolerances in [Tolerances::default(), strange] {
            assert_eq!(tolerances.at(2), tolerances);
        }
    }

    #[test]
    fn references_that_lie_further_apart_may_differ_less() {
        let tolerances = Tolerances::default();
        for (stride, norm, gcol) in [(4, 0.975, 0.15 / 16.0), (8, 0.993_75, 0.15 / 256.0)] {
            let further = tolerances.at(stride);
            assert_eq!((further.pos, further.tex), (tolerances.pos, tolerances.tex));
            assert!((further.norm - norm).abs() < 1e-6, "{stride}: {further:?}");
            assert!((further.gcol - gcol).abs() < 1e-6, "{stride}: {further:?}");
        }
    }

    #[test]
    fn relaxed_tolerances_pass_more() {
        let t = Tolerances::default();
        assert_eq!(t.relaxed(1.0), t);
        for (factor, expected) in [
            (2.0, Tolerances { pos: 0.06, norm: 0.8, tex: 0.15, gcol: 0.3 }),
            (0.5, Tolerances { pos: 0.015, norm: 0.95, tex: 0.5, gcol: 0.075 }),
            (1e9, Tolerances { pos: 3e7, norm: -1.0, tex: 3e-10, gcol: 1.5e8 }),
        ] {
            let found = t.relaxed(factor);
            let (Tolerances { pos, norm, tex, gcol }, e) = (found, expected);
            for (a, b) in [(pos, e.pos), (norm, e.norm), (tex, e.tex), (gcol, e.gcol)] {
                assert!((a - b).abs() <= 1e-6 * b.abs().max(0.1), "{factor}: {found:?}");
            }
        }
        let loosest = Tolerances { pos: f32::MAX, norm: -1.0, tex: 0.0, gcol: f32::MAX };
        let strictest = Tolerances { pos: 0.0, norm: 2.0, tex: 0.5, gcol: 0.0 };
        assert_eq!(loosest.relaxed(2.0), loosest);
        assert_eq!(strictest.relaxed(2.0), Tolerances { tex: 0.25, ..strictest });
    }

    /// Tolerances that trace every pixel do so at any stride: no distance is below 0, no cosine above 1.
    #[test]
    fn the_strictest_tolerances_stay_so() {
        let strictest = Tolerances { pos: 0.0, norm: 1.0, tex: 0.5, gcol: 0.0 };
        for stride in [2, 4, 8] {
            assert_eq!(strictest.at(stride), strictest);
        }
    }
}
