//! Tests of the measured rows and the table.

use super::*;
use crate::args::{FrameOptions, Size};
use crate::statistics::tests::example;

#[test]
fn the_table_has_aligned_columns_and_every_pass() {
    let text = table(&[("adaptive".to_owned(), example()), ("adaptive".to_owned(), example())]);
    let lines: Vec<_> = text.lines().collect();
    let head = lines.iter().position(|l| l.starts_with("method")).unwrap();
    assert!(lines[head].ends_with("Mrays/s"));
    for row in &lines[head + 1..head + 3] {
        assert_eq!(row.len(), lines[head].len());
        assert!(row.contains("10.00") && row.contains("0.340") && row.contains("48.13"), "{row}");
    }
    assert!(text.contains("adaptive resolve             2.000 ms  20.0 %"), "{text}");
}

#[test]
fn without_full_there_is_nothing_to_compare() {
    let mut alone = example();
    (alone.gain, alone.error, alone.cost.traced_share) = (None, None, None);
    assert_eq!(cells(&alone).iter().filter(|c| *c == "-").count(), 5);
}

fn bench(methods: &[Method], vary: &[&str]) -> BenchOptions {
    BenchOptions {
        scenes: vec![],
        size: Size([4, 3]),
        frame: FrameOptions::default().with("block", "4").unwrap(),
        methods: methods.to_vec(),
        vary: vary.iter().map(|text| text.parse().unwrap()).collect(),
        frames: 1,
        pan: None,
        json: false,
    }
}

fn names(options: &BenchOptions) -> Vec<String> {
    rows(options).unwrap().into_iter().map(|row| row.name).collect()
}

#[test]
fn a_method_named_twice_is_measured_once() {
    let options = bench(&[Method::Full, Method::Full, Method::Adaptive], &[]);
    assert_eq!(names(&options), ["full", "adaptive"]);
}

#[test]
fn every_combination_is_a_row_and_full_stands_once_for_what_concerns_it() {
    let options = bench(&[Method::Full, Method::Adaptive], &["specialize=auto,all", "block=2,8"]);
    assert_eq!(
        names(&options),
        [
            "full specialize=auto",
            "full specialize=all",
            "adaptive specialize=auto block=2",
            "adaptive specialize=auto block=8",
            "adaptive specialize=all block=2",
            "adaptive specialize=all block=8",
        ]
    );
    let rows = rows(&options).unwrap();
    assert_eq!(rows.iter().map(|row| row.request.settings.block).collect::<Vec<_>>(), [4, 4, 2, 8, 2, 8]);
    for row in &rows {
        assert_eq!(row.baseline.settings.specialize, row.request.settings.specialize);
        assert!(rows.iter().any(|full| full.request == row.baseline), "{row:?}");
    }
}

#[test]
fn methods_stand_once_for_what_they_do_not_heed() {
    let all = [Method::Full, Method::Adaptive, Method::Supersample, Method::Quincunx];
    for (vary, applying) in [
        ("tau-col=0.1,0.2", &["supersample"][..]),
        ("tau-ste=0.1,0.2", &["supersample"]),
        ("preset=edges,textures", &["supersample"]),
        ("focus=chair,lamp", &["supersample"]),
        ("refine=off,on", &["supersample"]),
        ("unsampled=nearest,bilinear", &["supersample"]),
        ("seed=1,2", &["supersample"]),
        ("quincunx-threshold=0.1,0.2", &["quincunx"]),
        ("t-pos=0.1,0.2", &["adaptive"]),
        ("supersample=false,true", &["adaptive"]),
        ("mip=on,off", &["full", "adaptive", "supersample", "quincunx"]),
    ] {
        let found = names(&bench(&all, &[vary]));
        let (option, values) = vary.split_once('=').unwrap();
        let expected = ["full", "adaptive", "supersample", "quincunx"].map(|method| {
            if !applying.contains(&method) {
                return vec![method.to_owned()];
            }
            values.split(',').map(|value| format!("{method} {option}={value}")).collect()
        });
        assert_eq!(found, expected.concat());
    }
    let mut combined = bench(&[Method::Full, Method::Adaptive], &["tau-col=0.1,0.2"]);
    combined.frame = combined.frame.with("supersample", "true").unwrap();
    assert_eq!(names(&combined), ["full", "adaptive tau-col=0.1", "adaptive tau-col=0.2"]);
    let jittered = bench(&[Method::Full], &["jitter=off,on", "seed=1,2"]);
    assert_eq!(names(&jittered), ["full jitter=off", "full jitter=on seed=1", "full jitter=on seed=2"]);
}

#[test]
fn a_value_that_no_frame_can_have_is_wrong_usage() {
    let error = rows(&bench(&[Method::Adaptive], &["block=2,3"])).unwrap_err();
    assert!(crate::errors::is_usage(&error), "{error}");
    assert!(crate::errors::told(&error).contains("--block"), "{error}");
}
