//! Bounds on the error of a picture, for frame tests.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::{ErrorReport, same_size};
use crate::{DisplayImage, Result};

/// Bounds within which a picture counts as equal to its reference; `None` bounds nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bounds {
    /// The largest [`ErrorReport::rmse`], in levels of 0 to 255.
    pub max_rmse: Option<f64>,
    /// The least [`ErrorReport::psnr_db`], in decibels.
    pub min_psnr: Option<f64>,
    /// The least [`ErrorReport::ssim`].
    pub min_ssim: Option<f64>,
    /// The largest [`ErrorReport::flip_mean`]; never held without the feature `flip`.
    pub max_flip: Option<f64>,
    /// The largest number of pixels of which a channel differs by more than the threshold.
    pub max_failed_pixels: Option<u64>,
    /// The largest difference of a channel, in levels of 0 to 255, with which a pixel does not fail.
    pub threshold: u8,
    /// The largest [`ErrorReport::worst_tile_rmse`], in levels of 0 to 255.
    pub max_worst_tile: Option<f64>,
}

/// The threshold of [`Bounds::rounding`].
pub const ROUNDING_THRESHOLD: u8 = 2;

/// A bound that does not hold.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Violation {
    /// Name of the bound as an option, such as `max-rmse`.
    pub bound: String,
    /// What the bound allows.
    pub allowed: f64,
    /// What was measured; `None` where it was not.
    pub found: Option<f64>,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { bound, allowed, found } = self;
        match found {
            Some(found) if found.is_infinite() => write!(f, "{bound} {allowed}: found none"),
            Some(found) => write!(f, "{bound} {allowed}: found {}", (found * 1e5).round() / 1e5),
            None => write!(f, "{bound} {allowed}: not measured"),
        }
    }
}

impl Bounds {
    /// Bounds that allow for the rounding of other processors: four pixels beyond two levels, and half a level in the
    /// worst tile, in which a single wrong pixel shows.
    #[must_use]
    pub fn rounding() -> Self {
        Self {
            max_failed_pixels: Some(4),
            threshold: ROUNDING_THRESHOLD,
            max_worst_tile: Some(0.5),
            ..Self::default()
        }
    }

    /// Whether nothing is bounded.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self { threshold: self.threshold, ..Self::default() }
    }

    /// The bounds that a picture with this report and this number of [`failed_pixels`] does not hold.
    #[must_use]
    pub fn violations(&self, report: &ErrorReport, failed_pixels: u64) -> Vec<Violation> {
        // A bound that is not compared below is an unused variable.
        let Self { max_rmse, min_psnr, min_ssim, max_flip, max_failed_pixels, threshold: _, max_worst_tile } =
            *self;
        let psnr = Some(report.psnr_db.unwrap_or(f64::INFINITY));
        let failed = Some(failed_pixels as f64);
        // Each with the greatest value that it allows; of those with a least one both are negated.
        let bounds = [
            ("max-rmse", max_rmse, Some(report.rmse), 1.0),
            ("min-psnr", min_psnr, psnr, -1.0),
            ("min-ssim", min_ssim, Some(report.ssim), -1.0),
            ("max-flip", max_flip, report.flip_mean, 1.0),
            ("max-failed-pixels", max_failed_pixels.map(|most| most as f64), failed, 1.0),
            ("max-worst-tile", max_worst_tile, Some(report.worst_tile_rmse), 1.0),
        ];
        let violated = bounds.into_iter().filter_map(|(bound, allowed, found, sign)| {
            let allowed = allowed?;
            let holds = found.is_some_and(|found| sign * found <= sign * allowed);
            (!holds).then(|| Violation { bound: bound.to_owned(), allowed, found })
        });
        violated.collect()
    }
}

/// Whether a pixel fails: a channel differs by more than the threshold. Alpha is ignored.
#[must_use]
pub fn pixel_fails(a: [u8; 4], b: [u8; 4], threshold: u8) -> bool {
    (0..3).any(|channel| a[channel].abs_diff(b[channel]) > threshold)
}

