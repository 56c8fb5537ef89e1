//! `glimpse view`: opens the window, or plays a script without one.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, anyhow};
use glimpse::{DisplayImage, to_png};
use glimpse_app::script::Script;
use glimpse_app::{Choices, Files, Phone};
use glimpse_shell::{Chosen, Screen, Setup, Wakeup, free_name};
use winit::error::EventLoopError;
use winit::event_loop::EventLoop;

use crate::args::{SceneOptions, Size, ViewOptions};
use crate::errors::Usage;
use crate::{files, render, scene_file};

const DEFAULT_SCENE: &str = "builtin:room";

/// Runs `glimpse view`; renders a picture if there is no display.
pub fn run(options: &ViewOptions, adapter: Option<&str>) -> anyhow::Result<()> {
    let scene = options.scene.as_deref().unwrap_or(DEFAULT_SCENE);
    scene_file::check(scene)?;
    let setup = setup(options, scene, adapter)?;
    if options.headless {
        return glimpse_shell::run_offscreen(setup).map_err(|line| anyhow!(line));
    }
    match EventLoop::<Wakeup>::with_user_event().build() {
        Ok(event_loop) => {
            glimpse_shell::run_window(event_loop, setup, Box::new(open_dialog)).map_err(|line| anyhow!(line))
        }
        Err(error @ (EventLoopError::Os(_) | EventLoopError::NotSupported(_)))
            if options.script.is_none() =>
        {
            log::info!("{error}");
            render::without_display(scene, adapter)
        }
        Err(error) => Err(error).context("no window; --headless plays a script without one"),
    }
}

fn setup(options: &ViewOptions, scene: &str, adapter: Option<&str>) -> anyhow::Result<Setup> {
    let phone = options.phone.as_deref().map(Phone::named).transpose();
    let phone = phone.map_err(|reason| Usage(format!("--phone: {reason}")))?;
    let script = options.script.as_deref().map(read_script).transpose()?;
    let (first, of_first) = (scene.to_owned(), options.file.clone());
    let surroundings = options.environment.surroundings();
    surroundings.check()?;
    let reader: Files = Arc::new(move |name| {
        // The variant is one of the scene that was named with it.
        let variant = of_first.variant.clone().filter(|_| name == first);
        let file = SceneOptions { variant, ..of_first.clone() };
        let loaded = file.load(name, &mut |_, _| ()).and_then(|mut scene| {
            surroundings.apply(&mut scene)?;
            Ok(scene)
        });
        loaded.map_err(|error| format!("{error:#}"))
    });
    let Size(size) = options.size;
    // A script must neither depend on recently opened scenes nor change their list.
    let scripted = script.is_some();
    Ok(Setup {
        files: reader,
        scene: scene.to_owned(),
        recent: if scripted { Vec::new() } else { recent() },
        choices: Choices::default(),
        adapter: adapter.map(str::to_owned),
        limits: phone.as_ref().map(Phone::limits),
        screen: phone.as_ref().map(screen),
        view: None,
        size,
        script,
        save: Box::new(|file, picture| save(file, picture).map_err(|error| format!("{error:#}"))),
        remember: Box::new(move |files| {
            if !scripted && let Err(error) = remember(files) {
                log::warn!("{error:#}");
            }
        }),
    })
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
    Script::parse(&name, &text).map_err(|line| anyhow!(line))
}

/// Saves a picture; without a name, under the first unused name in the working folder.
fn save(file: Option<PathBuf>, picture: &DisplayImage) -> anyhow::Result<String> {
    let path = file.or_else(|| free_name(Path::new(""))).context("no free name")?;
    files::write(&path, &to_png(picture)?)?;
    Ok(format!("Saved {}", path.display()))
}

/// Opens a file dialog on a separate thread; cancelling it has no effect.
fn open_dialog(chosen: Chosen) {
    std::thread::spawn(move || {
        let dialog = rfd::FileDialog::new().add_filter("glTF scenes", &["glb", "gltf"]);
        if let Some(path) = dialog.pick_file() {
            chosen(path);
        }
    });
}

/// File with the names of recently opened scenes, one per line.
fn recent_file() -> Option<PathBuf> {
    Some(dirs::state_dir().or_else(dirs::data_local_dir)?.join("glimpse").join("recent"))
}

fn recent() -> Vec<String> {
    let text = recent_file().and_then(|path| std::fs::read_to_string(path).ok()).unwrap_or_default();
    text.lines().filter(|name| Path::new(name).exists()).map(str::to_owned).collect()
}

fn remember(names: &[String]) -> anyhow::Result<()> {
    let Some(path) = recent_file() else { return Ok(()) };
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    let absolute = |name: &String| std::path::absolute(name).map(|path| path.display().to_string());
    let names = names.iter().map(absolute).collect::<std::io::Result<Vec<_>>>()?;
    files::write(&path, names.join("\n").as_bytes())
}
