//! What a frame cost: times, rays, samples, memory. Counts are of one frame and are counted where the work is done.

use serde::Serialize;

use crate::{Counts, Origin, passes::Tracing};

/// The time of one pass of one frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PassTime {
    /// The stage's name.
    pub name: &'static str,
    /// Whether it traces rays.
    pub tracing: Tracing,
    /// Milliseconds between its first and its last command.
    pub ms: f64,
}

/// GPU time of one frame, from timestamps.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FrameTime {
    /// From the start of the first pass to the end of the last, in milliseconds.
    pub ms: f64,
    /// Each pass in order.
    pub passes: Vec<PassTime>,
}

/// Bytes on the device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Memory {
    /// Geometry, materials, textures.
    pub scene: u64,
    /// Acceleration structure.
    pub bvh: u64,
    /// Per-pixel buffers and images.
    pub targets: u64,
    /// All of them.
    pub total: u64,
}

/// What the counting kernels say of one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelRecord {
    /// How it came to be.
    pub origin: Origin,
    /// The bits ([`crate::Check::bit`]) of the similarity checks that fail.
    pub failed: u32,
    /// Node visits and primitive tests spent on it.
    pub cost: u32,
    /// Bit i is set where quarter i gets extra samples, or is divided: 0 upper left, 1 upper right, 2 lower left, 3 lower right.
    pub active: u32,
    /// Bit i is set where attribute i of [`crate::THRESHOLD_NAMES`] differs from that of a neighbour; bit 0, where the
    /// contrast exceeds the threshold of the colour. Of a quincunx: which subpixels's quarters are divided. From
    /// bit 16 on, 1 + the round in which a pixel is refined ([`crate::Refine::On`]), of whose `active` a bit is set for each
    /// four samples, from the first bit on.
    pub differing: u32,
    /// Bit i is set where a refined pixel has the i-th of its sixteen samples.
    pub strata: u32,
    /// OID of the first hit; `None` where nothing is hit.
    pub object: Option<u32>,
    /// View depth of the first hit (in units of the camera's forward vector), infinite where nothing is hit.
    pub depth: f32,
    /// Unit shading normal of the first hit that faces the viewer, zero where nothing is hit.
    pub normal: [f32; 3],
}

impl PixelRecord {
    /// The round in which the pixel is refined, 0 the first ([`crate::Refine::On`]).
    #[must_use]
    pub fn round(&self) -> Option<u32> {
        (self.differing >> 16).checked_sub(1)
    }

    /// Samples besides its own, of a refined pixel.
    #[must_use]
    pub fn refined(&self) -> u32 {
        self.strata.count_ones()
    }
}

/// A frame rendered by counting kernels: the same picture, with everything known about it.
#[derive(Clone, Debug)]
pub struct Inspection {
    /// The frame's counters.
    pub counts: Counts,
    /// Row by row from the top left, `width * height`; empty where pixels have several samples, or where the device cannot
    /// hold them all in one binding.
    pub pixels: Vec<PixelRecord>,
    /// Samples that postcorrection found and did not come to: they are interpolated.
    pub uncorrected: u64,
}
