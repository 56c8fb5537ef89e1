//! Streams as meshoptimizer's encoders write them, with what its decoders make of them.

use super::*;

/// Three 16-bit numbers, two of 8 bits and two of 16 bits, of four vertices.
fn vertices() -> Vec<u8> {
    let vertex = |x: u16, y: u16, u: u16, v: u16| [x, y, 0, 0, u, v];
    let all =
        [vertex(0, 0, 0, 0), vertex(300, 0, 500, 0), vertex(0, 300, 0, 500), vertex(300, 300, 500, 500)];
    all.into_iter().flatten().flat_map(u16::to_le_bytes).collect()
}

fn words(numbers: &[u32]) -> Vec<u8> {
    numbers.iter().flat_map(|n| n.to_le_bytes()).collect()
}

fn shorts(numbers: &[u16]) -> Vec<u8> {
    numbers.iter().flat_map(|n| n.to_le_bytes()).collect()
}

/// Every shorter stream and every stream with another byte in it must end in a value or an error.
fn survives_damage(stream: &[u8], decode: impl Fn(&[u8]) -> Decoded<Vec<u8>>) {
    for length in 0..stream.len() {
        assert!(decode(&stream[..length]).is_err(), "{length} of {} bytes", stream.len());
    }
    for at in 0..stream.len() {
        for byte in [0, 1, 0x7f, 0x80, 0xfe, 0xff] {
            let mut damaged = stream.to_vec();
            damaged[at] = byte;
            let _ = decode(&damaged);
        }
    }
}

/// Four vertices of 12 bytes by version 0 of the codec.
#[rustfmt::skip]
pub const ATTRIBUTES_V0: [u8; 85] = [
    0xa0, 0x01, 0x3f, 0x00, 0x00, 0x00, 0x58, 0x57, 0x58, 0x01, 0x26, 0x00, 0x00, 0x00, 0x01, 0x0c, 0x00, 0x00,
    0x00, 0x58, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x01, 0x3f, 0x00, 0x00, 0x00, 0x17, 0x18,
    0x17, 0x01, 0x26, 0x00, 0x00, 0x00, 0x01, 0x0c, 0x00, 0x00, 0x00, 0x17, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
];

#[test]
fn attributes_of_version_0() {
    assert_eq!(attributes(&ATTRIBUTES_V0, 4, 12).unwrap(), vertices());
    survives_damage(&ATTRIBUTES_V0, |stream| attributes(stream, 4, 12));
    let many = attributes(&ATTRIBUTES_V0, 1 << 40, 12).unwrap_err();
    assert!(many.contains("cannot hold 1099511627776 elements of 12"), "{many}");
    let left = attributes(&[&ATTRIBUTES_V0[..53], &[0], &ATTRIBUTES_V0[53..]].concat(), 4, 12).unwrap_err();
    assert!(left.contains("1 bytes are left"), "{left}");
}

/// Lanes of 16 bits, of bytes and of rotated words, all bit widths, zeros and literals.
#[rustfmt::skip]
const ATTRIBUTES_V1: [u8; 112] = [
    0xa1, 0xa7, 0x9b, 0x68, 0x00, 0x58, 0x58, 0x58, 0x58, 0x58, 0x58, 0x58, 0x58, 0x58, 0x58, 0x58, 0x58, 0x58,
    0x58, 0x58, 0x58, 0x58, 0x58, 0x58, 0x05, 0x2a, 0xaa, 0xaa, 0xaa, 0xaa, 0x00, 0x00, 0x00, 0x00, 0x02, 0x06,
    0x0a, 0x0e, 0x12, 0x16, 0x1a, 0x1e, 0x22, 0x26, 0x2a, 0x2e, 0x32, 0x36, 0x3a, 0x3e, 0x42, 0x46, 0x4a, 0x02,
    0x05, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x0f, 0x00, 0x05, 0x05, 0x05, 0x05, 0x01, 0x00, 0x01, 0x0f,
    0x02, 0x02, 0x62, 0xe2, 0x62, 0xf1, 0x31, 0x71, 0x31, 0xfe, 0x0f, 0x00, 0x0f, 0x01, 0x03, 0x01, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xf4, 0x01, 0x00, 0x00, 0x80,
    0x3f, 0x01, 0x01, 0x52,
];

#[test]
fn attributes_of_version_1() {
    let element = |i: u16| {
        let (wide, float) = ((u32::from(i) * 300).to_le_bytes(), (1.0 + f32::from(i) * 0.125).to_le_bytes());
        [wide, bytemuck::cast([(i * i).to_le_bytes(), (500 - 3 * i).to_le_bytes()]), float].concat()
    };
    let expected: Vec<u8> = (0..20).flat_map(element).collect();
    assert_eq!(attributes(&ATTRIBUTES_V1, 20, 12).unwrap(), expected);
    survives_damage(&ATTRIBUTES_V1, |stream| attributes(stream, 20, 12));
    assert!(attributes(&ATTRIBUTES_V1, 1 << 40, 12).is_err());
}

