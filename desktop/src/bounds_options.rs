//! Options that bound the error of a picture.

use clap::{Args, ValueEnum};
use glimpse::metrics::{Bounds, ROUNDING_THRESHOLD};

/// Bounds on the error of a picture; the command fails where one does not hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Args)]
#[command(next_help_heading = "Bounds")]
pub struct BoundsOptions {
    /// Largest RMSE, in levels of 0 to 255
    #[arg(long, value_name = "LEVELS", value_parser = number)]
    pub max_rmse: Option<f64>,
    /// Least PSNR in decibels
    #[arg(long, value_name = "DB", value_parser = number)]
    pub min_psnr: Option<f64>,
    /// Least structural similarity, up to 1
    #[arg(long, value_name = "X", value_parser = number)]
    pub min_ssim: Option<f64>,
    /// Largest mean FLIP, 0 to 1
    #[arg(long, value_name = "X", value_parser = number)]
    pub max_flip: Option<f64>,
    /// Largest number of pixels that differ
    ///
    /// A pixel differs if one of its channels does by more than the threshold
    #[arg(long, value_name = "N")]
    pub max_failed_pixels: Option<u64>,
    /// Allowed difference in levels [default: 2]
    ///
    /// The difference of a channel up to which a pixel does not fail, 0 to 255
    #[arg(long, value_name = "LEVELS")]
    pub threshold: Option<u8>,
    /// Largest RMSE of a tile of 8x8 pixels
    ///
    /// In levels of 0 to 255
    #[arg(long, value_name = "LEVELS", value_parser = number)]
    pub max_worst_tile: Option<f64>,
}

impl BoundsOptions {
    /// The bounds that were typed.
    pub fn bounds(&self) -> Bounds {
        Bounds {
            max_rmse: self.max_rmse,
            min_psnr: self.min_psnr,
            min_ssim: self.min_ssim,
            max_flip: self.max_flip,
            max_failed_pixels: self.max_failed_pixels,
            threshold: self.threshold.unwrap_or(ROUNDING_THRESHOLD),
            max_worst_tile: self.max_worst_tile,
        }
    }

    /// The bounds that were typed; without any, those that allow for the rounding of other processors.
    pub fn or_rounding(&self) -> Bounds {
        let typed = self.bounds();
        if typed.is_empty() { Bounds { threshold: typed.threshold, ..Bounds::rounding() } } else { typed }
    }
}

/// What shows the difference.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum DiffKind {
    /// Absolute differences, eight times as large; pixels beyond the threshold in magenta
    #[default]
    Error,
    /// The map of FLIP, from black to pale yellow
    Flip,
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
    number.ok_or_else(|| format!("expected a number from 0 on, found {text}"))
}
