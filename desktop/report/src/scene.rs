//! A scene with all that was measured of it.

use crate::bench::Measured;
use crate::rows::Row;
use crate::subject::Prepared;

/// A scene with all that was measured of it.
pub struct SceneReport {
    /// The scene.
    pub prepared: Prepared,
    /// The name of its files.
    pub stem: String,
    /// By job: the ladder first.
    pub measured: Vec<Measured>,
    /// The ladder's rows, then those of the tables.
    pub rows: Vec<Row>,
}

impl SceneReport {
    /// What was measured for the table of that name.
    pub fn of_table<'s>(&'s self, table: &'s str) -> impl Iterator<Item = &'s Measured> {
        self.measured.iter().filter(move |measured| measured.job.shows(table))
    }

    /// Its name and the size of a frame, as the tables have it.
    pub fn sized(&self, [width, height]: [u32; 2]) -> String {
        format!("{}, {width}x{height}", self.prepared.name)
    }
}