#[rustfmt::skip]
const TRIANGLES_V0: [u8; 27] = [
    0xe0, 0xf0, 0x10, 0xfe, 0xff, 0xf0, 0x0c, 0xff, 0x02, 0x02, 0x02, 0x00, 0x76, 0x87, 0x56, 0x67, 0x78, 0xa9,
    0x86, 0x65, 0x89, 0x68, 0x98, 0x01, 0x69, 0x00, 0x00,
];
#[rustfmt::skip]
const TRIANGLES_V1: [u8; 24] = [
    0xe1, 0xf0, 0x10, 0xfe, 0x1f, 0x3d, 0x00, 0x0a, 0x00, 0x76, 0x87, 0x56, 0x67, 0x78, 0xa9, 0x86, 0x65, 0x89,
    0x68, 0x98, 0x01, 0x69, 0x00, 0x00,
];

#[test]
fn triangles_of_both_versions() {
    let expected = [0, 1, 2, 2, 1, 3, 4, 6, 5, 7, 8, 9];
    assert_eq!(triangles(&TRIANGLES_V0, 12, 4).unwrap(), words(&expected));
    assert_eq!(triangles(&TRIANGLES_V0, 12, 2).unwrap(), shorts(&expected.map(|i| i as u16)));
    let restarting = [0, 1, 2, 2, 1, 3, 0, 1, 2, 2, 1, 5, 2, 1, 4];
    assert_eq!(triangles(&TRIANGLES_V1, 15, 4).unwrap(), words(&restarting));
    survives_damage(&TRIANGLES_V0, |stream| triangles(stream, 12, 4));
    survives_damage(&TRIANGLES_V1, |stream| triangles(stream, 15, 4));
    assert!(triangles(&TRIANGLES_V1, 1 << 40, 4).is_err());
}

#[test]
fn indices_in_sequence() {
    let stream = [0xd1, 0x00, 0x04, 0xcd, 0x01, 0x04, 0x07, 0x98, 0x1f, 0x00, 0x00, 0x00, 0x00];
    let expected = [0, 1, 51, 2, 49, 1000];
    assert_eq!(indices(&stream, 6, 4).unwrap(), words(&expected));
    assert_eq!(indices(&stream, 6, 2).unwrap(), shorts(&expected.map(|i| i as u16)));
    survives_damage(&stream, |stream| indices(stream, 6, 4));
    assert!(indices(&stream, 1 << 40, 4).is_err());
}

fn filtered(filter: Filter, mut elements: Vec<u8>, stride: usize) -> Vec<u8> {
    assert!(filter.applies_to(stride));
    filter.apply(&mut elements, stride);
    elements
}

#[test]
fn filters_give_what_meshoptimizer_gives() {
    let vectors = shorts(&[0, 1, 2047, 0, 0, 1870, 2047, 1, 2017, 1, 2047, 0, 14, 1300, 2047, 1]);
    let expected = shorts(&[0, 16, 32767, 0, 0, 32621, 3088, 1, 32764, 16, 471, 0, 307, 28541, 16093, 1]);
    assert_eq!(filtered(Filter::Octahedral, vectors, 8), expected);
    let rotations = [0, 1, 0, 0x7fc, 0, 1870, 0, 0x7fd, 2017, 1, 0, 0x7fe, 14, 1300, 0, 0x7ff];
    let expected = [32767, 0, 11, 0, 0, 25013, 0, 21166, 11, 0, 23504, 22830, 158, 14715, 0, 29277];
    assert_eq!(filtered(Filter::Quaternion, shorts(&rotations), 8), shorts(&expected));
    let floats = words(&[0, 0xff00_0003, 0x02ff_fff7, 0xfe7f_ffff]);
    let expected = words(&[0, 0x3fc0_0000, 0xc210_0000, 0x49ff_fffe]);
    assert_eq!(filtered(Filter::Exponential, floats, 4), expected);
    let colors = vec![144, 95, 241, 255, 127, 0, 127, 192, 102, 205, 0, 230, 255, 0, 0, 128];
    let expected = [254, 129, 64, 255, 0, 254, 0, 128, 51, 102, 153, 204, 255, 255, 255, 0];
    assert_eq!(filtered(Filter::Color, colors, 4), expected);
    assert!(!Filter::Quaternion.applies_to(4) && !Filter::Octahedral.applies_to(12));
}
