//! Tangents with the sign of the bitangent in 32 bits: the octahedral encoding, whose lowest bit is the sign.

use glam::{DVec3, Vec3};

use super::{octahedral_decode_exact, octahedral_encode};

/// Encodes a unit tangent; the bitangent is `normal x tangent`, or its opposite if `flipped`.
#[must_use]
pub fn encode(tangent: Vec3, flipped: bool) -> u32 {
    octahedral_encode(tangent) & !1 | u32::from(flipped)
}

/// Decodes a unit tangent and the sign of the bitangent, 1 or -1.
#[must_use]
pub fn decode_exact(word: u32) -> (DVec3, f64) {
    (octahedral_decode_exact(word & !1), if word & 1 == 0 { 1.0 } else { -1.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tangents_keep_direction_and_sign() {
        for (tangent, flipped) in [(Vec3::X, false), (Vec3::new(0.6, 0.0, -0.8), true), (-Vec3::Y, true)] {
            let (decoded, sign) = decode_exact(encode(tangent, flipped));
            assert!((decoded.as_vec3() - tangent).length() < 2.0e-4, "{tangent}: {decoded}");
            assert_eq!(sign < 0.0, flipped);
        }
    }
}
