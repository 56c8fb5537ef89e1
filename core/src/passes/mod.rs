//! The stages of a frame and what each is made of.
//!
//! | stage | source | WGSL |
//! | --- | --- | --- |
//! | full | lecture, "trace() in detail" | `passes/full.wgsl` |
//! | base | Kim 2016, 3.2; Table 2, Step-I | `passes/base.wgsl` |
//! | similarity_a1 | Kim 2016, 3.3, 3.4, Table 1; Step-II-a | `passes/similarity_a1.wgsl` |
//! | compact_a1 | Kim 2016, 5; Step-II-b | `passes/compact.wgsl` |
//! | trace_a1 | Kim 2016, Step-II-c | `passes/trace.wgsl` |
//! | similarity_a2 | Kim 2016, Step-III-a | `passes/similarity_a2.wgsl` |
//! | compact_a2 | Kim 2016, Step-III-b | `passes/compact.wgsl` |
//! | trace_a2 | Kim 2016, Step-III-c | `passes/trace.wgsl` |
//! | compact_seed | Kim 2016, 4; Step-IV | `passes/compact.wgsl` |
//! | postcorrect_seed | Kim 2016, 4; Step-IV | `passes/postcorrect_seed.wgsl` |
//! | postcorrect_landmarks | ours | `passes/postcorrect_landmarks.wgsl` |
//! | compact_postcorrect | Kim 2016, 4; Step-IV | `passes/compact.wgsl` |
//! | postcorrect | Kim 2016, 4; Step-IV | `passes/postcorrect.wgsl` |
//! | postcorrect_scan | Kim 2016, 5; Step-IV | `passes/postcorrect_scan.wgsl` |
//! | resolve | Kim 2016, 6.1 ("Sampling") | `passes/resolve.wgsl` |
//! | presample | Jin 2009, 4.3.1 | `passes/presample.wgsl` |
//! | subpixel_test | Jin 2009, 4.3.2 | `passes/subpixel_test.wgsl` |
//! | compact_active | Jin 2009, 4.3.2 | `passes/compact.wgsl` |
//! | extra_samples | Jin 2009, 4.3.3 | `passes/extra_samples.wgsl` |
//! | refine_test | ours, after Jin 2009, 4.3.2 | `passes/refine_test.wgsl` |
//! | compact_refine | ours | `passes/compact.wgsl` |
//! | refine | ours, after Jin 2009, 4.3.3, and Kim 2016, 4 | `passes/refine.wgsl` |
//! | compact_cell_test | ours | `passes/compact.wgsl` |
//! | cell_test | ours, after Jin 2009, 4.2.2 | `passes/cell_test.wgsl` |
//! | compact_cells | ours | `passes/compact.wgsl` |
//! | cells | ours | `passes/cells.wgsl` |
//! | quincunx_base | lecture, "Adaptive supersampling (1)" | `passes/quincunx_base.wgsl` |
//! | quincunx_split_a, quincunx_split_b | the same, (2) | `passes/quincunx_split_a.wgsl`, `passes/quincunx_split_b.wgsl` |
//! | compact_quincunx_a, compact_quincunx_b | ours | `passes/compact.wgsl` |
//! | quincunx_trace_a, quincunx_trace_b | the same, (2) | `passes/quincunx_trace.wgsl` |
//! | quincunx_resolve | the same, (3) | `passes/quincunx_resolve.wgsl` |
//! | checkerboard | a baseline | `passes/checkerboard.wgsl` |
//! | fill | a baseline | `passes/fill.wgsl` |
//! | frameless | lecture, "Low level optimizations" | `passes/frameless.wgsl` |
//! | reproject_depth | lecture, "Reprojection" | `passes/reproject_depth.wgsl` |
//! | reproject_source | lecture, "Reprojection" | `passes/reproject_source.wgsl` |
//! | reuse | lecture, "Reprojection" | `passes/reuse.wgsl` |
//! | compact_renew | Kim 2016, 5 | `passes/compact.wgsl` |
//! | renew | lecture, "Reprojection" | `passes/renew.wgsl` |
//! | path | Kajiya 1986; Kim & Sung 2021, equation 7 | `passes/path.wgsl` |
//! | look, cross | Kim & Sung 2021, equations 1 to 6, Algorithm 1 | `passes/look.wgsl`, `passes/cross.wgsl` |
//! | median | Kim & Sung 2021, "Noise Removal for the Stopped Ray" | `passes/median.wgsl` |
//! | atrous_begin | ours | `passes/atrous_begin.wgsl` |
//! | atrous, atrous_end | Dammertz et al. 2010, section 2.2 | `passes/atrous.wgsl` |
//! | merge_planes | Kim & Sung 2021, Algorithm 5 | `passes/merge_planes.wgsl` |

