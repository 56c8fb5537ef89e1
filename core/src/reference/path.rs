//! One sample of a path tracer (Kajiya 1986): a path from the eye that continues by one lobe at each surface.
//! Emission is found by the path itself, by next-event estimation, or by both (multiple importance sampling,
//! Veach & Guibas 1995).
//!
//! Converges to the rendering equation with the materials of `scene/material.rs`, up to the depth limit, with one
//! exception: light that a bent shading normal would gather from below the face is lost.

use glam::{DVec2, DVec3};

use super::{
    Cause, GBufferPixel, Material, Ray, ReferenceFrame, Rng, Rounding, Surface,
    gbuffer::Search,
    lobes::{Chosen, Lobes},
    media::Media,
    stereo_reuse::{Mirror, Splat},
};
use crate::scene::DISPERSION_STEP;
use crate::{DirectLight, Foveation, LightSelection, MAX_RAYS, Roulette};

/// Bounce level from which on Russian roulette may end a path.
const ROULETTE_LEVEL: u32 = 3;

/// Random dimensions: pair 0 positions the sample in its pixel, then each vertex has [`DIMENSIONS`] pairs.
const PLACE_IN_PIXEL: u32 = 0;
const DIMENSIONS: u32 = 4;
/// Dimension of the choice of lobe, and of stopping away from the gaze.
const LOBE: u32 = 0;
/// Dimension of the direction of a diffuse or rough lobe.
const DIRECTION: u32 = 1;
/// Dimension of the choice of emitter, and of Russian roulette.
const EMITTER: u32 = 2;
/// Dimension of the point on the emitter.
const POINT: u32 = 3;
/// Dimension of the choice of a direction of the environment; the next one is that of the place in its texel.
const ENVIRONMENT: u32 = 512;
/// First dimension of the choices at partly covering surfaces, beyond those of all vertices.
const LAYERS: u32 = 0x4000_0000;
/// Dimension of the choice of the channel that a path refracts.
const DISPERSION: u32 = 0x2000_0000;
/// Distance between the dimensions of successive light samples.
const LIGHT_SAMPLE: u32 = 1024;

/// The result of one path.
#[derive(Clone, Copy, Debug)]
pub struct PathSample {
    /// Linear RGB radiance.
    pub radiance: DVec3,
    /// Whether gaze-based stopping ended the path.
    pub stopped: bool,
    /// Whether the path left every surface by the diffuse lobe.
    pub diffuse_only: bool,
    /// Weight of the sample in its own pixel.
    pub own: f64,
    /// The sample's contribution to a pixel of the other eye, if any.
    pub splat: Option<Splat>,
    /// Attributes of the first diffuse surface.
    pub gbuffer_pixel: GBufferPixel,
}

/// The state of a path between two bounces.
struct Path<'a> {
    frame: &'a ReferenceFrame<'a>,
    pixel: [u32; 2],
    rng: Rng,
    /// Probability of stopping at a vertex.
    stop: f64,
    ray: Ray,
    /// The primitive that the ray starts on; `None` at the eye.
    left: Option<usize>,
    /// The media at the ray's start.
    media: Media,
    /// Throughput: the weight of the radiance that arrives along the ray.
    throughput: DVec3,
    /// Bounce level: 1 for the primary ray.
    level: u32,
    /// Number of partly covering surfaces that the path has met, and whether it went straight on through one.
    layers: (u32, bool),
    /// Whether the path carries one channel alone.
    split: bool,
    /// Distance of the ray's origin from the last vertex; 0 unless the path went straight on.
    passed: f64,
    /// Density with which a lobe sampled the ray, per unit of solid angle.
    density: Option<f64>,
    /// The first hit if it is a planar mirror.
    mirror: Option<Mirror>,
    /// Weight of the sample in its own pixel, and its contribution to the other eye.
    stereo_splat: Option<(f64, Splat)>,
    search: Search,
    radiance: DVec3,
    stopped: bool,
    diffuse_only: bool,
}

