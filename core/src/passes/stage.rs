//! Stages: the facts about a frame's kernels that planning, recording and reporting read.

use serde::{Deserialize, Serialize};

use super::FrameSpec;
use crate::device::shader::Source;

/// Side in samples of the square that a workgroup of 64 threads, or of 256 threads, processes.
pub const TRACED_TILE: u32 = 8;
pub const INTERPOLATED_TILE: u32 = 16;
/// Side in samples of the square that a workgroup of 64 threads processes when threads trace several paths in
/// turn.
pub const PATH_TILE: u32 = 32;

/// Whether and how a stage traces rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Tracing {
    /// Coherent primary rays: workgroups trace whole tiles of neighbouring samples.
    Neighbours,
    /// Incoherent primary rays: workgroups trace samples from a list, in its order.
    Listed,
    /// No rays: checks, interpolation, compaction, filtering.
    No,
}

impl Tracing {
    /// All classes, in the order of their discriminants.
    pub const ALL: [Self; 3] = [Self::Neighbours, Self::Listed, Self::No];

    /// The class of the pass of that name ([`crate::PassTime::name`]); `None` if no stage has it.
    #[must_use]
    pub fn of_pass(name: &str) -> Option<Self> {
        super::stages().find(|stage| stage.name == name).map(|stage| stage.tracing)
    }
}

/// The shape of a stage's dispatches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// One workgroup for each square of samples of this side.
    Tiles(u32),
    /// One thread for each entry of the list, dispatched indirectly.
    List,
    /// A fixed number of workgroups.
    Fixed,
    /// One thread for each row or column of samples, which it walks along.
    Lines,
    /// One thread for each sample whose rank is due in this frame.
    Ranks,
}

impl Work {
    /// The side of a workgroup's square of samples; 1 where it has none.
    pub fn side(self) -> u32 {
        if let Self::Tiles(side) = self { side } else { 1 }
    }
}

/// A buffer that is cleared to zeros before a stage runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clears {
    /// The header of the list, which empties it.
    ListHeader,
    /// All attributes, so that no sample is claimed.
    Attributes,
    /// The depth keys and sources of reprojected points.
    Reprojected,
}

/// A stage: one kernel of a frame.
pub struct Stage {
    /// Its name in GPU labels, timings and reports.
    pub name: &'static str,
    /// The shape of its dispatches.
    pub work: Work,
    /// Whether it traces rays.
    pub tracing: Tracing,
    /// The buffers cleared before the stage's first dispatch.
    pub clears: &'static [Clears],
    /// The WGSL file with the entry point.
    pub entry: Source,
    /// Returns the kernel's sources for a frame, in link order; the last argument is `entry`.
    pub sources: fn(&FrameSpec, Source) -> Vec<Source>,
}

/// Stages compare by name.
impl PartialEq for Stage {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Stage {}

impl std::fmt::Debug for Stage {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.name)
    }
}

impl FrameSpec {
    /// The sources of a stage's kernel, in order.
    #[must_use]
    pub fn sources(&self, stage: &Stage) -> Vec<Source> {
        (stage.sources)(self, stage.entry.clone())
    }
}

/// Embeds a WGSL file of this crate.
macro_rules! wgsl {
    ($path:literal) => {
        $crate::device::shader::Source {
            file: $path,
            text: std::borrow::Cow::Borrowed(include_str!(concat!(
                env!("CARGO_MANIFEST_DIR"),
                "/src/",
                $path
            ))),
        }
    };
}
pub(crate) use wgsl;

/// Declares each stage of a file as a static, and `STAGES`, the list of them. `paper` names the source of a
/// stage.
macro_rules! stages {
    ($($(#[$doc:meta])* $stage:ident = {
        name: $name:literal, wgsl: $path:literal, paper: $paper:literal,
        work: $work:expr, tracing: $tracing:expr, clears: $clears:expr,
        sources: $sources:expr $(,)?
    })*) => {
        $($(#[$doc])* #[doc = concat!("\n\nSource: ", $paper, ".")] pub static $stage: $crate::passes::Stage = $crate::passes::Stage {
            name: $name,
            work: $work,
            tracing: $tracing,
            clears: &$clears,
            entry: $crate::passes::wgsl!($path),
            sources: $sources,
        };)*
        /// All stages of this file.
        pub static STAGES: &[&$crate::passes::Stage] = &[$(&$stage),*];
    };
}
pub(crate) use stages;