mod constants;
mod demand;
mod linked;
mod operations;
mod path_sources;
mod sources;
#[cfg(test)]
mod tests;
mod variant;

pub use constants::{
    CELL_CONTRAST, COUNTER_CLAIMED, COUNTER_FAILED, COUNTER_NODE_VISITS, COUNTER_ORIGINS,
    COUNTER_PRIMITIVE_TESTS, COUNTER_RAYS, COUNTER_WORDS, RAY_KINDS, REFINE_MOST, REFINE_STEP, REFINE_WORDS,
    TRACE_GROUP, TRACE_ROW,
};
pub use demand::{Demand, Demands};
pub use linked::Linked;
#[cfg(test)]
pub(crate) use operations::count as count_operations;
pub use variant::{Output, Variant};

use crate::gpu::shader::Source;

/// A file of this crate.
macro_rules! wgsl {
    ($path:literal) => {
        $crate::gpu::shader::Source {
            file: $path,
            text: include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/", $path)).into(),
        }
    };
}
pub(crate) use wgsl;

/// A kernel of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Every pixel.
    Full,
    /// Step-I.
    Base,
    /// Step-II-a.
    SimilarityA1,
    /// Step-II-b.
    CompactA1,
    /// Step-II-c.
    TraceA1,
    /// Step-III-a.
    SimilarityA2,
    /// Step-III-b.
    CompactA2,
    /// Step-III-c.
    TraceA2,
    /// Step-IV: all that was listed so far.
    CompactSeed,
    /// Step-IV: neighbours of what was listed.
    PostcorrectSeed,
    /// Step-IV: what has no traced neighbour.
    PostcorrectLandmarks,
    /// Step-IV: the next round.
    CompactPostcorrect,
    /// Step-IV: neighbours of neighbours.
    Postcorrect,
    /// Step-IV as the paper has it, in one direction.
    PostcorrectScan,
    /// Pixels from their samples.
    Resolve,
    /// Every second pixel.
    Checkerboard,
    /// The other pixels.
    Fill,
    /// Every pixel's centre.
    Presample,
    /// Which quarters of pixels get extra samples.
    SubpixelTest,
    /// Those.
    CompactActive,
    /// Their samples.
    ExtraSamples,
    /// Which pixels are refined.
    RefineTest,
    /// Those of the next round.
    CompactRefine,
    /// The first four samples of each.
    Refine,
    /// All that are refined.
    CompactCellTest,
    /// Which of their cells get samples.
    CellTest,
    /// Those of the next step.
    CompactCells,
    /// Their samples.
    Cells,
    /// Centres and corners of all pixels.
    QuincunxBase,
    /// Which quarters of pixels are divided.
    QuincunxSplitA,
    /// What they need.
    CompactQuincunxA,
    /// Its samples.
    QuincunxTraceA,
    /// Which quarters of those are divided.
    QuincunxSplitB,
    /// What they need.
    CompactQuincunxB,
    /// Its samples.
    QuincunxTraceB,
    /// Pixels from all that.
    QuincunxResolve,
    /// The pixels whose turn it is.
    Frameless,
    /// What was seen, where it is seen now: the nearest.
    ReprojectDepth,
    /// What was seen, where it is seen now: which it was.
    ReprojectSource,
    /// The pixels that show it again; the others are listed.
    Reuse,
    /// The list's dispatches.
    CompactRenew,
    /// The listed pixels.
    Renew,
    /// Every pixel, by a path.
    Path,
    /// What paths have met, from the other eye.
    Look,
    /// What landed in a pixel of one eye from the other.
    Cross,
    /// Pixels whose path was stopped, from their neighbours.
    Median,
    /// The light of all pixels that is filtered.
    AtrousBegin,
    /// The same, from more of their neighbours.
    Atrous,
    /// The pixels from that.
    AtrousEnd,
    /// Samples from elsewhere; between frames, not in one.
    MergePlanes,
}

