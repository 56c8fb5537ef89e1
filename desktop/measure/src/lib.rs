//! Parts shared by the commands that measure.
//!
//! - [`scene_file`] reads a scene by its name on the command line, [`files`] reads and writes whole files.
//! - [`surroundings`] reads environment maps and puts them around scenes.
//! - [`machine`] names the processor and the day.
//! - [`statistics`] holds medians and descriptions of scenes and adapters.
//! - [`progress`] shows a bar on a terminal, [`output`] writes to stdout and formats numbers.

pub mod files;
pub mod machine;
pub mod output;
pub mod progress;
pub mod scene_file;
pub mod statistics;
pub mod surroundings;
