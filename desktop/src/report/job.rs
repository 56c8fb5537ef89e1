//! What is measured: settings of one view of one scene that share the weather.

#[cfg(test)]
mod tests;

use glimpse::{Camera, Method, Settings};

use super::eyes;
use super::identity::Identity;
use super::jin::{figure7, table2};
use super::ladder::{self, Family, Rung};
use super::missing;
use super::pan;
use super::prediction;
use super::record::Record;
use super::subject::{Prepared, SHARES, TABLE_SIDE, Variant, turned};
use crate::args::{ReportOptions, TableName};

/// The samplings of tables 4 and 5.
const SAMPLINGS: [u32; 3] = [1, 2, 4];

/// The views of table 3(c), in degrees about the vertical.
const VIEWS: [f32; 5] = [0.0, 72.0, 144.0, 216.0, 288.0];

/// Settings that are measured interleaved.
#[derive(Clone, Debug)]
pub struct Job {
    /// The tables that show it; the ladder has none.
    pub tables: Vec<TableName>,
    /// What is changed in the scene.
    pub variant: Variant,
    /// Degrees by which the scene's camera is turned.
    pub turn: f32,
    /// The frame.
    pub shown: [u32; 2],
    /// Measured against the converged frame in the ladder and in Jin 2009's tables, in the others each but the first against
    /// the first.
    pub rungs: Vec<Rung>,
}

impl Job {
    /// All that is to be measured of a scene.
    pub fn all(options: &ReportOptions, base: &Settings, scene: &Prepared) -> Vec<Self> {
        let size = options.size.0;
        let ladder = ladder::rungs(base, size);
        let mut jobs =
            vec![Self { tables: vec![], variant: Variant::AsIs, turn: 0.0, shown: size, rungs: ladder }];
        for &table in &options.tables {
            for job in Self::of_table(table, options, base, scene) {
                match jobs.iter_mut().find(|known| known.renders_as(&job)) {
                    Some(known) => known.tables.push(table),
                    None => jobs.push(job),
                }
            }
        }
        // Each change of the scene costs an upload.
        jobs.sort_by_key(|job| job.variant != Variant::AsIs);
        jobs
    }

    fn of_table(table: TableName, options: &ReportOptions, base: &Settings, scene: &Prepared) -> Vec<Self> {
        let pair = |variant, turn, shown, sampling| Self {
            tables: vec![table],
            variant,
            turn,
            shown,
            rungs: pair(&Settings { sampling, ..*base }, shown),
        };
        let as_is =
            |shown, rungs| Self { tables: vec![table], variant: Variant::AsIs, turn: 0.0, shown, rungs };
        let (square, size) = ([TABLE_SIDE; 2], options.size.0);
        match table {
            TableName::None => Vec::new(),
            TableName::Kernels => vec![pair(Variant::AsIs, 0.0, square, 1)],
            TableName::Reflective => {
                SHARES.map(|share| pair(Variant::Reflective(share), 0.0, square, 1)).to_vec()
            }
            TableName::Views => VIEWS.map(|turn| pair(Variant::AsIs, turn, square, 1)).to_vec(),
            TableName::Hairball if !scene.name.to_lowercase().contains("hairball") => Vec::new(),
            TableName::Hairball => SAMPLINGS.map(|n| pair(Variant::AsIs, 0.0, size, n)).to_vec(),
            TableName::Resolutions => {
                let sizes = options.table5_sizes.iter();
                sizes.flat_map(|side| SAMPLINGS.map(|n| pair(Variant::AsIs, 0.0, [*side; 2], n))).collect()
            }
            TableName::Missing => vec![as_is(size, missing::rungs(base, size))],
            TableName::Phones => vec![as_is(prediction::SIZE, prediction::rungs(base))],
            TableName::Supersampling => vec![as_is(size, table2::rungs(base, size))],
            TableName::Thresholds => vec![as_is(size, figure7::rungs(base, size))],
            TableName::Eyes => vec![as_is(eyes::SIZE, eyes::rungs(base, scene))],
            TableName::Pan => vec![as_is(size, pan::rungs(base, size))],
        }
    }

    fn renders_as(&self, other: &Self) -> bool {
        let what = |job: &Self| (job.variant, job.turn, job.shown);
        what(self) == what(other) && self.rungs == other.rungs
    }

    /// The settings that the plots show.
    pub fn is_ladder(&self) -> bool {
        self.tables.is_empty()
    }

    /// Errors are measured against the converged frame.
    pub fn is_against_converged(&self) -> bool {
        let tables = [TableName::Supersampling, TableName::Thresholds, TableName::Eyes];
        self.is_ladder() || tables.into_iter().any(|table| self.shows(table))
    }

