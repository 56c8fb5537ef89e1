//! Values of the app that scripts can read, and the command line of the current frame.

use glam::DVec3;
use glimpse::options;

use crate::{App, command::command, script::Value};

impl App {
    /// Value of a name, for `expect` and `print` in scripts; `None` if the name is unknown or has no value
    /// yet.
    #[must_use]
    pub fn look(&self, name: &str) -> Option<Value> {
        let hud_state = &self.hud_state;
        let number = |value: f64| Some(Value::Number(value));
        let counts = hud_state.counts.as_ref();
        match name {
            "scene" => Some(Value::Text(hud_state.scene.clone())),
            "command" => self.command().map(Value::Text),
            "problem" => Some(Value::Text(hud_state.problem.clone().unwrap_or_default())),
            "notice" => Some(Value::Text(hud_state.notice.clone().unwrap_or_default())),
            "legend" => Some(Value::Text(hud_state.legend.clone())),
            "show" => Some(Value::Text(self.choices.show.name())),
            "split" => self.choices.split.map(|split| Value::Number(split.into())),
            "primitives" => number(hud_state.primitives as f64),
            "cameras" => number(hud_state.cameras.len() as f64),
            "width" => number(hud_state.size[0].into()),
            "height" => number(hud_state.size[1].into()),
            "view_width" => number(hud_state.view[0].into()),
            "view_height" => number(hud_state.view[1].into()),
            "memory" => number(hud_state.memory.total as f64),
            "psnr" => hud_state.psnr_db.map(Value::Number),
            "rt_ratio" => counts.map(|counts| Value::Number(counts.rt_ratio())),
            "frames" => number(self.pacing.tally().frames.into()),
            "late" => number(self.pacing.tally().late.into()),
            "rays" => counts.map(|counts| Value::Number(counts.rays.total as f64)),
            "moved" => {
                let moved =
                    self.control.as_ref().is_some_and(|control| control.command_line(DVec3::ZERO).is_some());
                number(f64::from(u8::from(moved)))
            }
            _ => options::find(name).ok().map(|option| option.get(&self.choices.settings).into()),
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
