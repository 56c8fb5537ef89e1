//! `--environment` and `--environment-rotation`: what surrounds the scene.

use clap::Args;
use clap::builder::{OsStringValueParser, TypedValueParser};
use glimpse_measure::surroundings::{EnvironmentChoice, Surroundings};

use super::SCENE;

/// What surrounds the scene instead of what its file states.
#[derive(Clone, Debug, Default, PartialEq, Args)]
#[command(next_help_heading = SCENE)]
pub struct EnvironmentOptions {
    /// A .hdr or .exr map, builtin:studio, or none
    ///
    /// Light from all around; the map is equirectangular [default: what the file states; the studio if it brings no light]
    #[arg(long, value_name = "FILE", value_parser = OsStringValueParser::new().try_map(EnvironmentChoice::try_from))]
    pub environment: Option<EnvironmentChoice>,
    /// Turns the environment about the vertical axis, counter-clockwise seen from above
    #[arg(long, hide_short_help = true, value_name = "DEGREES", default_value_t = 0.0, allow_negative_numbers = true,
        value_parser = degrees)]
    pub environment_rotation: f32,
}

impl EnvironmentOptions {
    /// The choice to apply to a scene.
    pub fn surroundings(&self) -> Surroundings {
        Surroundings { environment: self.environment.clone(), rotation: self.environment_rotation }
    }
}

fn degrees(text: &str) -> Result<f32, String> {
    let angle = text.parse().ok().filter(|angle: &f32| angle.is_finite());
    angle.ok_or_else(|| format!("expected a finite number of degrees, found {text}"))
}
