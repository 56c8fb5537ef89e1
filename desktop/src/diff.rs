//! The picture of a difference: the judged picture, its reference, and where they differ.

use glimpse::metrics::{flip_picture, pixel_fails};
use glimpse::{DisplayImage, Error, Result};
use image::{Rgba, imageops};

use crate::args::DiffKind;

/// Differences are shown eight times as large.
const GAIN: u8 = 8;
/// The colour of failed pixels.
const FAILED: Rgba<u8> = Rgba([255, 0, 255, 255]);

/// The judged picture, its reference and their difference side by side.
pub fn picture(a: &DisplayImage, b: &DisplayImage, threshold: u8, kind: DiffKind) -> Result<DisplayImage> {
    if a.dimensions() != b.dimensions() {
        let found = format!("{:?} and {:?}", a.dimensions(), b.dimensions());
        return Err(Error::setting("images", "images of one size", found));
    }
    let difference = match kind {
        DiffKind::Error => error(a, b, threshold),
        DiffKind::Flip => flip_picture(a, b)?,
    };
    let mut all = DisplayImage::new(3 * a.width(), a.height());
    for (column, part) in [a, b, &difference].into_iter().enumerate() {
        imageops::replace(&mut all, part, column as i64 * i64::from(a.width()), 0);
    }
    Ok(all)
}

fn error(a: &DisplayImage, b: &DisplayImage, threshold: u8) -> DisplayImage {
    DisplayImage::from_fn(a.width(), a.height(), |x, y| {
        let (a, b) = (a.get_pixel(x, y).0, b.get_pixel(x, y).0);
        if pixel_fails(a, b, threshold) {
            return FAILED;
        }
        let [red, green, blue] =
            [0, 1, 2].map(|channel: usize| a[channel].abs_diff(b[channel]).saturating_mul(GAIN));
        Rgba([red, green, blue, 255])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failed_pixels_are_marked_and_small_differences_are_seen() {
        let grey = |level: u8| Rgba([level, level, level, 255]);
        let b = DisplayImage::from_pixel(4, 4, grey(100));
        let mut a = b.clone();
        (*a.get_pixel_mut(1, 0), *a.get_pixel_mut(2, 3)) = (grey(102), grey(103));
        let all = picture(&a, &b, 2, DiffKind::Error).unwrap();
        assert_eq!(all.dimensions(), (12, 4));
        let found = [(1, 0), (5, 0), (9, 0), (10, 3), (8, 0)].map(|(x, y)| all.get_pixel(x, y).0[0]);
        assert_eq!(found, [102, 100, 16, 255, 0]);
        assert_eq!(*all.get_pixel(10, 3), FAILED);
        let flip = picture(&a, &b, 2, DiffKind::Flip).unwrap();
        assert!(flip.get_pixel(10, 3).0[..3] != flip.get_pixel(8, 0).0[..3]);
        let error = picture(&a, &DisplayImage::new(5, 4), 2, DiffKind::Error).unwrap_err().to_string();
        assert!(error.contains("(4, 4) and (5, 4)"), "{error}");
    }
}
