//! Parses scripts.

use egui::{Key, Modifiers, PointerButton};
use glimpse::options::suggestion;

use super::{Expectation, Finger, Script, Step, Stroke, expectation::Operator, words::WORDS};
use crate::script_values::{is_known, names};

/// The largest side of a window in pixels.
const MAX_SIDE: u32 = 16384;

/// The longest duration of a step in seconds.
pub const MAX_SECONDS: f64 = 3600.0;

impl Script {
    /// Parses a script; `file` is its name in messages.
    ///
    /// # Errors
    /// Fails for an invalid line, with `FILE:LINE: expected ..., found ...`.
    pub fn parse(file: &str, text: &str) -> Result<Self, String> {
        let mut steps = Vec::new();
        let text = text.trim_start_matches('\u{feff}');
        for (index, line) in text.lines().enumerate() {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let step = step(line).map_err(|reason| format!("{file}:{}: {reason}", index + 1))?;
            steps.push((index + 1, step));
        }
        Ok(Self { file: file.to_owned(), steps })
    }

    /// Checks the bounds of every picture that is expected.
    ///
    /// # Errors
    /// Fails with `FILE:LINE: ` and the reason that `check` gives.
    pub fn check_bounds(&self, check: impl Fn(&str) -> Result<(), String>) -> Result<(), String> {
        self.steps.iter().try_for_each(|(line, step)| match step {
            Step::ExpectPicture(_, bounds) => {
                check(bounds).map_err(|reason| format!("{}:{line}: {reason}", self.file))
            }
            _ => Ok(()),
        })
    }
}

fn step(line: &str) -> Result<Step, String> {
    let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    let known = WORDS.iter().find(|known| known.name == word).ok_or_else(|| {
        let meant = suggestion(word, WORDS.iter().map(|known| known.name));
        format!("expected a step{meant}, found `{word}`")
    })?;
    (known.parse)(rest.trim())
}

/// What follows a word, which must not be empty.
pub fn text(rest: &str, what: &str) -> Result<String, String> {
    if rest.is_empty() {
        Err(format!("expected {what}, found the end of the line"))
    } else {
        Ok(rest.to_owned())
    }
}

/// Parses a number from `low` to `high`.
pub fn number(text: &str, low: f64, high: f64) -> Result<f64, String> {
    let number: Option<f64> = text.parse().ok();
    number
        .filter(|number| (low..=high).contains(number))
        .ok_or_else(|| format!("expected a number from {low} to {high}, found `{text}`"))
}

fn point(text: &str) -> Result<[f32; 2], String> {
    let (x, y) = text.split_once(',').ok_or_else(|| format!("expected X,Y, found `{text}`"))?;
    Ok([number(x.trim(), -1.0, 2.0)? as f32, number(y.trim(), -1.0, 2.0)? as f32])
}

/// Parses a point and an optional duration in seconds.
pub fn motion(rest: &str) -> Result<([f32; 2], f64), String> {
    match rest.split_once(" over ") {
        None => Ok((point(rest)?, 0.0)),
        Some((to, seconds)) => Ok((point(to.trim())?, number(seconds.trim(), 0.0, MAX_SECONDS)?)),
    }
}

/// Parses the name of a mouse button, the left one by default.
pub fn button(rest: &str) -> Result<PointerButton, String> {
    match rest {
        "" | "left" => Ok(PointerButton::Primary),
        "right" => Ok(PointerButton::Secondary),
        "middle" => Ok(PointerButton::Middle),
        _ => Err(format!("expected left, right or middle, found `{rest}`")),
    }
}

/// Parses the movement of a finger.
pub fn touch(rest: &str) -> Result<Step, String> {
    let expected = || format!("expected FINGER begin X,Y, move X,Y or end, found `{rest}`");
    let (finger, rest) = rest.split_once(' ').ok_or_else(expected)?;
    let finger: u64 = finger.parse().map_err(|_| expected())?;
    let (phase, at) = rest.trim().split_once(' ').unwrap_or((rest.trim(), ""));
    let phase = match phase {
        "begin" => Finger::Begin(point(at.trim())?),
        "move" => {
            let (to, seconds) = motion(at.trim())?;
            Finger::Move(to, seconds)
        }
        "end" if at.is_empty() => Finger::End,
        _ => return Err(expected()),
    };
    Ok(Step::Touch(finger, phase))
}

