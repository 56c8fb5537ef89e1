//! Specular reflection and refraction: the rays that follow from a ray. Rays cut off by the depth limit or the
//! least weight have the environment's fallback radiance.

use glam::DVec3;

use super::{Attributes, Cause, Limits, Material, Ray, Reference, Rounding, Sample, Surface, media::Media};

/// A ray of the recursion with its state.
pub(super) struct PathState {
    pub ray: Ray,
    /// The primitive that the ray starts on, which it must not hit again; `None` for primary rays.
    pub left: Option<usize>,
    /// Weight of the ray's radiance in the sample.
    pub weight: DVec3,
    /// Recursion level: 1 for the primary ray.
    pub level: u32,
    /// Roughness of the surface that the ray leaves, in steps of 1/255; 0 for primary rays.
    pub roughness: f64,
    /// The media at the ray's start.
    pub media: Media,
}

/// A reflected or refracted ray that leaves a surface.
#[derive(Clone, Copy)]
pub(super) struct BsdfSample {
    pub direction: DVec3,
    /// Width of the ray's cone at its origin, and its growth per unit of distance.
    pub cone: (f64, f64),
    /// Weight of the ray's radiance in the pixel, for each channel.
    pub share: DVec3,
    /// Whether the ray crosses the surface.
    pub crosses: bool,
}

/// What the rays that leave a surface bring.
pub(super) struct Scattered {
    pub radiance: DVec3,
    /// The weight and the hit of the ray with the greatest weight that hits anything.
    pub hit: Option<(f64, Attributes)>,
    /// Radiance of the mirrored ray, if it was traced and met nothing.
    pub mirrored: Option<DVec3>,
}

impl Reference {
    /// The reflected ray and, unless reflection is total, the refracted one.
    pub(super) fn specular(
        &self,
        s: &Surface,
        m: &Material,
        direction: DVec3,
        rounding: &mut Rounding,
    ) -> [Option<BsdfSample>; 2] {
        let cosine = (-s.normal.dot(direction)).clamp(0.0, 1.0);
        let cosine = rounding.number(Cause::Branch, cosine, 1.0).clamp(0.0, 1.0);
        let mirrored = BsdfSample {
            direction: reflected(direction, m.mirroring(s.normal, cosine, s.inside)),
            cone: self.bent(s, 1.0, 2.0),
            share: m.mirror(cosine, s.inside),
            crosses: false,
        };
        let through = refracted(s, m, direction, cosine).map(|(refracted, kept, turned)| BsdfSample {
            direction: refracted.normalize_or_zero(),
            cone: self.bent(s, kept, turned),
            share: m.refraction(cosine, s.inside),
            crosses: true,
        });
        [Some(mirrored), through]
    }

    /// Radiance of the ray that goes straight on, into the media `beyond`, through a surface which covers this share of
    /// what is behind it, and its weight with its hit. All straight rays together count as one level.
    pub(super) fn straight(
        &self,
        s: &Surface,
        from: &PathState,
        beyond: &Media,
        covered: f64,
        limits: &Limits,
        rounding: &mut Rounding,
    ) -> (DVec3, Option<(f64, Attributes)>) {
        if covered >= 1.0 {
            return (DVec3::ZERO, None);
        }
        let weight = (1.0 - covered) * from.weight;
        let cone = (s.width, s.growth);
        let straight = BsdfSample { direction: from.ray.direction, cone, share: DVec3::ONE, crosses: true };
        let start = (from.level.max(2) - 1, beyond);
        let Some(seen) = self.followed((s, 0.0), &straight, weight, start, limits, rounding) else {
            return (self.cut_off(weight, straight.direction, 0.0), None);
        };
        (seen.color, seen.hit().map(|hit| (weight.max_element(), hit)))
    }

