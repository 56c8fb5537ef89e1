//! Error against run time for any scene, and the tables of the papers beside their published figures.
//!
//! [`run`] measures a ladder of settings of each scene and the [`TABLES`] that are asked for, keeps every measurement in the
//! report's folder, and writes a page, rows of comma-separated values and plots.
//!
//! A module uses those of the layers above it alone:
//!
//! - what a setting and a plot are: `rung`, `pareto`, `plot`, `upscale`, `identity`;
//! - what is measured and kept: `work`, `record`, `store`, `subject`, `job`;
//! - measuring: `complete`, `bench`, `rows`, `scene`, `ladder`;
//! - what a table of a paper is: `table`; the tables, a file each: `tables`;
//! - the whole: `page`, `run`.

mod bench;
mod complete;
mod identity;
mod job;
mod ladder;
mod page;
mod pareto;
mod plot;
mod record;
mod rows;
mod run;
mod rung;
mod scene;
mod store;
mod subject;
mod table;
mod tables;
mod upscale;
mod work;

pub use run::{Options, Program, run};
pub use table::Table;
pub use tables::{TABLES, named};