/// Parses a key with its modifiers.
pub fn key(rest: &str, stroke: Stroke) -> Result<Step, String> {
    let mut modifiers = Modifiers::NONE;
    let mut names = rest.split('+').collect::<Vec<_>>();
    let name = names.pop().filter(|name| !name.is_empty()).unwrap_or("+");
    for modifier in names.into_iter().filter(|name| !name.is_empty()) {
        modifiers |= match modifier {
            "ctrl" => Modifiers::CTRL | Modifiers::COMMAND,
            "shift" => Modifiers::SHIFT,
            "alt" => Modifiers::ALT,
            _ => return Err(format!("expected ctrl, shift or alt, found `{modifier}`")),
        };
    }
    let upper = name.to_uppercase();
    let key = Key::from_name(name)
        .or_else(|| Key::from_name(&upper))
        .or_else(|| Key::ALL.iter().copied().find(|key| key.name().eq_ignore_ascii_case(name)))
        .ok_or_else(|| format!("expected the name of a key, found `{name}`"))?;
    Ok(Step::Key(key, modifiers, stroke))
}

/// Parses the size of a window.
pub fn size(rest: &str) -> Result<[u32; 2], String> {
    let sides: Option<Vec<u32>> = rest.split('x').map(|side| side.trim().parse().ok()).collect();
    match sides.as_deref() {
        Some(&[width, height]) if [width, height].iter().all(|side| (1..=MAX_SIDE).contains(side)) => {
            Ok([width, height])
        }
        _ => Err(format!("expected WIDTHxHEIGHT with sides from 1 to {MAX_SIDE}, found `{rest}`")),
    }
}

/// Parses the name of a value.
pub fn name(rest: &str) -> Result<String, String> {
    let name = text(rest, "a name")?;
    if is_known(&name) {
        return Ok(name);
    }
    let meant = suggestion(&name, names());
    Err(format!("expected the name of a value{meant}, found `{name}`"))
}

