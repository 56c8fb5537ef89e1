//! What a frame cost: GPU time, memory, and the results of the counting kernels.

use serde::Serialize;

use crate::{Counts, Origin, passes::Tracing};

/// GPU time of one pass of one frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PassTime {
    /// Name of the pass's stage.
    pub name: &'static str,
    /// Whether and how the stage traces rays.
    pub tracing: Tracing,
    /// Milliseconds from the start of its first dispatch to the end of its last one.
    pub ms: f64,
}

/// GPU time of one frame, measured with timestamps.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FrameTime {
    /// From the start of the first pass to the end of the last, in milliseconds.
    pub ms: f64,
    /// The passes in order of execution.
    pub passes: Vec<PassTime>,
}

/// Memory on the device, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Memory {
    /// Geometry, materials and textures.
    pub scene: u64,
    /// The acceleration structure.
    pub bvh: u64,
    /// Buffers and images of a frame.
    pub targets: u64,
    /// The sum of these.
    pub total: u64,
}

/// The record that the counting kernels keep of one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelRecord {
    /// How the pixel's radiance was obtained.
    pub origin: Origin,
    /// A mask of the similarity checks that fail ([`crate::Check::bit`]).
    pub failed: u32,
    /// Node visits plus primitive tests of the pixel's rays.
    pub cost: u32,
    /// Bit i is set where subpixel i gets extra samples or is divided (0 upper left, 1 upper right, 2 lower left,
    /// 3 lower right). For refined pixels ([`crate::Refine::On`]) the number of bits is the number of samples
    /// divided by four.
    pub active: u32,
    /// Bit i is set where attribute i of [`crate::THRESHOLD_NAMES`] differs from a neighbour's; bit 0, where the
    /// contrast exceeds the colour threshold. With method quincunx, a mask of the subpixels whose quarters are
    /// divided. Bits from 16 on hold 1 + the round in which the pixel is refined ([`crate::Refine::On`]), 0 if it
    /// is not.
    pub differing: u32,
    /// Bit i is set where a refined pixel has a sample in the i-th of its sixteen cells.
    pub strata: u32,
    /// OID of the object that the primary ray hits; `None` if it hits none.
    pub object: Option<u32>,
    /// View depth of the first hit in units of the camera's forward vector; infinite if nothing is hit.
    pub depth: f32,
    /// Unit shading normal of the first hit in world space, on the viewer's side; zero if nothing is hit.
    pub normal: [f32; 3],
}

impl PixelRecord {
    /// The round in which the pixel is refined, counted from 0 ([`crate::Refine::On`]); `None` if it is not.
    #[must_use]
    pub fn round(&self) -> Option<u32> {
        (self.differing >> 16).checked_sub(1)
    }

    /// Number of samples of a refined pixel in addition to its own.
    #[must_use]
    pub fn refined(&self) -> u32 {
        self.strata.count_ones()
    }
}

/// The results of the counting kernels, which render the same frame as the others.
#[derive(Clone, Debug)]
pub struct Inspection {
    /// The frame's counters.
    pub counts: Counts,
    /// One record per pixel, row by row from the top left. Empty if pixels have several samples, or if the device
    /// cannot hold the records in one binding.
    pub pixels: Vec<PixelRecord>,
    /// Samples that postcorrection claimed but did not trace before its rounds ended; they stay interpolated.
    pub uncorrected: u64,
}
