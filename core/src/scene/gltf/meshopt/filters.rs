//! Filters: integers that decoded elements stand for, replaced in place.

use std::f32::consts::SQRT_2;

/// A filter of decoded elements.
#[derive(Clone, Copy, PartialEq)]
pub(in super::super) enum Filter {
    None,
    /// Unit vectors in octahedral encoding, to normalised integers of 8 or 16 bits.
    Octahedral,
    /// Unit quaternions without their largest component, to normalised integers of 16 bits.
    Quaternion,
    /// Mantissa and exponent, to floats.
    Exponential,
    /// Luma and chroma, to normalised unsigned integers of 8 or 16 bits.
    Color,
}

impl Filter {
    /// The filter of this name in a file.
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "NONE" => Self::None,
            "OCTAHEDRAL" => Self::Octahedral,
            "QUATERNION" => Self::Quaternion,
            "EXPONENTIAL" => Self::Exponential,
            "COLOR" => Self::Color,
            _ => return None,
        })
    }

    /// Whether elements of `stride` bytes can have the filter.
    pub fn applies_to(self, stride: usize) -> bool {
        match self {
            Self::None => true,
            Self::Exponential => stride.is_multiple_of(4),
            Self::Octahedral | Self::Color => matches!(stride, 4 | 8),
            Self::Quaternion => stride == 8,
        }
    }

    /// Replaces the elements.
    pub fn apply(self, elements: &mut [u8], stride: usize) {
        match (self, stride) {
            (Self::None, _) => {}
            (Self::Octahedral, 4) => {
                each(elements, |v: [u8; 4]| {
                    octahedral(v.map(|x| (x as i8).into()), 127.0).map(|x| x as i8 as u8)
                });
            }
            (Self::Octahedral, _) => {
                each_short(elements, |v| {
                    octahedral(v.map(|x| (x as i16).into()), 32767.0).map(|x| x as i16 as u16)
                });
            }
            (Self::Quaternion, _) => each_short(elements, quaternion),
            (Self::Exponential, _) => each(elements, |v| exponential(u32::from_le_bytes(v)).to_le_bytes()),
            (Self::Color, 4) => {
                let signed = |x: u8| i32::from(x as i8);
                each(elements, |[y, co, cg, a]: [u8; 4]| {
                    color([y.into(), signed(co), signed(cg), a.into()], 255.0).map(|x| x as u8)
                });
            }
            (Self::Color, _) => {
                let signed = |x: u16| i32::from(x as i16);
                each_short(elements, |[y, co, cg, a]| {
                    color([y.into(), signed(co), signed(cg), a.into()], 65535.0).map(|x| x as u16)
                });
            }
        }
    }
}

fn each<const N: usize>(elements: &mut [u8], filtered: impl Fn([u8; N]) -> [u8; N]) {
    for element in elements.as_chunks_mut::<N>().0 {
        *element = filtered(*element);
    }
}

/// Filters elements of four 16-bit integers.
fn each_short(elements: &mut [u8], filtered: impl Fn([u16; 4]) -> [u16; 4]) {
    each(elements, |bytes: [u8; 8]| {
        let short = |i: usize| u16::from_le_bytes([bytes[2 * i], bytes[2 * i + 1]]);
        bytemuck::cast(filtered([0, 1, 2, 3].map(short)).map(u16::to_le_bytes))
    });
}

fn rounded(x: f32) -> i32 {
    (x + if x >= 0.0 { 0.5 } else { -0.5 }) as i32
}

/// The unit vector whose x, y and scale are given, times `max`; the fourth component stays.
fn octahedral([x, y, one, w]: [i32; 4], max: f32) -> [i32; 4] {
    let (x, y) = (x as f32, y as f32);
    let z = one as f32 - x.abs() - y.abs();
    let t = z.min(0.0);
    let x = x + if x >= 0.0 { t } else { -t };
    let y = y + if y >= 0.0 { t } else { -t };
    let scale = max / (x * x + y * y + z * z).sqrt();
    [rounded(x * scale), rounded(y * scale), rounded(z * scale), w]
}

fn quaternion(stored: [u16; 4]) -> [u16; 4] {
    let [x, y, z, last] = stored.map(|v| v as i16);
    let scale = f32::from(last | 3);
    let [x, y, z] = [x, y, z].map(f32::from);
    let w = (2.0 * scale * scale - x * x - y * y - z * z).max(0.0).sqrt();
    let to_unit = 32767.0 / SQRT_2 / scale;
    // The two lowest bits say which component is the largest; the others follow it.
    let largest = (last & 3) as usize;
    let mut turned = [0; 4];
    for (i, component) in [w, x, y, z].into_iter().enumerate() {
        turned[(largest + i) % 4] = rounded(component * to_unit) as i16 as u16;
    }
    turned
}

/// The bits of a float with a mantissa of 24 and an exponent of 8 bits.
fn exponential(stored: u32) -> u32 {
    let mantissa = ((stored << 8) as i32 >> 8) as f32;
    let exponent = stored as i32 >> 24;
    // Not a NaN or an infinity for any exponent: the bits that overflow are lost, as in other decoders.
    let power = f32::from_bits(((exponent + 127) as u32) << 23);
    (power * mantissa).to_bits()
}

fn color([y, co, cg, a]: [i32; 4], max: f32) -> [i32; 4] {
    // All bits below the highest one of alpha: the scale of all components.
    let scale = [1, 2, 4, 8].into_iter().fold(a, |bits, shift| bits | bits >> shift);
    let alpha = a << 1 & scale | a & 1;
    let to_full = max / scale as f32;
    [y + co - cg, y + cg, y - co - cg, alpha].map(|x| (x as f32 * to_full + 0.5) as i32)
}
