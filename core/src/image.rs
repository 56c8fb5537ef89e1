//! Finished frames in main memory.

use std::io::Cursor;

use image::{DynamicImage, ImageFormat, Rgb32FImage, RgbaImage};

/// A frame as it is shown: sRGB-encoded 8-bit RGBA, top row first.
pub type DisplayImage = RgbaImage;

/// A frame as it was computed: linear RGB radiance, top row first.
pub type LinearImage = Rgb32FImage;

/// The bytes of a PNG file.
///
/// # Errors
/// [`crate::Error::Image`] where the encoder fails.
pub fn to_png(frame: &DisplayImage) -> crate::Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    let opaque = DynamicImage::from(frame.clone()).into_rgb8();
    opaque.write_to(&mut bytes, ImageFormat::Png)?;
    Ok(bytes.into_inner())
}

/// The bytes of an OpenEXR file.
///
/// # Errors
/// [`crate::Error::Image`] where the encoder fails.
pub fn to_exr(frame: &LinearImage) -> crate::Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    DynamicImage::from(frame.clone()).write_to(&mut bytes, ImageFormat::OpenExr)?;
    Ok(bytes.into_inner())
}
