//! The similarity checks (Kim 2016, Table 1), and interpolation between references that pass them.
//!
//! Deviations from the paper: tolerances are strict bounds. G4 uses the tangent planes of the faces and counts a
//! distance from them only if it exceeds the rounding errors of the stored normals and depths. Interpolation is
//! perspective-correct: weights are inverse depths, which is exact on planes.

use glam::{DVec2, DVec3};

use super::{Attributes, Maps, ReferenceFrame, Rounding, attributes, material::Shading};
use crate::{Check, Tolerances, scene::OCTAHEDRAL_ERROR};

/// A reference pixel: its stored attributes and its world-space position.
#[derive(Clone, Copy, Debug)]
pub struct Reached {
    /// Attributes of the first hit, quantised as they are stored.
    pub attributes: Attributes,
    /// Position of the first hit in world space.
    pub position: DVec3,
}

impl ReferenceFrame<'_> {
    /// Mask of the checks ([`Check::bit`]) that two reference pixels `stride` samples apart fail.
    #[must_use]
    pub fn failed(&self, a: &Reached, b: &Reached, stride: u32) -> u32 {
        let tolerances = self.settings.tolerances.at(stride);
        let pos = f64::from(tolerances.pos) * self.reference.longest_side();
        let (p, q) = (&a.attributes, &b.attributes);
        if p.object != q.object {
            return Check::Oid.bit();
        }
        let Some(object) = p.object else {
            // Two misses pass all checks.
            return if pos > 0.0 { 0 } else { Check::Pos.bit() };
        };
        let seam = self.reference.first_texture(object).is_some()
            && at_seam(p.texcoord, q.texcoord, f64::from(tolerances.tex))
            || self.maps_apart(object, [&p.maps, &q.maps], &tolerances);
        let gcol = f64::from(tolerances.gcol);
        let mirrors = p.mirrors_environment && q.mirrors_environment;
        // All but the first, which is decided.
        let checks: [(Check, bool); Check::ALL.len() - 1] = [
            (Check::Pos, (b.position - a.position).length() < pos),
            (Check::Norm, p.normal.dot(q.normal) > f64::from(tolerances.norm)),
            (Check::Convex, !self.inflected(a, b)),
            (Check::Tex, !seam),
            (Check::Shadow, p.shadow == q.shadow),
            (Check::Gcol, p.gcol.distance(q.gcol) < gcol || mirrors && gcol > 0.0),
        ];
        let failed = checks.iter().filter(|(_, passed)| !passed).map(|(check, _)| check.bit()).sum();
        if failed == 0 && self.coverage_bends(p, q, gcol) {
            return Check::Gcol.bit();
        }
        failed
    }

    /// Whether coverage half way between is other than the mean of that at both, which weighted their radiance.
    fn coverage_bends(&self, a: &Attributes, b: &Attributes, tolerance: f64) -> bool {
        let [middle, a, b] = [self.interpolated(a, b), *a, *b].map(|a| self.covered(&a));
        self.reference.features.coverage && (2.0 * middle - a - b).abs() >= tolerance
    }

    /// Coverage of an attribute vector's surface.
    fn covered(&self, a: &Attributes) -> f64 {
        a.object.map_or(1.0, |object| {
            self.reference.coverage(object, a.texcoord, attributes::moments(a.footprint), a.alpha)
        })
    }

    /// Part of TX: whether tangents or second coordinates must not be interpolated.
    fn maps_apart(&self, object: u32, [p, q]: [&Maps; 2], tolerances: &Tolerances) -> bool {
        let oriented = self.reference.material_of(object).reads_tangents();
        let turned = p.sign != q.sign || p.tangent.dot(q.tangent) <= f64::from(tolerances.norm);
        oriented && turned || at_seam(p.second.fract_gl(), q.second.fract_gl(), f64::from(tolerances.tex))
    }

    /// G4: whether each point lies on the other side of the other's tangent plane, by more than rounding.
    fn inflected(&self, a: &Reached, b: &Reached) -> bool {
        let step = b.position - a.position;
        let from_a = step.dot(a.attributes.face);
        let from_b = -step.dot(b.attributes.face);
        let coordinates = (a.position.abs() + self.camera.origin.as_dvec3().abs()).element_sum();
        let rounding = 1.5 * f64::from(OCTAHEDRAL_ERROR) * step.length()
            + 5.0e-7 * (coordinates + a.attributes.depth + b.attributes.depth);
        from_a * from_b < 0.0 && from_a.abs().min(from_b.abs()) > rounding
    }

    /// The attribute vector half way between two references.
    #[must_use]
    pub fn interpolated(&self, a: &Attributes, b: &Attributes) -> Attributes {
        if a.object.is_none() {
            return *a;
        }
        let perspective = !self.camera.orthographic;
        // Inverse depth is linear in the image, as is any plane's attribute divided by depth.
        let weight = if perspective { a.depth.recip() / (a.depth.recip() + b.depth.recip()) } else { 0.5 };
        let depth =
            if perspective { 2.0 / (a.depth.recip() + b.depth.recip()) } else { 0.5 * (a.depth + b.depth) };
        let mix = |a: DVec3, b: DVec3| weight * a + (1.0 - weight) * b;
        Attributes {
            depth,
            object: a.object,
            normal: mix(a.normal, b.normal).normalize_or_zero(),
            face: mix(a.face, b.face).normalize_or_zero(),
            shadow: a.shadow,
            mirrors_environment: a.mirrors_environment && b.mirrors_environment,
            gcol: 0.5 * (a.gcol + b.gcol),
            texcoord: weight * a.texcoord + (1.0 - weight) * b.texcoord,
            color: mix(a.color, b.color),
            alpha: weight * a.alpha + (1.0 - weight) * b.alpha,
            footprint: 0.5 * (a.footprint + b.footprint),
            maps: Maps::interpolated(&a.maps, &b.maps, weight),
        }
    }

    /// Shades an attribute vector.
    #[must_use]
    pub fn shaded(&self, pixel: [u32; 2], a: &Attributes, rounding: &mut Rounding) -> DVec3 {
        let Some(object) = a.object else {
            return self.reference.environment_radiance(self.ray(pixel).0.direction);
        };
        let (ray, _) = self.ray(pixel);
        let footprint = attributes::moments(a.footprint);
        let material = self.reference.material(object, a.texcoord, footprint, a.color, &a.maps);
        let apart = self.reference.features.coat_normals;
        let material = material.oriented(apart, a.normal, a.face, -ray.direction, &a.maps);
        let normal = material.normal(a.normal, a.face, -ray.direction, &a.maps);
        let gcol = if a.mirrors_environment {
            self.covered(a) * self.reference.mirrored_environment(&material, normal, ray.direction)
        } else {
            a.gcol
        };
        let local = self.reference.local(Shading {
            material,
            position: self.position(pixel, a.depth),
            normal,
            view: -ray.direction,
            inside: false,
            shadow: a.shadow,
            rounding,
        });
        gcol + self.covered(a) * local
    }
}

/// TX: whether the coordinates lie at opposite borders of the texture.
fn at_seam(a: DVec2, b: DVec2, tolerance: f64) -> bool {
    let apart = |a: f64, b: f64| a.min(b) < tolerance && a.max(b) > 1.0 - tolerance;
    apart(a.x, b.x) || apart(a.y, b.y)
}
