//! What a frame cost: times, rays, samples, memory. Counts are of one frame and are counted where the work is done.

use serde::Serialize;

/// The time of one pass of one frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PassTime {
    /// The stage's name.
    pub name: &'static str,
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

/// Rays by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Rays {
    /// Through pixels.
    pub primary: u64,
    /// Towards lights.
    pub shadow: u64,
    /// Mirrored.
    pub reflection: u64,
    /// Transmitted.
    pub refraction: u64,
    /// Scattered, as paths go on from diffuse surfaces.
    pub diffuse: u64,
    /// All of them.
    pub total: u64,
}

/// Samples by how they came to be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Samples {
    /// Of the whole frame.
    pub total: u64,
    /// Always traced (Step-I).
    pub base: u64,
    /// Traced in the rows of the base pixels (Step-II-c).
    pub traced_a1: u64,
    /// Traced in the other rows (Step-III-c).
    pub traced_a2: u64,
    /// Traced by postcorrection (Step-IV).
    pub postcorrected: u64,
    /// Traced besides a pixel's own (Jin 2009, 4.1.4).
    pub extra: u64,
    /// Not traced.
    pub interpolated: u64,
}

/// Work of the traversal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Cost {
    /// Visited nodes of the acceleration structure.
    pub node_visits: u64,
    /// Tested triangles and spheres.
    pub primitive_tests: u64,
    /// The part of the full frame's work that lies in the samples which this method traced; needs a full frame.
    pub traced_share: Option<f64>,
}

/// Adaptive samples by check that they fail (one sample may fail several). Names as in Kim 2016, Table 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct FailedChecks {
    /// G1, object.
    pub oid: u64,
    /// G2, distance.
    pub pos: u64,
    /// G3, normal.
    pub norm: u64,
    /// G4, convexity.
    pub convex: u64,
    /// TX, texture seam.
    pub tex: u64,
    /// SH, shadow bits.
    pub shadow: u64,
    /// GC, reflected and refracted radiance.
    pub gcol: u64,
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

/// The counters of one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Counts {
    /// Rays by kind.
    pub rays: Rays,
    /// Samples by origin.
    pub samples: Samples,
    /// Traversal work.
    pub cost: Cost,
    /// Failed checks.
    pub failed_checks: FailedChecks,
}

impl Counts {
    /// Kim 2016's RT ratio: traced samples over all samples of the frame; with extra samples, it may exceed 1.
    #[must_use]
    pub fn rt_ratio(&self) -> f64 {
        let s = &self.samples;
        (s.base + s.traced_a1 + s.traced_a2 + s.postcorrected + s.extra) as f64 / (s.total.max(1)) as f64
    }
}

/// How a pixel came to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
#[non_exhaustive]
pub enum Origin {
    /// Step-I.
    Base = 0,
    /// Step-II-c.
    TracedA1 = 1,
    /// Step-III-c.
    TracedA2 = 2,
    /// Step-II-a or III-a.
    Interpolated = 3,
    /// Step-IV.
    Postcorrected = 4,
    /// Besides the pixel's own sample: no pixel is of this origin.
    Extra = 5,
}

/// The seven checks as bits of [`PixelRecord::failed`], in the order of [`FailedChecks`].
pub const CHECK_NAMES: [&str; 7] = ["oid", "pos", "norm", "convex", "tex", "shadow", "gcol"];

/// What the counting kernels say of one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelRecord {
    /// How it came to be.
    pub origin: Origin,
    /// Bit i is set where check i of [`CHECK_NAMES`] fails.
    pub failed: u32,
    /// Node visits and primitive tests spent on it.
    pub cost: u32,
    /// Bit i is set where quarter i gets extra samples, or is divided: 0 upper left, 1 upper right, 2 lower left, 3 lower right.
    pub active: u32,
    /// Bit i is set where attribute i of [`crate::THRESHOLD_NAMES`] differs from that of a neighbour; bit 0, where the
    /// contrast exceeds the threshold of the colour. Of a quincunx: which quarters of the pixel's quarters are divided. From
    /// bit 16 on, 1 + the round in which a pixel is refined ([`crate::Refine::On`]), of whose `active` a bit is set for each
    /// four samples, from the first bit on.
    pub differing: u32,
    /// Bit i is set where a refined pixel has the i-th of its sixteen samples.
    pub cells: u32,
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
        self.cells.count_ones()
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
