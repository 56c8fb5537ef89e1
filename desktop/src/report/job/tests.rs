//! What is measured for which table.

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
    assert!(ladder.accepts(1, &without) && !counting.accepts(1, &without) && !counting.accepts(0, &without));
}

#[test]
fn jins_tables_are_jobs_of_the_reports_size_against_its_converged_frame() {
    let jobs = jobs("--tables jin2,jin7,5 --size 64x32 --table5-sizes 64", "a.glb");
    let against: Vec<_> = jobs.iter().filter(|job| job.is_against_converged()).collect();
    let [ladder, table, figure] = against.as_slice() else { panic!("{jobs:?}") };
    assert!(ladder.is_ladder() && !table.is_ladder() && !figure.is_ladder());
    assert_eq!((table.rungs.len(), figure.rungs.len(), jobs.len()), (11, 8, 3 + 3));
    let scene = Prepared::new("builtin:minray", None).unwrap();
    let converged = |job: &Job| (job.shown, job.converged("p", &scene, &Settings::default()).unwrap().1);
    assert_eq!(converged(ladder).0, [64, 32]);
    assert!(converged(ladder) == converged(table) && converged(table) == converged(figure));
}

#[test]
fn every_setting_has_an_identity_of_its_own() {
    let scene = Prepared::new("builtin:minray", None).unwrap();
    let mut all: Vec<_> = jobs("--tables 3a,3b,3c,4,5,missing,phones,jin2,jin7", "hairball.glb")
        .iter()
        .flat_map(|job| job.identities("p", "a", &scene).unwrap())
        .collect();
    let count = all.len();
    all.sort();
    all.dedup();
    assert_eq!(all.len(), count);
}
