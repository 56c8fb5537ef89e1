//! Wishes for path tracing.

choices! {
    /// How the light of emitters is found.
    pub enum DirectLight {
        /// By the path's own steps alone, as in Kim & Sung 2021: a path brings light where it happens to hit an emitter.
        Bsdf = "bsdf" or "walk": "By meeting them: sampling of the BSDF alone",
        /// By rays to points on emitters from every diffuse surface (next-event estimation), and where the path came by a
        /// mirror or glass.
        Nee = "nee" or "light": "By rays to points on them: next-event estimation",
        /// Both, each weighted by how likely it was to find that point (Veach 1995, balance heuristic).
        Mis = "mis": "By both, each weighted by how likely it was to find the point (balance heuristic)",
    }
}

choices! {
    /// What shines.
    pub enum LightSelection {
        /// Emissive surfaces and punctual lights.
        All = "all": "Emissive surfaces and punctual lights",
        /// Emissive surfaces alone: for files whose punctual lights stand for those.
        Emitters = "emitters": "Emissive surfaces, for files whose punctual lights stand for those",
        /// Punctual lights alone; emissive surfaces are as bright as ever to the eye, but light nothing.
        Punctual = "punctual": "Punctual lights",
    }
}

choices! {
    /// Where the random numbers of a path come from.
    pub enum Sampler {
        /// A hash: independent numbers.
        Random = "random": "Independent numbers",
        /// Owen-scrambled Sobol' pairs (Burley 2020): the samples of a pixel are spread evenly.
        Sobol = "sobol": "Owen-scrambled Sobol' pairs: the samples of a pixel are spread evenly",
    }
}

choices! {
    /// Whether long paths are ended at random, their survivors counting for more: no error in the mean.
    pub enum Roulette {
        /// From the third bounce on, by how much light the path can still bring.
        On = "on": "From the third bounce on",
        /// Paths go on up to the depth limit.
        Off = "off": "Paths go on up to the depth limit",
    }
}

choices! {
    /// What happens to paths away from the gaze (Kim & Sung 2021, equation 7).
    pub enum Foveation {
        /// They go on.
        Off = "off": "Paths go on",
        /// They stop with a probability that grows with the distance, and what they would have brought is missing: darker.
        Paper = "paper": "Paths stop, and those that go on count as before: darker",
        /// They stop, and those that go on count for more: noisier away from the gaze, but right.
        Compensated = "compensated": "Paths stop, and those that go on count for more: noisier",
    }
}

choices! {
    /// Whether what one eye finds out about a point counts for the other eye too (Kim & Sung 2021, equations 1 to 6).
    pub enum StereoReuse {
        /// Each eye for itself.
        Off = "off": "Each eye for itself",
        /// As in the paper: a sample counts as one more wherever it is seen, though points are not seen equally often by both
        /// eyes, and what a mirror shows goes where the reflected ray meets the other eye's picture. Biased.
        Paper = "paper": "Wherever the other eye sees the point: biased",
        /// Points of diffuse surfaces, seen straight or in plane mirrors, each sample weighted by how often both eyes find
        /// its point (Veach, Guibas 1995, balance heuristic): no error in the mean.
        Weighted = "weighted": "Weighted by how often both find the point: unbiased",
    }
}

choices! {
    /// What is done about noise in the picture that is shown. What is added up is what paths brought, with or without it.
    pub enum Denoise {
        /// Nothing.
        Off = "off": "Nothing",
        /// Kim & Sung 2021, section 3: a pixel whose last path was [stopped](Foveation) and met diffuse surfaces alone shows,
        /// channel by channel, the median of its 3x3 pixels. It does so however many samples there are: the picture stays
        /// darker than the mean, and more samples do not help there.
        Median = "median": "Stopped paths that met diffuse surfaces alone show the median of their 3x3 pixels",
        /// An edge-avoiding a-trous wavelet filter (Dammertz et al. 2010) of the light that arrives at the first diffuse
        /// surface, guided by its position, normal and albedo. Its colour weights narrow as samples are added up: the picture
        /// tends to the mean.
        Atrous = "atrous": "An edge-avoiding a-trous filter that narrows with every sample",
    }
}

/// Everything that can be wished of paths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paths {
    /// Samples a pixel after which a resting view is finished; a frame adds one.
    pub samples: u32,
    /// How the light of emitters is found.
    pub direct_light: DirectLight,
    /// Points on emitters for each diffuse surface that a path meets.
    pub light_samples: u32,
    /// What shines.
    pub lights: LightSelection,
    /// Where random numbers come from.
    pub sampler: Sampler,
    /// Whether long paths end at random.
    pub roulette: Roulette,
    /// What happens to paths away from the gaze.
    pub foveation: Foveation,
    /// Where the eyes look, in widths and heights of the picture from its upper left corner.
    pub gaze: [f32; 2],
    /// The probability of stopping where the picture is farthest from the gaze, at each bounce.
    pub foveation_max: f32,
    /// Bounces that no path does without; [`Paths::foveation_level`] has where they may stop.
    pub foveation_start: u32,
    /// Whether samples of one eye count for the other.
    pub stereo_reuse: StereoReuse,
    /// From one eye to the other, in the scene's units, which glTF has in metres.
    pub eye_distance: f32,
    /// From the eyes to where both see the same in the middle of their pictures, in the scene's units; none for eyes that
    /// look in parallel.
    pub convergence: Option<f32>,
    /// What is done about noise.
    pub denoise: Denoise,
    /// Threads of the CPU that trace samples beside the GPU. A [`crate::Renderer`] starts none: its caller runs them, and
    /// [merges](crate::Renderer::accumulate) what they bring.
    pub cpu_threads: u32,
}

/// The most points on emitters for a surface.
pub const MAX_LIGHT_SAMPLES: u32 = 64;

/// The most threads of the CPU.
pub const MAX_CPU_THREADS: u32 = 256;

impl Default for Paths {
    fn default() -> Self {
        Self {
            samples: 1,
            direct_light: DirectLight::Mis,
            light_samples: 1,
            lights: LightSelection::All,
            sampler: Sampler::Sobol,
            roulette: Roulette::On,
            foveation: Foveation::Off,
            gaze: [0.5; 2],
            foveation_max: 0.9,
            foveation_start: 1,
            stereo_reuse: StereoReuse::Weighted,
            eye_distance: 0.064,
            convergence: None,
            denoise: Denoise::Off,
            cpu_threads: 0,
        }
    }
}

impl Paths {
    /// The first surface that a path may stop at, counted from 1 for what the eye sees. Kim & Sung 2021, Algorithm 3, follows
    /// every path to the surface behind the threshold and shades it. Where those that go on count for more, that surface is
    /// as right without: only one in 1 / (1 - p) paths is followed there.
    pub fn foveation_level(&self) -> u32 {
        self.foveation_start.saturating_add(if self.foveation == Foveation::Compensated { 1 } else { 2 })
    }
}

/// How far outside the picture the eyes may look, in its widths and heights.
pub const MAX_GAZE: f32 = 1000.0;
