//! Settings of a frame: every option, with what more and less of it costs and buys.

/// An enum whose values are those of an option: each with its name, a name that it had before after `or`, and what it does
/// in one sentence.
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
            /// All of them.
            pub const ALL: [Self; [$(Self::$variant),+].len()] = [$(Self::$variant),+];

            /// Names and sentences, in the order of `ALL`.
            pub const CHOICES: &'static [$crate::options::Choice] = &[$($crate::options::Choice {
                name: $name,
                old_name: choices!(@old $($old)?),
                summary: $summary,
            }),+];

            /// The one of that name, present or old.
            #[must_use]
            pub fn named(name: &str) -> Option<Self> {
                Self::CHOICES.iter().position(|choice| choice.is(name)).map(|index| Self::ALL[index])
            }

            /// Its name as a value of an option.
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
    /// How a frame is made.
    pub enum Method {
        /// One ray through every pixel: the reference.
        Full = "full" or "fixed": "A ray through every sample",
        /// Kim 2016, section 3: rays where the seven similarity checks ask for them, interpolation elsewhere.
        Adaptive = "adaptive": "Rays where neighbours differ, interpolation elsewhere (Kim 2016)",
        /// A baseline: a ray through every second pixel in the order of a checkerboard, the average of their neighbours in the
        /// others. One sample a pixel.
        Checkerboard = "checkerboard": "A ray through every second sample, averages elsewhere",
        /// Jin 2009: a ray through every pixel, and four more through those subpixels whose neighbours differ.
        Supersample = "supersample": "A ray through every pixel, extra samples where neighbours differ (Jin 2009)",
        /// Lecture, "Adaptive supersampling": rays through centres and corners of pixels, and more between those that differ.
        Quincunx = "quincunx": "Rays through centres and corners of pixels, more between those that differ (lecture)",
        /// The lecture's "frameless rendering": a share of the pixels is traced anew, in a well-spread order; the others stay
        /// as they are, whatever has moved. One sample a pixel.
        Frameless = "frameless": "Rays through a share of the pixels; the others stay as they are (lecture)",
        /// The lecture's "reprojection": what the frame before showed is moved to where the camera sees it now. What is not
        /// covered, what mirrors or lets light through, and a share of the pixels are traced. One sample a pixel.
        Reproject = "reproject": "The last frame moved to where the camera sees it; rays where that leaves gaps (lecture)",
        /// Monte Carlo path tracing (Kajiya 1986): unbiased, one sample a pixel and frame, added up while the camera rests.
        Path = "path": "Path tracing, a sample of every pixel in each frame",
        /// Kim & Sung 2021: paths for two eyes, side by side in one picture, the left one on the left. What one eye sees of a
        /// point the other may show too.
        Vr = "vr": "Path tracing for two eyes side by side, each of the frame's size (Kim & Sung 2021)",
    }
}

impl Method {
    /// A frame keeps something of the frames before it.
    #[must_use]
    pub fn has_history(self) -> bool {
        matches!(self, Self::Frameless | Self::Reproject) || self.is_path_traced()
    }

    /// A frame is a sample of each pixel, added to those before it.
    #[must_use]
    pub fn is_path_traced(self) -> bool {
        matches!(self, Self::Path | Self::Vr)
    }

    /// The picture of a frame whose eyes see so many pixels each: two of them are side by side.
    #[must_use]
    pub fn picture(self, [width, height]: [u32; 2]) -> [u32; 2] {
        [if self == Self::Vr { width.saturating_mul(2) } else { width }, height]
    }

    /// What an eye sees of such a picture.
    #[must_use]
    pub fn eye(self, [width, height]: [u32; 2]) -> [u32; 2] {
        [if self == Self::Vr { width.div_ceil(2) } else { width }, height]
    }

    /// Levels of rays where nothing else is wished: all of them for paths, which end by themselves.
    #[must_use]
    pub fn usual_depth(self) -> u32 {
        if self.is_path_traced() { MAX_DEPTH } else { 3 }
    }

