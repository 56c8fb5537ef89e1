//! Jobs: settings of one view of one scene that are measured together, their frames interleaved.

use glimpse::{Camera, Settings};

use crate::identity::Identity;
use crate::record::Record;
use crate::rung::{Family, Rung};
use crate::subject::{Prepared, Variant, turned};

/// Settings of one view that are measured together, their frames interleaved.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// Names of the tables that show the job; empty for the ladder.
    pub tables: Vec<&'static str>,
    /// Change made to the scene.
    pub variant: Variant,
    /// Angle in degrees by which the scene's camera is turned about the vertical.
    pub turn: f32,
    /// Angle in degrees by which the camera pans to the right from one frame to the next.
    pub turn_per_frame: f64,
    /// Size of the shown frame in pixels.
    pub shown: [u32; 2],
    /// Settings to measure.
    pub rungs: Vec<Rung>,
    /// Index of the setting that is timed in every round, to tell changes of the device's speed from those between
    /// settings; `None` if all settings of the job take turns anyway.
    pub control: Option<usize>,
    /// Reference that the pictures are compared with.
    pub reference: Reference,
    /// Name of the reference in the identities. It also tells apart jobs whose settings must be measured
    /// separately although everything else agrees.
    pub against: &'static str,
    /// Whether the rungs are searched for the objects that the first rung shows.
    pub counts_missing: bool,
    /// Whether the operations and bytes that each rung requires are counted.
    pub counts_work: bool,
}

/// Reference that errors are measured against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reference {
    /// The picture of the first rung, which then has no error of its own.
    First,
    /// A frame rendered once with these settings.
    Converged {
        /// Settings of the reference frame.
        settings: Settings,
        /// Whether errors are also measured against the picture of the first rung.
        beside_first: bool,
    },
}

impl Job {
    /// Creates a job of a table: the unchanged scene, each rung but the first compared with the first.
    pub fn new(table: &'static str, shown: [u32; 2], rungs: Vec<Rung>) -> Self {
        Self {
            tables: vec![table],
            variant: Variant::AsIs,
            turn: 0.0,
            turn_per_frame: 0.0,
            shown,
            rungs,
            control: None,
            reference: Reference::First,
            against: "full",
            counts_missing: false,
            counts_work: false,
        }
    }

    /// Whether two jobs measure the same; only the tables that show them may differ.
    pub fn measures_the_same_as(&self, other: &Self) -> bool {
        let without_tables = |job: &Self| Self { tables: Vec::new(), ..job.clone() };
        without_tables(self) == without_tables(other)
    }

    /// Whether this is the ladder, which the plots of the scene show.
    pub fn is_ladder(&self) -> bool {
        self.tables.is_empty()
    }

    /// Whether errors are measured against a converged frame.
    pub fn is_against_converged(&self) -> bool {
        matches!(self.reference, Reference::Converged { .. })
    }

    /// Whether errors are measured against a converged frame and against the picture of the first rung.
    pub fn is_against_first_too(&self) -> bool {
        matches!(self.reference, Reference::Converged { beside_first: true, .. })
    }

    /// Whether the table of that name shows the job.
    pub fn shows(&self, table: &str) -> bool {
        self.tables.contains(&table)
    }

    /// Whether a record of the rung at `index` contains everything that the job asks for.
    pub fn accepts(&self, index: usize, record: &Record) -> bool {
        let searched = index == 0 || record.missing.is_some() || !self.counts_missing;
        searched && (record.work.is_some() || !self.counts_work)
    }

    /// Camera of a frame; frame 0 is the one whose picture is compared.
    pub fn view(&self, scene: &Prepared, frame: i32) -> Camera {
        let camera = if self.turn == 0.0 { scene.camera } else { turned(&scene.camera, self.turn) };
        let degrees = f64::from(frame) * self.turn_per_frame;
        if degrees == 0.0 { camera } else { camera.panned(degrees) }
    }

    /// Identity of each rung for a program and an adapter.
    pub fn identities(&self, program: &str, adapter: &str, scene: &Prepared) -> anyhow::Result<Vec<String>> {
        let of = |rung| self.identity(program, adapter, scene, rung, self.against).line();
        self.rungs.iter().map(of).collect()
    }

    /// Setting and identity of the converged frame, if there is one. The identity names no adapter, as its
    /// time does not matter.
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
