//! `glimpse bench`: the methods' times, interleaved in one run.

use glimpse::{Gpu, Method, Settings};

use crate::args::{BenchOptions, Size};
use crate::measure::{Plan, Stage};
use crate::output;
use crate::progress::Progress;
use crate::scene_file;
use crate::statistics::Statistics;
use crate::summary;

/// `glimpse bench`
pub fn run(options: &BenchOptions, adapter: Option<&str>) -> anyhow::Result<()> {
    let methods = methods(options)?;
    options.scenes.iter().try_for_each(|name| scene_file::check(name))?;
    let Size(size) = options.frame.size;
    let plan = Plan { size, methods: &methods, frames: options.frames, linear: false };
    let gpu = Gpu::headless(adapter)?;
    let mut all = Vec::new();
    for (index, name) in options.scenes.iter().enumerate() {
        let progress = Progress::new(plan.steps());
        let stage = Stage::set(&gpu, name, &options.frame, &progress)?;
        let runs = plan.measure(&stage, &progress)?;
        let full = runs.iter().find(|run| run.settings.method == Method::Full);
        let statistics = runs
            .iter()
            .map(|run| Statistics::of(&stage, size, run, full))
            .collect::<glimpse::Result<Vec<_>>>()?;
        drop(progress);
        if !options.json {
            let gap = if index > 0 { "\n" } else { "" };
            output::print(&format!("{gap}{}", table(&statistics)))?;
        }
        all.extend(statistics);
    }
    if options.json { output::print(&output::json(&all)?) } else { Ok(()) }
}

/// The settings of each method, each once.
fn methods(options: &BenchOptions) -> glimpse::Result<Vec<Settings>> {
    let mut methods: Vec<Settings> = Vec::new();
    for name in &options.methods {
        let settings = options.frame.settings(*name)?;
        if !methods.contains(&settings) {
            methods.push(settings);
        }
    }
    Ok(methods)
}

/// One scene: a line for each method, then a line for each of its passes.
fn table(methods: &[Statistics]) -> String {
    let Some(first) = methods.first() else { return String::new() };
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
    text += &line("method", &heads.map(str::to_owned));
    for statistics in methods {
        text += &line(&summary::method(statistics), &cells(statistics));
    }
    for statistics in methods {
        for pass in &statistics.time_ms.passes {
            let share = 100.0 * pass.median / statistics.time_ms.frame.median;
            let name = format!("{} {}", summary::method(statistics), pass.name);
            text += &format!("{name:<24}{:>10.3} ms {share:>5.1} %\n", pass.median);
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

fn line(name: &str, cells: &[String]) -> String {
    let cells: String = cells.iter().map(|cell| format!("{cell:>10}")).collect();
    format!("{name:<10}{cells}\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{FrameOptions, MethodName};
    use crate::statistics::tests::example;

    #[test]
    fn the_table_has_aligned_columns_and_every_pass() {
        let text = table(&[example(), example()]);
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

    #[test]
    fn a_method_named_twice_is_measured_once() {
        let options = BenchOptions {
            scenes: vec![],
            frame: FrameOptions::default(),
            methods: vec![MethodName::Full, MethodName::Full, MethodName::Adaptive],
            frames: 1,
            json: false,
        };
        let methods: Vec<_> = methods(&options).unwrap().iter().map(|s| s.method).collect();
        assert_eq!(methods, [Method::Full, Method::Adaptive]);
    }
}
