//! Settings of path tracing.

choices! {
    /// How paths find the light of emissive surfaces.
    pub enum DirectLight {
        /// Sampling of the BSDF alone, as in Kim & Sung 2021: a path gathers light when it happens to hit an
        /// emitter.
        Bsdf = "bsdf" or "walk": "By meeting them: sampling of the BSDF alone",
        /// Next-event estimation: shadow rays from every diffuse surface to points on emitters. Emitters that a
        /// path hits count only directly or after specular reflection or refraction.
        Nee = "nee" or "light": "By rays to points on them: next-event estimation",
        /// Both, combined by multiple importance sampling with the balance heuristic (Veach & Guibas 1995).
        Mis = "mis": "By both, each weighted by how likely it was to find the point (balance heuristic)",
    }
}

choices! {
    /// Which light sources illuminate the scene.
    pub enum LightSelection {
        /// Emissive surfaces and punctual lights.
        All = "all": "Emissive surfaces and punctual lights",
        /// Emissive surfaces only, for files whose punctual lights stand in for them.
        Emitters = "emitters": "Emissive surfaces, for files whose punctual lights stand for those",
        /// Punctual lights only. Emissive surfaces are visible but illuminate nothing.
        Punctual = "punctual": "Punctual lights",
    }
}

choices! {
    /// The random number generator of paths.
    pub enum Sampler {
        /// Independent numbers from a hash function.
        Random = "random": "Independent numbers",
        /// Owen-scrambled Sobol' pairs (Burley 2020), which stratify the samples of each pixel.
        Sobol = "sobol": "Owen-scrambled Sobol' pairs: the samples of a pixel are spread evenly",
    }
}

choices! {
    /// Russian roulette: ends long paths at random and weights the others up, which keeps the estimate unbiased.
    pub enum Roulette {
        /// From the third bounce on, with a probability that depends on the path's throughput.
        On = "on": "From the third bounce on",
        /// All paths continue to the depth limit.
        Off = "off": "Paths go on up to the depth limit",
    }
}

choices! {
    /// Foveated path tracing: stops paths away from the gaze (Kim & Sung 2021, equation 7).
    pub enum Foveation {
        /// No path is stopped.
        Off = "off": "Paths go on",
        /// Paths stop with a probability that grows with the distance from the gaze. The others are not weighted
        /// up, so pixels become darker.
        Paper = "paper": "Paths stop, and those that go on count as before: darker",
        /// Paths stop as with `Paper`, and the others are weighted up: unbiased, but noisier away from the gaze.
        Compensated = "compensated": "Paths stop, and those that go on count for more: noisier",
    }
}

choices! {
    /// Stereo reuse: whether samples of one eye contribute to the other (Kim & Sung 2021, equations 1 to 6).
    pub enum StereoReuse {
        /// Eyes are rendered independently.
        Off = "off": "Each eye for itself",
        /// As in the paper: a sample counts fully in the other eye wherever that sees its point, although the
        /// eyes sample points with different density. Mirrored points go to where the reflected ray meets the
        /// other eye's image. Biased.
        Paper = "paper": "Wherever the other eye sees the point: biased",
        /// Points on diffuse surfaces, seen directly or in planar mirrors. Weighted by the density with which
        /// both eyes sample the point (balance heuristic, Veach & Guibas 1995). Unbiased.
        Weighted = "weighted": "Weighted by how often both find the point: unbiased",
    }
}

choices! {
    /// The denoiser of the displayed image; the accumulated samples are not affected.
    pub enum Denoise {
        /// No denoiser.
        Off = "off": "Nothing",
        /// Kim & Sung 2021, section 3: a pixel whose last path was [stopped](Foveation) and hit only diffuse
        /// surfaces shows the median of its 3x3 pixels, channel by channel. This does not depend on the number of
        /// samples, so the image stays darker than the mean.
        Median = "median": "Stopped paths that met diffuse surfaces alone show the median of their 3x3 pixels",
        /// An edge-avoiding a-trous wavelet filter (Dammertz et al. 2010) of the light that arrives at the first
        /// diffuse surface, guided by position, normal and albedo. Its colour weights narrow as samples
        /// accumulate, so that the image converges to the mean.
        Atrous = "atrous": "An edge-avoiding a-trous filter that narrows with every sample",
    }
}

/// Settings of the path-tracing methods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paths {
    /// Samples per pixel at which a still view is complete; each frame adds one.
    pub samples: u32,
    /// How paths find the light of emissive surfaces.
    pub direct_light: DirectLight,
    /// Shadow rays towards emitters at each diffuse surface of a path.
    pub light_samples: u32,
    /// Which light sources illuminate the scene.
    pub lights: LightSelection,
    /// The random number generator.
    pub sampler: Sampler,
    /// Whether long paths end at random.
    pub roulette: Roulette,
    /// Whether paths away from the gaze are stopped.
    pub foveation: Foveation,
    /// Position of the gaze in widths and heights of one eye's image, from its upper left corner.
    pub gaze: [f32; 2],
    /// Probability of stopping at each bounce in the corner of the image farthest from the gaze.
    pub foveation_max: f32,
    /// Number of bounces before a path may be stopped; see [`Paths::foveation_level`].
    pub foveation_start: u32,
    /// Whether samples of one eye contribute to the other.
    pub stereo_reuse: StereoReuse,
    /// Distance between the eyes in the scene's unit of length (metres in glTF).
    pub eye_distance: f32,
    /// Distance at which the centres of both eyes' images show the same point, in the scene's unit of length;
    /// `None` for parallel views.
    pub convergence: Option<f32>,
    /// The denoiser of the displayed image.
    pub denoise: Denoise,
    /// Number of CPU threads that trace samples in addition to the GPU. A [`crate::Renderer`] starts none: the
    /// caller runs them and passes their samples to [`crate::Renderer::accumulate`].
    pub cpu_threads: u32,
}

/// Largest number of shadow rays towards emitters per surface.
pub const MAX_LIGHT_SAMPLES: u32 = 64;

/// Largest number of CPU threads.
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
    /// Index of the first surface at which a path may stop, counted from 1 for the visible surface. Kim & Sung
    /// 2021, Algorithm 3, traces every path to the surface after the threshold and shades it. With compensated
    /// weights the estimate is correct without that surface, so only one in 1 / (1 - p) paths is traced there.
    pub fn foveation_level(&self) -> u32 {
        self.foveation_start.saturating_add(if self.foveation == Foveation::Compensated { 1 } else { 2 })
    }
}

/// Farthest position of the gaze outside the image, in widths and heights of the image.
pub const MAX_GAZE: f32 = 1000.0;
