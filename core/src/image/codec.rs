//! Frames as the bytes of PNG and OpenEXR files.

use std::io::Cursor;

use image::{DynamicImage, ImageFormat};

use super::{DisplayImage, LinearImage, encode_display};

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
    /// [`crate::Error::Image`] for anything else; [`crate::Error::Setting`] where a radiance is not finite.
    pub fn decode(bytes: &[u8]) -> crate::Result<Self> {
        let image = image::load_from_memory(bytes)?;
        if !matches!(image, DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_)) {
            return Ok(Self::Display(image.into_rgba8()));
        }
        let image = image.into_rgb32f();
        match image.enumerate_pixels().find(|(.., p)| !p.0.iter().all(|v| v.is_finite())) {
            Some((x, y, pixel)) => {
                let found = format!("{:?} at ({x}, {y})", pixel.0);
                Err(crate::Error::setting("images", "finite radiance", found))
            }
            None => Ok(Self::Linear(image)),
        }
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
        let damaged =
            LinearImage::from_fn(3, 2, |x, _| image::Rgb([1.0, if x == 2 { f32::NAN } else { 0.0 }, 0.0]));
        let error = Picture::decode(&to_exr(&damaged).unwrap()).unwrap_err().to_string();
        assert!(error.contains("finite radiance") && error.contains("(2, 0)"), "{error}");
    }
}
