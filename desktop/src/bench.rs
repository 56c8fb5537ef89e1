//! `glimpse bench`: compares the times of methods, interleaved in one run.

use glimpse::{Gpu, Method, options};

use crate::args::{BenchOptions, FrameOptions, Size};
use crate::cpu_tracer;
use crate::errors::Usage;
use crate::focus::FrameRequest;
use crate::measure::{Plan, Run, Workbench};
use crate::output::{self, Verbosity};
use crate::pan::{self, Pan};
use crate::progress::Progress;
use crate::scene_file;
use crate::statistics::Statistics;
use crate::summary;

/// Runs `glimpse bench`.
pub fn run(options: &BenchOptions, adapter: Option<&str>, verbosity: Verbosity) -> anyhow::Result<()> {
    let rows = rows(options)?;
    let requests: Vec<_> = rows.iter().map(|row| row.request.clone()).collect();
    cpu_tracer::check(&requests, options.frames)?;
    options.scenes.iter().try_for_each(scene_file::check)?;
    options.frame.environment.surroundings().check()?;
    let Size(size) = options.size;
    let against = rows.iter().map(|row| rows.iter().position(|full| full.request == row.baseline)).collect();
    let pan = options.pan.map(|degrees| Pan { degrees, against });
    let plan = Plan { size, frames: options.frames, linear: false, pan };
    let gpu = Gpu::headless(adapter)?;
    let mut all = Vec::new();
    for (index, name) in options.scenes.iter().enumerate() {
        let progress = Progress::new(verbosity, plan.steps(requests.len()));
        let workbench = Workbench::set(&gpu, name, &options.frame, &requests, &progress)?;
        let runs = plan.measure(&workbench, &progress)?;
        let of_row = |(row, run): (&Row, &Run)| {
            let full = rows.iter().position(|full| full.request == row.baseline);
            // Pictures of two eyes cannot be compared with a picture of one.
            let full = full.map(|index| &runs[index]);
            let full = full.filter(|full| full.picture.dimensions() == run.picture.dimensions());
            Ok((row.name.clone(), Statistics::of(&workbench, run, full)?))
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

/// A row of the table: what is measured and what it is compared with.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    /// Name of the method followed by the varied options.
    name: String,
    request: FrameRequest,
    /// Method `full` with the same values of the options that affect it.
    baseline: FrameRequest,
}

/// Every method with every combination of the varied values, without duplicates.
fn rows(options: &BenchOptions) -> anyhow::Result<Vec<Row>> {
    let combinations = options.frame.combinations(&options.vary).map_err(not_varied)?;
    // Methods other than path tracing ignore --cpu-threads and are measured without it.
    let threads = options.frame.typed.settings(Method::Path)?.paths.cpu_threads;
    if threads > 0 && !options.methods.iter().any(|method| method.is_path_traced()) {
        let expected = "path or vr among --methods: no other adds samples up";
        return Err(glimpse::Error::setting("cpu-threads", expected, threads.to_string()).into());
    }
    let mut rows: Vec<Row> = Vec::new();
    for method in &options.methods {
        for combination in &combinations {
            let (request, varied) = applicable(&options.frame, combination, *method)?;
            let (baseline, _) = applicable(&options.frame, combination, Method::Full)?;
            let name = format!("{}{varied}", summary::method_name(request.settings.method));
            if rows.iter().all(|row| row.request != request) {
                rows.push(Row { name, request, baseline });
            }
        }
    }
    Ok(rows)
}

/// Request for a method with the varied options that affect it, and these options as text. Options without
/// effect on the method are dropped, so that it is measured once for all their values.
fn applicable(
    options: &FrameOptions,
    (combination, varied): &(FrameOptions, Vec<(String, String)>),
    method: Method,
) -> anyhow::Result<(FrameRequest, String)> {
    let settings = combination.settings_beside(method)?;
    let (mut applicable, mut told) = (options.clone(), String::new());
    for (option, value) in varied {
        if !options::find(option)?.applies(&settings) {
            continue;
        }
        applicable = applicable.with(option, value).map_err(not_varied)?;
        told += &format!(" {option}={value}");
    }
    Ok((FrameRequest::beside(&applicable, method)?, told))
}

fn not_varied(reason: String) -> Usage {
    Usage(format!("--vary: {reason}"))
}

/// Table of one scene: a line for each row, then a line for each pass.
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
    for (name, sides) in rows.iter().filter_map(|(name, s)| Some((name, s.sides.as_ref()?))) {
        text += &format!("{name:<column$} {}\n", summary::sides(sides));
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
#[path = "bench_tests.rs"]
mod tests;
