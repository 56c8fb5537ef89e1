//! The lobes that a path may continue by, and the choice among them.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::{
    Cause, Material, Reference, Rounding, Surface,
    microfacets::Microfacets,
    scatter::{BsdfSample, reflected},
};
use crate::scene::LobeAlbedos;

/// The lobes of a surface.
pub(super) struct Lobes {
    /// Albedo of the diffuse lobe.
    pub diffuse: DVec3,
    /// Albedo of the diffuse lobe on the side away from the viewer.
    behind: DVec3,
    /// Albedo of the lobes for which light is looked for: the diffuse one and the glossy ones.
    pub albedo: DVec3,
    /// The reflected ray and the refracted ray, each if the surface has that lobe.
    specular: [Option<BsdfSample>; 2],
    /// The ray reflected by a smooth coat with a normal of its own.
    coat_mirror: Option<BsdfSample>,
    /// Reflection by the rough surface, and by a rough coat over it.
    glossy: [Option<Microfacets>; 2],
    /// The material, for its sheen; what a coat lets through to it; and the unit vector to the viewer.
    sheen: (Material, DVec3, DVec3),
    /// The largest channel of each lobe: diffuse, mirror, refraction, glossy, coat, sheen, diffuse behind, smooth coat.
    largest: [f64; 8],
}

/// The lobe that a path is scattered by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Chosen {
    Diffuse,
    Mirror,
    Refraction,
    Glossy,
    Coat,
    Sheen,
    Behind,
    CoatMirror,
}

