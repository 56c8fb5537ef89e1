//! The words of scripts, in a table from which lines are parsed and the help is made.

use super::{ShellEvent, Step, Stroke, parse};
use crate::Change;

/// A word that begins a line.
pub struct Word {
    /// The first word of the line, which selects the step.
    pub name: &'static str,
    /// The form of what follows it; empty for nothing.
    pub form: &'static str,
    /// Description of the step.
    pub summary: &'static str,
    /// Parses the rest of the line into the step.
    pub parse: fn(&str) -> Result<Step, String>,
}

const fn word(
    name: &'static str,
    form: &'static str,
    summary: &'static str,
    parse: fn(&str) -> Result<Step, String>,
) -> Word {
    Word { name, form, summary, parse }
}

/// A word that nothing follows.
macro_rules! bare {
    ($name:literal, $summary:literal, $step:expr) => {
        word($name, "", $summary, |rest| {
            if rest.is_empty() {
                Ok($step)
            } else {
                Err(format!("expected nothing after {}, found `{rest}`", $name))
            }
        })
    };
}

/// The words that may begin a line, in the order of the help.
#[rustfmt::skip]
pub const WORDS: &[Word] = &[
    word("open", "SCENE", "opens a scene", |rest| Ok(Step::Open(parse::text(rest, "a scene")?))),
    word("drop", "FILE", "drops a file on the window", |rest| Ok(Step::Drop(parse::text(rest, "a file")?.into()))),
    word("move", "X,Y [over SECONDS]", "moves the pointer, within that time", |rest| {
        let (point, seconds) = parse::motion(rest)?;
        Ok(Step::Move(point, seconds))
    }),
    word("press", "[left|right|middle]", "presses a button", |rest| Ok(Step::Button(parse::button(rest)?, true))),
    word("release", "[left|right|middle]", "releases a button", |rest| Ok(Step::Button(parse::button(rest)?, false))),
    word("scroll", "NOTCHES", "turns the wheel, up is positive", |rest| {
        Ok(Step::Scroll(parse::number(rest, -1000.0, 1000.0)? as f32))
    }),
    word("pinch", "FACTOR", "pinches on a trackpad: a factor on the distance of the fingers", |rest| {
        Ok(Step::Pinch(parse::number(rest, 0.01, 100.0)? as f32))
    }),
    word("touch", "FINGER begin X,Y | move X,Y [over SECONDS] | end", "moves a finger", parse::touch),
    word("key", "[ctrl+|shift+|alt+]KEY", "presses and releases a key", |rest| parse::key(rest, Stroke::Tap)),
    word("hold", "KEY", "presses a key", |rest| parse::key(rest, Stroke::Hold)),
    word("let", "KEY", "releases a key", |rest| parse::key(rest, Stroke::Let)),
    word("set", "NAME VALUE", "sets an option, or show, split (off or a share), scale, lenses (none, cardboard), governor \
        (off, 15, 30, 60), at-rest (chosen, refined; chosen in scripts unless set) or overlay (hidden, brief, full)", |rest| Ok(Step::Set(rest.parse::<Change>()?))),
    word("size", "WxH", "resizes the window, in pixels", |rest| Ok(Step::Shell(ShellEvent::Size(parse::size(rest)?)))),
    bare!("minimise", "minimises the window", Step::Shell(ShellEvent::Minimise)),
    bare!("restore", "restores the window", Step::Shell(ShellEvent::Restore)),
    word("fullscreen", "on|off", "enters or leaves full screen", |rest| match rest {
        "on" => Ok(Step::Shell(ShellEvent::FullScreen(true))),
        "off" => Ok(Step::Shell(ShellEvent::FullScreen(false))),
        _ => Err(format!("expected on or off, found `{rest}`")),
    }),
    bare!("rotate", "rotates the phone by 90 degrees", Step::Shell(ShellEvent::Rotate)),
    bare!("pause", "brings another app to the front", Step::Shell(ShellEvent::Pause)),
    bare!("resume", "brings the app to the front again", Step::Shell(ShellEvent::Resume)),
    bare!("lose-surface", "loses the surface", Step::Shell(ShellEvent::LoseSurface)),
    bare!("lose-device", "loses the graphics device", Step::Shell(ShellEvent::LoseDevice)),
    bare!("low-memory", "reports low memory", Step::Shell(ShellEvent::LowMemory)),
    word("thermal", "FACTOR", "heats the device: a factor on the time limit of frames, 1 when cool", |rest| {
        Ok(Step::Shell(ShellEvent::Thermal(parse::number(rest, 0.0, 1.0)? as f32)))
    }),
    word("cost", "NANOSECONDS", "fixes the cost of frames, for each pixel", |rest| {
        Ok(Step::Cost(parse::number(rest, 0.0, 1e9)?))
    }),
    word("wait", "SECONDS", "lets simulated time pass", |rest| {
        Ok(Step::Wait(parse::number(rest, 0.0, parse::MAX_SECONDS)?))
    }),
    bare!("settle", "waits until the view is at rest and its frame is complete", Step::Settle),
    word("screenshot", "FILE", "saves the frame", |rest| Ok(Step::Screenshot(parse::text(rest, "a file")?.into()))),
    word("window", "FILE", "saves the content of the window", |rest| {
        Ok(Step::Window(parse::text(rest, "a file")?.into()))
    }),
    word("expect", "NAME OP VALUE | picture FILE [BOUNDS]", "fails where a value does not compare so, or the frame is not \
        the picture of a file within the bounds of `glimpse compare`", parse::expectation),
    word("print", "NAME", "prints NAME = VALUE to the standard output", |rest| Ok(Step::Print(parse::name(rest)?))),
    bare!("quit", "ends the program", Step::Quit),
];
