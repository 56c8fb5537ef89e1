//! `glimpse report`: error against run time, and the tables of Kim 2016 for other scenes.

mod bench;
mod complete;
mod eyes;
mod identity;
mod jin;
mod job;
mod ladder;
mod missing;
mod page;
mod pan;
mod paper;
mod pareto;
mod plot;
mod prediction;
mod record;
mod rows;
mod store;
mod subject;
mod tables;
mod upscale;

use std::path::Path;

use glimpse::{Gpu, Settings};

use crate::args::{ReportOptions, TableName};
use crate::progress::Progress;
use crate::statistics::AdapterStatistics;
use crate::{files, output, scene_file};

use bench::{Bench, Measured};
use job::Job;
use rows::Row;
use store::Store;
use subject::{Prepared, Subjects};

/// The file of the predictions for phones.
const PREDICTIONS: &str = "predictions.csv";

/// A scene with all that was measured of it.
pub struct SceneReport {
    /// The scene.
    pub prepared: Prepared,
    /// The name of its files.
    pub stem: String,
    /// By job: the ladder first.
    pub measured: Vec<Measured>,
    /// The ladder's rows, then those of the tables.
    pub rows: Vec<Row>,
}

/// Where and with what a report was made.
pub struct Header {
    /// Name and driver.
    pub adapter: String,
    /// What times are measured by.
    pub clock: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// Commit that it was built from.
    pub commit: &'static str,
    /// How it was called.
    pub command: String,
}

