//! Traces a sample: a primary ray and the rays that follow from it (Whitted 1980), as a plain recursion.

use glam::{DVec2, DVec3};

use super::{
    Attributes, Cause, Intersection, Ray, Reference, Rounding, attributes,
    material::Shading,
    scatter::{PathState, Scattered},
    texture::Encoding,
};
use crate::Settings;

/// Limits of the recursion. The reference has no limit on the number of rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Number of ray levels; 1 is primary rays alone.
    pub depth: u32,
    /// Rays with a smaller weight in the sample are not traced.
    pub min_weight: f64,
}

impl Limits {
    /// The limits in the settings of a frame.
    #[must_use]
    pub fn of(settings: &Settings) -> Self {
        Self { depth: settings.depth, min_weight: f64::from(settings.min_weight) }
    }
}

/// Radiance and attributes of one primary ray.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Unquantised attributes of the first hit; [`Attributes::miss`] if there is none.
    pub attributes: Attributes,
    /// Attributes of the hit one bounce further, along the ray with the largest weight of those that hit
    /// anything.
    pub secondary: Option<Attributes>,
    /// Linear radiance times the ray's weight.
    pub color: DVec3,
}

impl Sample {
    /// The attributes of the first hit, if there is one.
    pub(super) fn hit(&self) -> Option<Attributes> {
        self.attributes.object.map(|_| self.attributes)
    }
}

impl Reference {
    /// The first hit that stops the ray: not holes cut by alpha, for `shadow` rays not transmissive surfaces, and
    /// for others not the backs of single-sided ones.
    #[must_use]
    pub fn first(
        &self,
        ray: &Ray,
        left: Option<usize>,
        shadow: bool,
        rounding: &mut Rounding,
    ) -> Option<Intersection> {
        self.first_of(ray, left, shadow, rounding, |_, _| true)
    }

    /// Like [`Reference::first`]; of the hits that would stop the ray, those count that `counts` accepts.
    pub(super) fn first_of(
        &self,
        ray: &Ray,
        left: Option<usize>,
        shadow: bool,
        rounding: &mut Rounding,
        counts: impl Fn(&Intersection, &mut Rounding) -> bool,
    ) -> Option<Intersection> {
        let ray = self.displaced(ray, shadow, rounding);
        let rounding = std::cell::RefCell::new(rounding);
        self.tracer.first(&ray, left, |c| {
            self.stops(c, &ray, shadow, &mut rounding.borrow_mut()) && counts(c, &mut rounding.borrow_mut())
        })
    }

    /// A ray whose origin and direction are displaced by rounding errors.
    pub(super) fn displaced(&self, ray: &Ray, shadow: bool, rounding: &mut Rounding) -> Ray {
        // Numbers in the intersection are as large as the scene's extent seen from the origin.
        let span = (self.bounds.0 - ray.origin).abs().max((self.bounds.1 - ray.origin).abs()).max_element();
        let cause = if shadow { Cause::ShadowEdge } else { Cause::Silhouette };
        Ray {
            origin: rounding.vector(cause, ray.origin, span),
            direction: rounding.direction(cause, ray.direction),
            ..*ray
        }
    }

    /// Whether a hit stops the ray.
    pub(super) fn stops(&self, c: &Intersection, ray: &Ray, shadow: bool, rounding: &mut Rounding) -> bool {
        (shadow || !self.passes_back(c, ray.direction)) && self.hit_counts(c, shadow, rounding)
    }

    /// Whether a ray in this direction arrives at the back of a single-sided triangle.
    fn passes_back(&self, intersection: &Intersection, direction: DVec3) -> bool {
        let Some(corners) = self.scene.positions.get(intersection.primitive) else { return false };
        let [a, b, c] = corners.map(|p| p.as_dvec3());
        self.material_of(intersection.object).is_single_sided() && (b - a).cross(c - a).dot(direction) > 0.0
    }

    fn hit_counts(&self, intersection: &Intersection, shadow: bool, rounding: &mut Rounding) -> bool {
        let m = self.material_of(intersection.object);
        if shadow && !m.casts_shadow {
            return false;
        }
        m.alpha_cutoff.is_none_or(|cutoff| self.alpha(intersection, rounding) >= f64::from(cutoff))
    }

