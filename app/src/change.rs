//! A choice as text: what scripts set.

use std::str::FromStr;

use glimpse::{Denoise, Method, Mip, Postcorrect, Preset, Settings, Show, Stopping};

use crate::{Choices, FrameRate, Lenses, Overlay, SCALES};

/// One thing that is chosen.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Of a frame's settings: those after the change, of which one is taken.
    Setting(Setting),
    /// What the picture shows.
    Show(Show),
    /// Full ray tracing beside it.
    Split(Option<f32>),
    /// What two eyes look through.
    Lenses(Lenses),
    /// The resolution while nothing governs it.
    Scale(f32),
    /// What holds the frame time.
    Governor(Option<FrameRate>),
    /// The overlay.
    Overlay(Overlay),
}

/// A setting and its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// `method`
    Method(Method),
    /// `postcorrect`
    Postcorrect(Postcorrect),
    /// `mip`
    Mip(Mip),
    /// `block`
    Block(u32),
    /// `sampling`
    Sampling(u32),
    /// `depth`
    Depth(u32),
    /// `t-pos`
    Pos(f32),
    /// `t-norm`
    Norm(f32),
    /// `t-tex`
    Tex(f32),
    /// `t-gcol`
    Gcol(f32),
    /// `min-weight`
    MinWeight(f32),
    /// `supersample`
    Supersample(bool),
    /// `preset`
    Preset(Preset),
    /// `similar`
    Similar(f32),
    /// `share`
    Share(f32),
    /// `samples`
    Samples(u32),
    /// `stopping`
    Stopping(Stopping),
    /// `denoise`
    Denoise(Denoise),
}

impl Setting {
    fn apply(self, settings: &mut Settings) {
        let tolerances = &mut settings.tolerances;
        match self {
            Self::Method(method) => settings.method = method,
            Self::Postcorrect(postcorrect) => settings.postcorrect = postcorrect,
            Self::Mip(mip) => settings.mip = mip,
            Self::Block(block) => settings.block = block,
            Self::Sampling(sampling) => settings.sampling = sampling,
            Self::Depth(depth) => settings.depth = depth,
            Self::Pos(value) => tolerances.pos = value,
            Self::Norm(value) => tolerances.norm = value,
            Self::Tex(value) => tolerances.tex = value,
            Self::Gcol(value) => tolerances.gcol = value,
            Self::MinWeight(value) => settings.min_weight = value,
            Self::Share(value) => settings.share = value,
            Self::Supersample(supersample) => settings.supersample = supersample,
            Self::Preset(preset) => settings.thresholds = preset.thresholds(),
            Self::Similar(value) => settings.similar = value,
            Self::Samples(samples) => settings.paths.samples = samples,
            Self::Stopping(stopping) => settings.paths.stopping = stopping,
            Self::Denoise(denoise) => settings.paths.denoise = denoise,
        }
    }
}

impl Change {
    /// Makes it.
    ///
    /// # Errors
    /// A setting that does not go with the others; nothing is changed then.
    pub fn apply(&self, choices: &mut Choices) -> Result<(), String> {
        match self {
            Self::Setting(setting) => {
                let mut settings = choices.settings;
                setting.apply(&mut settings);
                settings.validate().map_err(|error| error.to_string())?;
                choices.settings = settings;
            }
            Self::Show(show) => choices.show = *show,
            Self::Split(split) => choices.split = *split,
            Self::Lenses(lenses) => choices.lenses = *lenses,
            Self::Scale(scale) => choices.scale = *scale,
            Self::Governor(governor) => choices.governor = *governor,
            Self::Overlay(overlay) => choices.overlay = *overlay,
        }
        Ok(())
    }
}

