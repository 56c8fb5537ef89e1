//! Makes a report: recalls stored results, measures what is missing, and writes the files.

use std::path::{Path, PathBuf};

use glimpse::{Gpu, Settings};
use glimpse_measure::output::Verbosity;
use glimpse_measure::progress::Progress;
use glimpse_measure::statistics::AdapterStatistics;
use glimpse_measure::{files, machine, output, scene_file};

use crate::bench::{Bench, Measured};
use crate::ladder::{self, Axis};
use crate::page::{self, Header};
use crate::scene::SceneReport;
use crate::store::Store;
use crate::subject::{Prepared, Subjects};
use crate::table::{Request, Table, plot_of, square_sides};
use crate::tables;
use crate::{identity, key, rows};

/// Options of a report.
pub struct Options {
    /// Scene files or `builtin:NAME`; duplicates are measured once.
    pub scenes: Vec<PathBuf>,
    /// Folder of all output and of the stored measurements, from which an interrupted run resumes.
    pub output: PathBuf,
    /// Frame size in pixels of the ladder and of tables without a size of their own.
    pub size: [u32; 2],
    /// Camera of each scene by index or name; `None` selects the first.
    pub camera: Option<String>,
    /// Recursion and features that all settings share.
    pub base: Settings,
    /// Number of timed frames of each setting.
    pub frames: usize,
    /// Tables to measure.
    pub tables: Vec<&'static dyn Table>,
    /// Sides of the square frames of Kim 2016's table 5, in pixels; `None` for two that follow from the frame size.
    pub table5_sizes: Option<Vec<u32>>,
    /// The program, as the page names it.
    pub program: Program,
    /// What is printed beside the report.
    pub verbosity: Verbosity,
}

/// Version and command line of the program, as the page shows them.
pub struct Program {
    /// Version.
    pub version: String,
    /// Git commit.
    pub commit: String,
    /// Command line.
    pub command: String,
}

/// Makes a report on the best adapter, or the best whose name contains `adapter`.
///
/// # Errors
/// Fails for settings, scenes or files that cannot be used, all checked before measuring, and if the device
/// fails.
pub fn run(options: &Options, adapter: Option<&str>) -> anyhow::Result<()> {
    options.base.validate()?;
    options.scenes.iter().try_for_each(scene_file::check)?;
    let mut names: Vec<&PathBuf> = Vec::new();
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
    files::check(&outputs.iter().map(AsRef::as_ref).collect::<Vec<_>>(), &[])?;
    let gpu = Gpu::headless(adapter)?;
    let header = header(options, &gpu);
    let bench = Bench {
        gpu: &gpu,
        adapter: format!("{}, {}", header.adapter, header.cpu),
        program: identity::program()?.to_string(),
        store: &store,
        frames: options.frames,
    };
    let measured = measure(&bench, options, &scenes)?;
    let reports: Vec<_> = scenes
        .into_iter()
        .zip(stems)
        .zip(measured)
        .map(|((prepared, stem), measured)| SceneReport::new(prepared, stem, measured))
        .collect();
    write(options, &header, &store, &reports)
}

fn measure(bench: &Bench<'_>, options: &Options, scenes: &[Prepared]) -> anyhow::Result<Vec<Vec<Measured>>> {
    let squares = square_sides(options.size);
    let [_, table3_side] = squares;
    let table5_sizes = options.table5_sizes.as_deref().unwrap_or(&squares);
    let of = |scene| {
        let request = Request { base: &options.base, size: options.size, table5_sizes, table3_side, scene };
        tables::jobs(&options.tables, &request)
    };
    let mut jobs: Vec<_> = scenes.iter().map(of).collect();
    key::assign(jobs.iter_mut().flatten());
    let mut known = Vec::new();
    for (scene, jobs) in scenes.iter().zip(jobs) {
        let jobs = jobs.into_iter();
        known.push(jobs.map(|job| bench.recall(scene, job)).collect::<anyhow::Result<Vec<_>>>()?);
    }
    let all = || known.iter().flatten();
    let [complete, total] =
        all().map(|k| k.complete(bench.frames)).fold([0, 0], |a, b| [a[0] + b[0], a[1] + b[1]]);
    if complete > 0 && options.verbosity > Verbosity::Quiet {
        output::print(&format!(
            "{complete} of {} are in {} already: going on from there\n",
            output::counted(total, "measurement"),
            options.output.display()
        ))?;
    }
    let progress = Progress::of_work(options.verbosity, all().map(|k| k.work(bench.frames)).sum());
    let mut measured = Vec::new();
    for (scene, jobs) in scenes.iter().zip(known) {
        let mut subjects = Subjects::new(bench.gpu, scene, table3_side);
        let jobs = jobs.into_iter().map(|known| bench.measure(&mut subjects, scene, known, &progress));
        measured.push(jobs.collect::<anyhow::Result<Vec<_>>>()?);
    }
    Ok(measured)
}