    /// Alpha at a point of a surface, not averaged.
    pub(super) fn alpha(&self, intersection: &Intersection, rounding: &mut Rounding) -> f64 {
        let m = self.material_of(intersection.object);
        let texcoord = self.texcoord(intersection, rounding);
        let texture = self.texture(m.base_color_texture, Encoding::Srgb, texcoord, DVec3::ZERO).w;
        let alpha = f64::from(m.alpha) * self.vertex_color(intersection).w * texture;
        rounding.number(Cause::TexelEdge, alpha, 1.0)
    }

    /// Share of what is seen that is the surface; the rest is what is behind it.
    pub(super) fn coverage(&self, object: u32, texcoord: DVec2, footprint: DVec3, vertices: f64) -> f64 {
        let m = self.material_of(object);
        if !m.blends {
            return 1.0;
        }
        let texture = self.texture(m.base_color_texture, Encoding::Srgb, texcoord, footprint).w;
        (f64::from(m.alpha) * vertices * texture).clamp(0.0, 1.0)
    }

    /// Traces and shades one primary ray by Whitted's model.
    #[must_use]
    pub fn sample(&self, ray: &Ray, limits: &Limits, rounding: &mut Rounding) -> Sample {
        let media = self.media_at_start(ray, rounding);
        self.follow(
            &PathState { ray: *ray, left: None, weight: DVec3::ONE, level: 1, roughness: 0.0, media },
            limits,
            rounding,
        )
    }

    pub(super) fn follow(&self, state: &PathState, limits: &Limits, rounding: &mut Rounding) -> Sample {
        let ray = &state.ray;
        let Some(boundary) = self.boundary(ray, state.left, &state.media, rounding) else {
            let color = state.weight * self.environment_lobe(ray.direction, state.roughness);
            return Sample { attributes: Attributes::miss(), secondary: None, color };
        };
        let (intersection, smooth) = (&boundary.intersection, boundary.surface);
        let m = self.material(smooth.object, smooth.texcoord, smooth.footprint, smooth.color, &smooth.maps);
        let m = self.relative(m, &boundary);
        let shadow = self.shadow_bits(&smooth, rounding);
        let (s, m) = self.bumped(&smooth, m, ray.direction);
        let local = self.local(Shading {
            material: m,
            position: s.position,
            normal: s.normal,
            view: -ray.direction,
            inside: s.inside,
            shadow,
            rounding,
        });
        let distance = intersection.t * ray.direction.length();
        let through = boundary.through.unwrap_or_else(|| self.absorbed(&s, distance));
        let state = &PathState { weight: state.weight * through, media: boundary.here.clone(), ..*state };
        let covered = self.coverage(s.object, s.texcoord, s.footprint, s.alpha);
        let weight = covered * state.weight;
        let dimmed = self.dimmed(&s, m, -ray.direction, rounding);
        let (beyond, behind) = self.straight(&s, state, &boundary.beyond, covered, limits, rounding);
        let from = PathState { weight, media: state.media.clone(), ..*state };
        let Scattered { radiance: scattered, hit: secondary, mirrored } =
            self.scattered(&s, &m, &from, &boundary.beyond, limits, rounding);
        // Of equal weights the scattered ray counts.
        let behind = behind.filter(|(w, _)| secondary.is_none_or(|(other, _)| *w > other));
        let secondary = behind.or(secondary).map(|(_, attributes)| attributes);
        let gcol = weight * dimmed + beyond + scattered;
        let whole = state.level == 1 && !s.inside && weight == DVec3::ONE && self.has_environment_map();
        let attributes = Attributes {
            mirrors_environment: whole && mirrored == Some(gcol),
            depth: intersection.t,
            object: Some(s.object),
            normal: smooth.normal,
            face: s.face,
            shadow,
            gcol,
            texcoord: self.folded(s.object, s.texcoord),
            color: s.color,
            alpha: s.alpha,
            footprint: attributes::footprint(self.folded_footprint(s.object, s.texcoord, s.footprint)),
            maps: s.maps,
        };
        Sample { attributes, secondary, color: weight * local + gcol }
    }
}