impl Stage {
    /// Does it come after all samples of paths, to show them with less noise?
    #[must_use]
    pub fn removes_noise(self) -> bool {
        matches!(self, Self::Median | Self::AtrousBegin | Self::Atrous | Self::AtrousEnd)
    }

    /// Every stage.
    pub const ALL: [Self; 50] = [
        Self::Full,
        Self::Base,
        Self::SimilarityA1,
        Self::CompactA1,
        Self::TraceA1,
        Self::SimilarityA2,
        Self::CompactA2,
        Self::TraceA2,
        Self::CompactSeed,
        Self::PostcorrectSeed,
        Self::PostcorrectLandmarks,
        Self::CompactPostcorrect,
        Self::Postcorrect,
        Self::PostcorrectScan,
        Self::Resolve,
        Self::Checkerboard,
        Self::Fill,
        Self::Presample,
        Self::SubpixelTest,
        Self::CompactActive,
        Self::ExtraSamples,
        Self::RefineTest,
        Self::CompactRefine,
        Self::Refine,
        Self::CompactCellTest,
        Self::CellTest,
        Self::CompactCells,
        Self::Cells,
        Self::QuincunxBase,
        Self::QuincunxSplitA,
        Self::CompactQuincunxA,
        Self::QuincunxTraceA,
        Self::QuincunxSplitB,
        Self::CompactQuincunxB,
        Self::QuincunxTraceB,
        Self::QuincunxResolve,
        Self::Frameless,
        Self::ReprojectDepth,
        Self::ReprojectSource,
        Self::Reuse,
        Self::CompactRenew,
        Self::Renew,
        Self::Path,
        Self::Look,
        Self::Cross,
        Self::Median,
        Self::AtrousBegin,
        Self::Atrous,
        Self::AtrousEnd,
        Self::MergePlanes,
    ];

