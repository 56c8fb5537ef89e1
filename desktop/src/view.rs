//! `glimpse view`: opens the window, or plays a script without one.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use anyhow::{Context, anyhow};
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args, FromArgMatches};
use glimpse::metrics::Bounds;
use glimpse::{DisplayImage, Scene, to_png};
use glimpse_app::script::Script;
use glimpse_app::{App, AtRest, Choices, Files, Opened, Phone, StartCamera};
use glimpse_shell::{Screen, Setup, Wakeup, free_name};
use winit::error::EventLoopError;
use winit::event_loop::EventLoop;

use crate::args::{BoundsOptions, FrameOptions, SceneOptions, Size, ViewOptions};
use crate::compare::{self, Comparison};
use crate::errors::{self, Usage};
use crate::output::{self, Verbosity};
use crate::{file_dialog, files, render, scene_file};

const DEFAULT_SCENE: &str = "builtin:room";

/// Runs `glimpse view`; renders a picture if there is no display.
pub fn run(options: &ViewOptions, adapter: Option<&str>, verbosity: Verbosity) -> anyhow::Result<()> {
    if options.list_phones {
        return output::print(&phones_text()?);
    }
    if options.script_help {
        return output::print(&glimpse_app::script::help());
    }
    let scene = options.scene.as_deref().unwrap_or(Path::new(DEFAULT_SCENE));
    scene_file::check(scene)?;
    let setup = setup(options, scene, adapter, verbosity)?;
    if options.headless {
        return glimpse_shell::run_offscreen(setup).map_err(|line| anyhow!(line));
    }
    match EventLoop::<Wakeup>::with_user_event().build() {
        Ok(event_loop) => glimpse_shell::run_window(event_loop, setup, Box::new(file_dialog::open))
            .map_err(|line| anyhow!(line)),
        Err(error @ (EventLoopError::Os(_) | EventLoopError::NotSupported(_)))
            if options.script.is_none() =>
        {
            log::info!("{error}");
            render::without_display(options, scene, adapter, verbosity)
        }
        Err(error) => Err(error).context("no window; --headless plays a script without one"),
    }
}

fn setup(
    options: &ViewOptions,
    scene: &Path,
    adapter: Option<&str>,
    verbosity: Verbosity,
) -> anyhow::Result<Setup> {
    let phone = options.phone.as_deref().map(Phone::named).transpose();
    let phone = phone.map_err(|reason| Usage(format!("--phone: {reason}")))?;
    let script = options.script.as_deref().map(read_script).transpose()?;
    let choices = choices(options, verbosity)?;
    let surroundings = options.frame.environment.surroundings();
    surroundings.check()?;
    let (first, frame) = (App::file_name(scene), options.frame.clone());
    // Files that scenes were read from, which pictures do not replace.
    let inputs = Arc::new(Mutex::new(Vec::<PathBuf>::from_iter(surroundings.file().map(Path::to_owned))));
    let read = inputs.clone();
    let reader: Files = Arc::new(move |name| {
        // Variant and camera are those of the scene that was named with them.
        let is_first = name == first;
        let file =
            SceneOptions { variant: frame.file.variant.clone().filter(|_| is_first), ..frame.file.clone() };
        let loaded = file.load(&App::file_path(name), &mut |path, _| kept(&read).push(path.to_owned()));
        let loaded = loaded.and_then(|mut scene| {
            surroundings.apply(&mut scene)?;
            let camera = if is_first { first_camera(&scene, &frame)? } else { StartCamera::default() };
            Ok(Opened { scene, camera })
        });
        loaded.map_err(|error| format!("{error:#}"))
    });
    let Size(size) = options.size.unwrap_or(Size([1280, 720]));
    // A script must neither depend on recently opened scenes nor change their list.
    let scripted = script.is_some();
    Ok(Setup {
        files: reader,
        scene: App::file_name(scene),
        recent: if scripted { Vec::new() } else { recent() },
        cached_kernels: if scripted { Vec::new() } else { cached_kernels() },
        choices,
        adapter: adapter.map(str::to_owned),
        limits: phone.as_ref().map(Phone::limits),
        screen: phone.as_ref().map(screen),
        view: None,
        size,
        script,
        save: Box::new(move |file, picture| {
            save(file, picture, &kept(&inputs)).map_err(|error| format!("{error:#}"))
        }),
        compare: Box::new(compared),
        print: Box::new(|line| output::print(&format!("{line}\n")).map_err(|error| format!("{error:#}"))),
        remember: Box::new(move |files| {
            if !scripted && let Err(error) = remember(files) {
                log::warn!("{error:#}");
            }
        }),
        keep_kernels: Box::new(move |fingerprints| {
            if !scripted && let Err(error) = keep_kernels(fingerprints) {
                log::warn!("{error:#}");
            }
        }),
    })
}

