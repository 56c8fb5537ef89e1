//! Mirror reflection and refraction: the rays that follow from a ray. What the depth limit or the weight cut leaves out
//! is replaced by the environment's truncated radiance.

use glam::DVec3;

use super::{Cause, Limits, Material, Ray, Reference, Rounding, Surface};

/// A ray on its way, with its place in the recursion.
pub(super) struct Branch {
    pub ray: Ray,
    /// The primitive that it starts on.
    pub left: Option<usize>,
    /// The share of the sample's radiance that it brings.
    pub weight: DVec3,
    /// 1 for the primary ray.
    pub level: u32,
}

impl Reference {
    /// What the rays that leave the surface bring to the sample.
    pub(super) fn bounced(
        &self,
        s: &Surface,
        m: &Material,
        from: &Branch,
        limits: &Limits,
        rounding: &mut Rounding,
    ) -> DVec3 {
        let direction = from.ray.direction;
        let cosine = (-s.normal.dot(direction)).clamp(0.0, 1.0);
        let cosine = rounding.number(Cause::Branch, cosine, 1.0).clamp(0.0, 1.0);
        let mut sum = DVec3::ZERO;
        if let Some((refracted, kept, turned)) = refracted(s, m, direction, cosine) {
            let weight = from.weight * m.refraction(cosine, s.inside);
            let cone = self.bent(s, kept, turned);
            sum += self.followed(s, (refracted, cone), weight, from.level, limits, rounding);
        }
        let mirrored = direction - 2.0 * s.normal.dot(direction) * s.normal;
        let weight = from.weight * m.mirror(cosine, s.inside);
        sum + self.followed(s, (mirrored, self.bent(s, 1.0, 2.0)), weight, from.level, limits, rounding)
    }

    fn followed(
        &self,
        s: &Surface,
        (direction, cone): (DVec3, (f64, f64)),
        weight: DVec3,
        level: u32,
        limits: &Limits,
        rounding: &mut Rounding,
    ) -> DVec3 {
        let largest = weight.max_element();
        if largest <= 0.0 {
            return DVec3::ZERO;
        }
        let largest = rounding.number(Cause::Branch, largest, largest);
        if level >= limits.depth || largest < limits.min_weight {
            return weight * self.scene.environment.truncated.as_dvec3();
        }
        let ray = s.spawn(direction.normalize_or_zero(), cone, rounding);
        let branch = Branch { ray, left: Some(s.primitive), weight, level: level + 1 };
        self.follow(&branch, limits, rounding).color
    }
}

/// The direction of the refracted ray (straight on through a pane), by Snell's law, and how much there is in it of the
/// direction of the ray that arrives and of the normal; `None` where reflection is total.
fn refracted(s: &Surface, m: &Material, direction: DVec3, cosine: f64) -> Option<(DVec3, f64, f64)> {
    if m.thin {
        return Some((direction, 1.0, 0.0));
    }
    let ratio = m.ratio(s.inside);
    let other2 = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    let turned = ratio * cosine - other2.max(0.0).sqrt();
    (other2 > 0.0).then(|| (ratio * direction + turned * s.normal, ratio, turned))
}