impl ReferenceFrame<'_> {
    /// Traces the path of sample `sample` (counted from 0) of a pixel.
    #[must_use]
    pub fn path(&self, pixel: [u32; 2], sample: u32, rounding: &mut Rounding) -> PathSample {
        let rng = Rng::of(&self.settings, pixel, sample);
        let place = rng.pair(PLACE_IN_PIXEL);
        let (ray, length) = self.eye_ray(pixel, place);
        let mut path = Path {
            media: self.reference.media_at_start(&ray, rounding),
            frame: self,
            pixel,
            rng,
            stop: self.stop(pixel),
            ray,
            left: None,
            throughput: DVec3::ONE,
            level: 1,
            layers: (0, false),
            split: false,
            passed: 0.0,
            density: None,
            mirror: None,
            stereo_splat: None,
            search: Search::new(length),
            radiance: DVec3::ZERO,
            stopped: false,
            diffuse_only: true,
        };
        while path.step(rounding).is_some() {}
        let Path { radiance, stopped, diffuse_only, .. } = path;
        let (own, splat) = path.stereo_splat.map_or((1.0, None), |(own, splat)| (own, Some(splat)));
        let gbuffer_pixel = path.search.gbuffer_pixel(stopped && diffuse_only);
        PathSample { radiance, stopped, diffuse_only, gbuffer_pixel, own, splat }
    }

    /// Probability of stopping at each bounce in a pixel (Kim & Sung 2021, equation 7).
    fn stop(&self, pixel: [u32; 2]) -> f64 {
        let (_, pixel) = Self::eye(pixel, self.eye_size());
        let size = self.eye_size().map(f64::from);
        let gaze = [0, 1].map(|i| f64::from(self.settings.paths.gaze[i]) * size[i]);
        let away = |[x, y]: [f64; 2]| (x - gaze[0]).hypot(y - gaze[1]);
        let corners = [[0.0, 0.0], [size[0], 0.0], [0.0, size[1]], size];
        let farthest = corners.map(away).into_iter().fold(0.0, f64::max);
        f64::from(self.settings.paths.foveation_max) * away(pixel.map(|i| f64::from(i) + 0.5)) / farthest
    }
}