/// The window's own choices with those of the command line.
fn choices(options: &ViewOptions, verbosity: Verbosity) -> anyhow::Result<Choices> {
    let usual = Choices::default();
    let settings = options.frame.typed.over(usual.settings.with_method(options.method))?;
    settings.validate()?;
    if let Some(focus) = options.frame.focus().filter(|focus| *focus != "none" && settings.focus.is_none()) {
        let expected = "indices of objects: only `render` and `bench` find them by their names";
        return Err(glimpse::Error::setting("focus", expected, focus).into());
    }
    if let Some(reason) = options.show.conflict(&settings) {
        return Err(Usage(format!("--show {}: {reason}", options.show.name())).into());
    }
    let warnings = options.frame.warnings(&settings);
    for warning in warnings.iter().filter(|_| verbosity > Verbosity::Quiet) {
        output::remark(&format!("warning: {warning}"));
    }
    // A script says what it shows: frames are those of `render` unless it sets another quality.
    let at_rest = if options.script.is_some() { AtRest::Chosen } else { usual.at_rest };
    Ok(Choices { settings, show: options.show, at_rest, ..usual })
}

fn first_camera(scene: &Scene, frame: &FrameOptions) -> glimpse::Result<StartCamera> {
    if let Some(camera) = frame.look_at.camera(scene.origin)? {
        return Ok(StartCamera::Free(camera));
    }
    let camera = scene.camera(frame.camera.as_deref())?;
    let index = scene.cameras.iter().position(|(_, known)| std::ptr::eq(known, camera));
    Ok(StartCamera::OfScene(index.unwrap_or_default()))
}

/// Adds the names of the phones to the values of `--phone`.
pub fn with_phones(command: clap::Command) -> clap::Command {
    // The table is part of the program, and tests read it.
    let phones = Phone::all().unwrap_or_default();
    let values = phones.into_iter().map(|phone| PossibleValue::new(phone.name).help(phone.model));
    let values = PossibleValuesParser::new(values);
    command.mut_subcommand("view", |view| view.mut_arg("phone", |phone| phone.value_parser(values)))
}

/// The phones, one per line.
fn phones_text() -> anyhow::Result<String> {
    let phones = Phone::all().map_err(|reason| anyhow!(reason))?;
    let width = phones.iter().map(|phone| phone.name.len()).max().unwrap_or_default();
    let line = |phone: &Phone| {
        let [pixels_x, pixels_y] = phone.size.value;
        format!("{:width$}  {}, {}, {pixels_x}x{pixels_y}\n", phone.name, phone.model, phone.gpu)
    };
    Ok(phones.iter().map(line).collect())
}

fn screen(phone: &Phone) -> Screen {
    let [top, right, bottom, left] = phone.insets.value;
    Screen {
        pixels: phone.size.value,
        pixels_per_point: phone.scale.value,
        insets: [left, top, right, bottom],
    }
}

fn read_script(path: &Path) -> anyhow::Result<Script> {
    let name = path.display().to_string();
    let text = String::from_utf8(files::read(path)?).with_context(|| name.clone())?;
    let script = Script::parse(&name, &text).map_err(|line| anyhow!(line))?;
    script.check_bounds(|typed| bounds(typed).map(drop)).map_err(|line| anyhow!(line))?;
    Ok(script)
}

