//! The denoiser's G-buffer: attributes of the first diffuse surface of each pixel's paths.

use glam::DVec3;

use super::{Surface, lobes::Lobes};
use crate::scene::octahedral_decode_exact;

/// How a pixel's paths reach their first diffuse surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Some path reached none, or met emission before it left the first: the pixel is not filtered.
    None,
    /// The surface is seen directly.
    DirectlySeen,
    /// The surface is seen in mirrors or through glass.
    Mirrored,
}

/// Attributes of a pixel's first diffuse surface.
#[derive(Clone, Copy, Debug)]
pub struct GBufferPixel {
    /// How the surface is seen.
    pub way: Way,
    /// Unit normal of the surface, from the first sample.
    pub normal: DVec3,
    /// Length of the path to the surface in units of the primary ray's unnormalised direction, from the first
    /// sample.
    pub depth: f64,
    /// Diffuse albedo times the transmittance of the mirrors and glass before it, as a mean over all samples.
    pub albedo: DVec3,
    /// Whether the last path was stopped and used only diffuse lobes.
    pub smoothed: bool,
}

/// Quantisation steps of an albedo channel (10 bits).
const ALBEDO_STEPS: f64 = 1023.0;

impl GBufferPixel {
    /// Decodes the words of [`crate::Renderer::gbuffer`], as the shaders store them.
    #[must_use]
    pub fn unpacked([normal, depth, albedo, smoothed]: [u32; 4]) -> Self {
        let channel = |shift: u32| f64::from(albedo >> shift & 1023) / ALBEDO_STEPS;
        Self {
            way: [Way::None, Way::DirectlySeen, Way::Mirrored][(albedo >> 30).min(2) as usize],
            normal: octahedral_decode_exact(normal),
            depth: f64::from(f32::from_bits(depth)),
            albedo: DVec3::new(channel(0), channel(10), channel(20)),
            smoothed: smoothed != 0,
        }
    }

    /// Adds a sample of the pixel to the `before` earlier ones.
    #[must_use]
    pub fn followed(self, sample: &Self, before: u32) -> Self {
        let way = if sample.way == Way::None { Way::None } else { self.way };
        let albedo = self.albedo.lerp(sample.albedo, 1.0 / (f64::from(before) + 1.0));
        Self { way, albedo, smoothed: sample.smoothed, ..self }
    }
}

/// A path that may not have reached its first diffuse surface yet.
pub(super) struct Search {
    gbuffer_pixel: GBufferPixel,
    /// Length of the primary ray's direction before normalisation.
    length: f64,
    shone: bool,
}

impl Search {
    /// Starts at the eye; `length` is the length of the primary ray's direction.
    pub fn new(length: f64) -> Self {
        let gbuffer_pixel = GBufferPixel {
            way: Way::None,
            normal: DVec3::ZERO,
            depth: 0.0,
            albedo: DVec3::ZERO,
            smoothed: false,
        };
        Self { gbuffer_pixel, length, shone: false }
    }

    /// Advances to a surface at this distance from the last one.
    pub fn arrive(&mut self, distance: f64, emission: DVec3) {
        if self.gbuffer_pixel.way == Way::None {
            self.gbuffer_pixel.depth += distance / self.length;
            self.shone |= emission != DVec3::ZERO;
        }
    }

    /// Records a surface as the first diffuse one: most paths leave it by the diffuse lobe, or this one does.
    pub fn meet(&mut self, (s, lobes): (&Surface, &Lobes), chosen: bool, throughput: DVec3, level: u32) {
        if self.gbuffer_pixel.way == Way::None && (lobes.is_diffuse() || chosen) {
            self.gbuffer_pixel.way = if level == 1 { Way::DirectlySeen } else { Way::Mirrored };
            self.gbuffer_pixel.normal = s.normal;
            self.gbuffer_pixel.albedo = (throughput * lobes.albedo).clamp(DVec3::ZERO, DVec3::ONE);
        }
    }

    /// The attributes of the first diffuse surface that the path met.
    pub fn gbuffer_pixel(&self, smoothed: bool) -> GBufferPixel {
        let way = if self.shone { Way::None } else { self.gbuffer_pixel.way };
        GBufferPixel { way, smoothed, ..self.gbuffer_pixel }
    }
}