    /// Is it shown by that table?
    pub fn shows(&self, table: TableName) -> bool {
        self.tables.contains(&table)
    }

    /// And against the first one's picture too.
    pub fn is_against_first(&self) -> bool {
        self.shows(TableName::Eyes)
    }

    /// The rungs are searched for the objects that the first one shows.
    pub fn counts_missing(&self) -> bool {
        self.shows(TableName::Missing)
    }

    /// What the rungs ask of a device is counted.
    pub fn counts_work(&self) -> bool {
        self.shows(TableName::Phones)
    }

    /// Whether a record has all that is shown of a rung.
    pub fn accepts(&self, index: usize, record: &Record) -> bool {
        let searched = index == 0 || record.missing.is_some() || !self.counts_missing();
        searched && (record.work.is_some() || !self.counts_work())
    }

    /// The view.
    pub fn camera(&self, scene: &Prepared) -> Camera {
        if self.turn == 0.0 { scene.camera } else { turned(&scene.camera, self.turn) }
    }

    /// The view of a frame, counted from the one whose picture is judged.
    pub fn view(&self, scene: &Prepared, frame: i32) -> Camera {
        let camera = self.camera(scene);
        if self.shows(TableName::Pan) { pan::view(&camera, frame) } else { camera }
    }

    /// The identity of each rung, for a program on an adapter.
    pub fn identities(&self, program: &str, adapter: &str, scene: &Prepared) -> anyhow::Result<Vec<String>> {
        let of = |(index, rung): (usize, &Rung)| {
            let against = match index {
                _ if self.is_ladder() => "converged",
                // What several parts show is measured in each, interleaved with what it is compared with there.
                _ if self.shows(TableName::Supersampling) => "converged, of table 2",
                _ if self.shows(TableName::Thresholds) => "converged, of figure 7",
                _ if self.shows(TableName::Eyes) => "converged paths",
                _ if self.counts_missing() => "full and its objects",
                _ if self.shows(TableName::Pan) => "full, after a turn",
                0 => "nothing",
                _ => "full",
            };
            self.identity(program, adapter, scene, rung, against).line()
        };
        self.rungs.iter().enumerate().map(of).collect()
    }

    /// The identity of the converged frame, whose time does not count.
    pub fn converged(
        &self,
        program: &str,
        scene: &Prepared,
        base: &Settings,
    ) -> anyhow::Result<(Rung, String)> {
        let eyes = self.shows(TableName::Eyes);
        let settings = if eyes { eyes::converged(base, scene) } else { ladder::converged(base) };
        let rung = Rung {
            name: "converged".to_owned(),
            family: Family::Fixed,
            settings,
            rendered: self.shown,
            keeps_picture: true,
        };
        let identity = self.identity(program, "", scene, &rung, "nothing").line()?;
        Ok((rung, identity))
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
            camera: Identity::camera(&self.camera(scene)),
            settings: rung.settings,
            rendered: rung.rendered,
            shown: self.shown,
            against: against.to_owned(),
        }
    }
}

/// Full ray tracing, and the adaptive method with the same samples.
fn pair(base: &Settings, size: [u32; 2]) -> Vec<Rung> {
    let rung = |name: &str, family, method| {
        Rung::beside_full(name.to_owned(), family, Settings { method, ..*base }, size)
    };
    vec![rung("full", Family::Fixed, Method::Full), rung("adaptive", Family::Tolerances, Method::Adaptive)]
}

impl Rung {
    /// Frames that a picture takes: until it has its samples, or nothing of what was before them.
    pub fn frames(&self) -> u64 {
        match self.settings.method {
            Method::Path | Method::Vr => self.settings.paths.samples.into(),
            Method::Frameless | Method::Reproject => (1.0 / self.settings.share).ceil() as u64,
            _ => 1,
        }
    }

    /// Frames whose time is that of a picture.
    pub fn timed_frames(&self) -> u64 {
        if self.settings.method.follows_paths() { self.frames() } else { 1 }
    }

    /// Samples that take the time of one frame: those that add some trace twice as many as there are, others half of them,
    /// or what costs as much.
    pub fn samples(&self) -> u64 {
        let [width, height] = self.rendered.map(u64::from);
        let samples = width * height * u64::from(self.settings.sampling).pow(2) * self.frames();
        match self.settings.method {
            Method::Full => samples,
            Method::Supersample | Method::Quincunx | Method::Path | Method::Vr => 2 * samples,
            Method::Adaptive if self.settings.supersample => 2 * samples,
            Method::Adaptive | Method::Checkerboard | Method::Frameless | Method::Reproject => {
                samples.div_ceil(2)
            }
        }
    }
}
