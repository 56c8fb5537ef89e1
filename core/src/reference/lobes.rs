//! The lobes that a path may continue by, and the choice among them.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::{Cause, Material, Reference, Rounding, Surface, scatter::BsdfSample};

/// Weights of the three lobes of a surface.
pub(super) struct Lobes {
    /// Albedo of the diffuse lobe.
    pub diffuse: DVec3,
    /// The reflected ray and the refracted ray, each if the surface has that lobe.
    pub specular: [Option<BsdfSample>; 2],
    /// The largest channel of each of the three lobes.
    largest: [f64; 3],
}

/// The lobe that a path was scattered by.
pub(super) struct Chosen {
    /// The lobe's weight divided by the probability of choosing it.
    pub weight: DVec3,
    /// The reflected or refracted ray; `None` for the diffuse lobe.
    pub bsdf_sample: Option<BsdfSample>,
}

impl Lobes {
    /// The lobes of a surface for an incident ray of this direction.
    pub fn of(
        reference: &Reference,
        s: &Surface,
        m: &Material,
        direction: DVec3,
        rounding: &mut Rounding,
    ) -> Self {
        let diffuse = m.albedo((-s.normal.dot(direction)).clamp(0.0, 1.0), s.inside);
        let specular = reference.specular(s, m, direction, rounding);
        let [mirror, refraction] =
            specular.map(|bsdf_sample| bsdf_sample.map_or(0.0, |l| l.share.max_element()));
        Self { diffuse, specular, largest: [diffuse.max_element(), mirror, refraction] }
    }

    /// Reflectance of the mirror lobe if it is the only lobe; else `None`.
    pub fn only_mirror(&self) -> Option<DVec3> {
        let [diffuse, mirror, refraction] = self.largest;
        let only = mirror > 0.0 && diffuse == 0.0 && refraction == 0.0;
        self.specular[0].filter(|_| only).map(|bsdf_sample| bsdf_sample.share)
    }

    /// Whether the diffuse lobe is the only lobe.
    pub fn only_diffuse(&self) -> bool {
        let [diffuse, mirror, refraction] = self.largest;
        diffuse > 0.0 && mirror == 0.0 && refraction == 0.0
    }

    /// Whether the surface has a mirror lobe.
    pub fn mirrors(&self) -> bool {
        self.largest[1] > 0.0
    }

    /// Probability of continuing by the diffuse lobe; 0 if there is none.
    pub fn chance_of_diffuse(&self) -> f64 {
        let sum: f64 = self.largest.iter().sum();
        if sum > 0.0 { self.largest[0] / sum } else { 0.0 }
    }

    /// Whether the diffuse lobe is at least as probable as the others together.
    pub fn is_diffuse(&self) -> bool {
        let [diffuse, mirror, refraction] = self.largest;
        diffuse >= mirror + refraction
    }

    /// Chooses a lobe by a number in [0, 1), with probabilities proportional to their largest channels; `None` if
    /// all are zero.
    pub fn choose(&self, number: f64, rounding: &mut Rounding) -> Option<Chosen> {
        let [diffuse, mirror, refraction] = self.largest;
        let sum = diffuse + mirror + refraction;
        if sum <= 0.0 {
            return None;
        }
        let number = rounding.number(Cause::Branch, number, 1.0).clamp(0.0, 1.0 - f64::EPSILON) * sum;
        if number < diffuse {
            return Some(Chosen { weight: self.diffuse * (sum / diffuse), bsdf_sample: None });
        }
        let reflected = number < diffuse + mirror;
        let (bsdf_sample, largest) =
            if reflected { (self.specular[0], mirror) } else { (self.specular[1], refraction) };
        bsdf_sample.map(|bsdf_sample| Chosen {
            weight: bsdf_sample.share * (sum / largest),
            bsdf_sample: Some(bsdf_sample),
        })
    }
}

/// A cosine-weighted direction around a unit normal, and its density, cosine over pi.
pub(super) fn cosine_weighted(n: DVec3, [u, v]: [f64; 2]) -> (DVec3, f64) {
    let (r, phi) = (u.sqrt(), TAU * v);
    let cosine = (1.0 - u).max(0.0).sqrt();
    let [x, y] = tangents(n);
    (r * phi.cos() * x + r * phi.sin() * y + cosine * n, cosine / PI)
}

/// Two tangents to a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
fn tangents(n: DVec3) -> [DVec3; 2] {
    // Treats both zeros alike, since f32 may compute either.
    let sign = if n.z >= 0.0 { 1.0 } else { -1.0 };
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    [DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), DVec3::new(b, sign + n.y * n.y * a, -n.y)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn tangents_are_a_right_handed_basis() {
        let mut random = Random(4);
        let axes = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
        for n in axes.chain((0..1000).map(|_| random.direction())) {
            let [x, y] = tangents(n);
            assert!((x.cross(y) - n).length() < 1e-12, "{n}");
            assert!((x.length() - 1.0).abs() < 1e-12 && (y.length() - 1.0).abs() < 1e-12, "{n}");
        }
    }

    #[test]
    fn directions_are_as_dense_as_their_cosine() {
        let n = DVec3::new(2.0, -3.0, -6.0) / 7.0;
        let mut random = Random(11);
        let count = 20_000;
        // The mean of cosine^k under this density is 2 / (k + 2); that of tangential components is 0.
        let (mut mean, mut square, mut beside) = (0.0, 0.0, DVec3::ZERO);
        for _ in 0..count {
            let (direction, density) = cosine_weighted(n, [random.unit(), random.unit()]);
            let cosine = direction.dot(n);
            assert!((direction.length() - 1.0).abs() < 1e-12 && (density - cosine / PI).abs() < 1e-12);
            mean += cosine / f64::from(count);
            square += cosine * cosine / f64::from(count);
            beside += (direction - cosine * n) / f64::from(count);
        }
        // Four standard errors: variances are 1/18, 1/12, and 1/4 along each axis.
        let error = |variance: f64| 4.0 * (variance / f64::from(count)).sqrt();
        assert!((mean - 2.0 / 3.0).abs() < error(1.0 / 18.0), "{mean}");
        assert!((square - 0.5).abs() < error(1.0 / 12.0), "{square}");
        assert!(beside.abs().max_element() < error(0.25), "{beside}");
    }
}
