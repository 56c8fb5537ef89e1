//! FLIP (Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images"), NVIDIA's own program.

use nv_flip::FlipImageRgb8;

use super::same_size;
use crate::{DisplayImage, Result};

/// The viewing condition: a 0.7 m wide 4K screen seen from 0.7 m, FLIP's default.
pub const PIXELS_PER_DEGREE: f32 = nv_flip::DEFAULT_PIXELS_PER_DEGREE;

/// Statistics of the error map; every pixel's error lies in 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flip {
    /// Mean over all pixels, 0 to 1.
    pub mean: f64,
    /// The least error that 99 % of the pixels do not exceed.
    pub p99: f64,
}

/// FLIP of `a` against the reference `b`, at [`PIXELS_PER_DEGREE`].
///
/// # Errors
/// [`crate::Error::Setting`] where the sizes differ or the images are empty.
pub fn flip(a: &DisplayImage, b: &DisplayImage) -> Result<Flip> {
    same_size(a.dimensions(), b.dimensions())?;
    let map = nv_flip::flip(rgb(b), rgb(a), PIXELS_PER_DEGREE);
    let mut errors = map.to_vec();
    let mean = errors.iter().map(|e| f64::from(*e)).sum::<f64>() / errors.len() as f64;
    let rank = (errors.len() * 99).div_ceil(100) - 1;
    let (_, p99, _) = errors.select_nth_unstable_by(rank, f32::total_cmp);
    Ok(Flip { mean, p99: f64::from(*p99) })
}

/// The error map of `a` against the reference `b` in the colours of Andersson et al. 2020 (magma): black for no error, pale
/// yellow for 1.
///
/// # Errors
/// [`crate::Error::Setting`] where the sizes differ or the images are empty.
pub fn flip_picture(a: &DisplayImage, b: &DisplayImage) -> Result<DisplayImage> {
    same_size(a.dimensions(), b.dimensions())?;
    let map = nv_flip::flip(rgb(b), rgb(a), PIXELS_PER_DEGREE).apply_color_lut(&nv_flip::magma_lut());
    let bytes = map.to_vec();
    Ok(DisplayImage::from_fn(a.width(), a.height(), |x, y| {
        let at = 3 * (y * a.width() + x) as usize;
        image::Rgba([bytes[at], bytes[at + 1], bytes[at + 2], 255])
    }))
}

fn rgb(image: &DisplayImage) -> FlipImageRgb8 {
    let bytes: Vec<u8> = image.pixels().flat_map(|p| [p.0[0], p.0[1], p.0[2]]).collect();
    FlipImageRgb8::with_data(image.width(), image.height(), &bytes)
}
