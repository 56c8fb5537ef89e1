//! Measures that look at each pixel alone.

use super::same_size;
use crate::{DisplayImage, Error, LinearImage, Result};

/// The side of a tile of [`worst_tile`], in pixels.
pub const TILE: u32 = 8;

/// A tile of 8x8 pixels and its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tile {
    /// Position of its top left pixel.
    pub position: [u32; 2],
    /// As [`rmse`], over the tile's pixels that lie inside the frame.
    pub rmse: f64,
}

/// Root of the mean squared difference over all pixels and the three channels, in levels of 0 to 255.
///
/// # Errors
/// [`Error::Setting`] where the sizes differ or the images are empty.
pub fn rmse(a: &DisplayImage, b: &DisplayImage) -> Result<f64> {
    same_size(a.dimensions(), b.dimensions())?;
    let sum: u64 = a.pixels().zip(b.pixels()).map(|(a, b)| squared_difference(a.0, b.0)).sum();
    Ok(root_mean(sum, u64::from(a.width()) * u64::from(a.height())))
}

/// Peak signal to noise ratio of an [`rmse`], in decibels; `None` where it is infinite.
#[must_use]
pub fn psnr_db(rmse: f64) -> Option<f64> {
    (rmse > 0.0).then(|| 20.0 * (255.0 / rmse).log10())
}

/// The aligned tile with the greatest error; the first in reading order where several share it.
///
/// # Errors
/// [`Error::Setting`] where the sizes differ or the images are empty.
pub fn worst_tile(a: &DisplayImage, b: &DisplayImage) -> Result<Tile> {
    same_size(a.dimensions(), b.dimensions())?;
    let (width, height) = a.dimensions();
    let columns = width.div_ceil(TILE) as usize;
    let mut worst = Tile { position: [0, 0], rmse: 0.0 };
    let mut sums = vec![0_u64; columns];
    let rows = a.rows().zip(b.rows()).enumerate();
    for (y, (row_a, row_b)) in rows {
        for (x, (a, b)) in row_a.zip(row_b).enumerate() {
            sums[x / TILE as usize] += squared_difference(a.0, b.0);
        }
        let y = y as u32;
        if y % TILE == TILE - 1 || y == height - 1 {
            let top = y / TILE * TILE;
            for (column, sum) in sums.iter_mut().enumerate() {
                let left = column as u32 * TILE;
                let pixels = u64::from(TILE.min(width - left)) * u64::from(y - top + 1);
                let rmse = root_mean(std::mem::take(sum), pixels);
                if rmse > worst.rmse {
                    worst = Tile { position: [left, top], rmse };
                }
            }
        }
    }
    Ok(worst)
}

/// Root of the mean squared difference of linear radiance over all pixels and the three channels.
///
/// # Errors
/// [`Error::Setting`] where the sizes differ, the images are empty, or a value is not finite.
pub fn linear_rmse(a: &LinearImage, b: &LinearImage) -> Result<f64> {
    same_size(a.dimensions(), b.dimensions())?;
    for (which, image) in [("first", a), ("second", b)] {
        if let Some((x, y, pixel)) =
            image.enumerate_pixels().find(|(.., p)| !p.0.iter().all(|v| v.is_finite()))
        {
            let found = format!("{:?} at ({x}, {y}) of the {which} image", pixel.0);
            return Err(Error::setting("images", "finite radiance", found));
        }
    }
    let sum: f64 = a.iter().zip(b.iter()).map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2)).sum();
    Ok((sum / a.as_raw().len() as f64).sqrt())
}

fn squared_difference(a: [u8; 4], b: [u8; 4]) -> u64 {
    (0..3).map(|i| u64::from(a[i].abs_diff(b[i])).pow(2)).sum()
}

fn root_mean(sum: u64, pixels: u64) -> f64 {
    (sum as f64 / (3 * pixels) as f64).sqrt()
}
