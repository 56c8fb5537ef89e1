//! Wishes for path tracing.

use serde::Serialize;

use crate::{Error, Result, scene::MAX_COORDINATE};

/// How the light of emitters is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Direct {
    /// By the path's own steps alone, as in Kim & Sung 2021: a path brings light where it happens to hit an emitter.
    Walk,
    /// By rays to points on emitters from every diffuse surface (next-event estimation), and where the path came by a
    /// mirror or glass.
    Light,
    /// Both, each weighted by how likely it was to find that point (Veach 1995, balance heuristic).
    Mis,
}

/// What shines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Shining {
    /// Emissive surfaces and punctual lights.
    All,
    /// Emissive surfaces alone: for files whose punctual lights stand for those.
    Emitters,
    /// Punctual lights alone; emissive surfaces are as bright as ever to the eye, but light nothing.
    Punctual,
}

/// Where the random numbers of a path come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Sampler {
    /// A hash: independent numbers.
    Random,
    /// Owen-scrambled Sobol' pairs (Burley 2020): the samples of a pixel are spread evenly.
    Sobol,
}

/// Whether long paths are ended at random, their survivors counting for more: no error in the mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Roulette {
    /// From the third bounce on, by how much light the path can still bring.
    On,
    /// Paths go on up to the depth limit.
    Off,
}

/// What happens to paths away from the gaze (Kim & Sung 2021, equation 7).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Stopping {
    /// They go on.
    Off,
    /// They stop with a probability that grows with the distance, and what they would have brought is missing: darker.
    Paper,
    /// They stop, and those that go on count for more: noisier away from the gaze, but right.
    Compensated,
}

/// Whether what one eye finds out about a point counts for the other eye too (Kim & Sung 2021, equations 1 to 6).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Crossing {
    /// Each eye for itself.
    Off,
    /// As in the paper: a sample counts as one more wherever it is seen, though points are not seen equally often by both
    /// eyes, and what a mirror shows goes where the reflected ray meets the other eye's picture. Biased.
    Paper,
    /// Points of diffuse surfaces, seen straight or in plane mirrors, each sample weighted by how often both eyes find
    /// its point (Veach, Guibas 1995, balance heuristic): no error in the mean.
    Weighted,
}

/// What is done about noise in the picture that is shown. What is added up is what paths brought, with or without it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Denoise {
    /// Nothing.
    Off,
    /// Kim & Sung 2021, section 3: a pixel whose last path was [stopped](Stopping) and met diffuse surfaces alone shows,
    /// channel by channel, the median of its 3x3 pixels. It does so however many samples there are: the picture stays
    /// darker than the mean, and more samples do not help there.
    Median,
    /// An edge-avoiding a-trous wavelet filter (Dammertz et al. 2010) of the light that arrives at the first diffuse
    /// surface, guided by its position, normal and albedo. Its colour weights narrow as samples are added up: the picture
    /// tends to the mean.
    Atrous,
}

names! {
    Crossing: Off = "off", Paper = "paper", Weighted = "weighted";
    Direct: Walk = "walk", Light = "light", Mis = "mis";
    Shining: All = "all", Emitters = "emitters", Punctual = "punctual";
    Sampler: Random = "random", Sobol = "sobol";
    Roulette: On = "on", Off = "off";
    Stopping: Off = "off", Paper = "paper", Compensated = "compensated";
    Denoise: Off = "off", Median = "median", Atrous = "atrous";
}

/// Everything that can be wished of paths.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Paths {
    /// Samples a pixel after which a resting view is finished; a frame adds one.
    pub samples: u32,
    /// How the light of emitters is found.
    pub direct: Direct,
    /// Points on emitters for each diffuse surface that a path meets.
    pub light_samples: u32,
    /// What shines.
    pub shining: Shining,
    /// Where random numbers come from.
    pub sampler: Sampler,
    /// Whether long paths end at random.
    pub roulette: Roulette,
    /// What happens to paths away from the gaze.
    pub stopping: Stopping,
    /// Where the eyes look, in widths and heights of the picture from its upper left corner.
    pub gaze: [f32; 2],
    /// The probability of stopping where the picture is farthest from the gaze, at each bounce.
    pub p_max: f32,
    /// Bounces that no path does without; [`Paths::stopping_level`] has where they may stop.
    pub stop_after: u32,
    /// Whether samples of one eye count for the other.
    pub crossing: Crossing,
    /// From one eye to the other, in the scene's units, which glTF has in metres.
    pub eye_distance: f32,
    /// From the eyes to where both see the same in the middle of their pictures, in the scene's units; none for eyes that
    /// look in parallel.
    pub convergence: Option<f32>,
    /// What is done about noise.
    pub denoise: Denoise,
}

