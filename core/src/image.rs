//! Finished frames in main memory, and their PNG and OpenEXR files.

#[cfg(feature = "images")]
mod codec;

use image::{Rgb32FImage, RgbaImage};

#[cfg(feature = "images")]
pub use codec::{Picture, to_exr, to_png};

/// A frame as it is shown: sRGB-encoded 8-bit RGBA, top row first.
pub type DisplayImage = RgbaImage;

/// A frame as it was computed: linear RGB radiance, top row first.
pub type LinearImage = Rgb32FImage;

/// Linear radiance clamped to [0, 1] and encoded as sRGB (IEC 61966-2-1), opaque.
#[must_use]
pub fn encode_display(linear: &LinearImage) -> DisplayImage {
    let encode = |v: f32| (255.0 * linear_to_srgb(v.clamp(0.0, 1.0))).round() as u8;
    DisplayImage::from_fn(linear.width(), linear.height(), |x, y| {
        let [r, g, b] = linear.get_pixel(x, y).0.map(encode);
        image::Rgba([r, g, b, 255])
    })
}

/// Encodes a linear value in [0, 1] as sRGB (IEC 61966-2-1).
pub(crate) fn linear_to_srgb(v: f32) -> f32 {
    if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 }
}

/// The linear values of all 256 sRGB bytes (IEC 61966-2-1).
pub(crate) fn srgb_to_linear() -> [f32; 256] {
    std::array::from_fn(|byte| {
        let c = byte as f32 / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_display_encoding_is_srgb() {
        let encode = |v: f32| encode_display(&LinearImage::from_pixel(1, 1, image::Rgb([v, v, v])))[(0, 0)].0;
        assert_eq!(encode(0.0), [0, 0, 0, 255]);
        assert_eq!(encode(1.0)[0], 255);
        assert_eq!(encode(7.0)[0], 255);
        assert_eq!(encode(-1.0)[0], 0);
        assert_eq!(encode(0.215_861)[0], 128, "the middle of the code range");
        assert_eq!(encode(0.002)[0], 7, "on the linear toe");
    }
}