/// The number of pixels of which a channel differs by more than `threshold`, in levels of 0 to 255.
///
/// # Errors
/// [`crate::Error::Setting`] where the sizes differ or the images are empty.
pub fn failed_pixels(a: &DisplayImage, b: &DisplayImage, threshold: u8) -> Result<u64> {
    same_size(a.dimensions(), b.dimensions())?;
    Ok(a.pixels().zip(b.pixels()).filter(|(a, b)| pixel_fails(a.0, b.0, threshold)).count() as u64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::compare;

    fn grey(level: u8) -> DisplayImage {
        DisplayImage::from_pixel(16, 16, image::Rgba([level, level, level, 255]))
    }

    fn violated(bounds: &Bounds, a: &DisplayImage, b: &DisplayImage) -> Vec<String> {
        let failed = failed_pixels(a, b, bounds.threshold).expect("one size");
        let violations = bounds.violations(&compare(a, b).expect("one size"), failed);
        violations.into_iter().map(|violation| violation.bound).collect()
    }

    #[test]
    fn each_bound_holds_up_to_its_value_and_no_further() {
        let (a, b) = (grey(100), grey(105));
        let report = compare(&a, &b).expect("one size");
        let psnr = report.psnr_db.expect("they differ");
        for (name, holds, fails) in [
            (
                "max-rmse",
                Bounds { max_rmse: Some(5.0), ..Bounds::default() },
                Bounds { max_rmse: Some(4.99), ..Bounds::default() },
            ),
            (
                "min-psnr",
                Bounds { min_psnr: Some(psnr), ..Bounds::default() },
                Bounds { min_psnr: Some(psnr + 0.01), ..Bounds::default() },
            ),
            (
                "min-ssim",
                Bounds { min_ssim: Some(report.ssim), ..Bounds::default() },
                Bounds { min_ssim: Some(1.0), ..Bounds::default() },
            ),
            (
                "max-worst-tile",
                Bounds { max_worst_tile: Some(5.0), ..Bounds::default() },
                Bounds { max_worst_tile: Some(4.9), ..Bounds::default() },
            ),
            (
                "max-failed-pixels",
                Bounds { max_failed_pixels: Some(0), threshold: 5, ..Bounds::default() },
                Bounds { max_failed_pixels: Some(255), threshold: 4, ..Bounds::default() },
            ),
        ] {
            assert_eq!(violated(&holds, &a, &b), [""; 0], "{name}");
            assert_eq!(violated(&fails, &a, &b), [name]);
        }
        let flip = Bounds { max_flip: Some(0.0), ..Bounds::default() };
        assert_eq!(violated(&flip, &a, &b), ["max-flip"], "measured or not");
    }

    #[test]
    fn equal_pictures_hold_all_bounds_and_one_wrong_pixel_does_not_hide() {
        let strict = Bounds {
            max_rmse: Some(0.0),
            min_psnr: Some(1e9),
            min_ssim: Some(1.0),
            max_failed_pixels: Some(0),
            max_worst_tile: Some(0.0),
            ..Bounds::default()
        };
        assert_eq!(violated(&strict, &grey(9), &grey(9)), [""; 0]);
        let mut wrong = grey(9);
        wrong.get_pixel_mut(3, 12).0 = [9, 40, 9, 255];
        assert_eq!(violated(&Bounds::rounding(), &wrong, &grey(9)), ["max-worst-tile"]);
        assert_eq!(violated(&strict, &wrong, &grey(9)).len(), 5);
        assert!(Bounds::default().is_empty() && !Bounds::rounding().is_empty());
    }

    #[test]
    fn a_violation_says_what_was_allowed_and_what_was_found() {
        let violation = |found| Violation { bound: "max-rmse".to_owned(), allowed: 2.0, found }.to_string();
        assert_eq!(violation(Some(50.812_345_6)), "max-rmse 2: found 50.81235");
        assert_eq!(violation(None), "max-rmse 2: not measured");
    }
}
