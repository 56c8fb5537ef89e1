//! Compares two pictures by three bounds: the largest error of a pixel, the number of pixels that may exceed
//! it, and the error of the worst 8x8 tile (a few wrong pixels in one place hardly change the mean of a
//! picture).

use std::fmt;

use glimpse::DisplayImage;
use image::Rgba;
use serde::{Deserialize, Serialize};

/// Side of a tile in pixels.
pub const TILE: u32 = 8;

/// Bounds within which a picture counts as equal to its golden.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tolerance {
    /// Largest allowed difference of a channel, in 1/255; a pixel beyond it fails.
    pub threshold: u8,
    /// Largest allowed number of failed pixels.
    pub max_failed_pixels: usize,
    /// Largest allowed root mean square error of an 8x8 tile, in 1/255.
    pub worst_tile_rmse: f64,
}

/// The measured difference of two pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Number of pixels that differ by more than the threshold.
    pub failed_pixels: usize,
    /// Largest difference of a channel, in 1/255.
    pub largest: u8,
    /// Root mean square error of the worst tile, in 1/255.
    pub worst_tile_rmse: f64,
    /// Position of that tile's top left pixel.
    pub worst_tile_at: [u32; 2],
    /// Number of pixels that would fail at other thresholds.
    pub sweep: [(u8, usize); 6],
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = self.worst_tile_at;
        writeln!(
            f,
            "{} pixels fail, largest difference {}, worst tile RMSE {:.3} at ({x}, {y})",
            self.failed_pixels, self.largest, self.worst_tile_rmse
        )?;
        write!(f, "pixels that would fail at threshold")?;
        self.sweep.iter().try_for_each(|(threshold, count)| write!(f, "  {threshold}: {count}"))
    }
}

/// Compares the red, green and blue channels.
///
/// # Errors
/// Describes the difference if the tolerance does not allow it; pictures of different sizes always differ.
pub fn compare(
    actual: &DisplayImage,
    expected: &DisplayImage,
    tolerance: &Tolerance,
) -> Result<Difference, String> {
    let difference = difference(actual, expected, tolerance.threshold)?;
    let bad = difference.failed_pixels > tolerance.max_failed_pixels
        || tolerance.worst_tile_rmse.is_nan()
        || difference.worst_tile_rmse > tolerance.worst_tile_rmse;
    if bad { Err(format!("{difference}\nallowed: {tolerance:?}")) } else { Ok(difference) }
}

/// Measures the difference of two pictures.
///
/// # Errors
/// If the pictures differ in size or are empty.
pub fn difference(
    actual: &DisplayImage,
    expected: &DisplayImage,
    threshold: u8,
) -> Result<Difference, String> {
    let (width, height) = actual.dimensions();
    if actual.dimensions() != expected.dimensions() {
        return Err(format!(
            "expected a picture of {:?} pixels, found {:?}",
            expected.dimensions(),
            (width, height)
        ));
    }
    if width == 0 || height == 0 {
        return Err("an empty picture shows nothing".to_owned());
    }
    let mut sweep = [1, 2, 4, 8, 16, 32].map(|threshold| (threshold, 0));
    let (mut failed_pixels, mut largest) = (0, 0);
    for (a, b) in actual.pixels().zip(expected.pixels()) {
        let off = distance(a, b);
        failed_pixels += usize::from(off > threshold);
        largest = largest.max(off);
        for (threshold, count) in &mut sweep {
            *count += usize::from(off > *threshold);
        }
    }
    let (mut worst_tile_rmse, mut worst_tile_at) = (0.0, [0, 0]);
    for top in (0..height).step_by(TILE as usize) {
        for left in (0..width).step_by(TILE as usize) {
            let (mut sum, mut count) = (0.0, 0.0);
            for y in top..(top + TILE).min(height) {
                for x in left..(left + TILE).min(width) {
                    let (a, b) = (actual.get_pixel(x, y), expected.get_pixel(x, y));
                    for channel in 0..3 {
                        let off = f64::from(a[channel]) - f64::from(b[channel]);
                        sum += off * off;
                        count += 1.0;
                    }
                }
            }
            let rmse = f64::sqrt(sum / count);
            if rmse > worst_tile_rmse {
                (worst_tile_rmse, worst_tile_at) = (rmse, [left, top]);
            }
        }
    }
    Ok(Difference { failed_pixels, largest, worst_tile_rmse, worst_tile_at, sweep })
}

/// A picture of the absolute differences times eight; white where `expected` has no pixel.
#[must_use]
pub fn difference_image(actual: &DisplayImage, expected: &DisplayImage) -> DisplayImage {
    DisplayImage::from_fn(actual.width(), actual.height(), |x, y| {
        let a = actual.get_pixel(x, y);
        match expected.get_pixel_checked(x, y) {
            Some(b) => {
                let [r, g, b] = [0, 1, 2].map(|c| a[c].abs_diff(b[c]).saturating_mul(8));
                Rgba([r, g, b, 255])
            }
            None => Rgba([255; 4]),
        }
    })
}

fn distance(a: &Rgba<u8>, b: &Rgba<u8>) -> u8 {
    (0..3).map(|c| a[c].abs_diff(b[c])).max().unwrap_or(0)
}
