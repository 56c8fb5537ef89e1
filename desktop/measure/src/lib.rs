//! What the commands that measure have in common.
//!
//! - [`scene_file`] reads a scene by its name on the command line, [`files`] reads and writes whole files.
//! - [`statistics`] holds medians, and what is known of a scene and of an adapter.
//! - [`progress`] shows a bar on a terminal, [`output`] writes to stdout and formats numbers.

pub mod files;
pub mod output;
pub mod progress;
pub mod scene_file;
pub mod statistics;
