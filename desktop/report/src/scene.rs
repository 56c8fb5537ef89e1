//! A scene with all its measurements.

use crate::bench::Measured;
use crate::equal_error::EqualError;
use crate::noise::Noise;
use crate::rows::{self, Row};
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
    /// Times of the ladder at equal error, or why there are none.
    pub compared: Result<EqualError, String>,
    /// Noise of the ladder's times.
    pub noise: Option<Noise>,
}

impl SceneReport {
    /// Evaluates the measurements of a scene.
    pub fn new(prepared: Prepared, stem: String, measured: Vec<Measured>) -> Self {
        let ladder = measured.iter().find(|measured| measured.job.is_ladder());
        let compared = ladder.map_or_else(|| Err("no ladder".to_owned()), EqualError::of);
        let noise = ladder.and_then(Noise::of);
        let rows = rows::of(&prepared.name, &measured);
        Self { prepared, stem, measured, rows, compared, noise }
    }

    /// Measurements for the table of that name.
    pub fn of_table<'s>(&'s self, table: &'s str) -> impl Iterator<Item = &'s Measured> {
        self.measured.iter().filter(move |measured| measured.job.shows(table))
    }

    /// Name of the scene and size of the frame, the first cell of many tables.
    pub fn sized(&self, [width, height]: [u32; 2]) -> String {
        format!("{}, {width}x{height}", self.prepared.name)
    }
}
