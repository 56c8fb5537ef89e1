//! Options about where samples go: jitter, extra samples and what they are worth (Jin 2009).

use std::str::FromStr;

use clap::{ArgAction, Args, ValueEnum};
use glimpse::{Filter, Focus, Inactive, Jitter, Method, Preset, Refine, Settings, Thresholds};

/// What decides where samples go.
#[derive(Clone, Debug, PartialEq, Args)]
pub struct SampleOptions {
    /// Extra samples after the adaptive frame, where its pixels differ from their neighbours
    #[arg(long, value_name = "BOOL", action = ArgAction::Set, num_args = 0..=1, require_equals = true,
        default_value_t = false, default_missing_value = "true", hide_default_value = true)]
    pub supersample: bool,
    /// Thresholds of the contrast that extra samples need
    #[arg(long, value_enum, default_value = "balanced", ignore_case = true)]
    pub preset: PresetName,
    #[command(flatten)]
    pub tau: TauOptions,
    /// Extra samples for the differences of these objects: a part of their names, an index, or FIRST-LAST
    #[arg(long, value_name = "OBJECT")]
    pub focus: Option<String>,
    /// Extra samples for whole pixels, 4 to 16 of them as they differ, and along what they find
    #[arg(long, value_enum, default_value = "auto", ignore_case = true)]
    pub refine: RefineName,
    /// What stands for the rest of a pixel that gets extra samples
    #[arg(long, value_enum, default_value = "nearest", ignore_case = true)]
    pub inactive: InactiveName,
    /// Samples lie anywhere in their cells
    #[arg(long, value_enum, default_value = "auto", ignore_case = true)]
    pub jitter: JitterName,
    /// How a pixel follows from the samples of a grid
    #[arg(long, value_enum, default_value = "box", ignore_case = true)]
    pub filter: FilterName,
    /// How much the ends of a quincunx may differ before there are samples between them, 0 to 1
    #[arg(long, value_name = "X", default_value_t = Settings::default().similar, allow_negative_numbers = true)]
    pub similar: f32,
    /// Of whatever is random; the same seed gives the same samples
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u32,
}

/// `--tau-*`: thresholds in the place of the preset's, 0 (always) to 1 (never).
#[derive(Clone, Debug, Default, PartialEq, Args)]
pub struct TauOptions {
    /// Threshold where nothing but colours differ, 0 to 1 [default: the preset's]
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub tau_col: Option<f32>,
    /// Threshold where objects differ
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub tau_poid: Option<f32>,
    /// Threshold where surface normals differ
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub tau_psn: Option<f32>,
    /// Threshold where shadows differ
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub tau_psc: Option<f32>,
    /// Threshold on textured surfaces
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub tau_pte: Option<f32>,
    /// Threshold where objects differ that are seen in mirrors or through glass
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub tau_soid: Option<f32>,
    /// Threshold where their normals differ
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub tau_ssn: Option<f32>,
    /// Threshold where their shadows differ
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub tau_ssc: Option<f32>,
    /// Threshold where they are textured
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub tau_ste: Option<f32>,
}

impl Default for SampleOptions {
    fn default() -> Self {
        Self {
            supersample: false,
            preset: PresetName::Balanced,
            tau: TauOptions::default(),
            focus: None,
            refine: RefineName::Auto,
            inactive: InactiveName::Nearest,
            jitter: JitterName::Auto,
            filter: FilterName::Box,
            similar: Settings::default().similar,
            seed: 0,
        }
    }
}

impl SampleOptions {
    /// Those that one method of several can heed.
    pub fn concerning(&self, method: Method) -> Self {
        let mut samples = self.clone();
        samples.supersample &= method == Method::Adaptive;
        if method != Method::Full {
            samples.filter = FilterName::Box;
        }
        if !matches!(method, Method::Full | Method::Supersample) && self.jitter == JitterName::On {
            samples.jitter = JitterName::Auto;
        }
        samples
    }

    /// The preset's thresholds, with those that were typed.
    pub fn thresholds(&self) -> Thresholds {
        let (t, preset) = (&self.tau, Preset::from(self.preset).thresholds());
        Thresholds {
            col: t.tau_col.unwrap_or(preset.col),
            poid: t.tau_poid.unwrap_or(preset.poid),
            psn: t.tau_psn.unwrap_or(preset.psn),
            psc: t.tau_psc.unwrap_or(preset.psc),
            pte: t.tau_pte.unwrap_or(preset.pte),
            soid: t.tau_soid.unwrap_or(preset.soid),
            ssn: t.tau_ssn.unwrap_or(preset.ssn),
            ssc: t.tau_ssc.unwrap_or(preset.ssc),
            ste: t.tau_ste.unwrap_or(preset.ste),
        }
    }
}

/// Objects by `FIRST-LAST` or by one index; `None` for a name.
pub fn focus_by_index(text: &str) -> Option<Focus> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    Some(Focus { first: u32::from_str(first).ok()?, last: u32::from_str(last).ok()? })
}

/// `--preset`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PresetName {
    /// What is most visible: edges and shadows, textures where they are strong (Jin 2009, Table 2)
    Balanced,
    /// Textures too
    Textures,
    /// Edges alone
    Edges,
    /// Colours alone, whatever their cause
    Color,
    /// Edges and shadows wherever they show, textures where they are strong: for --refine on
    Refined,
}

/// `--refine`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RefineName {
    /// On with --supersample, off with --method supersample
    Auto,
    /// Whole pixels, step by step
    On,
    /// Quarters of pixels (Jin 2009)
    Off,
}

/// `--inactive`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum InactiveName {
    /// The sample at the pixel's centre
    Nearest,
    /// The centres around it, bilinearly
    Bilinear,
}

/// `--jitter`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum JitterName {
    /// Extra samples do, others lie in the centre
    Auto,
    /// All do: noise in the place of aliasing
    On,
    /// None do
    Off,
}

/// `--filter`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FilterName {
    /// The mean of its own samples
    Box,
    /// The neighbours' samples too, the less the farther off
    Tent,
}

same_names! {
    PresetName => Preset: Balanced, Textures, Edges, Color, Refined;
    RefineName => Refine: Auto, On, Off;
    InactiveName => Inactive: Nearest, Bilinear;
    JitterName => Jitter: Auto, On, Off;
    FilterName => Filter: Box, Tent;
}
