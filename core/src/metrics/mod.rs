//! The error of one image against another, on display-encoded 8-bit RGB as the papers measure it; alpha is ignored.
//!
//! SSIM is computed here rather than by a crate: the crates for it bring their own thread pool.

mod bounds;
#[cfg(feature = "flip")]
mod flip;
pub(crate) mod missing;
mod pixelwise;
mod ssim;

#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

pub use bounds::{Bounds, ROUNDING_THRESHOLD, Violation, failed_pixels, pixel_fails};
pub use pixelwise::{TILE, Tile, linear_rmse, psnr_db, rmse, worst_tile};
pub use ssim::ssim;

#[cfg(feature = "flip")]
pub use flip::{Flip, PIXELS_PER_DEGREE, flip, flip_picture};

use crate::{DisplayImage, Error, Result};

/// Every measure of image A against image B.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct ErrorReport {
    /// Root of the mean squared difference over all channels, in levels of 0 to 255.
    pub rmse: f64,
    /// `20 log10(255 / rmse)` in decibels; `None` (null in JSON) for equal images, where it is infinite.
    pub psnr_db: Option<f64>,
    /// Mean structural similarity of the luma: 1 for equal images.
    pub ssim: f64,
    /// Mean of the FLIP error map (0 to 1) at 67 pixels per degree; `None` without the feature `flip`.
    pub flip_mean: Option<f64>,
    /// 99th percentile of the FLIP error map; `None` without the feature `flip`.
    pub flip_p99: Option<f64>,
    /// RMSE of the worst tile of [`TILE`] x [`TILE`] pixels: a mean over the frame hides a small wrong place.
    pub worst_tile_rmse: f64,
    /// Position of that tile's top left pixel.
    pub worst_tile: [u32; 2],
    /// RMSE of linear radiance, where both images have it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linear_rmse: Option<f64>,
}

/// Measures image `a` against the reference `b`.
///
/// # Errors
/// [`Error::Setting`] where the sizes differ or the images are empty.
pub fn compare(a: &DisplayImage, b: &DisplayImage) -> Result<ErrorReport> {
    let rmse = rmse(a, b)?;
    let tile = worst_tile(a, b)?;
    #[cfg(feature = "flip")]
    let (flip_mean, flip_p99) = {
        let flip = flip(a, b)?;
        (Some(flip.mean), Some(flip.p99))
    };
    #[cfg(not(feature = "flip"))]
    let (flip_mean, flip_p99) = (None, None);
    Ok(ErrorReport {
        rmse,
        psnr_db: psnr_db(rmse),
        ssim: ssim(a, b)?,
        flip_mean,
        flip_p99,
        worst_tile_rmse: tile.rmse,
        worst_tile: tile.position,
        linear_rmse: None,
    })
}

fn same_size(a: (u32, u32), b: (u32, u32)) -> Result<()> {
    if a != b {
        let found = format!("{}x{} and {}x{}", a.0, a.1, b.0, b.1);
        return Err(Error::setting("images", "images of one size", found));
    }
    if a.0 == 0 || a.1 == 0 {
        return Err(Error::setting("images", "at least one pixel", format!("{}x{}", a.0, a.1)));
    }
    Ok(())
}