/// Parses what is expected of a value or of the frame.
pub fn expectation(rest: &str) -> Result<Step, String> {
    if let Some(picture) = rest.strip_prefix("picture ") {
        // File names may have spaces, bounds begin with dashes.
        let (file, bounds) = match picture.split_once(" --") {
            Some((file, bounds)) => (file, format!("--{bounds}")),
            None => (picture, String::new()),
        };
        return Ok(Step::ExpectPicture(text(file.trim(), "a file")?.into(), bounds));
    }
    let form = || format!("expected NAME OP VALUE or picture FILE, found `{rest}`");
    let mut words = rest.splitn(3, char::is_whitespace).map(str::trim);
    let (Some(of), Some(sign)) = (words.next(), words.next()) else { return Err(form()) };
    let of = name(of)?;
    let operator = Operator::ALL.iter().find(|(text, _)| *text == sign).map(|(_, operator)| *operator);
    let operator = operator.ok_or_else(|| {
        let all: Vec<_> = Operator::ALL.iter().map(|(text, _)| *text).collect();
        format!("expected one of {}, found `{sign}`", all.join(" "))
    })?;
    // The expected text may be empty.
    let value = words.next().unwrap_or_default().to_owned();
    if value.is_empty() && !matches!(operator, Operator::Equal | Operator::NotEqual) {
        return Err(form());
    }
    Ok(Step::Expect(Expectation { name: of, operator, value }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::ShellEvent;

    fn one(line: &str) -> Step {
        Script::parse("a.script", line).expect("a step").steps.remove(0).1
    }

    #[test]
    fn each_kind_of_step() {
        assert_eq!(one("open builtin:room"), Step::Open("builtin:room".to_owned()));
        assert_eq!(one("drop my scene.glb"), Step::Drop("my scene.glb".into()));
        assert_eq!(one("move 0.25,0.5"), Step::Move([0.25, 0.5], 0.0));
        assert_eq!(one("move 0.25, 0.5 over 0.4"), Step::Move([0.25, 0.5], 0.4));
        assert_eq!(one("press"), Step::Button(PointerButton::Primary, true));
        assert_eq!(one("release right"), Step::Button(PointerButton::Secondary, false));
        assert_eq!(one("scroll -3"), Step::Scroll(-3.0));
        assert_eq!(one("touch 1 begin 0.4,0.5"), Step::Touch(1, Finger::Begin([0.4, 0.5])));
        assert_eq!(one("touch 1 move 0.4,0.5 over 1"), Step::Touch(1, Finger::Move([0.4, 0.5], 1.0)));
        assert_eq!(one("touch 1 end"), Step::Touch(1, Finger::End));
        assert_eq!(one("key h"), Step::Key(Key::H, Modifiers::NONE, Stroke::Tap));
        assert_eq!(
            one("key ctrl+shift+c"),
            Step::Key(Key::C, Modifiers::CTRL | Modifiers::COMMAND | Modifiers::SHIFT, Stroke::Tap)
        );
        assert_eq!(one("hold f12"), Step::Key(Key::F12, Modifiers::NONE, Stroke::Hold));
        assert_eq!(one("let escape"), Step::Key(Key::Escape, Modifiers::NONE, Stroke::Let));
        assert_eq!(one("size 1x1"), Step::Shell(ShellEvent::Size([1, 1])));
        assert_eq!(one("thermal 0.5"), Step::Shell(ShellEvent::Thermal(0.5)));
        assert_eq!(one("fullscreen off"), Step::Shell(ShellEvent::FullScreen(false)));
        assert_eq!(one("settle"), Step::Settle);
        assert_eq!(one("set block 4"), Step::Set("block 4".parse().expect("a change")));
        assert!(matches!(one("expect problem ="), Step::Expect(_)));
        assert_eq!(one("print command"), Step::Print("command".to_owned()));
        assert!(matches!(one("expect problem contains no such file"), Step::Expect(_)));
        let picture = |file: &str, bounds: &str| Step::ExpectPicture(file.into(), bounds.to_owned());
        assert_eq!(one("expect picture a b.png"), picture("a b.png", ""));
        let bounds = "--max-rmse 1 --threshold 3";
        assert_eq!(one(&format!("expect picture my ref.png {bounds}")), picture("my ref.png", bounds));
    }

    #[test]
    fn a_byte_order_mark_is_skipped() {
        let script = Script::parse("a.script", "\u{feff}settle\r\nquit").expect("a script");
        assert_eq!(script.steps, [(1, Step::Settle), (2, Step::Quit)]);
    }

    #[test]
    fn bounds_are_checked_by_the_line() {
        let script = Script::parse("a.script", "settle\nexpect picture a.png --wide 3").expect("a script");
        let error = script.check_bounds(|bounds| Err(format!("found `{bounds}`"))).unwrap_err();
        assert_eq!(error, "a.script:2: found `--wide 3`");
        script.check_bounds(|_| Ok(())).expect("bounds");
    }

    #[test]
    fn comments_and_empty_lines_are_skipped_and_lines_are_counted() {
        let script = Script::parse("a.script", "# one\n\n  settle\nquit\n").expect("a script");
        assert_eq!(script.steps, [(3, Step::Settle), (4, Step::Quit)]);
    }

    #[test]
    fn errors_name_the_line_and_what_was_expected() {
        for (line, expected) in [
            ("dance", "expected a step, found `dance`"),
            ("settle down", "expected nothing after settle, found `down`"),
            ("open", "expected a scene, found the end of the line"),
            ("move 0.5", "expected X,Y, found `0.5`"),
            ("move nan,0", "expected a number from -1 to 2, found `nan`"),
            ("wait inf", "expected a number from 0 to 3600, found `inf`"),
            ("press top", "expected left, right or middle, found `top`"),
            ("key ctrl+nothing", "expected the name of a key, found `nothing`"),
            ("key hyper+a", "expected ctrl, shift or alt, found `hyper`"),
            ("size 0x9", "expected WIDTHxHEIGHT with sides from 1 to 16384, found `0x9`"),
            ("touch x", "expected FINGER begin X,Y, move X,Y or end, found `x`"),
            ("dacne", "expected a step, found `dacne`"),
            ("setle", "expected a step (did you mean settle?), found `setle`"),
            ("expect rays", "expected NAME OP VALUE or picture FILE, found `rays`"),
            ("expect rays <", "expected NAME OP VALUE or picture FILE, found `rays <`"),
            ("expect picture", "expected NAME OP VALUE or picture FILE, found `picture`"),
            ("expect rasy > 3", "expected the name of a value (did you mean rays?), found `rasy`"),
            ("print cats", "expected the name of a value, found `cats`"),
            ("expect rays ~ 3", "expected one of = != < <= > >= contains, found `~`"),
        ] {
            let error = Script::parse("a.script", &format!("settle\n{line}")).unwrap_err();
            assert_eq!(error, format!("a.script:2: {expected}"));
        }
        let error = Script::parse("a.script", "set block 3").unwrap_err();
        assert!(error.starts_with("a.script:1: ") && error.contains("2, 4 or 8"), "{error}");
    }
}
