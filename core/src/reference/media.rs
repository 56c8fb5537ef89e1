//! Media along rays where solids touch, overlap or contain one another (Schmidt & Budge 2002, "Simple Nested Dielectrics
//! in Ray Traced Images").

use std::cmp::Ordering;

use glam::DVec3;

use super::{Intersection, Material, Ray, Reference, Rounding, Surface};

/// The solids that a point lies in, by increasing precedence.
#[derive(Clone, Debug, Default)]
pub(super) struct Media(Vec<u32>);

/// The first surface along a ray that is seen.
pub(super) struct Boundary {
    pub intersection: Intersection,
    pub surface: Surface,
    /// The media before the surface, and behind it.
    pub here: Media,
    pub beyond: Media,
    /// Transmittance of the media along the ray; `None` in scenes whose solids do not touch.
    pub through: Option<DVec3>,
}

/// The media before and behind surfaces that a ray crosses.
struct Crossing<'a> {
    reference: &'a Reference,
    here: Media,
    beyond: Media,
}

impl Crossing<'_> {
    /// A solid that is left without having been entered surrounded the ray all along.
    fn cross(&mut self, s: &Surface) {
        if !s.inside {
            self.beyond.add(self.reference, s.object, Some(&self.here));
        } else if let Some(place) = self.beyond.0.iter().rposition(|object| *object == s.object) {
            self.beyond.0.remove(place);
        } else {
            self.here.add(self.reference, s.object, None);
        }
    }
}

impl Media {
    fn top(&self) -> Option<u32> {
        self.0.last().copied()
    }

    /// Adds a solid by its priority: one that the ray enters from the media `here` above others of the same, except
    /// those of greater index that it enters at the same boundary; one that was around it from the start below them.
    fn add(&mut self, reference: &Reference, object: u32, here: Option<&Self>) {
        let priority = |object: u32| reference.material_of(object).priority;
        let precedes = |other: u32| match (priority(other).cmp(&priority(object)), here) {
            (Ordering::Equal, Some(here)) => other > object && !here.0.contains(&other),
            (order, _) => order.is_ge(),
        };
        let above = self.0.iter().rev().take_while(|other| precedes(**other)).count();
        self.0.insert(self.0.len() - above, object);
    }
}

impl Reference {
    fn index_of(&self, medium: Option<u32>) -> f64 {
        medium.map_or(1.0, |object| f64::from(self.material_of(object).ior))
    }

    fn is_solid(&self, c: &Intersection) -> bool {
        self.material_of(c.object).is_solid()
    }

    /// The media at the start of a primary ray: the solids that it leaves without having entered them.
    pub(super) fn media_at_start(&self, ray: &Ray, rounding: &mut Rounding) -> Media {
        let mut crossing = Crossing { reference: self, here: Media::default(), beyond: Media::default() };
        if self.features.nested_media {
            let mut crossed = Vec::new();
            while let Some(c) = self.next_along(ray, None, &crossed, rounding) {
                if self.is_solid(&c) {
                    crossing.cross(&self.surface(ray, &c, rounding));
                }
                crossed.push(c);
            }
        }
        crossing.here
    }

    fn next_along(
        &self,
        ray: &Ray,
        left: Option<usize>,
        crossed: &[Intersection],
        rounding: &mut Rounding,
    ) -> Option<Intersection> {
        let rounding = std::cell::RefCell::new(rounding);
        self.tracer.next(ray, left, crossed, |c| self.stops(c, ray, false, &mut rounding.borrow_mut()))
    }