/// Bounds as `compare` takes them; without any, those that allow for the rounding of other processors.
fn bounds(typed: &str) -> Result<Bounds, String> {
    let command = BoundsOptions::augment_args(clap::Command::new("picture")).no_binary_name(true);
    let matches = command
        .args_override_self(true)
        .disable_help_flag(true)
        .try_get_matches_from(typed.split_whitespace());
    let options = matches.and_then(|matches| BoundsOptions::from_arg_matches(&matches));
    options.map(|options| options.or_rounding()).map_err(|error| errors::of_usage(&error))
}

/// Compares a frame with the picture in a file, as `compare` does.
fn compared(file: &Path, typed: &str, frame: &DisplayImage) -> Result<(), String> {
    let bounds = bounds(typed)?;
    let name = file.display();
    let reference = compare::read(file).map_err(|error| errors::told(&error))?.into_display();
    let comparison = Comparison::of(frame, &reference, &bounds);
    let comparison =
        comparison.map_err(|error| format!("{name}: {}", errors::told(&compare::not_usage(error))))?;
    comparison.complaint().map_or(Ok(()), |complaint| Err(format!("the frame against {name}: {complaint}")))
}

fn kept(inputs: &Mutex<Vec<PathBuf>>) -> MutexGuard<'_, Vec<PathBuf>> {
    inputs.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Saves a picture in none of the inputs' places; without a name, under the first unused name in the working folder.
fn save(file: Option<PathBuf>, picture: &DisplayImage, inputs: &[PathBuf]) -> anyhow::Result<String> {
    let path = file.or_else(|| free_name(Path::new(""))).context("no free name")?;
    files::check(&[&path], &inputs.iter().map(PathBuf::as_path).collect::<Vec<_>>())?;
    files::write(&path, &to_png(picture)?)?;
    Ok(format!("Saved {}", path.display()))
}

/// File with the names of recently opened scenes, one per line.
fn recent_file() -> Option<PathBuf> {
    Some(dirs::state_dir().or_else(dirs::data_local_dir)?.join("glimpse").join("recent"))
}

fn recent() -> Vec<String> {
    let text = recent_file().and_then(|path| std::fs::read_to_string(path).ok()).unwrap_or_default();
    text.lines().filter(|name| App::file_path(name).exists()).map(str::to_owned).collect()
}

/// File with the fingerprints of kernels in the driver's cache, one per line: in the folder of that cache if it was
/// chosen.
fn kernels_file() -> Option<PathBuf> {
    let chosen = std::env::var_os("MESA_SHADER_CACHE_DIR").filter(|folder| !folder.is_empty());
    let folder = chosen.map(PathBuf::from).or_else(dirs::cache_dir)?;
    Some(folder.join("glimpse").join("kernels"))
}

fn cached_kernels() -> Vec<u64> {
    let text = kernels_file().and_then(|path| std::fs::read_to_string(path).ok()).unwrap_or_default();
    text.lines().filter_map(|line| u64::from_str_radix(line, 16).ok()).collect()
}

fn keep_kernels(fingerprints: &[u64]) -> anyhow::Result<()> {
    let Some(path) = kernels_file() else { return Ok(()) };
    let lines: String = fingerprints.iter().map(|fingerprint| format!("{fingerprint:016x}\n")).collect();
    write_in_folder(&path, &lines)
}

/// Writes a file of the program's own, and makes its folder where there is none.
fn write_in_folder(path: &Path, text: &str) -> anyhow::Result<()> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    files::write(path, text.as_bytes())
}

fn remember(names: &[String]) -> anyhow::Result<()> {
    let Some(path) = recent_file() else { return Ok(()) };
    let absolute =
        |name: &String| std::path::absolute(App::file_path(name)).map(|path| App::file_name(&path));
    let names = names.iter().map(absolute).collect::<std::io::Result<Vec<_>>>()?;
    write_in_folder(&path, &names.join("\n"))
}
