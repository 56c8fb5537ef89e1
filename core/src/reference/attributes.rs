//! The ray-attribute vector of a pixel (Kim 2016, section 3.2), exact or quantised as for storage.

use glam::{DVec2, DVec3};

use super::{Cause, Maps, Rounding};
use crate::{
    Features,
    scene::{octahedral_decode_exact, octahedral_encode},
};

/// Mantissas, exponents and bias of three radiances in 32 bits (EXT_texture_shared_exponent).
const MANTISSA_BITS: i32 = 9;
const EXPONENT_BIAS: i32 = 15;
const MOST_RADIANCE: f64 = 65408.0;

/// The attributes of a pixel that are tested for similarity and interpolated (Kim 2016, section 3.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attributes {
    /// Parameter along the pixel's ray (POS).
    pub depth: f64,
    /// OID; `None` if the ray hits nothing.
    pub object: Option<u32>,
    /// Unit shading normal on the viewer's side of the face (NORM).
    pub normal: DVec3,
    /// Unit normal of the face on the viewer's side.
    pub face: DVec3,
    /// Bit i is set if light i does not reach the point (SHDBIT).
    pub shadow: u32,
    /// Whether `gcol` is the radiance of one mirrored ray, which met nothing where the environment is a map.
    pub mirrors_environment: bool,
    /// Reflected and refracted radiance (GCOL).
    pub gcol: DVec3,
    /// Texture coordinates, wrapped into [0, 1] (TCOORD).
    pub texcoord: DVec2,
    /// Interpolated vertex colour, linear RGB.
    pub color: DVec3,
    /// Interpolated alpha of the vertices.
    pub alpha: f64,
    /// Footprint in texture coordinates: log2 of the second moments along s and t, and their correlation.
    pub footprint: DVec3,
    /// What extended materials need.
    pub maps: Maps,
}

/// Range of the stored logarithms of second moments.
const LEAST_LOG: f64 = -32.0;
const MOST_LOG: f64 = 10.0;

/// Converts second moments (ss, tt, st) to a footprint attribute.
pub(super) fn footprint(moments: DVec3) -> DVec3 {
    let [s, t] = [moments.x, moments.y].map(|x| x.log2().clamp(LEAST_LOG, MOST_LOG));
    DVec3::new(s, t, (moments.z / (0.5 * (s + t)).exp2()).clamp(-1.0, 1.0))
}

/// Converts a footprint attribute to second moments (ss, tt, st).
pub(super) fn moments(footprint: DVec3) -> DVec3 {
    let [s, t] = [footprint.x, footprint.y];
    DVec3::new(s.exp2(), t.exp2(), footprint.z * (0.5 * (s + t)).exp2())
}

impl Attributes {
    /// The attributes of a ray without a hit.
    #[must_use]
    pub fn miss() -> Self {
        Self {
            depth: f64::INFINITY,
            object: None,
            normal: DVec3::ZERO,
            face: DVec3::ZERO,
            shadow: 0,
            mirrors_environment: false,
            gcol: DVec3::ZERO,
            texcoord: DVec2::ZERO,
            color: DVec3::ONE,
            alpha: 1.0,
            footprint: footprint(DVec3::ZERO),
            maps: Maps::default(),
        }
    }

    /// The attributes after quantisation for storage; those that a scene with these features does not need are
    /// left out.
    #[must_use]
    pub fn stored(&self, features: &Features, rounding: &mut Rounding) -> Self {
        if self.object.is_none() {
            return Self::miss();
        }
        let normal = stored_direction(rounding.direction(Cause::Storage, self.normal));
        let depth = rounding.number(Cause::Storage, self.depth, self.depth);
        let largest = self.gcol.max_element();
        let gcol = rounding.vector(Cause::Storage, self.gcol, largest);
        let texcoord = rounding.pair(Cause::Storage, self.texcoord, 1.0);
        let color = rounding.vector(Cause::Storage, self.color, 1.0);
        let alpha = rounding.number(Cause::Storage, self.alpha, 1.0);
        let footprint = displaced(self.footprint, rounding);
        let maps = self.maps.stored(features, rounding);
        Self {
            depth: f64::from(depth as f32),
            normal,
            face: if features.smooth_normals {
                stored_direction(rounding.direction(Cause::Storage, self.face))
            } else {
                normal
            },
            gcol: stored_radiance(gcol),
            texcoord: if features.textures {
                DVec2::from_array(texcoord.to_array().map(|x| in_steps(x, 65535.0)))
            } else {
                DVec2::ZERO
            },
            color: if features.vertex_colors {
                DVec3::from_array(color.to_array().map(|x| in_steps(x, 65535.0)))
            } else {
                DVec3::ONE
            },
            alpha: if features.vertex_colors { in_steps(alpha, 65535.0) } else { 1.0 },
            footprint: if features.textures { stored_footprint(footprint) } else { self.footprint },
            maps,
            ..*self
        }
    }
}

/// A footprint attribute within the errors of its computation.
pub(super) fn displaced(footprint: DVec3, rounding: &mut Rounding) -> DVec3 {
    rounding.vector(Cause::Storage, footprint, MOST_LOG - LEAST_LOG)
}

fn in_steps(x: f64, steps: f64) -> f64 {
    (x.clamp(0.0, 1.0) * steps).round() / steps
}

pub(super) fn stored_direction(d: DVec3) -> DVec3 {
    octahedral_decode_exact(octahedral_encode(d.as_vec3()))
}

/// Quantises a footprint: eleven bits for each logarithm, ten for the correlation.
pub(super) fn stored_footprint(footprint: DVec3) -> DVec3 {
    let log = |x: f64| {
        LEAST_LOG + (MOST_LOG - LEAST_LOG) * in_steps((x - LEAST_LOG) / (MOST_LOG - LEAST_LOG), 2047.0)
    };
    DVec3::new(log(footprint.x), log(footprint.y), 2.0 * in_steps(0.5 * footprint.z + 0.5, 1022.0) - 1.0)
}

/// Quantises three radiances to nine bits each with the exponent of the largest.
fn stored_radiance(color: DVec3) -> DVec3 {
    let color = color.clamp(DVec3::ZERO, DVec3::splat(MOST_RADIANCE));
    let power = color.max_element().log2().floor().max(f64::from(-EXPONENT_BIAS - 1)) as i32 + 1;
    let step = |power: i32| 2.0_f64.powi(power - MANTISSA_BITS);
    // A mantissa that rounds to 2^9 needs the next exponent.
    let rounded = (color.max_element() / step(power)).round();
    let step = if rounded >= step(2 * MANTISSA_BITS) { step(power + 1) } else { step(power) };
    (color / step).round() * step
}
