//! A scene with all its measurements.

use crate::bench::Measured;
use crate::rows::Row;
use crate::subject::Prepared;

/// A scene with all its measurements.
pub struct SceneReport {
    /// Scene with its description and camera.
    pub prepared: Prepared,
    /// Stem of the scene's file names.
    pub stem: String,
    /// Measurements by job, the ladder first.
    pub measured: Vec<Measured>,
    /// Rows of report.csv: the ladder's, then those of the tables.
    pub rows: Vec<Row>,
}

impl SceneReport {
    /// Measurements for the table of that name.
    pub fn of_table<'s>(&'s self, table: &'s str) -> impl Iterator<Item = &'s Measured> {
        self.measured.iter().filter(move |measured| measured.job.shows(table))
    }

    /// Name of the scene and size of the frame, the first cell of many tables.
    pub fn sized(&self, [width, height]: [u32; 2]) -> String {
        format!("{}, {width}x{height}", self.prepared.name)
    }
}