    /// The first surface along a ray that is seen: boundaries that change nothing are crossed. Surfaces of solids that
    /// the ray crosses within the offset of their faces touch, and are one boundary.
    pub(super) fn boundary(
        &self,
        ray: &Ray,
        left: Option<usize>,
        media: &Media,
        rounding: &mut Rounding,
    ) -> Option<Boundary> {
        if !self.features.nested_media {
            let intersection = self.first(ray, left, false, rounding)?;
            let surface = self.surface(ray, &intersection, rounding);
            let [here, beyond] = [Media::default(), Media::default()];
            return Some(Boundary { intersection, surface, here, beyond, through: None });
        }
        let along = self.displaced(ray, false, rounding);
        let (mut crossed, mut here, mut through, mut start) = (Vec::new(), media.clone(), DVec3::ONE, 0.0);
        loop {
            let first = self.next_along(&along, left, &crossed, rounding)?;
            if let Some(object) = here.top() {
                let absorption = self.material_of(object).absorption.as_dvec3();
                through *= (-(first.t - start) * ray.direction.length() * absorption).exp();
            }
            if !self.is_solid(&first) {
                let surface = self.surface(ray, &first, rounding);
                let beyond = here.clone();
                return Some(Boundary { intersection: first, surface, here, beyond, through: Some(through) });
            }
            let mut crossing = Crossing { reference: self, beyond: here.clone(), here };
            let (shown, contact) = self.touching(&along, left, first, &mut crossed, &mut crossing, rounding);
            let Crossing { here: before, beyond, .. } = crossing;
            if let Some(intersection) = shown {
                let surface = Surface { contact, ..self.surface(ray, &intersection, rounding) };
                return Some(Boundary {
                    intersection,
                    surface,
                    here: before,
                    beyond,
                    through: Some(through),
                });
            }
            start = crossed.last().map_or(start, |last: &Intersection| last.t);
            here = beyond;
        }
    }

    /// Crosses a solid's surface and all that touch it. Returns the surface that is seen, if any, and the distance from
    /// the face beyond which spawned rays start.
    fn touching(
        &self,
        ray: &Ray,
        left: Option<usize>,
        first: Intersection,
        crossed: &mut Vec<Intersection>,
        crossing: &mut Crossing<'_>,
        rounding: &mut Rounding,
    ) -> (Option<Intersection>, f64) {
        let of_first = self.surface(ray, &first, rounding);
        let slant = of_first.face.dot(ray.direction).abs().max(1.0e-3);
        let (mut entered, mut exited, mut contact) = (first, first, 0.0);
        let (mut next, mut surface) = (first, of_first);
        loop {
            crossing.cross(&surface);
            crossed.push(next);
            if !surface.inside && crossing.beyond.top() == Some(next.object) {
                entered = next;
            }
            if surface.inside && crossing.here.top() == Some(next.object) {
                exited = next;
            }
            let Some(another) = self.next_along(ray, left, crossed, rounding) else { break };
            surface = self.surface(ray, &another, rounding);
            let offset = surface.offset.max(of_first.offset);
            if (another.t - next.t) * slant > offset {
                break;
            }
            contact = offset.max(contact);
            if !self.is_solid(&another) {
                return (Some(another), 2.0 * contact);
            }
            next = another;
        }
        let (before, behind) = (crossing.here.top(), crossing.beyond.top());
        let shown = if behind == Some(entered.object) { entered } else { exited };
        let alike = self.index_of(before) == self.index_of(behind);
        let unseen = before == behind || alike && self.material_of(shown.object).is_clear();
        ((!unseen).then_some(shown), 2.0 * contact)
    }

    /// The material of a boundary, with its index of refraction relative to the medium on the other side.
    pub(super) fn relative(&self, mut m: Material, boundary: &Boundary) -> Material {
        let s = &boundary.surface;
        let of_object = self.material_of(s.object);
        let before = self.index_of(boundary.here.top());
        if !self.features.nested_media || m.thin {
            return m;
        }
        if !of_object.is_solid() {
            if of_object.weights.is_none() {
                m.ior /= before;
            }
            return m;
        }
        let behind = self.index_of(boundary.beyond.top());
        m.ior = if s.inside { before / behind } else { behind / before };
        m
    }
}