/// `glimpse report`
pub fn run(options: &ReportOptions, adapter: Option<&str>) -> anyhow::Result<()> {
    let base = options.recursion.settings(Settings::default().method)?;
    base.validate()?;
    options.scenes.iter().try_for_each(|name| scene_file::check(name))?;
    let mut names: Vec<&String> = Vec::new();
    for name in &options.scenes {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let scenes = names
        .iter()
        .map(|name| Prepared::new(name, options.camera.as_deref()))
        .collect::<anyhow::Result<Vec<_>>>()?;
    let store = Store::open(&options.output)?;
    let stems = stems(&names);
    let outputs: Vec<_> =
        outputs(&stems, &options.tables).into_iter().map(|name| options.output.join(name)).collect();
    files::check(outputs.iter().map(AsRef::as_ref), Path::new(""))?;
    let gpu = Gpu::headless(adapter)?;
    let header = Header::new(&gpu);
    let bench = Bench {
        gpu: &gpu,
        adapter: header.adapter.clone(),
        program: identity::program()?.to_string(),
        store: &store,
        frames: options.frames as usize,
        base,
    };
    let measured = measure(&bench, options, &scenes)?;
    let reports: Vec<_> = scenes
        .into_iter()
        .zip(stems)
        .zip(measured)
        .map(|((prepared, stem), measured)| {
            let rows = rows::of(&prepared.name, &measured);
            SceneReport { prepared, stem, measured, rows }
        })
        .collect();
    write(options, &header, &store, &reports)
}

fn measure(
    bench: &Bench<'_>,
    options: &ReportOptions,
    scenes: &[Prepared],
) -> anyhow::Result<Vec<Vec<Measured>>> {
    let mut known = Vec::new();
    for scene in scenes {
        let jobs = Job::all(options, &bench.base, scene).into_iter();
        known.push(jobs.map(|job| bench.recall(scene, job)).collect::<anyhow::Result<Vec<_>>>()?);
    }
    let all = || known.iter().flatten();
    let [complete, total] =
        all().map(|k| k.complete(bench.frames)).fold([0, 0], |a, b| [a[0] + b[0], a[1] + b[1]]);
    if complete > 0 {
        output::print(&format!(
            "{complete} of {} are in {} already: going on from there\n",
            output::counted(total, "measurement"),
            options.output.display()
        ))?;
    }
    let progress = Progress::of_work(all().map(|k| k.work(bench.frames)).sum());
    let mut measured = Vec::new();
    for (scene, jobs) in scenes.iter().zip(known) {
        let mut subjects = Subjects::new(bench.gpu, scene);
        let jobs = jobs.into_iter().map(|known| bench.measure(&mut subjects, scene, known, &progress));
        measured.push(jobs.collect::<anyhow::Result<Vec<_>>>()?);
    }
    Ok(measured)
}

fn write(
    options: &ReportOptions,
    header: &Header,
    store: &Store,
    scenes: &[SceneReport],
) -> anyhow::Result<()> {
    let into = |name: &str, bytes: &[u8]| files::write(&options.output.join(name), bytes);
    let rows: Vec<_> = scenes.iter().flat_map(|scene| &scene.rows).collect();
    into("report.csv", &rows::csv(&rows)?)?;
    for scene in scenes {
        for axis in plot::Axis::ALL {
            into(&axis.file(&scene.stem), plot::svg(scene, axis).as_bytes())?;
        }
        for (table, what) in plot::OF_TABLES {
            if let Some(svg) = plot::table_svg(scene, table) {
                into(&plot::table_file(&scene.stem, what), svg.as_bytes())?;
            }
        }
    }
    let predictions = prediction::of(scenes);
    if let Some(predictions) = &predictions {
        let rows = predictions.as_ref().map_or(&[][..], |predictions| &predictions.rows);
        into(PREDICTIONS, &prediction::csv(rows)?)?;
    }
    into("report.html", page::html(header, store, scenes, predictions.as_ref())?.as_bytes())?;
    let mut text = String::new();
    for scene in scenes {
        text += &format!("{}: {}\n", scene.prepared.name, rows::verdict(&scene.rows));
    }
    output::print(&format!("{text}wrote {}\n", options.output.join("report.html").display()))
}

impl Header {
    fn new(gpu: &Gpu) -> Self {
        let facts = gpu.facts();
        let adapter = AdapterStatistics::of(&facts.info);
        Self {
            adapter: format!("{} ({}, {})", adapter.name, adapter.backend, adapter.driver),
            clock: if facts.timestamps { "GPU timestamps" } else { "CPU clock" },
            version: env!("CARGO_PKG_VERSION"),
            commit: option_env!("GLIMPSE_COMMIT").unwrap_or("unknown"),
            command: std::env::args().skip(1).fold("glimpse".to_owned(), |line, word| line + " " + &word),
        }
    }
}

/// What the files of each scene are called: the scene's own name, numbered where two are alike.
fn stems(scenes: &[&String]) -> Vec<String> {
    let plain = |name: &&String| {
        let path = Path::new(name.strip_prefix("builtin:").unwrap_or(name));
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        stem.chars().map(|c| if c.is_alphanumeric() || c == '-' { c } else { '_' }).collect::<String>()
    };
    let mut stems: Vec<String> = Vec::new();
    for plain in scenes.iter().map(plain) {
        let numbered = (2..).map(|n| format!("{plain}-{n}"));
        let free = std::iter::once(plain.clone()).chain(numbered).find(|stem| !stems.contains(stem));
        stems.extend(free);
    }
    stems
}

/// All files that will be written, by their names in the folder.
fn outputs(stems: &[String], tables: &[TableName]) -> Vec<String> {
    let plots = stems.iter().flat_map(|stem| plot::Axis::ALL.map(|axis| axis.file(stem)));
    let predictions = tables.contains(&TableName::Phones).then_some(PREDICTIONS);
    let fixed = ["report.csv", "report.html"].into_iter().chain(predictions);
    let of_tables = plot::OF_TABLES.into_iter().filter(|(table, _)| tables.contains(table));
    let of_tables =
        of_tables.flat_map(|(_, what)| stems.iter().map(move |stem| plot::table_file(stem, what)));
    fixed.map(str::to_owned).chain(plots).chain(of_tables).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_of_one_name_get_files_of_their_own() {
        let scenes = ["a/room.glb", "builtin:room", "b/my room!.gltf", "room.glb"].map(str::to_owned);
        let stems = stems(&scenes.each_ref());
        assert_eq!(stems, ["room", "room-2", "my_room_", "room-3"]);
        assert_eq!(outputs(&stems, &[TableName::Phones]).len(), 3 + 2 * 4);
        let mut names = outputs(&stems, &[]);
        assert_eq!(names.len(), 2 + 2 * 4);
        names.sort();
        names.dedup();
        assert_eq!(names.len(), 2 + 2 * 4);
    }
}
