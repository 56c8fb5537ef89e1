//! The command line of `android-run`.

use std::ffi::{OsStr, OsString};
use std::path::PathBuf;

/// The usage message.
pub const USAGE: &str = "\
usage: android-run APP.so SCENARIO [OPTIONS]

scenarios: start, life, rotate, touch, back, again, view, thermal, storm,
           errors:no-vulkan, errors:no-device, errors:small-limits, errors:lost-device

  --assets DIR    the assets folder of the unpacked APK
  --files DIR     the app's own folder (default: a new one under the system's folder for such)
  --expect PNG    the picture that must be presented
  --content FILE  what the content URI of the scenario `view` leads to
  --size WxH      pixels of the window (default 320x180)
  --view WxH      pixels of the ray-traced frame (the intent's extra `view`)
  --scene S       the scene (the intent's extra `scene`)
  --set S         choices (the intent's extra `set`)
  --events N      events of the scenario `storm` (default 1000)
  --seed N        of its random numbers (default 1)
  --api N         the API level that is played, 28 to 36 (default 34)
  --slow N        every bound is N times as long (default 1): for an emulated processor
  --keep DIR      writes the pictures that were presented at each step there";

/// The scenario to run, and its parameters.
#[derive(Clone, Debug)]
pub struct Options {
    /// Path of the app's library.
    pub app: PathBuf,
    /// Name of the scenario.
    pub scenario: String,
    /// The `assets` folder of the unpacked package.
    pub assets: Option<PathBuf>,
    /// The app's own folder (`internalDataPath`).
    pub files: Option<PathBuf>,
    /// The picture that the app must present.
    pub expect: Option<PathBuf>,
    /// The file behind the intent's content URI.
    pub content: Option<PathBuf>,
    /// Size of the window in pixels.
    pub size: [u32; 2],
    /// Extra `view` of the intent.
    pub view: Option<[u32; 2]>,
    /// Extra `scene` of the intent.
    pub scene: Option<String>,
    /// Extra `set` of the intent.
    pub set: Option<String>,
    /// Number of events in the storm scenario.
    pub events: u64,
    /// Seed of the storm scenario.
    pub seed: u64,
    /// The API level to emulate.
    pub api: i32,
    /// Factor on time limits, for an emulated processor that is slower than the real one.
    pub slow: u32,
    /// Folder in which presented pictures are saved.
    pub keep: Option<PathBuf>,
}

impl Options {
    /// Parses the arguments after the program's name.
    ///
    /// # Errors
    /// An invalid argument, with what was expected and what was found.
    pub fn parse(arguments: &[OsString]) -> Result<Self, String> {
        let mut options = Self {
            app: PathBuf::new(),
            scenario: String::new(),
            assets: None,
            files: None,
            expect: None,
            content: None,
            size: [320, 180],
            view: None,
            scene: None,
            set: None,
            events: 1000,
            seed: 1,
            api: 34,
            slow: 1,
            keep: None,
        };
        let mut plain = Vec::new();
        let mut rest = arguments.iter();
        while let Some(argument) = rest.next() {
            match argument.to_str().filter(|text| text.starts_with("--")) {
                Some(name) => {
                    let value =
                        rest.next().ok_or_else(|| format!("{name}: expected a value, found the end"))?;
                    options.set(name, value)?;
                }
                None => plain.push(argument),
            }
        }
        let [app, scenario] = plain[..] else {
            return Err(format!("expected APP.so and SCENARIO, found {} arguments", plain.len()));
        };
        options.app = app.into();
        options.scenario = text("SCENARIO", scenario)?;
        Ok(options)
    }

    fn set(&mut self, name: &str, value: &OsStr) -> Result<(), String> {
        match name {
            "--assets" => self.assets = Some(value.into()),
            "--files" => self.files = Some(value.into()),
            "--expect" => self.expect = Some(value.into()),
            "--content" => self.content = Some(value.into()),
            "--size" => self.size = size(name, value)?,
            "--view" => self.view = Some(size(name, value)?),
            "--scene" => self.scene = Some(text(name, value)?),
            "--set" => self.set = Some(text(name, value)?),
            "--events" => self.events = number(name, value)?,
            "--seed" => self.seed = number(name, value)?,
            "--api" => self.api = api(name, value)?,
            "--slow" => self.slow = factor(name, value)?,
            "--keep" => self.keep = Some(value.into()),
            _ => return Err(format!("{name}: no such option")),
        }
        Ok(())
    }
}

fn text(name: &str, value: &OsStr) -> Result<String, String> {
    value.to_str().map(str::to_owned).ok_or_else(|| format!("{name}: expected text, found {value:?}"))
}

fn number(name: &str, value: &OsStr) -> Result<u64, String> {
    let found = text(name, value)?;
    found.parse().map_err(|_| format!("{name}: expected a number, found `{found}`"))
}

fn factor(name: &str, value: &OsStr) -> Result<u32, String> {
    let factor = number(name, value)?;
    u32::try_from(factor)
        .ok()
        .filter(|factor| (1..=1000).contains(factor))
        .ok_or_else(|| format!("{name}: expected a factor from 1 to 1000, found {factor}"))
}

fn api(name: &str, value: &OsStr) -> Result<i32, String> {
    let level = number(name, value)?;
    i32::try_from(level)
        .ok()
        .filter(|level| (28..=36).contains(level))
        .ok_or_else(|| format!("{name}: expected an API level from 28 to 36, found {level}"))
}

fn size(name: &str, value: &OsStr) -> Result<[u32; 2], String> {
    let found = text(name, value)?;
    let sides = found.split_once('x').map(|(w, h)| (w.parse(), h.parse()));
    match sides {
        Some((Ok(width), Ok(height))) if (1..=8192).contains(&width) && (1..=8192).contains(&height) => {
            Ok([width, height])
        }
        _ => Err(format!("{name}: expected WIDTHxHEIGHT, each from 1 to 8192, found `{found}`")),
    }
}
