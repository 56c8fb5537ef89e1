//! Frames: their plan, buffers, command buffers and results.
//!
//! [`plan`] orders the stages of a method and divides them into dispatches of bounded work. [`targets`] holds the
//! buffers and images of one frame size. [`recorder`] records the dispatches into command buffers. [`sequence`]
//! tracks which pixels a frame traces in methods that reuse earlier frames. [`inspection`] decodes the counting
//! kernels' results, and [`show`] displays them. [`renderer`] is the public interface and owns all of these.

pub(crate) mod counters;
pub(crate) mod inspection;
pub(crate) mod plan;
pub(crate) mod recorder;
pub(crate) mod renderer;
pub(crate) mod sequence;
pub mod show;
pub(crate) mod stats;
pub(crate) mod targets;
