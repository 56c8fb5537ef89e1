//! What settings may be, each and together.

use super::{Filter, Focus, Jitter, MAX_DEPTH, MAX_SAMPLING, Method, Settings};
use crate::{Error, Result};

impl Settings {
    /// Checks every value.
    ///
    /// # Errors
    /// [`Error::Setting`] names the option, what was expected and what was found.
    pub fn validate(&self) -> Result<()> {
        let t = &self.tolerances;
        let ranges = [
            ("--t-pos", t.pos, 0.0, f32::MAX),
            ("--t-norm", t.norm, -1.0, 2.0),
            ("--t-tex", t.tex, 0.0, 0.5),
            ("--t-gcol", t.gcol, 0.0, f32::MAX),
            ("--min-weight", self.min_weight, 0.0, 1.0),
            ("--similar", self.similar, 0.0, 1.0),
        ];
        for (name, value, low, high) in ranges {
            if !(low..=high).contains(&value) {
                let range = if high == f32::MAX {
                    format!("a number of at least {low}")
                } else {
                    format!("a number from {low} to {high}")
                };
                return Err(Error::setting(name, format!("expected {range}, found {value}")));
            }
        }
        if !(self.share > 0.0 && self.share <= 1.0) {
            let expected = format!("expected a number above 0 and at most 1, found {}", self.share);
            return Err(Error::setting("--share", expected));
        }
        let counts = [("--depth", self.depth, MAX_DEPTH), ("--sampling", self.sampling, MAX_SAMPLING)];
        for (name, value, most) in counts {
            if !(1..=most).contains(&value) {
                return Err(Error::setting(name, format!("expected 1 to {most}, found {value}")));
            }
        }
        let single = self.method.takes_one_sample();
        if self.sampling > 1 && (single || self.supersample) {
            let with =
                if single { format!("--method {}", self.method.name()) } else { "--supersample".to_owned() };
            return Err(Error::setting(
                "--sampling",
                format!("expected 1 with {with}, found {}", self.sampling),
            ));
        }
        self.thresholds.validate()?;
        self.paths.validate()?;
        self.validate_samples()?;
        if ![2, 4, 8].contains(&self.block) {
            return Err(Error::setting("--block", format!("expected 2, 4 or 8, found {}", self.block)));
        }
        Ok(())
    }

    /// What goes with what.
    fn validate_samples(&self) -> Result<()> {
        let wrong = |name: &str, expected: String| Err(Error::setting(name, format!("expected {expected}")));
        let method = self.method.name();
        if self.supersample && self.method != Method::Adaptive {
            return wrong("--supersample", format!("--method adaptive, found --method {method}"));
        }
        if self.jitter == Jitter::On && !matches!(self.method, Method::Full | Method::Supersample) {
            return wrong(
                "--jitter",
                format!("auto or off with --method {method}, whose samples have fixed places"),
            );
        }
        if self.filter == Filter::Tent && self.method != Method::Full {
            return wrong(
                "--filter",
                format!("box with --method {method}, which has no even grid of samples"),
            );
        }
        if let Some(Focus { first, last }) = self.focus.filter(|focus| focus.first > focus.last) {
            return wrong(
                "--focus",
                format!("a first object that is not behind the last, found {first}-{last}"),
            );
        }
        Ok(())
    }
}