fn write(options: &Options, header: &Header, store: &Store, scenes: &[SceneReport]) -> anyhow::Result<()> {
    let into = |name: &str, bytes: &[u8]| files::write(&options.output.join(name), bytes);
    let rows: Vec<_> = scenes.iter().flat_map(|scene| &scene.rows).collect();
    into("report.csv", &rows::csv(&rows)?)?;
    for scene in scenes {
        for axis in Axis::ALL {
            into(&axis.file(&scene.stem), ladder::svg(scene, axis).as_bytes())?;
        }
        for table in &options.tables {
            if let (Some(plot), Some(svg)) = (table.plot(), plot_of(*table, scene)) {
                into(&plot.name(&scene.stem), svg.as_bytes())?;
            }
        }
    }
    for csv in options.tables.iter().filter_map(|table| table.csv()) {
        into(csv.file, &(csv.bytes)(scenes)?)?;
    }
    into("report.html", page::html(header, store, scenes)?.as_bytes())?;
    if options.verbosity == Verbosity::Quiet {
        return Ok(());
    }
    let mut text = page::sentence(scenes) + "\n";
    for scene in scenes {
        text += &format!("{}: {}\n", scene.prepared.name, rows::verdict(&scene.rows));
    }
    output::print(&format!("{text}wrote {}\n", options.output.join("report.html").display()))
}

fn header(options: &Options, gpu: &Gpu) -> Header {
    let (facts, program) = (gpu.facts(), &options.program);
    let adapter = AdapterStatistics::of(&facts.info);
    Header {
        adapter: format!("{} ({}, {})", adapter.name, adapter.backend, adapter.driver),
        cpu: machine::cpu(),
        frames: options.frames,
        clock: if facts.timestamps { "GPU timestamps" } else { "CPU clock" },
        version: program.version.clone(),
        commit: program.commit.clone(),
        command: program.command.clone(),
    }
}

/// File stem of each scene: its own name without special characters, numbered where two are equal.
fn stems(scenes: &[&PathBuf]) -> Vec<String> {
    let plain = |name: &&PathBuf| {
        let builtin = name.to_str().and_then(|name| name.strip_prefix("builtin:"));
        let path = builtin.map_or(name.as_path(), Path::new);
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

/// Names of all files in the folder that the report writes.
fn outputs(stems: &[String], tables: &[&dyn Table]) -> Vec<String> {
    let mut names = vec!["report.csv".to_owned(), "report.html".to_owned()];
    names.extend(tables.iter().filter_map(|table| table.csv()).map(|csv| csv.file.to_owned()));
    for stem in stems {
        names.extend(Axis::ALL.map(|axis| axis.file(stem)));
        names.extend(tables.iter().filter_map(|table| table.plot()).map(|plot| plot.name(stem)));
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_of_one_name_get_files_of_their_own() {
        let scenes = ["a/room.glb", "builtin:room", "b/my room!.gltf", "room.glb"].map(PathBuf::from);
        let stems = stems(&scenes.each_ref());
        assert_eq!(stems, ["room", "room-2", "my_room_", "room-3"]);
        let phones = tables::named("phones").unwrap();
        assert_eq!(outputs(&stems, &[phones]).len(), 3 + 2 * 4);
        assert_eq!(outputs(&stems, &[]).len(), 2 + 2 * 4);
        let mut names = outputs(&stems, &tables::TABLES);
        assert_eq!(names.len(), 3 + 4 * 4, "two tables are plotted");
        names.sort();
        names.dedup();
        assert_eq!(names.len(), 3 + 4 * 4);
    }
}