    /// It knows pixels of one sample alone.
    #[must_use]
    pub fn takes_one_sample(self) -> bool {
        !matches!(self, Self::Full | Self::Adaptive)
    }
}

choices! {
    /// What is traced again after an adaptive frame, from traced pixels into interpolated neighbours that differ from them
    /// (Kim 2016, section 4).
    pub enum Postcorrect {
        /// Objects and shadows, if the scene holds something so thin that it may fall between samples.
        Auto = "auto": "Objects and shadows, where the scene holds things thinner than a block",
        /// Nothing.
        Off = "off": "Nothing",
        /// Where the object differs.
        Objects = "objects": "Where the object differs",
        /// Where the object or the shadow bits differ.
        On = "on": "Where the object or the shadow differs",
        /// As `On`, by the paper's scans along rows and columns (section 5).
        Scans = "scans": "As on, by scans along rows and columns",
    }
}

choices! {
    /// What of a texture a sample shows.
    pub enum Mip {
        /// The texture at the one point that the ray meets: it aliases where it is seen small.
        Off = "off": "The texture at the point that the ray meets",
        /// Its average over the part that the sample stands for, from mip levels; wherever texels are seen larger than
        /// samples, the same.
        On = "on": "Its average over what a sample stands for",
    }
}

choices! {
    /// Which pieces of the shaders are linked.
    pub enum Specialize {
        /// Only what the scene needs.
        Auto = "auto": "Only what the scene needs",
        /// Everything: the check that leaving out changes nothing.
        All = "all": "Everything",
    }
}

/// The tolerances of the similarity checks (Kim 2016, section 6). A pair of reference pixels passes a check
/// while its difference stays *below* the tolerance; stricter means more rays and less error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// G2, distance of the hit points in units of the scene's longest box side. 0 traces every pixel.
    pub pos: f32,
    /// G3, least cosine between the normals.
    pub norm: f32,
    /// TX, width of the border zone of the texture, [0, 0.5].
    pub tex: f32,
    /// GC, distance of the secondary radiances in linear RGB.
    pub gcol: f32,
}

impl Tolerances {
    /// What references may differ by that lie so many samples apart; as they stand for 2.
    ///
    /// An interpolated quantity is wrong by as much as it bends between the references, which grows with the square of
    /// their distance, while the checks see how much it changes. For normals the bound on 1 - cos, the square of an angle,
    /// shrinks with the square of the distance, so that the angle shrinks with the distance. What mirrors and glass show
    /// has no shape of its own to interpolate: its bound shrinks with the fourth power, so that larger blocks interpolate
    /// only where it is nearly constant. Distances grow with the stride by themselves, and the zone at the border of a
    /// texture is wider than any step: both stay. Chosen by measurement: desktop/MEASUREMENTS.md, "Larger blocks".
    #[must_use]
    pub fn at(&self, stride: u32) -> Self {
        let nearer = 2.0 / stride as f32;
        Self { norm: 1.0 - (1.0 - self.norm) * nearer.powi(2), gcol: self.gcol * nearer.powi(4), ..*self }
    }
}

impl Default for Tolerances {
    fn default() -> Self {
        Self { pos: 0.03, norm: 0.9, tex: 0.3, gcol: 0.15 }
    }
}

