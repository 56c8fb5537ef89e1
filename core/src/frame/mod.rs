//! A frame: what it is planned as, the buffers that it needs, the commands that make it, and what is known of it afterwards.
//!
//! [`plan`] puts the stages of a method in order, in parts of bounded work. [`targets`] holds the buffers and images of one
//! frame size. [`recorder`] records the parts into command buffers. [`sequence`] says which pixels a frame of a sequence
//! traces anew. [`renderer`] is what programs use: it owns all of these.

pub(crate) mod counters;
pub(crate) mod inspection;
pub(crate) mod plan;
pub(crate) mod recorder;
pub(crate) mod renderer;
pub(crate) mod sequence;
pub mod show;
pub(crate) mod stats;
pub(crate) mod targets;
