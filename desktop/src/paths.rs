//! Options of path tracing.

use std::str::FromStr;

use clap::{Args, ValueEnum};
use glimpse::{Crossing, Denoise, Direct, Paths, Roulette, Sampler, Shining, Stopping};

/// What paths do.
#[derive(Clone, Debug, PartialEq, Args)]
pub struct PathOptions {
    /// Samples of a pixel of a path-traced picture
    #[arg(long = "samples", value_name = "N", default_value_t = Paths::default().samples)]
    pub path_samples: u32,
    /// How paths find the light of emitters: by meeting them, by rays to points on them, or by both
    #[arg(long, value_enum, default_value = "mis", ignore_case = true)]
    pub direct: DirectName,
    /// Points on emitters for each diffuse surface that a path meets
    #[arg(long, value_name = "N", default_value_t = Paths::default().light_samples)]
    pub light_samples: u32,
    /// What lights path-traced scenes
    #[arg(long, value_enum, default_value = "all", ignore_case = true)]
    pub shining: ShiningName,
    /// Where the random numbers of paths come from
    #[arg(long, value_enum, default_value = "sobol", ignore_case = true)]
    pub sampler: SamplerName,
    /// Long paths end at random, and those that go on count for more
    #[arg(long, value_enum, default_value = "on", ignore_case = true)]
    pub roulette: RouletteName,
    /// Paths stop away from the gaze
    #[arg(long, value_enum, default_value = "off", ignore_case = true)]
    pub stopping: StoppingName,
    /// Where the eyes look, in widths and heights of the picture from its upper left corner
    #[arg(long, value_name = "X,Y", default_value = "0.5,0.5", allow_hyphen_values = true)]
    pub gaze: Gaze,
    /// The probability of stopping where the picture is farthest from the gaze, at each bounce
    #[arg(long, value_name = "P", default_value_t = Paths::default().p_max, allow_negative_numbers = true)]
    pub p_max: f32,
    /// Bounces before paths may stop away from the gaze
    #[arg(long, value_name = "N", default_value_t = Paths::default().stop_after)]
    pub stop_after: u32,
    /// What one eye finds out counts for the other too
    #[arg(long, value_enum, default_value = "weighted", ignore_case = true)]
    pub crossing: CrossingName,
    /// From one eye to the other, in the scene's units
    #[arg(long, value_name = "D", default_value_t = Paths::default().eye_distance, allow_negative_numbers = true)]
    pub eye_distance: f32,
    /// From the eyes to where both see the same in the middle, in the scene's units [default: they look in parallel]
    #[arg(long, value_name = "D", allow_negative_numbers = true)]
    pub convergence: Option<f32>,
    /// What is done about noise in path-traced pictures
    #[arg(long, value_enum, default_value = "off", ignore_case = true)]
    pub denoise: DenoiseName,
    /// Threads that trace samples of paths beside the GPU, after the timed frames
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=MAX_CORES))]
    pub cores: u32,
}

/// The most threads beside the GPU.
const MAX_CORES: i64 = 256;

impl Default for PathOptions {
    fn default() -> Self {
        let paths = Paths::default();
        Self {
            path_samples: paths.samples,
            direct: DirectName::Mis,
            light_samples: paths.light_samples,
            shining: ShiningName::All,
            sampler: SamplerName::Sobol,
            roulette: RouletteName::On,
            stopping: StoppingName::Off,
            gaze: Gaze(paths.gaze),
            p_max: paths.p_max,
            stop_after: paths.stop_after,
            crossing: CrossingName::Weighted,
            eye_distance: paths.eye_distance,
            convergence: paths.convergence,
            denoise: DenoiseName::Off,
            cores: 0,
        }
    }
}

impl PathOptions {
    /// Is that the name of one of them?
    pub fn contain(option: &str) -> bool {
        let command = Self::augment_args(clap::Command::new("--vary"));
        command.get_arguments().any(|argument| argument.get_long() == Some(option))
    }

    /// Settings of paths.
    pub fn paths(&self) -> Paths {
        Paths {
            samples: self.path_samples,
            direct: self.direct.into(),
            light_samples: self.light_samples,
            shining: self.shining.into(),
            sampler: self.sampler.into(),
            roulette: self.roulette.into(),
            stopping: self.stopping.into(),
            gaze: self.gaze.0,
            p_max: self.p_max,
            stop_after: self.stop_after,
            crossing: self.crossing.into(),
            eye_distance: self.eye_distance,
            convergence: self.convergence,
            denoise: self.denoise.into(),
        }
    }
}

/// `--gaze X,Y`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaze(pub [f32; 2]);

impl FromStr for Gaze {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once(',').and_then(|(x, y)| Some([x.parse().ok()?, y.parse().ok()?]));
        numbers.map(Self).ok_or_else(|| format!("expected X,Y such as 0.5,0.5, found {text}"))
    }
}

/// `--direct`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DirectName {
    /// By meeting them
    Walk,
    /// By rays to points on them
    Light,
    /// By both, each weighted by how likely it was to find the point
    Mis,
}

/// `--shining`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShiningName {
    /// Emissive surfaces and punctual lights
    All,
    /// Emissive surfaces
    Emitters,
    /// Punctual lights
    Punctual,
}

/// `--sampler`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SamplerName {
    /// Independent numbers
    Random,
    /// Samples of a pixel are spread evenly
    Sobol,
}

/// `--roulette`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RouletteName {
    /// From the third bounce on
    On,
    /// Paths go on up to the depth limit
    Off,
}

/// `--stopping`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StoppingName {
    /// Paths go on
    Off,
    /// Those that go on count as before: darker
    Paper,
    /// Those that go on count for more: noisier
    Compensated,
}

/// `--crossing`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CrossingName {
    /// Each eye for itself
    Off,
    /// Wherever the other eye sees the point: biased
    Paper,
    /// Weighted by how often both find the point
    Weighted,
}

/// `--denoise`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DenoiseName {
    /// Nothing
    Off,
    /// Stopped paths that met diffuse surfaces alone show the median of their 3x3 pixels
    Median,
    /// Light is averaged along surfaces, less with every sample
    Atrous,
}

same_names! {
    CrossingName => Crossing: Off, Paper, Weighted;
    DirectName => Direct: Walk, Light, Mis;
    ShiningName => Shining: All, Emitters, Punctual;
    SamplerName => Sampler: Random, Sobol;
    RouletteName => Roulette: On, Off;
    StoppingName => Stopping: Off, Paper, Compensated;
    DenoiseName => Denoise: Off, Median, Atrous;
}
