//! `glimpse stress`: tests extreme scenes against the f64 reference.

use std::time::Instant;

use anyhow::bail;
use clap::ValueEnum;
use glimpse::stress::{Bench, CASES, Case, Outcome};
use glimpse::{Gpu, Robustness};
use glimpse_measure::statistics::AdapterStatistics;
use serde::Serialize;

use crate::args::{Measure, StressOptions};
use crate::output::{self, Verbosity, grouped};
use crate::progress::Progress;

/// A row of the table: the outcome of a case.
#[derive(Debug, Serialize)]
struct Row {
    case: &'static str,
    construction: &'static str,
    rule: &'static str,
    #[serde(flatten)]
    outcome: Outcome,
    passed: bool,
    seconds: f64,
}

#[derive(Debug, Serialize)]
struct Report {
    glimpse: &'static str,
    adapter: AdapterStatistics,
    seed: u64,
    rays: u64,
    /// Measures against rounding that were left out.
    without: Vec<String>,
    cases: Vec<Row>,
}

/// Runs `glimpse stress`.
pub fn run(options: &StressOptions, adapter: Option<&str>, verbosity: Verbosity) -> anyhow::Result<()> {
    if options.list {
        return output::print(&list());
    }
    let cases = chosen(&options.cases)?;
    let gpu = Gpu::headless(adapter)?;
    let left_out = |measure| options.without.contains(&measure);
    let bench = Bench {
        gpu: &gpu,
        rays: options.rays,
        seed: options.seed,
        robustness: Robustness {
            watertight: !left_out(Measure::Watertight),
            boxes: !left_out(Measure::Boxes),
            offset: !left_out(Measure::Offset),
        },
    };
    let progress = Progress::new(verbosity, cases.len() as u64);
    let mut rows = Vec::new();
    for case in cases {
        progress.doing(case.name);
        rows.push(measure(case, &bench)?);
        progress.step();
    }
    drop(progress);
    let report = Report {
        glimpse: env!("CARGO_PKG_VERSION"),
        adapter: AdapterStatistics::of(&gpu.facts().info),
        seed: options.seed,
        rays: options.rays,
        without: options.without.iter().map(name).collect(),
        cases: rows,
    };
    output::print(&if options.json { output::json(&report)? } else { table(&report) })?;
    let failed: Vec<_> = report.cases.iter().filter(|row| !row.passed).map(|row| row.case).collect();
    if failed.is_empty() { Ok(()) } else { bail!("these cases fail: {}", failed.join(", ")) }
}

fn name(measure: &Measure) -> String {
    measure.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

/// The cases, one per line.
fn list() -> String {
    let width = CASES.iter().map(|case| case.name.len()).max().unwrap_or_default();
    CASES.iter().map(|case| format!("{:width$}  {}\n", case.name, case.construction)).collect()
}

/// Cases of these names; all cases if there are no names.
fn chosen(names: &[String]) -> glimpse::Result<Vec<&'static Case>> {
    if names.is_empty() {
        return Ok(CASES.iter().collect());
    }
    let find = |name: &String| {
        CASES.iter().find(|case| case.name == name).ok_or_else(|| {
            let known: Vec<_> = CASES.iter().map(|case| case.name).collect();
            glimpse::Error::setting("cases", format!("one of {}", known.join(", ")), name)
        })
    };
    names.iter().map(find).collect()
}

fn measure(case: &Case, bench: &Bench<'_>) -> anyhow::Result<Row> {
    let start = Instant::now();
    let outcome = (case.run)(bench)?;
    Ok(Row {
        case: case.name,
        construction: case.construction,
        rule: case.rule,
        passed: outcome.failures == 0 && outcome.rays > 0,
        outcome,
        seconds: start.elapsed().as_secs_f64(),
    })
}

fn table(report: &Report) -> String {
    let AdapterStatistics { name, backend, driver } = &report.adapter;
    let mut text = format!("adapter   {name} ({backend}, {driver}), seed {}\n\n", report.seed);
    text += &format!("{:<12}{:>14}{:>10}{:>12}{:>9}\n", "case", "rays", "failures", "explained", "s");
    for row in &report.cases {
        let explained: u64 = row.outcome.explained.iter().map(|e| e.count).sum();
        text += &format!(
            "{:<12}{:>14}{:>10}{:>12}{:>9.1}\n",
            row.case,
            grouped(row.outcome.rays),
            grouped(row.outcome.failures),
            grouped(explained),
            row.seconds
        );
        for cause in &row.outcome.explained {
            text += &format!("            {} x {}\n", grouped(cause.count), cause.cause);
        }
        if let Some(digest) = &row.outcome.digest {
            text += &format!("            digest {digest}\n");
        }
        if let Some(worst) = &row.outcome.worst {
            text += &format!("            worst: {worst}\n");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_are_chosen_by_name() {
        let names = |cases: Vec<&Case>| cases.iter().map(|case| case.name).collect::<Vec<_>>();
        assert_eq!(chosen(&[]).unwrap().len(), CASES.len());
        assert_eq!(names(chosen(&["watertight".to_owned()]).unwrap()), ["watertight"]);
        let error = chosen(&["waterproof".to_owned()]).err().unwrap().to_string();
        assert!(error.contains("waterproof") && error.contains("watertight"), "{error}");
    }

    #[test]
    fn case_names_differ() {
        let mut names: Vec<_> = CASES.iter().map(|case| case.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), CASES.len());
    }
}
