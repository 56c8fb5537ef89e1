//! `glimpse bench`: the methods' times, interleaved in one run.

use glimpse::{Gpu, Settings};

use crate::args::{BenchOptions, MethodName, Size};
use crate::measure::{Plan, Run, Stage};
use crate::output;
use crate::pan::{self, Pan};
use crate::progress::Progress;
use crate::scene_file;
use crate::statistics::Statistics;
use crate::summary;

/// `glimpse bench`
pub fn run(options: &BenchOptions, adapter: Option<&str>) -> anyhow::Result<()> {
    let rows = rows(options)?;
    let methods: Vec<_> = rows.iter().map(|row| row.settings).collect();
    options.scenes.iter().try_for_each(|name| scene_file::check(name))?;
    let Size(size) = options.frame.size;
    let against = rows.iter().map(|row| methods.iter().position(|full| *full == row.baseline)).collect();
    let pan = options.pan.map(|degrees| Pan { degrees, against });
    let plan = Plan { size, methods: &methods, frames: options.frames, linear: false, pan };
    let gpu = Gpu::headless(adapter)?;
    let mut all = Vec::new();
    for (index, name) in options.scenes.iter().enumerate() {
        let progress = Progress::new(plan.steps());
        let stage = Stage::set(&gpu, name, &options.frame, &progress)?;
        let runs = plan.measure(&stage, &progress)?;
        let of_row = |(row, run): (&Row, &Run)| {
            let full = methods.iter().position(|full| *full == row.baseline);
            Ok((row.name.clone(), Statistics::of(&stage, size, run, full.map(|index| &runs[index]))?))
        };
        let statistics = rows.iter().zip(&runs).map(of_row).collect::<glimpse::Result<Vec<_>>>()?;
        drop(progress);
        if !options.json {
            let gap = if index > 0 { "\n" } else { "" };
            output::print(&format!("{gap}{}", table(&statistics)))?;
        }
        all.extend(statistics.into_iter().map(|(_, statistics)| statistics));
    }
    if options.json { output::print(&output::json(&all)?) } else { Ok(()) }
}

/// What does not concern `full`: it is measured once for all values of these.
const OF_OTHERS: [&str; 7] = ["block", "postcorrect", "t-pos", "t-norm", "t-tex", "t-gcol", "share"];

/// What is measured, and against what.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    /// The method and what was varied.
    name: String,
    settings: Settings,
    /// `full` with the same of everything that concerns it.
    baseline: Settings,
}

/// Every method with every combination of what is varied, each once.
fn rows(options: &BenchOptions) -> glimpse::Result<Vec<Row>> {
    let wrong = |reason| glimpse::Error::setting("--vary", reason);
    let combinations = options.frame.combinations(&options.vary).map_err(wrong)?;
    let mut rows: Vec<Row> = Vec::new();
    for method in &options.methods {
        for (frame, varied) in &combinations {
            let mut concerned = options.frame.clone();
            for (option, value) in varied.iter().filter(|(option, _)| !OF_OTHERS.contains(&option.as_str())) {
                concerned = concerned.with(option, value).map_err(wrong)?;
            }
            let full = *method == MethodName::Full;
            let settings = if full { concerned.settings(*method)? } else { frame.settings(*method)? };
            let told = |(option, _): &&(String, String)| !full || !OF_OTHERS.contains(&option.as_str());
            let varied: String =
                varied.iter().filter(told).map(|(option, value)| format!(" {option}={value}")).collect();
            let name = format!("{}{varied}", summary::method_name(settings.method));
            if rows.iter().all(|row| row.settings != settings) {
                rows.push(Row { name, settings, baseline: concerned.settings(MethodName::Full)? });
            }
        }
    }
    Ok(rows)
}

