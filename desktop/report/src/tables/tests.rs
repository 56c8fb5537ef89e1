//! Tests of the list of tables, and of the jobs of each.

use glimpse::{Missing, Settings};

use super::*;
use crate::record::Record;
use crate::record::tests::example;
use crate::subject::Prepared;
use crate::table::{Content, square_sides};

/// Jobs of the tables for a scene of that name with frames of 64x32 pixels.
fn jobs(tables: &[&str], scene: &str, table5_sizes: &[u32]) -> Vec<Job> {
    let mut prepared = Prepared::new("builtin:minray", None).unwrap();
    prepared.name = scene.to_owned();
    let base = Settings::default();
    let request = Request { base: &base, size: [64, 32], table5_sizes, table3_side: 1024, scene: &prepared };
    let tables: Vec<_> = tables.iter().map(|name| named(name).unwrap()).collect();
    super::jobs(&tables, &request)
}

#[test]
fn squares_are_the_papers_at_the_usual_size_and_grow_with_it() {
    let sides = [[960, 540], [160, 90], [90, 160], [1, 1], [2560, 1440]].map(square_sides);
    assert_eq!(sides, [[512, 1024], [64, 128], [64, 128], [1, 2], [1024, 2048]]);
}

#[test]
fn tables_are_asked_for_by_names_of_their_own() {
    for (index, table) in TABLES.iter().enumerate() {
        assert_eq!(named(&table.name().to_uppercase()).unwrap().name(), table.name());
        assert!(TABLES[..index].iter().all(|other| other.name() != table.name()), "{}", table.name());
        assert!(!table.summary().is_empty() && table.name() != "none", "{}", table.name());
    }
    assert!(named("6").is_none());
}

#[test]
fn every_table_measures_what_it_shows() {
    for table in TABLES {
        let jobs = jobs(&[table.name()], "hairball.glb", &[64]);
        assert!(jobs.len() > 1, "{} measures nothing", table.name());
        for job in &jobs[1..] {
            assert!(job.tables == [table.name()] && !job.rungs.is_empty(), "{}", table.name());
            assert!(job.rungs.iter().all(|rung| rung.settings.validate().is_ok()), "{}", table.name());
        }
    }
}

#[test]
fn published_rows_have_the_tables_columns() {
    for table in TABLES {
        let Content::Rows(rows) = table.content(&[]) else { continue };
        assert!(rows.measured.is_empty(), "{}: nothing was measured", table.name());
        assert!(rows.published.iter().all(|row| row.len() == rows.head.len()), "{}", table.name());
        assert!(rows.published.is_empty() || !rows.citation.is_empty(), "{}", table.name());
    }
}

#[test]
fn what_two_tables_show_is_one_job() {
    let jobs = jobs(&["5", "3a", "3c"], "a.glb", &[512, 1024]);
    assert_eq!(jobs.len(), 1 + 2 * 3 + 4);
    let shared: Vec<_> = jobs.iter().filter(|job| job.tables.len() > 1).collect();
    assert!(jobs[0].is_ladder() && shared.iter().any(|job| job.shows("3a")));
    let square = shared.iter().find(|job| job.shows("3c")).unwrap();
    assert_eq!((square.shown, square.turn), ([1024, 1024], 0.0));
}

#[test]
fn tables_have_their_rows_and_no_others() {
    assert_eq!(jobs(&[], "a.glb", &[]).len(), 1);
    assert_eq!(jobs(&["4"], "a.glb", &[]).len(), 1);
    assert_eq!(jobs(&["4"], "x/Hairball_2.glb", &[]).len(), 1 + 3);
    assert_eq!(jobs(&["5"], "a.glb", &[64, 128, 256]).len(), 1 + 9);
    let changed = jobs(&["3b", "3a"], "a.glb", &[]);
    assert_eq!(changed.len(), 1 + 5 + 1);
    assert!(changed[..2].iter().all(|job| job.variant == Variant::AsIs), "uploads are few");
}

#[test]
fn missing_objects_are_one_job_of_the_reports_size() {
    let jobs = jobs(&["missing", "5"], "a.glb", &[64]);
    let counting: Vec<_> = jobs.iter().filter(|job| job.counts_missing).collect();
    assert_eq!((jobs.len(), counting.len()), (1 + 1 + 3, 1));
    assert_eq!((counting[0].shown, counting[0].rungs.len()), ([64, 32], 1 + 2 * 3));
    assert!(!counting[0].is_ladder() && counting[0].variant == Variant::AsIs);
}

#[test]
fn records_that_count_no_missing_objects_are_no_use_where_those_are_shown() {
    let without = example("r", 10.0, Some(40.0));
    let with = Record { missing: Some(Missing::default()), ..without.clone() };
    let jobs = jobs(&["missing", "3a"], "a.glb", &[]);
    let [ladder, counting, kernels] = jobs.as_slice() else { panic!("{jobs:?}") };
    assert!(counting.accepts(0, &without), "full tracing is what objects are counted against");
    assert!(counting.accepts(1, &with) && !counting.accepts(1, &without));
    assert!(ladder.accepts(1, &without) && kernels.accepts(1, &without));
}

#[test]
fn predictions_are_one_job_of_their_own_size_whose_work_is_counted() {
    let jobs = jobs(&["phones"], "a.glb", &[]);
    let [ladder, counting] = jobs.as_slice() else { panic!("{jobs:?}") };
    assert!(counting.counts_work && !ladder.counts_work);
    assert_eq!((counting.shown, counting.rungs.len()), ([2560, 1440], 4));
    let without = example("r", 10.0, Some(40.0));
    assert!(ladder.accepts(1, &without) && !counting.accepts(1, &without) && !counting.accepts(0, &without));
}

#[test]
fn jins_tables_are_jobs_of_the_reports_size_against_its_converged_frame() {
    let jobs = jobs(&["jin2", "jin7", "5"], "a.glb", &[64]);
    let against: Vec<_> = jobs.iter().filter(|job| job.is_against_converged()).collect();
    let [ladder, table, figure] = against.as_slice() else { panic!("{jobs:?}") };
    assert!(ladder.is_ladder() && !table.is_ladder() && !figure.is_ladder());
    assert_eq!((table.rungs.len(), figure.rungs.len(), jobs.len()), (11, 8, 3 + 3));
    let scene = Prepared::new("builtin:minray", None).unwrap();
    let converged = |job: &Job| (job.shown, job.converged("p", &scene).unwrap().unwrap().1);
    assert_eq!(converged(ladder).0, [64, 32]);
    assert!(converged(ladder) == converged(table) && converged(table) == converged(figure));
}

#[test]
fn every_setting_has_an_identity_of_its_own() {
    let scene = Prepared::new("builtin:minray", None).unwrap();
    let mut all: Vec<_> = jobs(&TABLES.map(|table| table.name()), "hairball.glb", &[512, 1024])
        .iter()
        .flat_map(|job| job.identities("p", "a", &scene).unwrap())
        .collect();
    let count = all.len();
    all.sort();
    all.dedup();
    assert_eq!(all.len(), count);
}
