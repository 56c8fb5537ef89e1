//! Unit vectors in 32 bits: octahedral mapping to two 16-bit signed normalised integers (Cigolle et al. 2014, "A
//! Survey of Efficient Representations for Independent Unit Vectors", section 3.1). A test checks that the
//! angular error is below [`MAX_ERROR`].

use glam::{DVec3, Vec3};

/// Largest angle in radians between a unit vector and its decoded encoding.
pub const MAX_ERROR: f32 = 6.5e-5;

/// Encodes a unit vector; x is in the lower half of the word.
#[must_use]
pub fn encode(n: Vec3) -> u32 {
    let n = n.as_dvec3();
    let l1 = n.x.abs() + n.y.abs() + n.z.abs();
    let (mut x, mut y) = if l1 > 0.0 { (n.x / l1, n.y / l1) } else { (0.0, 0.0) };
    if n.z < 0.0 {
        (x, y) = ((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y));
    }
    let quantise = |v: f64| (v.clamp(-1.0, 1.0) * 32767.0).round() as i16 as u16 as u32;
    quantise(x) | quantise(y) << 16
}

/// Decodes a unit vector in f32.
#[must_use]
pub fn decode(packed: u32) -> Vec3 {
    decode_exact(packed).as_vec3()
}

/// Decodes a unit vector in f64.
#[must_use]
pub fn decode_exact(packed: u32) -> DVec3 {
    let component = |bits: u32| f64::from(bits as u16 as i16).max(-32767.0) / 32767.0;
    let (x, y) = (component(packed), component(packed >> 16));
    let z = 1.0 - x.abs() - y.abs();
    let fold = (-z).max(0.0);
    DVec3::new(x - fold.copysign(x), y - fold.copysign(y), z).normalize_or_zero()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_direction_comes_back_within_the_stated_error() {
        let mut worst = 0.0_f64;
        for i in 0..200_000_u32 {
            // A spherical Fibonacci lattice.
            let z = 1.0 - (2.0 * f64::from(i) + 1.0) / 200_000.0;
            let phi = f64::from(i) * std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
            let r = (1.0 - z * z).sqrt();
            let n = DVec3::new(r * phi.cos(), r * phi.sin(), z);
            let back = decode(encode(n.as_vec3())).as_dvec3();
            worst = worst.max(n.cross(back).length().atan2(n.dot(back)));
        }
        assert!(worst < f64::from(MAX_ERROR), "worst angle {worst}");
        assert!(worst > 1e-5, "the measure sees the quantisation: {worst}");
    }

    #[test]
    fn axes_are_exact() {
        for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
            assert_eq!(decode(encode(axis)), axis);
            assert_eq!(decode(encode(-axis)), -axis);
        }
    }
}
