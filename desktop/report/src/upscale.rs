//! Bilinear upscaling of frames of reduced resolution, as a display does it.

use std::array;

use glimpse::{DisplayImage, LinearImage, encode_display};

/// Resizes a picture, interpolating linear radiance between pixel centres, as a texture unit does for an sRGB
/// texture with clamped edges.
pub fn bilinear(picture: &DisplayImage, [width, height]: [u32; 2]) -> DisplayImage {
    let linear: [f32; 256] = array::from_fn(|code| decoded(code as u8));
    let columns = taps(picture.width(), width);
    let rows = taps(picture.height(), height);
    let at = |x: u32, y: u32, channel: usize| linear[usize::from(picture.get_pixel(x, y).0[channel])];
    let mut upscaled = LinearImage::new(width, height);
    for (pixel, ([top, bottom], v)) in upscaled.rows_mut().zip(&rows) {
        for (pixel, ([left, right], u)) in pixel.zip(&columns) {
            pixel.0 = array::from_fn(|channel| {
                let mix = |y: u32| (1.0 - u) * at(*left, y, channel) + u * at(*right, y, channel);
                (1.0 - v) * mix(*top) + v * mix(*bottom)
            });
        }
    }
    encode_display(&upscaled)
}

/// For each target pixel of a line, the two source pixels around it and the interpolation weight of the
/// second.
fn taps(from: u32, to: u32) -> Vec<([u32; 2], f32)> {
    let last = from - 1;
    let place = |i: u32| {
        let x = ((f64::from(i) + 0.5) * f64::from(from) / f64::from(to) - 0.5).clamp(0.0, f64::from(last));
        ([x as u32, (x as u32 + 1).min(last)], x.fract() as f32)
    };
    (0..to).map(place).collect()
}

/// Decodes an sRGB code (IEC 61966-2-1) to linear.
fn decoded(code: u8) -> f32 {
    let v = f32::from(code) / 255.0;
    if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(width: u32, levels: &[u8]) -> DisplayImage {
        let raw = levels.iter().flat_map(|l| [*l, *l, *l, 255]).collect();
        DisplayImage::from_raw(width, levels.len() as u32 / width, raw).unwrap()
    }

    #[test]
    fn the_same_size_is_the_same_picture() {
        let all: Vec<u8> = (0..=255).collect();
        assert_eq!(bilinear(&grey(16, &all), [16, 16]), grey(16, &all));
    }

    #[test]
    fn between_black_and_white_lie_quarters_of_the_radiance() {
        // The centres of four pixels over two are at -0.25, 0.25, 0.75 and 1.25, clamped at the ends. In sRGB a quarter
        // of white is code 137, three quarters are 225.
        assert_eq!(bilinear(&grey(2, &[0, 255]), [4, 1]), grey(4, &[0, 137, 225, 255]));
        assert_eq!(bilinear(&grey(1, &[0, 255]), [1, 4]), grey(1, &[0, 137, 225, 255]));
    }

    #[test]
    fn both_directions_mix() {
        // One white corner: 9/16, 3/16, 3/16 and 1/16 of it in the middle; 198, 120, 120, 71.
        let upscaled = bilinear(&grey(2, &[255, 0, 0, 0]), [4, 4]);
        let middle = [(1, 1), (2, 1), (1, 2), (2, 2)].map(|(x, y)| upscaled.get_pixel(x, y).0[0]);
        assert_eq!(middle, [198, 120, 120, 71]);
    }

    #[test]
    fn one_pixel_fills_any_frame() {
        assert_eq!(bilinear(&grey(1, &[77]), [3, 2]), grey(3, &[77; 6]));
    }
}