/// How a path continues.
pub(super) struct Continued {
    /// Unit direction.
    pub direction: DVec3,
    /// Width of the ray's cone at its origin, and its growth per unit of distance.
    pub cone: (f64, f64),
    /// The lobe's weight divided by the probability of choosing it.
    pub weight: DVec3,
    /// Density of the direction per unit of solid angle; `None` for mirrored and refracted rays.
    pub density: Option<f64>,
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
        let cosine = (-s.normal.dot(direction)).clamp(0.0, 1.0);
        let shares = m.shares(s, -direction, reference.albedos.get_or_init(LobeAlbedos::new));
        let [mut mirror, mut refraction] = reference.specular(s, m, direction, rounding);
        let mirrored_by = |normal: DVec3| reflected(direction, normal);
        mirror = mirror.map(|ray| BsdfSample { direction: mirrored_by(s.normal), ..ray });
        let coat_mirror = m.coat_normal.map(|(normal, _)| BsdfSample {
            direction: mirrored_by(normal),
            cone: reference.bent(s, 1.0, 2.0),
            share: DVec3::splat(shares.coat_mirror),
            crosses: false,
        });
        for (ray, share) in [(&mut mirror, shares.mirror), (&mut refraction, shares.refraction)] {
            *ray = ray.map(|ray| BsdfSample { share, ..ray });
        }
        let [glossy, coat] = shares.glossy;
        let mut transmitted = refraction.map_or(0.0, |ray| ray.share.max_element());
        if let Some(glossy) = glossy {
            // Some microfacets may refract where the surface as a plane does not.
            let passed = (1.0 - glossy.reflectance(cosine).max_element()).max(0.25);
            transmitted = shares.refraction.max_element() * passed;
        }
        let largest = |lobe: Option<Microfacets>| lobe.map_or(0.0, |lobe| lobe.albedo.max_element());
        Self {
            diffuse: shares.diffuse,
            behind: shares.behind,
            albedo: shares.diffuse
                + shares.sheen[0]
                + shares.behind
                + [glossy, coat].into_iter().flatten().map(|l| l.albedo).sum::<DVec3>(),
            specular: [
                mirror,
                refraction.or(glossy.and(mirror)).map(|ray| BsdfSample { share: shares.refraction, ..ray }),
            ],
            coat_mirror,
            glossy: [glossy, coat],
            sheen: (*m, shares.sheen[1], -direction),
            largest: [
                shares.diffuse.max_element(),
                shares.mirror.max_element(),
                transmitted,
                largest(glossy),
                largest(coat),
                shares.sheen[0].max_element(),
                shares.behind.max_element(),
                shares.coat_mirror,
            ],
        }
    }

    fn sum(&self) -> f64 {
        self.largest.iter().sum()
    }

    /// Reflectance of the mirror lobe if it is the only lobe; else `None`.
    pub fn only_mirror(&self) -> Option<DVec3> {
        let only = self.largest[1] > 0.0 && self.sum() == self.largest[1];
        self.specular[0].filter(|_| only).map(|bsdf_sample| bsdf_sample.share)
    }

    /// Whether the diffuse lobe is the only lobe.
    pub fn only_diffuse(&self) -> bool {
        self.largest[0] > 0.0 && self.sum() == self.largest[0]
    }

    /// Whether the surface has a mirror lobe.
    pub fn mirrors(&self) -> bool {
        self.largest[1] > 0.0
    }

    /// Whether the diffuse lobe is at least as probable as the others together.
    pub fn is_diffuse(&self) -> bool {
        2.0 * self.largest[0] >= self.sum()
    }

    /// Chooses a lobe by a number in [0, 1), with probabilities proportional to their largest channels; `None` if
    /// all are zero.
    pub fn choose(&self, number: f64, rounding: &mut Rounding) -> Option<Chosen> {
        let sum = self.sum();
        if sum <= 0.0 {
            return None;
        }
        let number = rounding.number(Cause::Branch, number, 1.0).clamp(0.0, 1.0 - f64::EPSILON) * sum;
        let all = [
            (Chosen::Diffuse, 0),
            (Chosen::CoatMirror, 7),
            (Chosen::Mirror, 1),
            (Chosen::Refraction, 2),
            (Chosen::Glossy, 3),
            (Chosen::Coat, 4),
            (Chosen::Sheen, 5),
            (Chosen::Behind, 6),
        ];
        let mut end = 0.0;
        let chosen = all.into_iter().find(|(_, lobe)| {
            end += self.largest[*lobe];
            number < end
        });
        chosen.map(|(chosen, _)| chosen)
    }

    /// The lobes for which light is looked for, times the cosine, for light from a direction; and the density with which
    /// a path continues in it.
    pub fn response(&self, s: &Surface, direction: DVec3) -> (DVec3, f64) {
        let cosine = s.normal.dot(direction);
        if self.largest[6] > 0.0 && cosine < 0.0 && s.face.dot(direction) < 0.0 {
            let share = -cosine / PI;
            return (share * self.behind, share * self.largest[6] / self.sum());
        }
        if s.face.dot(direction) <= 0.0 {
            return (DVec3::ZERO, 0.0);
        }
        self.response_above(s, direction)
    }

    /// Like [`Lobes::response`] for light on the viewer's side of the shading normal, whatever the side of the face: of
    /// punctual lights, which reach the curved surface above it.
    pub fn response_above(&self, s: &Surface, direction: DVec3) -> (DVec3, f64) {
        let cosine = s.normal.dot(direction);
        if cosine <= 0.0 {
            return (DVec3::ZERO, 0.0);
        }
        let mut value = self.diffuse / PI * cosine;
        let mut density = (self.largest[0] + self.largest[5]) * cosine / PI;
        let (m, passes, view) = self.sheen;
        value += passes * m.sheen_lobe(s.normal, view, direction) * cosine;
        for (lobe, largest) in self.glossy.iter().zip(&self.largest[3..]) {
            if let Some(lobe) = lobe.filter(|_| *largest > 0.0) {
                let (reflected, drawn) = lobe.response(direction);
                value += reflected;
                density += largest * drawn;
            }
        }
        (value, density / self.sum())
    }

    /// Continues by a lobe, with uniform numbers in [0, 1); `None` if that leads nowhere. `reflected` is the cone of
    /// mirrored rays.
    pub fn leave(
        &self,
        chosen: Chosen,
        (s, m): (&Surface, &Material),
        random: [f64; 2],
        reflected: (f64, f64),
    ) -> Option<Continued> {
        let of = |weight: DVec3, lobe: usize| weight * self.sum() / self.largest[lobe];
        let (direction, cone) = match chosen {
            Chosen::Diffuse | Chosen::Sheen => (cosine_weighted(s.normal, random).0, (0.0, 0.0)),
            Chosen::Behind => (cosine_weighted(-s.normal, random).0, (0.0, 0.0)),
            Chosen::Glossy => (self.glossy[0]?.draw(random), reflected),
            Chosen::Coat => (self.glossy[1]?.draw(random), reflected),
            Chosen::Refraction if self.glossy[0].is_some() => {
                let (direction, passed) = self.glossy[0]?.refract(m.thin, m.ratio(s.inside), random)?;
                let weight = of(self.specular[1]?.share * passed, 2);
                let cone = (s.width, s.growth);
                let beyond = s.face.dot(direction) < 0.0;
                return beyond.then_some(Continued { direction, cone, weight, density: None });
            }
            Chosen::CoatMirror => {
                let BsdfSample { direction, cone, share, .. } = self.coat_mirror?;
                return Some(Continued { direction, cone, weight: of(share, 7), density: None });
            }
            Chosen::Mirror | Chosen::Refraction => {
                let i = usize::from(chosen == Chosen::Refraction);
                let BsdfSample { direction, cone, share, .. } = self.specular[i]?;
                return Some(Continued { direction, cone, weight: of(share, i + 1), density: None });
            }
        };
        let (value, density) = self.response(s, direction);
        (density > 0.0).then(|| Continued {
            direction,
            cone,
            weight: value / density,
            density: Some(density),
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
pub(super) fn tangents(n: DVec3) -> [DVec3; 2] {
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