/// Everything that can be wished of a frame besides its size and camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How the frame is made.
    pub method: Method,
    /// When to trace.
    pub tolerances: Tolerances,
    /// Side of the square of samples of which one is always traced: 2, 4 or 8. Larger ones trace fewer samples and lose
    /// more of what is small.
    pub block: u32,
    /// Samples along a side of a pixel, 1 to [`MAX_SAMPLING`]: the method works on the finer grid, whose samples are
    /// averaged (Kim 2016's "Sampling" column).
    pub sampling: u32,
    /// What is traced again.
    pub postcorrect: Postcorrect,
    /// What of a texture a sample shows.
    pub mip: Mip,
    /// Levels of rays: 1 is primary rays alone. More shows more mirrors in mirrors, 1 to [`MAX_DEPTH`].
    pub depth: u32,
    /// Rays that would contribute less than this share of the pixel are not traced. 0 follows them all.
    pub min_weight: f32,
    /// The share of the pixels that a frame traces anew which keeps the others, above 0 and at most 1: more costs time,
    /// less leaves longer what is no longer so. No pixel is older than `1 / refresh_fraction` frames.
    pub refresh_fraction: f32,
    /// Which pieces are linked.
    pub specialize: Specialize,
    /// Extra samples after an adaptive frame too, where its pixels differ from their neighbours.
    pub supersample: bool,
    /// Where extra samples go.
    pub thresholds: Thresholds,
    /// Whose differences count; `None` for everything's.
    pub focus: Option<Focus>,
    /// Whether extra samples go to whole pixels, step by step.
    pub refine: Refine,
    /// What stands for the rest of a pixel.
    pub unsampled: Unsampled,
    /// Where samples lie.
    pub jitter: Jitter,
    /// How a pixel follows from several samples.
    pub filter: Filter,
    /// How much the ends of a quincunx may differ, 0 to 1, before there are samples between them; as [`Thresholds`].
    pub quincunx_threshold: f32,
    /// Of whatever is random; the same seed gives the same samples.
    pub seed: u32,
    /// What paths do.
    pub paths: Paths,
}

/// The deepest recursion: what the ray stack of the refraction kernels is sized for.
pub const MAX_DEPTH: u32 = 64;

/// The finest grid: 256 samples a pixel.
pub const MAX_SAMPLING: u32 = 16;

/// The most rays that a sample follows, shadow rays aside: nested glass would send 2^depth. Branches beyond count as the
/// environment's fallback radiance, as those that other limits cut off.
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
    /// Does a frame get extra samples?
    #[must_use]
    pub fn supersamples(&self) -> bool {
        self.method == Method::Supersample || self.supersample
    }

    /// Do they go to whole pixels, step by step?
    #[must_use]
    pub fn refines(&self) -> bool {
        match self.refine {
            Refine::Auto => self.supersample,
            Refine::On => self.supersamples(),
            Refine::Off => false,
        }
    }

    /// Can samples that were traced elsewhere be [merged](crate::Renderer::accumulate)? Not where pixels count them one by one.
    #[must_use]
    pub fn accepts_cpu_samples(&self) -> bool {
        let copied = self.reuses_stereo() && self.paths.stereo_reuse == StereoReuse::Paper;
        self.method.is_path_traced() && !copied
    }

    /// What is done about noise: it is that of paths.
    #[must_use]
    pub fn denoise(&self) -> Denoise {
        if self.method.is_path_traced() { self.paths.denoise } else { Denoise::Off }
    }

    /// Do samples of one eye count for the other?
    #[must_use]
    pub fn reuses_stereo(&self) -> bool {
        self.method == Method::Vr && self.paths.stereo_reuse != StereoReuse::Off
    }
}

/// The measures against rounding that traversal and spawned rays take. All are on in every frame; the stress cases leave
/// one out to see that they notice, and to measure what it costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Robustness {
    /// Edges of triangles are decided exactly (after Woop 2013).
    pub watertight: bool,
    /// Boxes are widened by what rounding may move a ray (after Ize 2013).
    pub boxes: bool,
    /// Spawned rays start off their surface.
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

    /// What traces everything still does: no pair is closer than 0, no cosine above 1.
    #[test]
    fn the_strictest_tolerances_stay_so() {
        let strictest = Tolerances { pos: 0.0, norm: 1.0, tex: 0.5, gcol: 0.0 };
        for stride in [2, 4, 8] {
            assert_eq!(strictest.at(stride), strictest);
        }
    }
}
