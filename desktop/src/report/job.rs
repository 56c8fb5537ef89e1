//! What is measured: settings of one view of one scene that share the weather.

use glimpse::{Camera, Method, Settings};

use super::identity::Identity;
use super::ladder::{self, Family, Rung};
use super::missing;
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
    /// In the ladder against the converged frame, in a table each but the first against the first.
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
        let square = [TABLE_SIDE; 2];
        match table {
            TableName::None => Vec::new(),
            TableName::Kernels => vec![pair(Variant::AsIs, 0.0, square, 1)],
            TableName::Reflective => {
                SHARES.map(|share| pair(Variant::Reflective(share), 0.0, square, 1)).to_vec()
            }
            TableName::Views => VIEWS.map(|turn| pair(Variant::AsIs, turn, square, 1)).to_vec(),
            TableName::Hairball if !scene.name.to_lowercase().contains("hairball") => Vec::new(),
            TableName::Hairball => SAMPLINGS.map(|n| pair(Variant::AsIs, 0.0, options.size.0, n)).to_vec(),
            TableName::Resolutions => {
                let sizes = options.table5_sizes.iter();
                sizes.flat_map(|side| SAMPLINGS.map(|n| pair(Variant::AsIs, 0.0, [*side; 2], n))).collect()
            }
            TableName::Missing => {
                let size = options.size.0;
                let rungs = missing::rungs(base, size);
                vec![Self { tables: vec![table], variant: Variant::AsIs, turn: 0.0, shown: size, rungs }]
            }
            TableName::Phones => {
                let (shown, rungs) = (prediction::SIZE, prediction::rungs(base));
                vec![Self { tables: vec![table], variant: Variant::AsIs, turn: 0.0, shown, rungs }]
            }
        }
    }

    fn renders_as(&self, other: &Self) -> bool {
        let what = |job: &Self| (job.variant, job.turn, job.shown);
        what(self) == what(other) && self.rungs == other.rungs
    }

    /// The ladder, which is measured against the converged frame.
    pub fn is_ladder(&self) -> bool {
        self.tables.is_empty()
    }

    /// The rungs are searched for the objects that the first one shows.
    pub fn counts_missing(&self) -> bool {
        self.tables.contains(&TableName::Missing)
    }

    /// What the rungs ask of a device is counted.
    pub fn counts_work(&self) -> bool {
        self.tables.contains(&TableName::Phones)
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

    /// The identity of each rung, for a program on an adapter.
    pub fn identities(&self, program: &str, adapter: &str, scene: &Prepared) -> anyhow::Result<Vec<String>> {
        let of = |(index, rung): (usize, &Rung)| {
            let against = match index {
                _ if self.is_ladder() => "converged",
                _ if self.counts_missing() => "full and its objects",
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
        let rung = Rung {
            name: "converged".to_owned(),
            family: Family::Fixed,
            settings: ladder::converged(base),
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
    let rung = |name: &str, family, method, keeps_picture| Rung {
        name: name.to_owned(),
        family,
        settings: Settings { method, ..*base },
        rendered: size,
        keeps_picture,
    };
    vec![
        rung("full", Family::Fixed, Method::Full, true),
        rung("adaptive", Family::Tolerances, Method::Adaptive, false),
    ]
}

impl Rung {
    /// Samples that take the time of one frame: the other methods trace half of them, or what costs as much.
    pub fn samples(&self) -> u64 {
        let [width, height] = self.rendered.map(u64::from);
        let samples = width * height * u64::from(self.settings.sampling).pow(2);
        if self.settings.method == Method::Full { samples } else { samples.div_ceil(2) }
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use glimpse::Missing;

    use super::*;
    use crate::args::{Arguments, Command};
    use crate::report::record::tests::example;

    fn jobs(line: &str, scene: &str) -> Vec<Job> {
        let line = format!("glimpse report {scene} -o out {line}");
        let command = Arguments::try_parse_from(line.split_whitespace()).unwrap().command;
        let Some(Command::Report(options)) = command else { panic!("{line}") };
        let mut prepared = Prepared::new("builtin:minray", None).unwrap();
        prepared.name = scene.to_owned();
        Job::all(&options, &Settings::default(), &prepared)
    }

    #[test]
    fn what_two_tables_show_is_one_job() {
        let jobs = jobs("--tables 5,3a,3c,5", "a.glb");
        assert_eq!(jobs.len(), 1 + 2 * 3 + 4);
        let shared: Vec<_> = jobs.iter().filter(|job| job.tables.len() > 1).collect();
        assert!(jobs[0].is_ladder() && shared.iter().any(|job| job.tables.contains(&TableName::Kernels)));
        let square = shared.iter().find(|job| job.tables.contains(&TableName::Views)).unwrap();
        assert_eq!((square.shown, square.turn), ([1024, 1024], 0.0));
    }

    #[test]
    fn tables_have_their_rows_and_no_others() {
        assert_eq!(jobs("--tables none", "a.glb").len(), 1);
        assert_eq!(jobs("--tables 4", "a.glb").len(), 1);
        assert_eq!(jobs("--tables 4", "x/Hairball_2.glb").len(), 1 + 3);
        assert_eq!(jobs("--tables 5 --table5-sizes 64,128,256", "a.glb").len(), 1 + 9);
        let changed = jobs("--tables 3b,3a", "a.glb");
        assert_eq!(changed.len(), 1 + 5 + 1);
        assert!(changed[..2].iter().all(|job| job.variant == Variant::AsIs), "uploads are few");
    }

    #[test]
    fn missing_objects_are_one_job_of_the_reports_size() {
        let jobs = jobs("--tables missing,5 --size 64x32 --table5-sizes 64", "a.glb");
        let counting: Vec<_> = jobs.iter().filter(|job| job.counts_missing()).collect();
        assert_eq!((jobs.len(), counting.len()), (1 + 1 + 3, 1));
        assert_eq!((counting[0].shown, counting[0].rungs.len()), ([64, 32], 1 + 2 * 3));
        assert!(!counting[0].is_ladder() && counting[0].variant == Variant::AsIs);
    }

    #[test]
    fn records_that_count_no_missing_objects_are_no_use_where_those_are_shown() {
        let without = example("r", 10.0, Some(40.0));
        let with = Record { missing: Some(Missing::default()), ..without.clone() };
        let jobs = jobs("--tables missing,3a", "a.glb");
        let [ladder, counting, kernels] = jobs.as_slice() else { panic!("{jobs:?}") };
        assert!(counting.accepts(0, &without), "full tracing is what objects are counted against");
        assert!(counting.accepts(1, &with) && !counting.accepts(1, &without));
        assert!(ladder.accepts(1, &without) && kernels.accepts(1, &without));
    }

    #[test]
    fn predictions_are_one_job_of_their_own_size_whose_work_is_counted() {
        let jobs = jobs("--tables phones --size 64x32", "a.glb");
        let [ladder, counting] = jobs.as_slice() else { panic!("{jobs:?}") };
        assert!(counting.counts_work() && !ladder.counts_work());
        assert_eq!((counting.shown, counting.rungs.len()), (prediction::SIZE, 4));
        let without = example("r", 10.0, Some(40.0));
        assert!(
            ladder.accepts(1, &without) && !counting.accepts(1, &without) && !counting.accepts(0, &without)
        );
    }

    #[test]
    fn every_setting_has_an_identity_of_its_own() {
        let scene = Prepared::new("builtin:minray", None).unwrap();
        let mut all: Vec<_> = jobs("--tables 3a,3b,3c,4,5,missing,phones", "hairball.glb")
            .iter()
            .flat_map(|job| job.identities("p", "a", &scene).unwrap())
            .collect();
        let count = all.len();
        all.sort();
        all.dedup();
        assert_eq!(all.len(), count);
    }
}
