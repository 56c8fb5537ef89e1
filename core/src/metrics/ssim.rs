//! Structural similarity (Wang, Bovik, Sheikh, Simoncelli 2004, "Image quality assessment", equation 13) of
//! Rec. 601 luma, with the paper's window: Gaussian, 11 x 11, sigma 1.5, K1 = 0.01, K2 = 0.03, L = 255.
//!
//! ```text
//! SSIM = (2 ma mb + C1)(2 sab + C2) / ((ma^2 + mb^2 + C1)(saa + sbb + C2)),   C = (K L)^2
//! ```
//!
//! Only windows that lie inside the frame count, as in the paper's program. Deviation: in a frame with a side
//! below 11 pixels the window shrinks to the largest odd size that fits.

use std::collections::VecDeque;

use super::same_size;
use crate::{DisplayImage, Result};

const RADIUS: usize = 5;
const SIGMA: f64 = 1.5;
const C1: f64 = (0.01 * 255.0) * (0.01 * 255.0);
const C2: f64 = (0.03 * 255.0) * (0.03 * 255.0);

/// Weighted means in a window: a, b, a a, b b, a b.
type Moments = [f64; 5];

/// Mean structural similarity of two images.
///
/// # Errors
/// [`crate::Error::Setting`] where the sizes differ or the images are empty.
pub fn ssim(a: &DisplayImage, b: &DisplayImage) -> Result<f64> {
    same_size(a.dimensions(), b.dimensions())?;
    let shorter = a.width().min(a.height()) as usize;
    let window = gaussian(RADIUS.min((shorter - 1) / 2));
    let mut filtered: VecDeque<Vec<Moments>> = VecDeque::with_capacity(window.len());
    let (mut sum, mut count) = (0.0, 0_u64);
    for (row_a, row_b) in a.rows().zip(b.rows()) {
        let products: Vec<Moments> = row_a
            .zip(row_b)
            .map(|(a, b)| {
                let (a, b) = (luma(a.0), luma(b.0));
                [a, b, a * a, b * b, a * b]
            })
            .collect();
        filtered.push_back(products.windows(window.len()).map(|w| weighted(&window, w.iter())).collect());
        if filtered.len() == window.len() {
            for x in 0..filtered[0].len() {
                sum += similarity(weighted(&window, filtered.iter().map(|row| &row[x])));
                count += 1;
            }
            filtered.pop_front();
        }
    }
    Ok(sum / count as f64)
}

fn luma([r, g, b, _]: [u8; 4]) -> f64 {
    0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b)
}

fn gaussian(radius: usize) -> Vec<f64> {
    let weight = |i: usize| (-(i as f64 - radius as f64).powi(2) / (2.0 * SIGMA * SIGMA)).exp();
    let sum: f64 = (0..=2 * radius).map(weight).sum();
    (0..=2 * radius).map(|i| weight(i) / sum).collect()
}

fn weighted<'m>(window: &[f64], values: impl Iterator<Item = &'m Moments>) -> Moments {
    let mut sum = [0.0; 5];
    for (weight, value) in window.iter().zip(values) {
        for (sum, value) in sum.iter_mut().zip(value) {
            *sum += weight * value;
        }
    }
    sum
}

fn similarity([a, b, aa, bb, ab]: Moments) -> f64 {
    let (variance_a, variance_b, covariance) = (aa - a * a, bb - b * b, ab - a * b);
    (2.0 * a * b + C1) * (2.0 * covariance + C2) / ((a * a + b * b + C1) * (variance_a + variance_b + C2))
}