impl Path<'_> {
    /// Traces the ray to the next surface and scatters it there; `None` if the path ends.
    fn step(&mut self, rounding: &mut Rounding) -> Option<()> {
        let reference = self.frame.reference;
        let Some(boundary) = reference.boundary(&self.ray, self.left, &self.media, rounding) else {
            let weight = self.environment_weight();
            self.radiance += self.throughput * reference.environment_radiance(self.ray.direction) * weight;
            return None;
        };
        let (intersection, s) = (boundary.intersection, boundary.surface);
        self.throughput *= boundary.through.unwrap_or(DVec3::ONE);
        if self.goes_straight_on(&s, intersection.t, rounding) {
            self.media = boundary.beyond;
            return Some(());
        }
        let m = reference.material(s.object, s.texcoord, s.footprint, s.color, &s.maps);
        let m = reference.relative(m, &boundary);
        let (s, mut m) = reference.bumped(&s, m, self.ray.direction);
        let dispersion = self.dispersion(&s);
        m.ior = (m.ior + (f64::from(self.channel()) - 1.0) * dispersion * (m.ior - 1.0)).max(1.0);
        if boundary.through.is_none() {
            self.throughput *= reference.absorbed(&s, self.passed + intersection.t);
        }
        self.search.arrive(intersection.t, m.emission);
        if m.unlit {
            self.radiance += self.throughput * m.base;
            return None;
        }
        if m.emission != DVec3::ZERO {
            self.radiance += self.throughput * m.emission * self.weight(&s, self.passed + intersection.t);
        }
        if self.level == self.frame.settings.depth {
            return None;
        }
        let lobes = Lobes::of(reference, &s, &m, self.ray.direction, rounding);
        if self.frame.settings.reuses_stereo() && self.stereo_splat.is_none() && !self.layers.1 {
            let place = (self.pixel, self.level);
            let met = (&s, &m, &lobes);
            self.stereo_splat = self.frame.stereo_splat(place, &self.ray, met, &mut self.mirror, rounding);
        }
        let [lobe, foveation] = self.pair(LOBE);
        let chosen = lobes.choose(lobe, rounding);
        let diffuse = chosen == Some(Chosen::Diffuse);
        self.search.meet((&s, &lobes), diffuse, self.throughput, self.level);
        if lobes.albedo != DVec3::ZERO {
            let light = self.punctual(&s, &lobes, rounding)
                + self.emitters(&s, &lobes, rounding)
                + self.environment(&s, &lobes, rounding);
            self.radiance += self.throughput * light;
        }
        self.foveate(foveation, rounding)?;
        let chosen = chosen?;
        self.media = if matches!(chosen, Chosen::Refraction | Chosen::Behind) {
            boundary.beyond
        } else {
            boundary.here
        };
        self.leave((&s, &m), &lobes, chosen, rounding)
    }

    /// Difference of the indices of successive channels at a surface, as a share of the index less 1.
    fn dispersion(&self, s: &Surface) -> f64 {
        let m = self.frame.reference.material_of(s.object);
        if m.is_dispersive() { f64::from(DISPERSION_STEP) * f64::from(m.dispersion) } else { 0.0 }
    }

    /// The channel by whose index the path is refracted.
    fn channel(&self) -> u32 {
        let [number, _] = self.rng.pair(DISPERSION);
        ((3.0 * number) as u32).min(2)
    }

    /// Continues the path straight through a surface that covers in part what is behind it, by chance.
    fn goes_straight_on(&mut self, s: &Surface, distance: f64, rounding: &mut Rounding) -> bool {
        let covered = self.frame.reference.coverage(s.object, s.texcoord, s.footprint, s.alpha);
        let (met, _) = self.layers;
        if covered >= 1.0 || met >= MAX_RAYS {
            return false;
        }
        let [number, _] = self.rng.pair(LAYERS + met);
        self.layers.0 += 1;
        if rounding.number(Cause::Branch, number, 1.0) < covered {
            return false;
        }
        self.search.arrive(distance, DVec3::ZERO);
        self.layers.1 = true;
        self.passed += distance;
        self.ray = s.spawn(self.ray.direction, (s.width, s.growth), rounding);
        self.left = Some(s.primitive);
        true
    }

    /// Weight of emission that the path hits at this distance from its last vertex; next-event estimation
    /// contributes the rest.
    fn weight(&self, s: &Surface, distance: f64) -> f64 {
        let paths = &self.frame.settings.paths;
        match (self.density, paths.direct_light, paths.lights) {
            (None, ..) => 1.0,
            (_, _, LightSelection::Punctual) | (_, DirectLight::Nee, _) => 0.0,
            (_, DirectLight::Bsdf, _) => 1.0,
            (Some(density), DirectLight::Mis, _) => {
                let cosine = s.face.dot(self.ray.direction);
                let drawn = self.frame.reference.density(s.object, cosine, distance);
                density / (density + f64::from(paths.light_samples) * drawn)
            }
        }
    }

    /// Whether next-event estimation draws directions of an environment map.
    fn draws_environment(&self) -> bool {
        let paths = &self.frame.settings.paths;
        self.frame.reference.has_environment_map()
            && paths.direct_light != DirectLight::Bsdf
            && paths.lights != LightSelection::Punctual
    }

    /// Weight of the environment's radiance along a ray that leaves the scene; next-event estimation contributes the
    /// rest.
    fn environment_weight(&self) -> f64 {
        match (self.density, self.frame.settings.paths.direct_light) {
            (Some(_), DirectLight::Nee) if self.draws_environment() => 0.0,
            (Some(density), DirectLight::Mis) if self.draws_environment() => {
                density / (density + self.frame.reference.environment_density(self.ray.direction))
            }
            _ => 1.0,
        }
    }

    /// Estimate of the light of an environment map times the lobes, without the part that is left to paths that leave the scene.
    fn environment(&self, s: &Surface, lobes: &Lobes, rounding: &mut Rounding) -> DVec3 {
        if !self.draws_environment() {
            return DVec3::ZERO;
        }
        let number = DVec2::from(self.pair(ENVIRONMENT)).as_vec2();
        let Some(light) = self.frame.reference.environment_drawn(s, number, rounding) else {
            return DVec3::ZERO;
        };
        let (value, met) = self.response(s, lobes, light.direction);
        light.radiance * value / (light.density + met)
    }

    /// The lobes times the cosine, and the density with which the path finds light that is also drawn.
    fn response(&self, s: &Surface, lobes: &Lobes, direction: DVec3) -> (DVec3, f64) {
        let (value, density) = lobes.response(s, direction);
        let both = self.frame.settings.paths.direct_light == DirectLight::Mis;
        (value, if both { density } else { 0.0 })
    }

    /// Light of the punctual lights that are not shadowed, times the lobes.
    fn punctual(&self, s: &Surface, lobes: &Lobes, rounding: &mut Rounding) -> DVec3 {
        if self.frame.settings.paths.lights == LightSelection::Emitters {
            return DVec3::ZERO;
        }
        let reference = self.frame.reference;
        (0..reference.scene.lights.len())
            .map(|i| {
                let arrival = reference.arrival(i, s.position);
                let share = reference.light_share(s, i, rounding);
                let above = s.normal.dot(arrival.direction) > 0.0;
                let respond = if above { Lobes::response_above } else { Lobes::response };
                share * arrival.irradiance * respond(lobes, s, arrival.direction).0
            })
            .sum()
    }

    /// Estimate of the light from emitters times the lobes, without the part that is left to paths that hit them.
    fn emitters(&self, s: &Surface, lobes: &Lobes, rounding: &mut Rounding) -> DVec3 {
        let reference = self.frame.reference;
        let paths = &self.frame.settings.paths;
        let dark = reference.emitters.primitives.is_empty() || paths.lights == LightSelection::Punctual;
        if dark || paths.direct_light == DirectLight::Bsdf {
            return DVec3::ZERO;
        }
        let count = paths.light_samples;
        let mut sum = DVec3::ZERO;
        for i in 0..count {
            let [number, _] = self.pair(EMITTER + LIGHT_SAMPLE * i);
            let which = (i as f32 + number as f32) / count as f32;
            let Some(light) = reference.emitted(s, which, self.pair(POINT + LIGHT_SAMPLE * i), rounding)
            else {
                continue;
            };
            let drawn = light.density * f64::from(count);
            let (value, met) = self.response(s, lobes, light.direction);
            sum += light.radiance * value / (drawn + met);
        }
        sum
    }

    /// Stops the path, after the first bounces, by a number in [0, 1) and the pixel's distance from the gaze.
    fn foveate(&mut self, number: f64, rounding: &mut Rounding) -> Option<()> {
        let paths = &self.frame.settings.paths;
        if paths.foveation == Foveation::Off || self.level < paths.foveation_level() {
            return Some(());
        }
        if rounding.number(Cause::Branch, number, 1.0) < self.stop {
            self.stopped = true;
            return None;
        }
        if paths.foveation == Foveation::Compensated {
            self.throughput /= 1.0 - self.stop;
        }
        Some(())
    }

    /// Continues by the chosen lobe unless Russian roulette ends the path.
    fn leave(
        &mut self,
        (s, m): (&Surface, &Material),
        lobes: &Lobes,
        chosen: Chosen,
        rounding: &mut Rounding,
    ) -> Option<()> {
        let reflected = self.frame.reference.bent(s, 1.0, 2.0);
        let continued = lobes.leave(chosen, (s, m), self.pair(DIRECTION), reflected)?;
        self.throughput *= continued.weight;
        if chosen == Chosen::Refraction && !self.split && self.dispersion(s) > 0.0 {
            self.split = true;
            self.throughput *= 3.0 * DVec3::AXES[self.channel() as usize];
        }
        if self.frame.settings.paths.roulette == Roulette::On && self.level >= ROULETTE_LEVEL {
            let survivors = self.throughput.max_element().min(1.0);
            let [_, survival] = self.pair(EMITTER);
            if rounding.number(Cause::Branch, survival, 1.0).max(0.0) >= survivors {
                return None;
            }
            self.throughput /= survivors;
        }
        self.density = continued.density;
        self.diffuse_only &= chosen == Chosen::Diffuse;
        self.ray = s.spawn(continued.direction, continued.cone, rounding);
        self.left = Some(s.primitive);
        self.passed = 0.0;
        self.level += 1;
        Some(())
    }

    /// A pair of random numbers in [0, 1) of this vertex.
    fn pair(&self, dimension: u32) -> [f64; 2] {
        self.rng.pair(DIMENSIONS * self.level + dimension)
    }
}