/// One scene: a line for each row, then a line for each of its passes.
fn table(rows: &[(String, Statistics)]) -> String {
    let Some((_, first)) = rows.first() else { return String::new() };
    let mut text = summary::scene(&first.scene);
    text += &summary::row("adapter", &summary::adapter(first));
    let [width, height] = first.size;
    text += &summary::row(
        "frame",
        &format!(
            "{width}x{height}, camera {}, medians of {} after warm-up, {} clock",
            first.settings.camera,
            output::counted(first.frames, "frame"),
            first.time_ms.clock
        ),
    );
    let heads =
        ["ms", "p95", "RT ratio", "work", "speedup", "eff.", "cost eff.", "overhead", "PSNR/dB", "Mrays/s"];
    let column = rows.iter().map(|(name, _)| name.len() + 1).max().unwrap_or(0).max(10);
    text += &line(column, "method", &heads.map(str::to_owned));
    for (name, statistics) in rows {
        text += &line(column, name, &cells(statistics));
    }
    for (name, statistics) in rows {
        for pass in &statistics.time_ms.passes {
            let share = 100.0 * pass.median / statistics.time_ms.frame.median;
            let name = format!("{name} {}", pass.name);
            text += &format!("{name:<width$}{:>10.3} ms {share:>5.1} %\n", pass.median, width = column + 14);
        }
    }
    text += &pan::table(column, rows);
    for (name, missing) in rows.iter().filter_map(|(name, s)| Some((name, s.missing?))) {
        if missing.pixels_lost > 0 {
            text += &format!("{name:<column$} loses {}\n", summary::missing(&missing));
        }
    }
    text
}

fn cells(s: &Statistics) -> [String; 10] {
    let ratio = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |v| format!("{v:.3}"));
    let psnr = s.error.map_or_else(
        || "-".to_owned(),
        |e| e.report.psnr_db.map_or_else(|| "infinite".to_owned(), |db| format!("{db:.2}")),
    );
    [
        format!("{:.2}", s.time_ms.frame.median),
        format!("{:.2}", s.time_ms.frame.p95),
        ratio(Some(s.rt_ratio)),
        ratio(s.cost.traced_share),
        ratio(s.gain.map(|g| g.speedup)),
        ratio(s.gain.map(|g| g.efficiency)),
        ratio(s.gain.map(|g| g.cost_efficiency)),
        ratio(s.non_tracing_share.map(|share| share.max(0.0))),
        psnr,
        format!("{:.2}", s.mrays_per_s),
    ]
}

fn line(column: usize, name: &str, cells: &[String]) -> String {
    let cells: String = cells.iter().map(|cell| format!("{cell:>10}")).collect();
    format!("{name:<column$}{cells}\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::FrameOptions;
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

    fn bench(methods: &[MethodName], vary: &[&str]) -> BenchOptions {
        BenchOptions {
            scenes: vec![],
            frame: FrameOptions { block: 4, ..FrameOptions::default() },
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
        let options = bench(&[MethodName::Full, MethodName::Full, MethodName::Adaptive], &[]);
        assert_eq!(names(&options), ["full", "adaptive"]);
    }

    #[test]
    fn every_combination_is_a_row_and_full_stands_once_for_what_concerns_it() {
        let options = bench(&[MethodName::Full, MethodName::Adaptive], &["features=auto,all", "block=2,8"]);
        assert_eq!(
            names(&options),
            [
                "full features=auto",
                "full features=all",
                "adaptive features=auto block=2",
                "adaptive features=auto block=8",
                "adaptive features=all block=2",
                "adaptive features=all block=8",
            ]
        );
        let rows = rows(&options).unwrap();
        assert_eq!(rows.iter().map(|row| row.settings.block).collect::<Vec<_>>(), [4, 4, 2, 8, 2, 8]);
        for row in &rows {
            assert_eq!(row.baseline.features, row.settings.features);
            assert!(rows.iter().any(|full| full.settings == row.baseline), "{row:?}");
        }
    }

    #[test]
    fn a_value_that_no_frame_can_have_is_wrong_usage() {
        let error = rows(&bench(&[MethodName::Adaptive], &["block=2,3"])).unwrap_err();
        assert!(matches!(&error, glimpse::Error::Setting { .. }), "{error}");
        assert!(error.to_string().contains("--block"), "{error}");
    }
}
