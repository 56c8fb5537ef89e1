//! Finished frames in main memory, and their PNG and OpenEXR files.

use std::io::Cursor;

use image::{DynamicImage, ImageFormat, Rgb32FImage, RgbaImage};

/// A frame as it is shown: sRGB-encoded 8-bit RGBA, top row first.
pub type DisplayImage = RgbaImage;

/// A frame as it was computed: linear RGB radiance, top row first.
pub type LinearImage = Rgb32FImage;

/// Encodes a PNG file.
///
/// # Errors
/// [`crate::Error::Image`] where the encoder fails.
pub fn to_png(frame: &DisplayImage) -> crate::Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    let opaque = DynamicImage::from(frame.clone()).into_rgb8();
    opaque.write_to(&mut bytes, ImageFormat::Png)?;
    Ok(bytes.into_inner())
}

/// Encodes an OpenEXR file of 32-bit floating-point RGB.
///
/// # Errors
/// [`crate::Error::Image`] where the encoder fails.
pub fn to_exr(frame: &LinearImage) -> crate::Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    DynamicImage::from(frame.clone()).write_to(&mut bytes, ImageFormat::OpenExr)?;
    Ok(bytes.into_inner())
}

/// A picture read from a file, in the form that the file has.
#[derive(Clone, Debug, PartialEq)]
pub enum Picture {
    /// Display-encoded RGBA of a PNG file.
    Display(DisplayImage),
    /// Linear radiance of an OpenEXR file.
    Linear(LinearImage),
}

impl Picture {
    /// Reads the bytes of a PNG or OpenEXR file.
    ///
    /// # Errors
    /// [`crate::Error::Image`] for anything else.
    pub fn decode(bytes: &[u8]) -> crate::Result<Self> {
        let image = image::load_from_memory(bytes)?;
        Ok(match image {
            DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => Self::Linear(image.into_rgb32f()),
            _ => Self::Display(image.into_rgba8()),
        })
    }

    /// The display-encoded picture; linear radiance is encoded as sRGB.
    #[must_use]
    pub fn into_display(self) -> DisplayImage {
        match self {
            Self::Display(image) => image,
            Self::Linear(image) => encode_display(&image),
        }
    }
}

/// Linear radiance clamped to [0, 1] and encoded as sRGB (IEC 61966-2-1), opaque.
#[must_use]
pub fn encode_display(linear: &LinearImage) -> DisplayImage {
    let encode = |v: f32| {
        let v = v.clamp(0.0, 1.0);
        let encoded = if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
        (255.0 * encoded).round() as u8
    };
    DisplayImage::from_fn(linear.width(), linear.height(), |x, y| {
        let [r, g, b] = linear.get_pixel(x, y).0.map(encode);
        image::Rgba([r, g, b, 255])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_come_back_from_their_files() {
        let linear = LinearImage::from_fn(3, 2, |x, y| image::Rgb([x as f32 * 4.0, y as f32, 0.125]));
        assert_eq!(Picture::decode(&to_exr(&linear).unwrap()).unwrap(), Picture::Linear(linear.clone()));
        let shown = encode_display(&linear);
        assert_eq!(Picture::decode(&to_png(&shown).unwrap()).unwrap(), Picture::Display(shown));
        assert!(Picture::decode(b"GIF89a").is_err());
    }

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
