//! Values of the app that scripts can read, and the command line of the current frame.

use glam::DVec3;
use glimpse::{Counts, options};

use crate::{App, command::command, script::Value};

/// A value of the app that scripts can read.
pub(crate) struct ScriptValue {
    /// Its name.
    pub name: &'static str,
    /// Description of the value.
    pub summary: &'static str,
    /// The value; `None` while there is none.
    get: fn(&App) -> Option<Value>,
}

const fn value(name: &'static str, summary: &'static str, get: fn(&App) -> Option<Value>) -> ScriptValue {
    ScriptValue { name, summary, get }
}

/// All values but those of options.
pub(crate) const VALUES: &[ScriptValue] = &[
    value("scene", "name of the scene", |app| text(&app.hud_state.scene)),
    value("title", "title of the window", |app| Some(Value::Text(app.title()))),
    value("command", "command that renders the frame", |app| app.command().map(Value::Text)),
    value("problem", "error message on display, or empty", |app| {
        text(app.hud_state.problem.as_deref().unwrap_or_default())
    }),
    value("notice", "confirmation on display, or empty", |app| {
        text(app.hud_state.notice.as_deref().unwrap_or_default())
    }),
    value("folder", "folder in the list of files, or empty", |app| {
        text(&app.hud_state.folder.as_ref().map(|folder| App::file_name(&folder.path)).unwrap_or_default())
    }),
    value("legend", "what the colours of the picture mean", |app| text(&app.hud_state.legend)),
    value("show", "what the picture shows", |app| text(&app.choices.show.name())),
    value("split", "place of the split, a share of the width", |app| {
        app.choices.split.map(|split| Value::Number(split.into()))
    }),
    value("primitives", "triangles and spheres of the scene", |app| number(app.hud_state.primitives as f64)),
    value("cameras", "cameras of the scene", |app| number(app.hud_state.cameras.len() as f64)),
    value("width", "width of the frame in pixels", |app| number(app.hud_state.size[0].into())),
    value("height", "height of the frame in pixels", |app| number(app.hud_state.size[1].into())),
    value("view_width", "width of the view in pixels", |app| number(app.hud_state.view[0].into())),
    value("view_height", "height of the view in pixels", |app| number(app.hud_state.view[1].into())),
    value("memory", "bytes of device memory", |app| number(app.hud_state.memory.total as f64)),
    value("psnr", "PSNR against full in decibels, while the view is split", |app| {
        app.hud_state.psnr_db.map(Value::Number)
    }),
    value("rt_ratio", "traced samples over all samples", |app| counted(app, Counts::rt_ratio)),
    value("rays", "rays of the frame", |app| counted(app, |counts| counts.rays.total as f64)),
    value("frames", "frames since the governor was set", |app| number(app.pacing.tally().frames.into())),
    value("late", "those of them that took too long", |app| number(app.pacing.tally().late.into())),
    value("moved", "1 where the camera is none of the scene's, 0 else", |app| {
        let moved = app.control.as_ref().is_some_and(|control| control.command_line(DVec3::ZERO).is_some());
        number(f64::from(u8::from(moved)))
    }),
];

fn text(text: &str) -> Option<Value> {
    Some(Value::Text(text.to_owned()))
}

fn number(number: f64) -> Option<Value> {
    Some(Value::Number(number))
}

fn counted(app: &App, number: fn(&Counts) -> f64) -> Option<Value> {
    app.hud_state.counts.as_ref().map(|counts| Value::Number(number(counts)))
}

/// Names of all values, those of options by their present names.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    VALUES.iter().map(|value| value.name).chain(options::OPTIONS.iter().map(|option| option.name))
}

/// Whether there is a value of this name, or an option that had it.
pub(crate) fn is_known(name: &str) -> bool {
    VALUES.iter().any(|value| value.name == name) || options::find(name).is_ok()
}

impl App {
    /// Value of a name, for `expect` and `print` in scripts; `None` if the name is unknown or has no value
    /// yet.
    #[must_use]
    pub fn look(&self, name: &str) -> Option<Value> {
        match VALUES.iter().find(|value| value.name == name) {
            Some(value) => (value.get)(self),
            None => options::find(name).ok().map(|option| option.get(&self.choices.settings).into()),
        }
    }

    /// Command line that renders the current frame; `None` before a scene is shown.
    #[must_use]
    pub fn command(&self) -> Option<String> {
        let job = self.still_job()?;
        let scene = self.scenes.shown()?;
        let moved = self.control.as_ref()?.command_line(scene.origin);
        let camera = moved.unwrap_or_else(|| match self.hud_state.camera {
            0 => String::new(),
            index => format!("--camera {index}"),
        });
        Some(command(&scene.name, &camera, &job))
    }
}
