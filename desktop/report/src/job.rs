//! What is measured: settings of one view of one scene whose frames are interleaved.

use glimpse::{Camera, Settings};

use crate::identity::Identity;
use crate::record::Record;
use crate::rung::{Family, Rung};
use crate::subject::{Prepared, Variant, turned};

/// Settings that are measured interleaved.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// The names of the tables that show it; the ladder has none.
    pub tables: Vec<&'static str>,
    /// What is changed in the scene.
    pub variant: Variant,
    /// Degrees by which the scene's camera is turned.
    pub turn: f32,
    /// Degrees by which it turns to the right from one frame to the next.
    pub turn_per_frame: f64,
    /// The size of the frame as it is shown.
    pub shown: [u32; 2],
    /// The settings.
    pub rungs: Vec<Rung>,
    /// What their pictures are measured against.
    pub reference: Reference,
    /// Names the reference, or the interleaved settings that it is measured with: settings that differ in this alone are
    /// measured apart.
    pub against: &'static str,
    /// The rungs are searched for the objects that the first one shows.
    pub counts_missing: bool,
    /// What the rungs ask of a device is counted.
    pub counts_work: bool,
}

/// What errors are measured against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reference {
    /// The picture of the first rung, which has no error itself.
    First,
    /// A frame of these settings, which is made once.
    Converged {
        /// How that frame is rendered.
        settings: Settings,
        /// Against the picture of the first rung too.
        beside_first: bool,
    },
}

impl Job {
    /// Settings of the scene as it is for that table, each but the first measured against the first.
    pub fn new(table: &'static str, shown: [u32; 2], rungs: Vec<Rung>) -> Self {
        Self {
            tables: vec![table],
            variant: Variant::AsIs,
            turn: 0.0,
            turn_per_frame: 0.0,
            shown,
            rungs,
            reference: Reference::First,
            against: "full",
            counts_missing: false,
            counts_work: false,
        }
    }

    /// Both are the same measurements, whichever tables show them.
    pub fn measures_the_same_as(&self, other: &Self) -> bool {
        let without_tables = |job: &Self| Self { tables: Vec::new(), ..job.clone() };
        without_tables(self) == without_tables(other)
    }

    /// The settings that the plots of the scene show.
    pub fn is_ladder(&self) -> bool {
        self.tables.is_empty()
    }

    /// Errors are measured against the converged frame.
    pub fn is_against_converged(&self) -> bool {
        matches!(self.reference, Reference::Converged { .. })
    }

    /// Errors are measured against the converged frame, and against the first one's picture too.
    pub fn is_against_first_too(&self) -> bool {
        matches!(self.reference, Reference::Converged { beside_first: true, .. })
    }

    /// Is it shown by the table of that name?
    pub fn shows(&self, table: &str) -> bool {
        self.tables.contains(&table)
    }

    /// Whether a record has all that is shown of a rung.
    pub fn accepts(&self, index: usize, record: &Record) -> bool {
        let searched = index == 0 || record.missing.is_some() || !self.counts_missing;
        searched && (record.work.is_some() || !self.counts_work)
    }

    /// The view of a frame, counted from the one whose picture is judged.
    pub fn view(&self, scene: &Prepared, frame: i32) -> Camera {
        let camera = if self.turn == 0.0 { scene.camera } else { turned(&scene.camera, self.turn) };
        let degrees = f64::from(frame) * self.turn_per_frame;
        if degrees == 0.0 { camera } else { camera.panned(degrees) }
    }

    /// The identity of each rung, for a program on an adapter.
    pub fn identities(&self, program: &str, adapter: &str, scene: &Prepared) -> anyhow::Result<Vec<String>> {
        let of = |rung| self.identity(program, adapter, scene, rung, self.against).line();
        self.rungs.iter().map(of).collect()
    }

    /// The converged frame, where there is one, and its identity, in which no adapter is named as its time does not count.
    pub fn converged(&self, program: &str, scene: &Prepared) -> anyhow::Result<Option<(Rung, String)>> {
        let Reference::Converged { settings, .. } = self.reference else { return Ok(None) };
        let rung = Rung {
            keeps_picture: true,
            ..Rung::beside_converged("converged", Family::FIXED, settings, self.shown)
        };
        let identity = self.identity(program, "", scene, &rung, "nothing").line()?;
        Ok(Some((rung, identity)))
    }

    fn identity(
        &self,
        program: &str,
        adapter: &str,
        scene: &Prepared,
        rung: &Rung,
        against: &str,
    ) -> Identity {
        Identity {
            program: program.to_owned(),
            adapter: adapter.to_owned(),
            scene: scene.content.to_string(),
            variant: format!("{:?}", self.variant),
            camera: Identity::camera(&self.view(scene, 0)),
            settings: rung.settings,
            rendered: rung.rendered,
            shown: self.shown,
            against: against.to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turning_camera_ends_as_it_is() {
        let scene = Prepared::new("builtin:room", None).unwrap();
        let job = Job { turn_per_frame: 0.25, ..Job::new("pan", [4, 3], Vec::new()) };
        assert_eq!(job.view(&scene, 0), scene.camera);
        let [before, after] = [-1, 1].map(|frame| job.view(&scene, frame).forward.normalize());
        let angle = before.angle_between(after).to_degrees();
        assert!((angle - 0.5).abs() < 1e-2, "{angle}");
    }

    #[test]
    fn only_the_tables_may_differ_between_the_same_measurements() {
        let job = Job::new("a", [4, 3], Vec::new());
        assert!(job.measures_the_same_as(&Job::new("b", [4, 3], Vec::new())));
        for other in [
            Job { shown: [3, 4], ..job.clone() },
            Job { turn: 72.0, ..job.clone() },
            Job { variant: Variant::Reflective(20), ..job.clone() },
            Job { counts_missing: true, ..job.clone() },
        ] {
            assert!(!job.measures_the_same_as(&other), "{other:?}");
        }
    }
}
