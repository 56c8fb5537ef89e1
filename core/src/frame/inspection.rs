//! Decodes the buffer that the counting kernels write.

use glam::Vec3;

use crate::{
    Counts, Inspection, Origin, PixelRecord, frame::counters::COUNTER_WORDS, frame::recorder,
    scene::octahedral_decode,
};

/// Decodes the counters and the first `recorded` pixel records of a frame with `grid` samples across and down.
pub fn decode(bytes: &[u8], grid: [u32; 2], recorded: u64) -> Inspection {
    let (counters, records) = bytes.split_at(4 * COUNTER_WORDS);
    let words: Vec<u32> = bytemuck::pod_collect_to_vec(counters);
    let (counts, uncorrected) = Counts::decode(&words, u64::from(grid[0]) * u64::from(grid[1]));
    let records = records.chunks_exact(size_of::<recorder::PixelRecord>()).map(bytemuck::pod_read_unaligned);
    Inspection {
        counts,
        uncorrected,
        pixels: records.take(recorded as usize).map(|record| pixel_record(&record)).collect(),
    }
}

fn pixel_record(record: &recorder::PixelRecord) -> PixelRecord {
    let hit = record.object != 0;
    PixelRecord {
        origin: Origin::ALL.get(record.origin as usize).copied().unwrap_or(Origin::Interpolated),
        failed: record.failed,
        cost: record.cost,
        active: record.edges & 15,
        differing: record.edges >> 4,
        strata: record.strata,
        object: hit.then(|| record.object - 1),
        depth: if hit { record.depth } else { f32::INFINITY },
        normal: if hit { octahedral_decode(record.normal).into() } else { Vec3::ZERO.into() },
    }
}
