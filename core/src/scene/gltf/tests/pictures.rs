//! Images that are unusual, damaged or declare a wrong size.

use serde_json::json;

use super::{File, data_uri, png};
use crate::scene::Image8;

fn with_image(bytes: &[u8]) -> File {
    let mut file = File::triangle();
    file.json["materials"] = json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
    file.primitive()["material"] = json!(0);
    file.json["textures"] = json!([{ "source": 0 }]);
    file.json["images"] = json!([{ "uri": data_uri("image/png", bytes) }]);
    file
}

fn imported(bytes: &[u8]) -> Image8 {
    with_image(bytes).scene().images.remove(0)
}

fn refused(bytes: &[u8], parts: &[&str]) {
    with_image(bytes).fails(&[&["image 0"], parts].concat());
}

fn encoded(image: &image::DynamicImage, format: image::ImageFormat) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// A PNG whose header declares another size, with a valid checksum (PNG, annex D).
fn png_that_says(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = png(2, 2, [1; 4]);
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let crc = bytes[12..29].iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| crc >> 1 ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 })
    });
    bytes[29..33].copy_from_slice(&(!crc).to_be_bytes());
    bytes
}

/// A JPEG whose frame header (marker SOF0) declares another size.
fn jpeg_that_says(width: u16, height: u16) -> Vec<u8> {
    let image = image::DynamicImage::new_rgb8(8, 8);
    let mut bytes = encoded(&image, image::ImageFormat::Jpeg);
    let frame = bytes.windows(2).position(|w| w == [0xff, 0xc0]).unwrap();
    bytes[frame + 5..frame + 7].copy_from_slice(&height.to_be_bytes());
    bytes[frame + 7..frame + 9].copy_from_slice(&width.to_be_bytes());
    bytes
}

#[test]
fn long_and_small_images() {
    for (width, height) in [(1, 1), (16_384, 1), (1, 16_384)] {
        let image = imported(&png(width, height, [1, 2, 3, 4]));
        assert_eq!((image.width, image.height), (width, height));
        assert!(image.rgba.chunks(4).all(|texel| texel == [1, 2, 3, 4]));
    }
}

#[test]
fn every_depth_and_number_of_channels() {
    use image::DynamicImage as Image;
    let pixels =
        [Image::new_luma8(3, 2), Image::new_luma_a16(3, 2), Image::new_rgb16(3, 2), Image::new_rgba16(3, 2)];
    for image in pixels {
        assert_eq!(imported(&encoded(&image, image::ImageFormat::Png)).rgba.len(), 24);
    }
    for image in [Image::new_luma8(3, 2), Image::new_rgb8(3, 2)] {
        assert_eq!(imported(&encoded(&image, image::ImageFormat::Jpeg)).rgba.len(), 24);
    }
}

#[test]
fn headers_that_promise_too_much() {
    refused(&png_that_says(0, 5), &["decoded"]);
    refused(&png_that_says(16_385, 1), &["decoded"]);
    refused(&png_that_says(65_535, 65_535), &["decoded"]);
    refused(&png_that_says(1 << 31, 1), &["decoded"]);
    refused(&png_that_says(u32::MAX, u32::MAX), &["decoded"]);
    refused(&png_that_says(16_384, 16_384), &["says 16384 x 16384 texels", "cannot hold more than"]);
    refused(&jpeg_that_says(65_535, 65_535), &["decoded"]);
    refused(&jpeg_that_says(16_384, 16_384), &["says 16384 x 16384 texels", "cannot hold more than"]);
    refused(&jpeg_that_says(0, 8), &["decoded"]);
}

#[test]
fn data_that_ends_too_early() {
    refused(&png_that_says(2, 200), &["decoded"]);
    let whole = png(64, 64, [1; 4]);
    for length in [0, 7, 8, 30, 40, whole.len() / 2, whole.len() - 20] {
        refused(&whole[..length], &["decoded"]);
    }
    let whole = encoded(&image::DynamicImage::new_rgb8(64, 64), image::ImageFormat::Jpeg);
    for length in [2, 20, 100, whole.len() / 2, whole.len() - 20] {
        refused(&whole[..length], &["decoded"]);
    }
}

/// Comparisons read OpenEXR, but glTF images are PNG or JPEG with 8 bits per channel.
#[test]
fn other_formats() {
    let exr = encoded(&image::DynamicImage::new_rgb32f(4, 4), image::ImageFormat::OpenExr);
    refused(&exr, &["expected a PNG or a JPEG, found neither"]);
    refused(b"GIF89a\x01\0\x01\0\0\0\0", &["expected a PNG or a JPEG"]);
}
