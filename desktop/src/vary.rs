//! `--vary OPTION=V1,V2,...`: compares values of an option in one run.

use std::str::FromStr;

use super::FrameOptions;

/// An option of a frame with the values to compare.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variation {
    /// Name of the option, without dashes.
    pub option: String,
    /// Values as typed.
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

/// Varied options, each with one value.
pub type Varied = Vec<(String, String)>;

impl FrameOptions {
    /// These options with one more value, as if typed.
    ///
    /// # Errors
    /// Fails with one line that names the option and the expected values.
    pub fn with(&self, option: &str, value: &str) -> Result<Self, String> {
        Ok(Self { typed: self.typed.with(option, value)?, ..self.clone() })
    }

    /// Every combination of the values, the last option varying fastest, with the values that it has.
    ///
    /// # Errors
    /// Fails as [`FrameOptions::with`].
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
