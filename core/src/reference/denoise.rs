//! Denoisers of path-traced images.

use glam::DVec3;

use super::{GBufferPixel, ReferenceFrame, gbuffer::Way};

/// A path-traced image with the G-buffer that guides its denoiser.
pub struct Denoiser<'a> {
    /// The settings and camera of the frame.
    pub frame: &'a ReferenceFrame<'a>,
    /// Number of samples of each pixel.
    pub samples: u32,
    /// Means of each pixel's samples, row by row.
    pub means: &'a [DVec3],
    /// First diffuse surface of each pixel, row by row.
    pub gbuffer: &'a [GBufferPixel],
}

/// Lower bound of an albedo channel when radiance is divided by albedo.
const LEAST_ALBEDO: f64 = 0.01;
/// Limit of a pixel's brightness after one sample, as a multiple of the mean of its four neighbours.
const BRIGHTER: f64 = 4.0;
/// Number of samples from which brightness is no longer clamped.
const SETTLED: f64 = 256.0;
/// Widths of the edge-stopping weights: for the difference of light over the sum, at the first level and after
/// one sample; for the distance from the plane in pixel widths; for mirrored surfaces, the relative difference of
/// distances; for unit normals; for albedos.
const LIGHT: f64 = 1.5;
const CHANNEL: f64 = 2.0;
const DEPTH: f64 = 0.125;
const NORMAL: f64 = 0.25;
const ALBEDO: f64 = 0.5;
/// Quantisation steps of the guides that are compared: a component of the normal, and the mean albedo.
const STEPS: f64 = 127.0;
/// Number of levels of the a-trous filter; the step doubles from one to the next.
const LEVELS: u32 = 4;

