//! `glimpse check`: renders scenes and compares them with reference pictures.

mod cases;
mod junit;

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, anyhow, bail};
use clap::{CommandFactory, FromArgMatches};
use glimpse::{DisplayImage, Gpu, Picture, to_png};

use crate::args::{Arguments, CheckOptions, Command, DiffKind, Size};
use crate::compare::{self, Comparison};
use crate::diff;
use crate::errors::{self, Usage};
use crate::focus::FrameRequest;
use crate::measure::{Plan, Workbench};
use crate::output::{self, Verbosity};
use crate::progress::Progress;
use crate::{files, scene_file};

/// A picture to render, and the reference that it is compared with.
struct Case {
    name: String,
    reference: PathBuf,
    options: CheckOptions,
}

/// What came of a case.
struct Outcome {
    name: String,
    seconds: f64,
    /// What was measured, or why the case failed.
    verdict: Result<String, String>,
}

/// Runs `glimpse check`.
pub fn run(options: &CheckOptions, adapter: Option<&str>, verbosity: Verbosity) -> anyhow::Result<()> {
    let cases = cases_of(options)?;
    for case in &cases {
        FrameRequest::of(&case.options.frame, case.options.method).with_context(|| case.name.clone())?;
    }
    let junit: Vec<_> = options.junit.iter().map(PathBuf::as_path).collect();
    files::check(&junit, &[&options.scene])?;
    if let Some(folder) = &options.failures {
        std::fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
        for case in &cases {
            files::check(&[&case.failure(folder)], &[])?;
        }
    }
    let gpu = Gpu::headless(adapter)?;
    let progress = Progress::new(verbosity, cases.len() as u64);
    let mut outcomes = Vec::with_capacity(cases.len());
    for case in cases {
        progress.doing(&case.name);
        let began = Instant::now();
        let verdict = case.verdict(&gpu, options, &progress).map_err(|error| errors::told(&error));
        outcomes.push(Outcome { name: case.name, seconds: began.elapsed().as_secs_f64(), verdict });
        progress.step();
    }
    drop(progress);
    if let Some(path) = &options.junit {
        files::write(path, junit::report(&outcomes).as_bytes())?;
    }
    let text: String = outcomes.iter().map(Outcome::line).collect();
    if verbosity > Verbosity::Quiet {
        output::print(&text)?;
    }
    match outcomes.iter().filter(|outcome| outcome.verdict.is_err()).count() {
        0 => Ok(()),
        failed => bail!("{failed} of {} failed", output::counted(outcomes.len(), "case")),
    }
}

/// The case of the command line, or those of the file that it names.
fn cases_of(options: &CheckOptions) -> anyhow::Result<Vec<Case>> {
    let path = Path::new(&options.scene);
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
        if options.reference.is_some() {
            bail!(Usage(format!("{}: expected no reference beside a file of cases", path.display())));
        }
        return cases::read(path);
    }
    let reference = options.reference.clone().ok_or_else(|| {
        Usage(format!("{}: expected a reference picture, or a .toml file of cases", path.display()))
    })?;
    let typed = Case { name: stem(&reference), reference, options: options.clone() };
    Ok(vec![typed])
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// The options of a case that is typed as on the command line.
fn parsed(arguments: &[OsString]) -> anyhow::Result<CheckOptions> {
    let command = ["glimpse", "check"].map(OsString::from);
    let matches = Arguments::command().try_get_matches_from(command.iter().chain(arguments));
    let wrong = |error: clap::Error| anyhow!(Usage(errors::of_usage(&error)));
    match Arguments::from_arg_matches(&matches.map_err(wrong)?).map_err(wrong)?.command {
        Some(Command::Check(options)) => Ok(options),
        _ => bail!(Usage("expected the arguments of `check`".to_owned())),
    }
}

impl Case {
    /// Renders the case and compares it; what was measured, or an error that says why it failed.
    fn verdict(&self, gpu: &Gpu, run: &CheckOptions, progress: &Progress) -> anyhow::Result<String> {
        let reference = (!run.update).then(|| self.read_reference()).transpose()?;
        let (picture, inputs) = self.picture(gpu, progress)?;
        let inputs: Vec<_> = inputs.iter().map(PathBuf::as_path).collect();
        let Some(reference) = reference else {
            files::check(&[&self.reference], &inputs)?;
            files::write(&self.reference, &to_png(&picture)?)?;
            bail!("{} was written: look at it, then run without --update", self.reference.display());
        };
        let bounds = self.options.bounds.or_rounding();
        let compared = Comparison::of(&picture, &reference, &bounds);
        let comparison =
            compared.map_err(compare::not_usage).with_context(|| self.reference.display().to_string())?;
        let Some(complaint) = comparison.complaint() else { return Ok(comparison.text(&bounds)) };
        let mut reason = format!("{complaint}; {}", comparison.text(&bounds));
        if let Some(folder) = &run.failures {
            let path = self.failure(folder);
            files::check(&[&path], &inputs)?;
            let shown = diff::picture(&picture, &reference, bounds.threshold, DiffKind::Error)?;
            files::write(&path, &to_png(&shown)?)?;
            reason += &format!("; see {}", path.display());
        }
        Err(anyhow!(reason))
    }

    /// The file that shows how the case failed.
    fn failure(&self, folder: &Path) -> PathBuf {
        folder.join(format!("{}.png", self.name.replace(['/', '\\'], "_")))
    }

    fn read_reference(&self) -> anyhow::Result<DisplayImage> {
        let missing = || "the reference cannot be read, --update writes it";
        compare::read(&self.reference).map(Picture::into_display).with_context(missing)
    }

    /// Renders the picture; returns it with the files that it was made from.
    fn picture(&self, gpu: &Gpu, progress: &Progress) -> anyhow::Result<(DisplayImage, Vec<PathBuf>)> {
        let CheckOptions { scene, frame, method, size: Size(size), .. } = &self.options;
        scene_file::check(scene)?;
        frame.environment.surroundings().check()?;
        let requests = [FrameRequest::of(frame, *method)?];
        let workbench = Workbench::set(gpu, scene, frame, &requests, progress)?;
        let picture = Plan { size: *size, frames: 0, linear: false, pan: None }.picture(&workbench)?;
        Ok((picture, workbench.inputs))
    }
}

impl Outcome {
    fn line(&self) -> String {
        let (word, text) = match &self.verdict {
            Ok(text) => ("passed", text),
            Err(text) => ("FAILED", text),
        };
        format!("{word}  {}  {}\n", output::one_line(&self.name), output::one_line(text))
    }
}
