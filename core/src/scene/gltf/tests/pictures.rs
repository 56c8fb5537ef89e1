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

/// Comparisons read OpenEXR, but glTF images are files of 8 bits a channel.
#[test]
fn other_formats() {
    let exr = encoded(&image::DynamicImage::new_rgb32f(4, 4), image::ImageFormat::OpenExr);
    refused(&exr, &["expected one of PNG, JPEG", "found another format"]);
    refused(b"GIF89a\x01\0\x01\0\0\0\0", &["expected one of PNG, JPEG"]);
}

#[cfg(feature = "webp")]
#[test]
fn webp_in_the_core_and_by_its_extension() {
    let texels: Vec<u8> = (0..24).collect();
    let image = image::RgbaImage::from_raw(3, 2, texels.clone()).unwrap();
    let bytes = encoded(&image.into(), image::ImageFormat::WebP);
    assert_eq!(imported(&bytes).rgba, texels);
    for length in [0, 12, 20, bytes.len() / 2, bytes.len() - 6] {
        refused(&bytes[..length], &["decoded"]);
    }
    let mut file = with_image(b"no picture");
    file.json["images"].as_array_mut().unwrap().push(json!({ "uri": data_uri("image/webp", &bytes) }));
    file.json["textures"] = json!([{ "source": 0, "extensions": { "EXT_texture_webp": { "source": 1 } } }]);
    file.json["extensionsRequired"] = json!(["EXT_texture_webp"]);
    assert_eq!(file.scene().images[0].rgba, texels);
    file.json["textures"] = json!([{ "extensions": { "EXT_texture_webp": { "source": -1 } } }]);
    file.fails(&["texture 0, EXT_texture_webp: expected an image's index, found -1"]);
}

/// A KTX 2.0 file of one level (KTX 2.0 specification, section 3).
#[cfg(feature = "ktx2")]
fn ktx2(format: u32, model: u8, scheme: u32, size: [u32; 2], level: &[u8], inflated: u64) -> Vec<u8> {
    let mut bytes = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    let [width, height] = size;
    // Depth, layers, faces, levels, scheme; places of the format's descriptor, of keys, of global data.
    let words = [format, 1, width, height, 0, 0, 1, 1, scheme, 104, 44, 0, 0, 0, 0, 0, 0];
    bytes.extend(words.into_iter().flat_map(u32::to_le_bytes));
    bytes.extend([148, level.len() as u64, inflated].into_iter().flat_map(u64::to_le_bytes));
    // sRGB in blocks of 4 x 4 texels, one sample with alpha.
    let descriptor =
        [44, 0, 2 | 40 << 16, u32::from(model) | 1 << 8 | 2 << 16, 3 | 3 << 8, 16, 0, 3 << 24, 0, 0, 0];
    bytes.extend(descriptor.into_iter().flat_map(u32::to_le_bytes));
    bytes.extend(level);
    bytes
}

/// A frame of Zstandard that stores bytes as they are (RFC 8878, section 3.1.1).
#[cfg(feature = "ktx2")]
fn zstd(bytes: &[u8]) -> Vec<u8> {
    let block = 1 | (bytes.len() as u32) << 3;
    [&[0x28, 0xb5, 0x2f, 0xfd, 0x20, bytes.len() as u8], &block.to_le_bytes()[..3], bytes].concat()
}

#[cfg(feature = "ktx2")]
#[test]
fn ktx2_of_plain_formats_and_of_uastc() {
    let texels: Vec<u8> = (0..24).collect();
    let plain = ktx2(37, 1, 0, [3, 2], &texels, 24);
    assert_eq!(imported(&plain).rgba, texels);
    assert_eq!(imported(&ktx2(43, 1, 2, [3, 2], &zstd(&texels), 24)).rgba, texels);
    let rgb = imported(&ktx2(23, 1, 2, [4, 2], &zstd(&texels), 24)).rgba;
    assert_eq!(rgb[..8], [0, 1, 2, 255, 3, 4, 5, 255]);
    assert_eq!(imported(&ktx2(9, 1, 0, [24, 1], &texels, 24)).rgba[4..8], [1, 1, 1, 255]);
    // A block of one colour: 5 bits of its mode, then 8 bits a channel.
    let block = (0x17 | 10_u128 << 5 | 20 << 13 | 30 << 21 | 40 << 29).to_le_bytes();
    let uastc = ktx2(0, 166, 0, [4, 4], &block, 16);
    assert_eq!(imported(&uastc).rgba, [10, 20, 30, 40].repeat(16));
    let squeezed = ktx2(0, 166, 2, [4, 4], &zstd(&block), 16);
    assert_eq!(imported(&squeezed).rgba, [10, 20, 30, 40].repeat(16));
    let mut file = with_image(b"no picture");
    file.json["images"].as_array_mut().unwrap().push(json!({ "uri": data_uri("image/ktx2", &uastc) }));
    file.json["textures"] = json!([{ "extensions": { "KHR_texture_basisu": { "source": 1 } } }]);
    file.json["extensionsRequired"] = json!(["KHR_texture_basisu"]);
    assert_eq!(file.scene().images[0].width, 4);
}

#[cfg(feature = "ktx2")]
#[test]
fn ktx2_that_is_damaged_or_promises_too_much() {
    let texels = [7; 24];
    let files = [
        ktx2(37, 1, 0, [3, 2], &texels, 24),
        ktx2(37, 1, 2, [3, 2], &zstd(&texels), 24),
        ktx2(0, 166, 0, [4, 4], &texels[..16], 16),
        ktx2(0, 163, 1, [4, 4], &texels, 0),
    ];
    for file in &files {
        for length in 12..file.len() {
            refused(&file[..length], &["cannot be decoded as KTX 2.0"]);
        }
        for at in 12..file.len() {
            for byte in [0, 1, 0x7f, 0xff] {
                let mut damaged = file.clone();
                damaged[at] = byte;
                let _ = with_image(&damaged).read();
            }
        }
    }
    let refused_as = |file: &[u8], part: &str| refused(file, &["cannot be decoded as KTX 2.0", part]);
    refused_as(&ktx2(37, 1, 2, [3, 2], &zstd(&texels), 1 << 40), "expected 24 bytes in its first level");
    refused_as(&ktx2(37, 1, 0, [16_384, 16_384], &texels, 24), "truncated");
    refused_as(&ktx2(131, 1, 0, [3, 2], &texels, 24), "found format 131 of colour model 1");
    refused_as(&ktx2(0, 166, 1, [4, 4], &texels, 16), "its supercompression 1 does not apply");
    refused_as(&ktx2(37, 1, 0, [0, 2], &texels, 24), "expected one picture of two dimensions");
    refused(&ktx2(37, 1, 0, [16_385, 1], &texels, 24), &["expected a side of at most 16384"]);
    // A window of 2 GiB.
    let mut wide = zstd(&texels);
    wide.splice(4..6, [0, 21 << 3]);
    refused_as(&ktx2(37, 1, 2, [3, 2], &wide, 24), "a wider window");
}
