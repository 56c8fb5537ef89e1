//! Values of the app that scripts can read, and the command line of the present frame.

use glimpse::options;

use crate::{App, command::command, script::Value};

impl App {
    /// The value of a name, for `expect` and `print` in scripts; `None` where the name is unknown or has no value yet.
    #[must_use]
    pub fn look(&self, name: &str) -> Option<Value> {
        let readings = &self.readings;
        let number = |value: f64| Some(Value::Number(value));
        let counts = readings.counts.as_ref();
        match name {
            "scene" => Some(Value::Text(readings.scene.clone())),
            "command" => self.command().map(Value::Text),
            "problem" => Some(Value::Text(readings.problem.clone().unwrap_or_default())),
            "notice" => Some(Value::Text(readings.notice.clone().unwrap_or_default())),
            "legend" => Some(Value::Text(readings.legend.clone())),
            "show" => Some(Value::Text(self.choices.show.name())),
            "split" => self.choices.split.map(|split| Value::Number(split.into())),
            "primitives" => number(readings.primitives as f64),
            "cameras" => number(readings.cameras.len() as f64),
            "width" => number(readings.size[0].into()),
            "height" => number(readings.size[1].into()),
            "view_width" => number(readings.view[0].into()),
            "view_height" => number(readings.view[1].into()),
            "memory" => number(readings.memory.total as f64),
            "psnr" => readings.psnr_db.map(Value::Number),
            "rt_ratio" => counts.map(|counts| Value::Number(counts.rt_ratio())),
            "frames" => number(self.pacing.tally().frames.into()),
            "late" => number(self.pacing.tally().late.into()),
            "rays" => counts.map(|counts| Value::Number(counts.rays.total as f64)),
            "moved" => {
                let moved = self.control.as_ref().is_some_and(|control| control.command_line().is_some());
                number(f64::from(u8::from(moved)))
            }
            _ => options::find(name).ok().map(|option| option.get(&self.choices.settings).into()),
        }
    }

    /// The command line that renders the present frame; `None` before a scene is shown.
    #[must_use]
    pub fn command(&self) -> Option<String> {
        let job = self.still_job()?;
        let moved = self.control.as_ref()?.command_line();
        let camera = moved.unwrap_or_else(|| match self.readings.camera {
            0 => String::new(),
            index => format!("--camera {index}"),
        });
        Some(command(&self.scenes.shown()?.name, &camera, &job))
    }
}
