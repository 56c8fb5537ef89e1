//! The stages of a frame and their kernels. Each file holds the stages of one method, or of a step that methods
//! share: their order in a frame and the WGSL files that their kernels are linked from.

mod constants;
mod demand;
mod linked;
mod operations;
mod recipe;
mod sources;
mod spec;
mod stage;
#[cfg(test)]
mod tests;

pub use constants::{REFINE_MOST, REFINE_STEP, REFINE_WORDS, STRATUM_CONTRAST, TRACE_GROUP, TRACE_ROW};
pub use demand::{Demand, Demands};
pub use linked::Linked;
#[cfg(test)]
pub(crate) use operations::count as count_operations;
pub use recipe::Recipe;
pub use spec::{FrameSpec, Output};
pub use stage::{Clears, PATH_TILE, Stage, Tracing};
#[cfg(test)]
pub use stage::{TRACED_TILE, Work};
pub(crate) use stage::{stages, wgsl};

/// Declares the modules with stages and the list of all stages.
macro_rules! files_with_stages {
    ($($file:ident)*) => {
        $(pub mod $file;)*
        /// All stages of all methods.
        pub fn stages() -> impl Iterator<Item = &'static Stage> {
            [$($file::STAGES),*].into_iter().flatten().copied()
        }
    };
}

files_with_stages! {
    full
    checkerboard
    adaptive
    postcorrect
    supersample
    refine
    quincunx
    frameless
    reproject
    path
    stereo
    denoise
}
