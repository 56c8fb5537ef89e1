//! `glimpse render`: renders one frame into a file and prints its statistics.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use anyhow::bail;
use glimpse::{Gpu, Method, Settings, Show, show, to_exr, to_png};

use crate::args::{PictureFile, RenderOptions, Size, ViewOptions};
use crate::errors::Usage;
use crate::focus::FrameRequest;
use crate::measure::{Plan, Run, Workbench};
use crate::output::{self, Verbosity};
use crate::progress::Progress;
use crate::statistics::Statistics;
use crate::{cpu_tracer, files, scene_file, summary};

const VIEW_PICTURE: &str = "glimpse.png";

/// Renders a picture for `glimpse view` if there is no display.
pub fn without_display(
    view: &ViewOptions,
    scene: &Path,
    adapter: Option<&str>,
    verbosity: Verbosity,
) -> anyhow::Result<()> {
    let options = RenderOptions {
        scene: scene.to_owned(),
        method: view.method,
        size: view.size.unwrap_or(Size([2560, 1440])),
        show: view.show,
        frame: view.frame.clone(),
        output: PictureFile { path: PathBuf::from(VIEW_PICTURE), linear: false },
        frames: 1,
        reference: view.method != Method::Vr,
        stats: None,
    };
    if verbosity > Verbosity::Quiet {
        output::print(&format!("There is no display: rendering a frame to {VIEW_PICTURE}.\n"))?;
    }
    run(&options, adapter, verbosity)
}

/// Runs `glimpse render`.
pub fn run(options: &RenderOptions, adapter: Option<&str>, verbosity: Verbosity) -> anyhow::Result<()> {
    let request = FrameRequest::of(&options.frame, options.method)?;
    check_show(options, &request.settings)?;
    if options.reference && request.settings.method == Method::Vr {
        bail!(Usage(
            "--reference: expected a method of one eye, found vr: method full shows one picture".to_owned()
        ));
    }
    scene_file::check(&options.scene)?;
    let surroundings = options.frame.environment.surroundings();
    surroundings.check()?;
    let outputs: Vec<_> =
        std::iter::once(&options.output.path).chain(&options.stats).map(PathBuf::as_path).collect();
    let inputs: Vec<_> = std::iter::once(options.scene.as_path()).chain(surroundings.file()).collect();
    files::check(&outputs, &inputs)?;
    let on_stdout = outputs.iter().any(|output| files::is_standard(output));
    if files::is_standard(&options.output.path) && std::io::stdout().is_terminal() {
        bail!(Usage("--output -: expected a file or a pipe as standard output, found a terminal".to_owned()));
    }

    let mut requests = vec![request];
    if options.reference && options.method != Method::Full {
        requests.push(FrameRequest::beside(&options.frame, Method::Full)?);
    }
    let Size(size) = options.size;
    cpu_tracer::check(&requests, options.frames)?;
    let plan = Plan { size, frames: options.frames, linear: options.output.linear, pan: None };
    let progress = Progress::new(verbosity, plan.steps(requests.len()));
    let gpu = Gpu::headless(adapter)?;
    let workbench = Workbench::set(&gpu, &options.scene, &options.frame, &requests, &progress)?;
    files::check(&outputs, &workbench.inputs.iter().map(PathBuf::as_path).collect::<Vec<_>>())?;
    let runs = plan.measure(&workbench, &progress)?;

    progress.doing("writing");
    let full = runs.iter().find(|run| options.reference && run.settings.method == Method::Full);
    let statistics = Statistics::of(&workbench, &runs[0], full)?;
    let legend = write_picture(options, &runs[0])?;
    if let Some(path) = &options.stats {
        files::write(path, output::json(&statistics)?.as_bytes())?;
    }
    drop(progress);
    let warnings = [options.frame.warnings(&runs[0].settings), workbench.warnings.clone()].concat();
    if verbosity == Verbosity::Quiet {
        return Ok(());
    }
    let name = options.output.path.display().to_string();
    let text = summary::frame(&statistics, &name, &legend, &warnings, verbosity);
    for not_shown in &workbench.not_shown {
        output::remark(&format!("not shown: {not_shown}"));
    }
    if on_stdout {
        output::print_aside(&text);
        return Ok(());
    }
    output::print(&text)
}

/// Checks that the settings and the output format provide the per-pixel data that `--show` displays.
fn check_show(options: &RenderOptions, settings: &Settings) -> Result<(), Usage> {
    let unfit = match options.show {
        Show::Final => None,
        _ if options.output.linear => Some("An output that ends in .exr has the frame alone."),
        show => show.conflict(settings),
    };
    unfit.map_or(Ok(()), |reason| Err(Usage(format!("--show {}: {reason}", options.show.name()))))
}

/// Writes the picture that `--show` selects; returns its legend.
fn write_picture(options: &RenderOptions, run: &Run) -> anyhow::Result<String> {
    if let Some(linear) = run.linear.as_ref().filter(|_| options.output.linear) {
        files::write(&options.output.path, &to_exr(linear)?)?;
        return Ok(String::new());
    }
    if options.show == Show::Final {
        files::write(&options.output.path, &to_png(&run.picture)?)?;
        return Ok(String::new());
    }
    let (picture, legend) = show::picture(options.show, &run.picture, &run.inspection.pixels)?;
    files::write(&options.output.path, &to_png(&picture)?)?;
    Ok(summary::row("shown", &legend))
}