    /// Traces the reflected ray, and the refracted one into the media `beyond`.
    pub(super) fn scattered(
        &self,
        s: &Surface,
        m: &Material,
        from: &PathState,
        beyond: &Media,
        limits: &Limits,
        rounding: &mut Rounding,
    ) -> Scattered {
        let rays = self.specular(s, m, from.ray.direction, rounding);
        let mut scattered = Scattered { radiance: DVec3::ZERO, hit: None, mirrored: None };
        for (ray, bsdf_sample) in rays.iter().enumerate() {
            let Some(bsdf_sample) = bsdf_sample else { continue };
            let weight = from.weight * bsdf_sample.share;
            let start = (from.level, if bsdf_sample.crosses { beyond } else { &from.media });
            let Some(seen) = self.followed((s, m.roughness), bsdf_sample, weight, start, limits, rounding)
            else {
                scattered.radiance += self.cut_off(weight, bsdf_sample.direction, m.roughness);
                continue;
            };
            scattered.radiance += seen.color;
            let found = seen.hit().map(|hit| (weight.max_element(), hit));
            if ray == 0 && found.is_none() {
                scattered.mirrored = Some(seen.color);
            }
            if found.is_some_and(|(w, _)| scattered.hit.is_none_or(|(most, _)| w > most)) {
                scattered.hit = found;
            }
        }
        scattered
    }

    /// Radiance that takes the place of a ray which a limit cuts off: that of a map along it, else the same for all.
    fn cut_off(&self, weight: DVec3, direction: DVec3, roughness: f64) -> DVec3 {
        if self.has_environment_map() {
            return weight * self.environment_lobe(direction, stepped(roughness));
        }
        weight * self.scene.environment.fallback_radiance.as_dvec3()
    }

    /// Radiance of the mirrored ray of a surface seen from outside, where it meets nothing; `direction` is that of the
    /// incident ray, of unit length.
    pub(super) fn mirrored_environment(&self, m: &Material, normal: DVec3, direction: DVec3) -> DVec3 {
        let cosine = (-normal.dot(direction)).clamp(0.0, 1.0);
        let mirrored = reflected(direction, m.mirroring(normal, cosine, false));
        m.mirror(cosine, false) * self.environment_lobe(mirrored, stepped(m.roughness))
    }

    /// The sample of a ray that leaves a surface; `None` if a limit cuts it off or it has no weight.
    fn followed(
        &self,
        (s, roughness): (&Surface, f64),
        bsdf_sample: &BsdfSample,
        weight: DVec3,
        (level, media): (u32, &Media),
        limits: &Limits,
        rounding: &mut Rounding,
    ) -> Option<Sample> {
        let largest = weight.max_element();
        if largest <= 0.0 {
            return None;
        }
        let largest = rounding.number(Cause::Branch, largest, largest);
        if level >= limits.depth || largest < limits.min_weight {
            return None;
        }
        let ray = s.spawn(bsdf_sample.direction, bsdf_sample.cone, rounding);
        let state = PathState {
            ray,
            left: Some(s.primitive),
            weight,
            level: level + 1,
            roughness: stepped(roughness),
            media: media.clone(),
        };
        Some(self.follow(&state, limits, rounding))
    }
}

/// A roughness as rays carry it.
fn stepped(roughness: f64) -> f64 {
    (roughness.clamp(0.0, 1.0) * 255.0 + 0.5).floor() / 255.0
}

/// Direction of the refracted ray by Snell's law (unchanged through a pane), and its components along the
/// incident direction and along the normal; `None` for total reflection.
fn refracted(s: &Surface, m: &Material, direction: DVec3, cosine: f64) -> Option<(DVec3, f64, f64)> {
    if m.thin {
        return Some((direction, 1.0, 0.0));
    }
    let ratio = m.ratio(s.inside);
    let other2 = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    let turned = ratio * cosine - other2.max(0.0).sqrt();
    (other2 > 0.0).then(|| (ratio * direction + turned * s.normal, ratio, turned))
}

/// A direction mirrored by a normal.
pub(super) fn reflected(direction: DVec3, normal: DVec3) -> DVec3 {
    (direction - 2.0 * normal.dot(direction) * normal).normalize_or_zero()
}