/// The most points on emitters for a surface.
pub const MAX_LIGHT_SAMPLES: u32 = 64;

impl Default for Paths {
    fn default() -> Self {
        Self {
            samples: 1,
            direct: Direct::Mis,
            light_samples: 1,
            shining: Shining::All,
            sampler: Sampler::Sobol,
            roulette: Roulette::On,
            stopping: Stopping::Off,
            gaze: [0.5; 2],
            p_max: 0.9,
            stop_after: 1,
            crossing: Crossing::Weighted,
            eye_distance: 0.064,
            convergence: None,
            denoise: Denoise::Off,
        }
    }
}

impl Paths {
    /// The first surface that a path may stop at, counted from 1 for what the eye sees. Kim & Sung 2021, Algorithm 3, follows
    /// every path to the surface behind the threshold and shades it. Where those that go on count for more, that surface is
    /// as right without: only one in 1 / (1 - p) paths is followed there.
    pub fn stopping_level(&self) -> u32 {
        self.stop_after.saturating_add(if self.stopping == Stopping::Compensated { 1 } else { 2 })
    }

    /// Checks every value.
    pub(super) fn validate(&self) -> Result<()> {
        let wrong = |name: &str, expected: &str, found: String| {
            Err(Error::setting(name, format!("expected {expected}, found {found}")))
        };
        if self.samples == 0 {
            return wrong("--samples", "at least 1", "0".to_owned());
        }
        if !(1..=MAX_LIGHT_SAMPLES).contains(&self.light_samples) {
            let expected = format!("1 to {MAX_LIGHT_SAMPLES}");
            return wrong("--light-samples", &expected, self.light_samples.to_string());
        }
        if !self.gaze.iter().all(|g| g.abs() <= MAX_GAZE) {
            let expected = format!("two numbers from -{MAX_GAZE} to {MAX_GAZE}");
            return wrong("--gaze", &expected, format!("{},{}", self.gaze[0], self.gaze[1]));
        }
        // At 1 nothing would go on that could be compensated for.
        if !(0.0..1.0).contains(&self.p_max) {
            return wrong("--p-max", "a number of at least 0 and below 1", self.p_max.to_string());
        }
        if !(0.0..=MAX_COORDINATE).contains(&self.eye_distance) {
            let expected = format!("a number from 0 to {MAX_COORDINATE:e}");
            return wrong("--eye-distance", &expected, self.eye_distance.to_string());
        }
        if let Some(convergence) = self.convergence
            && !(convergence > 0.0 && convergence <= MAX_COORDINATE)
        {
            let expected = format!("a number above 0 and at most {MAX_COORDINATE:e}");
            return wrong("--convergence", &expected, convergence.to_string());
        }
        Ok(())
    }
}

/// How far outside the picture the eyes may look, in its widths and heights.
pub const MAX_GAZE: f32 = 1000.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_is_told_by_name() {
        let fine = Paths::default();
        assert!(fine.validate().is_ok());
        assert!(Paths { gaze: [-3.0, 2.0], p_max: 0.0, ..fine }.validate().is_ok());
        let wrong = [
            ("--samples", Paths { samples: 0, ..fine }),
            ("--light-samples", Paths { light_samples: 0, ..fine }),
            ("--light-samples", Paths { light_samples: 65, ..fine }),
            ("--gaze", Paths { gaze: [0.5, f32::NAN], ..fine }),
            ("--gaze", Paths { gaze: [1e4, 0.5], ..fine }),
            ("--p-max", Paths { p_max: 1.0, ..fine }),
            ("--p-max", Paths { p_max: f32::NAN, ..fine }),
            ("--eye-distance", Paths { eye_distance: -0.1, ..fine }),
            ("--eye-distance", Paths { eye_distance: f32::INFINITY, ..fine }),
            ("--convergence", Paths { convergence: Some(0.0), ..fine }),
            ("--convergence", Paths { convergence: Some(f32::NAN), ..fine }),
        ];
        for (name, paths) in wrong {
            let error = paths.validate().expect_err(name).to_string();
            assert!(error.contains(name), "{name}: {error}");
        }
    }
}
