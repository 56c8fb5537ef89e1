//! `--vary OPTION=V1,V2,...`: settings compared with each other in one run.

use std::str::FromStr;

use clap::parser::ValueSource;
use clap::{ArgMatches, Args, FromArgMatches};

use super::FrameOptions;

/// One scene is rendered at one size through one camera in a run.
const FIXED: [&str; 2] = ["size", "camera"];

/// An option of a frame with the values to compare.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variation {
    /// Its name, without dashes.
    pub option: String,
    /// As they would follow the option.
    pub values: Vec<String>,
}

impl FromStr for Variation {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((option, values)) = text.split_once('=') else {
            return Err("expected OPTION=VALUE,VALUE,..., for example block=2,4,8".to_owned());
        };
        let option = option.trim_start_matches('-').to_owned();
        let values: Vec<_> = values.split(',').map(str::to_owned).collect();
        for value in &values {
            FrameOptions::default().with(&option, value)?;
        }
        Ok(Self { option, values })
    }
}

/// Options with the values that they take.
pub type Varied = Vec<(String, String)>;

impl FrameOptions {
    /// These options with one more, as if it had been typed.
    ///
    /// # Errors
    /// One line that names the option, and what was expected of it.
    pub fn with(&self, option: &str, value: &str) -> Result<Self, String> {
        // Only what is typed is to change.
        let command = Self::augment_args(clap::Command::new("--vary").no_binary_name(true))
            .mut_args(|argument| argument.default_value(None::<&str>));
        let names = || command.get_arguments().filter_map(clap::Arg::get_long).filter(|n| !FIXED.contains(n));
        if !names().any(|name| name == option) {
            return Err(format!(
                "expected one of {}, found {option}",
                names().collect::<Vec<_>>().join(", ")
            ));
        }
        let mut options = self.clone();
        command
            .try_get_matches_from([format!("--{option}={value}")])
            .and_then(|mut matches| options.update_from_arg_matches_mut(&mut matches))
            .map_err(|error| first_line(&error))?;
        Ok(options)
    }

    /// Every combination of the values, the last option's varying fastest, each with what was varied.
    ///
    /// # Errors
    /// As [`FrameOptions::with`].
    pub fn combinations(&self, variations: &[Variation]) -> Result<Vec<(Self, Varied)>, String> {
        let mut all = vec![(self.clone(), Vec::new())];
        for Variation { option, values } in variations {
            let mut longer = Vec::with_capacity(all.len() * values.len());
            for (options, varied) in &all {
                for value in values {
                    let mut varied = varied.clone();
                    varied.push((option.clone(), value.clone()));
                    longer.push((options.with(option, value)?, varied));
                }
            }
            all = longer;
        }
        Ok(all)
    }
}

/// Names of a frame's options that were typed after `render`, without dashes.
pub fn typed(matches: &ArgMatches) -> Vec<String> {
    let Some(matches) = matches.subcommand_matches("render") else { return Vec::new() };
    let frame = FrameOptions::augment_args(clap::Command::new("render"));
    let typed = frame
        .get_arguments()
        .filter(|option| matches.value_source(option.get_id().as_str()) == Some(ValueSource::CommandLine));
    typed.filter_map(|option| option.get_long().map(str::to_owned)).collect()
}

fn first_line(error: &clap::Error) -> String {
    let text = error.to_string();
    text.lines().next().unwrap_or_default().trim_start_matches("error: ").to_owned()
}