impl FromStr for Change {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, value) = text.split_once(' ').map_or((text, ""), |(name, value)| (name, value.trim()));
        let change = match name {
            "show" => Self::Show(value.parse()?),
            "split" if value == "off" => Self::Split(None),
            "split" => Self::Split(Some(number_within(value, [0.0, 1.0])?)),
            "lenses" => Self::Lenses(one_of(value, &Lenses::ALL.map(|lenses| (lenses.name(), lenses)))?),
            "scale" => Self::Scale(number_within(value, SCALES)?),
            "governor" => Self::Governor(one_of(
                value,
                &[
                    ("off", None),
                    ("15", Some(FrameRate::Fifteen)),
                    ("30", Some(FrameRate::Thirty)),
                    ("60", Some(FrameRate::Sixty)),
                ],
            )?),
            "overlay" => Self::Overlay(one_of(
                value,
                &[("hidden", Overlay::Hidden), ("brief", Overlay::Brief), ("full", Overlay::Full)],
            )?),
            _ => Self::Setting(setting(name, value)?),
        };
        // What no other choice could make right is wrong now.
        change.apply(&mut Choices::default())?;
        Ok(change)
    }
}

fn setting(name: &str, value: &str) -> Result<Setting, String> {
    Ok(match name {
        "method" => Setting::Method(one_of(value, &Method::ALL.map(|method| (method.name(), method)))?),
        "postcorrect" => {
            Setting::Postcorrect(one_of(value, &Postcorrect::ALL.map(|wish| (wish.name(), wish)))?)
        }
        "mip" => Setting::Mip(one_of(value, &Mip::ALL.map(|mip| (mip.name(), mip)))?),
        "block" => Setting::Block(number(value)?),
        "sampling" => Setting::Sampling(number(value)?),
        "depth" => Setting::Depth(number(value)?),
        "t-pos" => Setting::Pos(number(value)?),
        "t-norm" => Setting::Norm(number(value)?),
        "t-tex" => Setting::Tex(number(value)?),
        "t-gcol" => Setting::Gcol(number(value)?),
        "min-weight" => Setting::MinWeight(number(value)?),
        "supersample" => Setting::Supersample(one_of(value, &[("off", false), ("on", true)])?),
        "preset" => Setting::Preset(one_of(value, &Preset::ALL.map(|preset| (preset.name(), preset)))?),
        "similar" => Setting::Similar(number(value)?),
        "share" => Setting::Share(number(value)?),
        "samples" => Setting::Samples(number(value)?),
        "stopping" => {
            Setting::Stopping(one_of(value, &Stopping::ALL.map(|stopping| (stopping.name(), stopping)))?)
        }
        "denoise" => Setting::Denoise(one_of(value, &Denoise::ALL.map(|denoise| (denoise.name(), denoise)))?),
        _ => return Err(format!("expected the name of a choice, found `{name}`")),
    })
}

fn number<T: FromStr>(text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("expected a number, found `{text}`"))
}

fn number_within(text: &str, [low, high]: [f32; 2]) -> Result<f32, String> {
    let value = number(text)?;
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    Err(format!("expected a number from {low} to {high}, found `{text}`"))
}

fn one_of<T: Copy>(text: &str, values: &[(&str, T)]) -> Result<T, String> {
    values.iter().find(|(name, _)| *name == text).map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<_> = values.iter().map(|(name, _)| *name).collect();
        format!("expected {}, found `{text}`", names.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_that_go_with_no_others_are_refused_at_once() {
        for (text, expected) in [
            ("block 3", "2, 4 or 8"),
            ("depth 0", "1 to 64"),
            ("t-norm x", "expected a number, found `x`"),
            (
                "method maybe",
                "expected full, adaptive, checkerboard, supersample, quincunx, frameless, reproject, path, vr, found `maybe`",
            ),
            ("share 0", "above 0 and at most 1"),
            ("split 1.5", "expected a number from 0 to 1, found `1.5`"),
            ("mip maybe", "expected off, on, found `maybe`"),
            ("color red", "expected the name of a choice, found `color`"),
            ("show everything", "expected one of final, origin"),
        ] {
            let error = text.parse::<Change>().unwrap_err();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }

    #[test]
    fn a_change_that_does_not_go_with_the_others_changes_nothing() {
        let mut choices = Choices::default();
        "method checkerboard".parse::<Change>().expect("a change").apply(&mut choices).expect("changed");
        let before = choices;
        assert!("sampling 2".parse::<Change>().expect("a change").apply(&mut choices).is_err());
        assert_eq!(choices, before);
    }
}