    /// Its name everywhere: GPU label, timing row.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Base => "base",
            Self::SimilarityA1 => "similarity_a1",
            Self::CompactA1 => "compact_a1",
            Self::TraceA1 => "trace_a1",
            Self::SimilarityA2 => "similarity_a2",
            Self::CompactA2 => "compact_a2",
            Self::TraceA2 => "trace_a2",
            Self::CompactSeed => "compact_seed",
            Self::PostcorrectSeed => "postcorrect_seed",
            Self::PostcorrectLandmarks => "postcorrect_landmarks",
            Self::CompactPostcorrect => "compact_postcorrect",
            Self::Postcorrect => "postcorrect",
            Self::PostcorrectScan => "postcorrect_scan",
            Self::Resolve => "resolve",
            Self::Checkerboard => "checkerboard",
            Self::Fill => "fill",
            Self::Presample => "presample",
            Self::SubpixelTest => "subpixel_test",
            Self::CompactActive => "compact_active",
            Self::ExtraSamples => "extra_samples",
            Self::RefineTest => "refine_test",
            Self::CompactRefine => "compact_refine",
            Self::Refine => "refine",
            Self::CompactCellTest => "compact_cell_test",
            Self::CellTest => "cell_test",
            Self::CompactCells => "compact_cells",
            Self::Cells => "cells",
            Self::QuincunxBase => "quincunx_base",
            Self::QuincunxSplitA => "quincunx_split_a",
            Self::CompactQuincunxA => "compact_quincunx_a",
            Self::QuincunxTraceA => "quincunx_trace_a",
            Self::QuincunxSplitB => "quincunx_split_b",
            Self::CompactQuincunxB => "compact_quincunx_b",
            Self::QuincunxTraceB => "quincunx_trace_b",
            Self::QuincunxResolve => "quincunx_resolve",
            Self::Frameless => "frameless",
            Self::ReprojectDepth => "reproject_depth",
            Self::ReprojectSource => "reproject_source",
            Self::Reuse => "reuse",
            Self::CompactRenew => "compact_renew",
            Self::Renew => "renew",
            Self::Path => "path",
            Self::Look => "look",
            Self::Cross => "cross",
            Self::Median => "median",
            Self::AtrousBegin => "atrous_begin",
            Self::Atrous => "atrous",
            Self::AtrousEnd => "atrous_end",
            Self::MergePlanes => "merge_planes",
        }
    }

    fn entry(self) -> Source {
        match self {
            Self::Full => wgsl!("passes/full.wgsl"),
            Self::Base => wgsl!("passes/base.wgsl"),
            Self::SimilarityA1 => wgsl!("passes/similarity_a1.wgsl"),
            Self::CompactA1
            | Self::CompactA2
            | Self::CompactSeed
            | Self::CompactPostcorrect
            | Self::CompactActive
            | Self::CompactRefine
            | Self::CompactCellTest
            | Self::CompactCells
            | Self::CompactQuincunxA
            | Self::CompactQuincunxB
            | Self::CompactRenew => wgsl!("passes/compact.wgsl"),
            Self::Presample => wgsl!("passes/presample.wgsl"),
            Self::SubpixelTest => wgsl!("passes/subpixel_test.wgsl"),
            Self::ExtraSamples => wgsl!("passes/extra_samples.wgsl"),
            Self::RefineTest => wgsl!("passes/refine_test.wgsl"),
            Self::Refine => wgsl!("passes/refine.wgsl"),
            Self::CellTest => wgsl!("passes/cell_test.wgsl"),
            Self::Cells => wgsl!("passes/cells.wgsl"),
            Self::QuincunxBase => wgsl!("passes/quincunx_base.wgsl"),
            Self::QuincunxSplitA => wgsl!("passes/quincunx_split_a.wgsl"),
            Self::QuincunxSplitB => wgsl!("passes/quincunx_split_b.wgsl"),
            Self::QuincunxTraceA | Self::QuincunxTraceB => wgsl!("passes/quincunx_trace.wgsl"),
            Self::QuincunxResolve => wgsl!("passes/quincunx_resolve.wgsl"),
            Self::PostcorrectSeed => wgsl!("passes/postcorrect_seed.wgsl"),
            Self::PostcorrectLandmarks => wgsl!("passes/postcorrect_landmarks.wgsl"),
            Self::Postcorrect => wgsl!("passes/postcorrect.wgsl"),
            Self::PostcorrectScan => wgsl!("passes/postcorrect_scan.wgsl"),
            Self::SimilarityA2 => wgsl!("passes/similarity_a2.wgsl"),
            Self::TraceA1 | Self::TraceA2 => wgsl!("passes/trace.wgsl"),
            Self::Resolve => wgsl!("passes/resolve.wgsl"),
            Self::Checkerboard => wgsl!("passes/checkerboard.wgsl"),
            Self::Fill => wgsl!("passes/fill.wgsl"),
            Self::Frameless => wgsl!("passes/frameless.wgsl"),
            Self::ReprojectDepth => wgsl!("passes/reproject_depth.wgsl"),
            Self::ReprojectSource => wgsl!("passes/reproject_source.wgsl"),
            Self::Reuse => wgsl!("passes/reuse.wgsl"),
            Self::Renew => wgsl!("passes/renew.wgsl"),
            Self::Path => wgsl!("passes/path.wgsl"),
            Self::Look => wgsl!("passes/look.wgsl"),
            Self::Cross => wgsl!("passes/cross.wgsl"),
            Self::Median => wgsl!("passes/median.wgsl"),
            Self::AtrousBegin => wgsl!("passes/atrous_begin.wgsl"),
            Self::Atrous | Self::AtrousEnd => wgsl!("passes/atrous.wgsl"),
            Self::MergePlanes => wgsl!("passes/merge_planes.wgsl"),
        }
    }
}