impl Denoiser<'_> {
    /// The displayed colour of a pixel with the median filter (Kim & Sung 2021, Algorithm 5).
    #[must_use]
    pub fn median(&self, pixel: [u32; 2]) -> DVec3 {
        let own = self.means[self.index(pixel)];
        if !self.gbuffer[self.index(pixel)].smoothed {
            return own;
        }
        let around: Vec<_> =
            offsets().map(|o| self.tap(pixel, o, 1).map_or(own, |i| self.means[i])).collect();
        let channel = |i: usize| {
            let mut values: Vec<_> = around.iter().map(|v| v[i]).collect();
            values.sort_by(f64::total_cmp);
            values[values.len() / 2]
        };
        DVec3::new(channel(0), channel(1), channel(2))
    }

    /// The image after the a-trous filter (Dammertz et al. 2010), row by row.
    #[must_use]
    pub fn atrous(&self) -> Vec<DVec3> {
        let mut lights: Vec<_> = self.pixels().map(|pixel| self.light(pixel)).collect();
        for level in 0..LEVELS {
            lights = self.pixels().map(|pixel| self.filtered(pixel, 1 << level, &lights)).collect();
        }
        let shown = |(i, light): (usize, &DVec3)| match self.gbuffer[i].way {
            Way::None => self.means[i],
            _ => *light * self.albedo(i),
        };
        lights.iter().enumerate().map(shown).collect()
    }

    fn pixels(&self) -> impl Iterator<Item = [u32; 2]> + use<> {
        let [width, height] = self.frame.size;
        (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]))
    }

    fn index(&self, [x, y]: [u32; 2]) -> usize {
        (y * self.frame.size[0] + x) as usize
    }

    /// Index of the pixel `step` times `offset` away; `None` if it is outside the same eye's image.
    fn tap(&self, pixel: [u32; 2], offset: [i32; 2], step: i32) -> Option<usize> {
        let at = [0, 1].map(|i| pixel[i].checked_add_signed(step * offset[i]));
        let inside = |i: usize| at[i].filter(|place| *place < self.frame.size[i]);
        let tap = [inside(0)?, inside(1)?];
        let eye = |pixel| ReferenceFrame::eye(pixel, self.frame.eye_size()).0;
        (eye(tap) == eye(pixel)).then(|| self.index(tap))
    }

    fn albedo(&self, i: usize) -> DVec3 {
        self.gbuffer[i].albedo.max(DVec3::splat(LEAST_ALBEDO))
    }

    /// Irradiance at the first diffuse surface over pi, with pixels clamped that are much brighter than their
    /// neighbours.
    fn light(&self, pixel: [u32; 2]) -> DVec3 {
        let own = self.index(pixel);
        let brightness = |i: usize| self.means[i].element_sum() / self.albedo(i).element_sum();
        let beside = offsets().filter(|o| o[0].abs() + o[1].abs() == 1);
        let taps = beside.filter_map(|o| self.tap(pixel, o, 1));
        let around: Vec<_> =
            taps.filter(|i| self.gbuffer[*i].way == self.gbuffer[own].way).map(brightness).collect();
        let light = self.means[own] / self.albedo(own);
        let bright = brightness(own);
        let most = BRIGHTER * around.iter().sum::<f64>() / around.len() as f64;
        // Without neighbours `most` is NaN, and nothing is clamped.
        if bright > most {
            let settled = (f64::from(self.samples - 1) / SETTLED).min(1.0);
            return light * (most + (bright - most) * settled * settled) / bright;
        }
        light
    }

    /// Filters one pixel at one level, with samples `step` pixels apart.
    fn filtered(&self, pixel: [u32; 2], step: i32, lights: &[DVec3]) -> DVec3 {
        let own = self.index(pixel);
        if self.gbuffer[own].way == Way::None {
            return DVec3::ZERO;
        }
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        // Axis-aligned taps at steps of 1 and 4, diagonal ones at steps of 2 and 8.
        let apart = if step.trailing_zeros().is_multiple_of(2) { 1 } else { 2 };
        for offset in offsets().filter(|o| [0, apart].contains(&(o[0].abs() + o[1].abs()))) {
            let Some(other) = self.tap(pixel, offset, step) else { continue };
            let weight = self.alike(own, other) * self.of_light(step, lights[own], lights[other]);
            sum += weight * lights[other];
            weights += weight;
        }
        sum / weights
    }

    /// Weight by the similarity of two pixels' surfaces.
    fn alike(&self, own: usize, other: usize) -> f64 {
        let [p, q] = [own, other].map(|i| &self.gbuffer[i]);
        if p.way != q.way {
            return 0.0;
        }
        let [normal, other_normal] =
            [p, q].map(|gbuffer_pixel| (gbuffer_pixel.normal * STEPS).round() / STEPS);
        let away = match p.way {
            Way::Mirrored => (q.depth - p.depth) / (DEPTH * p.depth),
            _ => {
                let [point, other] = [(own, p), (other, q)].map(|(i, g)| self.point(i, g.depth));
                normal.dot(other - point) / (CHANNEL * self.footprint(p.depth))
            }
        };
        let grey =
            |gbuffer_pixel: &GBufferPixel| (gbuffer_pixel.albedo.element_sum() / 3.0 * STEPS).round() / STEPS;
        let albedo = (grey(p) - grey(q)) / ALBEDO;
        let bent = (normal - other_normal) / NORMAL;
        (-(albedo * albedo + bent.length_squared() + away * away)).exp2()
    }

    /// Weight by the difference of two pixels' light, with a width that follows its expected noise.
    fn of_light(&self, step: i32, a: DVec3, b: DVec3) -> f64 {
        let [a, b] = [a, b].map(DVec3::element_sum);
        if a + b == 0.0 {
            return 1.0;
        }
        let width = LIGHT / f64::from(self.samples).sqrt() / f64::from(step);
        (-((a - b) / (a + b) / width).powi(2)).exp2()
    }

    fn point(&self, i: usize, depth: f64) -> DVec3 {
        let pixel = [i as u32 % self.frame.size[0], i as u32 / self.frame.size[0]];
        let (ray, length) = self.frame.eye_ray(pixel, [0.5; 2]);
        ray.origin + depth * length * ray.direction
    }

    /// Side of a pixel's footprint at this view depth, in world units.
    fn footprint(&self, depth: f64) -> f64 {
        let side = 2.0 * self.frame.camera.up.as_dvec3().length() / f64::from(self.frame.size[1]);
        if self.frame.camera.orthographic { side } else { side * depth }
    }
}

/// Offsets of the 3x3 pixels around a pixel.
fn offsets() -> impl Iterator<Item = [i32; 2]> {
    (-1..=1).flat_map(|y| (-1..=1).map(move |x| [x, y]))
}
