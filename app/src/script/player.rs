//! Plays a script: one step per frame, at 60 frames per second of simulated time.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    sync::Arc,
    time::Duration,
};

use egui::{Event, Pos2, Rect, TouchDeviceId, TouchId, TouchPhase};

use super::{Finger, Script, ShellEvent, Step, Stroke, Value};
use crate::Change;

/// Time between two frames.
const FRAME: Duration = Duration::from_nanos(16_666_667);

/// Seconds after which the script fails if the view has not come to rest.
const TIMEOUT: f64 = 120.0;

/// A request of a step to the app or to the shell.
#[derive(Clone, Debug, PartialEq)]
pub enum Ask {
    /// Open a scene by its name.
    Open(String),
    /// Apply a change of the choices.
    Set(Change),
    /// Fix the cost of frames in nanoseconds per pixel.
    Cost(f64),
    /// Save the frame.
    Screenshot(PathBuf),
    /// Compare the frame with the picture in a file, within bounds as they are typed.
    Compare(PathBuf, String),
    /// Save the window's content.
    Window(PathBuf),
    /// Simulate an event of the window or the phone.
    Shell(ShellEvent),
    /// Print that line.
    Print(String),
    /// End the program.
    Quit,
}

/// A script in progress.
pub struct Player {
    script: Script,
    next: usize,
    now: Duration,
    /// The step in progress that lasts several frames.
    lasting: Option<Lasting>,
    pointer: [f32; 2],
    fingers: BTreeMap<u64, [f32; 2]>,
    /// Finger that is reported as the pointer as well: the first that came down.
    pointing: Option<u64>,
}

/// A file that is dropped on the view.
#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("scenes are read by their name".to_owned())
    }
}

enum Lasting {
    Pause { until: Duration },
    Rest { until: Duration },
    Motion { finger: Option<u64>, from: [f32; 2], to: [f32; 2], began: Duration, seconds: f64 },
}

impl Player {
    /// Starts before the first step.
    #[must_use]
    pub fn new(script: Script) -> Self {
        Self {
            script,
            next: 0,
            now: Duration::ZERO,
            lasting: None,
            pointer: [0.5; 2],
            fingers: BTreeMap::new(),
            pointing: None,
        }
    }

    /// Simulated time of the current frame.
    #[must_use]
    pub fn now(&self) -> Duration {
        self.now
    }

    /// Plays a frame: adds events to `input` for a view of that rectangle in points, and returns the step's
    /// request to the app or the shell. `rests` tells whether the view is at rest with its frame complete;
    /// `look` returns the value of a name.
    ///
    /// # Errors
    /// Fails with a step, with `FILE:LINE: expected ..., found ...`.
    pub fn frame(
        &mut self,
        input: &mut egui::RawInput,
        view: Rect,
        rests: bool,
        look: &dyn Fn(&str) -> Option<Value>,
    ) -> Result<Option<Ask>, String> {
        self.now += FRAME;
        if let Some(lasting) = self.lasting.take() {
            self.lasting = self.go_on(lasting, input, view, rests)?;
            if self.lasting.is_some() {
                return Ok(None);
            }
        }
        let Some((line, step)) = self.script.steps.get(self.next).cloned() else {
            return Ok(Some(Ask::Quit));
        };
        self.next += 1;
        self.step(step, input, view, look).map_err(|reason| format!("{}:{line}: {reason}", self.script.file))
    }

    /// Position of the last step, for messages: `FILE:LINE`.
    #[must_use]
    pub fn place(&self) -> String {
        let line =
            self.next.checked_sub(1).and_then(|last| self.script.steps.get(last)).map_or(0, |step| step.0);
        format!("{}:{line}", self.script.file)
    }

    fn step(
        &mut self,
        step: Step,
        input: &mut egui::RawInput,
        view: Rect,
        look: &dyn Fn(&str) -> Option<Value>,
    ) -> Result<Option<Ask>, String> {
        let events = &mut input.events;
        match step {
            Step::Open(scene) => return Ok(Some(Ask::Open(scene))),
            Step::Set(change) => return Ok(Some(Ask::Set(change))),
            Step::Cost(cost) => return Ok(Some(Ask::Cost(cost))),
            Step::Screenshot(file) => return Ok(Some(Ask::Screenshot(file))),
            Step::ExpectPicture(file, bounds) => return Ok(Some(Ask::Compare(file, bounds))),
            Step::Window(file) => return Ok(Some(Ask::Window(file))),
            Step::Shell(event) => return Ok(Some(Ask::Shell(event))),
            Step::Quit => return Ok(Some(Ask::Quit)),
            Step::Print(name) => {
                let value =
                    look(&name).ok_or_else(|| format!("expected a value of {name}, found none yet"))?;
                let value = match value {
                    Value::Number(number) => number.to_string(),
                    Value::Text(text) => text,
                };
                return Ok(Some(Ask::Print(format!("{name} = {value}"))));
            }
            Step::Expect(expectation) => expectation.check(look(expectation.name()).as_ref())?,
            Step::Drop(path) => {
                input.dropped_files.push(Arc::new(Dropped(path)));
            }
            Step::Move(to, seconds) => {
                self.lasting = Some(self.motion(None, self.pointer, to, seconds));
            }
            Step::Button(button, pressed) => {
                let modifiers = egui::Modifiers::NONE;
                events.push(Event::PointerButton {
                    pos: within(view, self.pointer),
                    button,
                    pressed,
                    modifiers,
                });
            }
            Step::Scroll(notches) => events.push(Event::MouseWheel {
                unit: egui::MouseWheelUnit::Line,
                delta: egui::vec2(0.0, notches),
                phase: TouchPhase::Move,
                source: egui::MouseWheelSource::Unknown,
                modifiers: egui::Modifiers::NONE,
            }),
            Step::Pinch(factor) => events.push(Event::Zoom(factor)),
            Step::Touch(finger, phase) => self.touch(finger, phase, events, view)?,
            Step::Key(key, modifiers, stroke) => {
                let mut push = |pressed| {
                    events.push(Event::Key { key, physical_key: None, pressed, repeat: false, modifiers });
                };
                if stroke != Stroke::Let {
                    push(true);
                }
                if stroke != Stroke::Hold {
                    push(false);
                }
            }
            Step::Wait(seconds) => {
                self.lasting = Some(Lasting::Pause { until: self.now + Duration::from_secs_f64(seconds) });
            }
            Step::Settle => {
                self.lasting = Some(Lasting::Rest { until: self.now + Duration::from_secs_f64(TIMEOUT) });
            }
        }
        Ok(None)
    }

    fn motion(&self, finger: Option<u64>, from: [f32; 2], to: [f32; 2], seconds: f64) -> Lasting {
        Lasting::Motion { finger, from, to, began: self.now, seconds }
    }

    /// Continues a step that lasts several frames.
    fn go_on(
        &mut self,
        lasting: Lasting,
        input: &mut egui::RawInput,
        view: Rect,
        rests: bool,
    ) -> Result<Option<Lasting>, String> {
        match lasting {
            Lasting::Pause { until } => Ok((self.now < until).then_some(lasting)),
            Lasting::Rest { .. } if rests => Ok(None),
            Lasting::Rest { until } if self.now < until => Ok(Some(lasting)),
            Lasting::Rest { .. } => {
                Err(format!("{}: expected rest within {TIMEOUT} s, found none", self.place()))
            }
            Lasting::Motion { finger, from, to, began, seconds } => {
                let passed = (self.now - began).as_secs_f64();
                let part = if passed >= seconds { 1.0 } else { (passed / seconds) as f32 };
                let at = [0, 1].map(|i| from[i] + part * (to[i] - from[i]));
                match finger {
                    None => {
                        self.pointer = at;
                        input.events.push(Event::PointerMoved(within(view, at)));
                    }
                    Some(finger) => {
                        self.fingers.insert(finger, at);
                        input.events.push(touch(finger, TouchPhase::Move, within(view, at)));
                        if self.pointing == Some(finger) {
                            self.pointer = at;
                            input.events.push(Event::PointerMoved(within(view, at)));
                        }
                    }
                }
                Ok((part < 1.0).then_some(lasting))
            }
        }
    }

    fn touch(
        &mut self,
        finger: u64,
        phase: Finger,
        events: &mut Vec<Event>,
        view: Rect,
    ) -> Result<(), String> {
        let down = self.fingers.get(&finger).copied();
        match (phase, down) {
            (Finger::Begin(at), None) => {
                self.fingers.insert(finger, at);
                events.push(touch(finger, TouchPhase::Start, within(view, at)));
                if self.fingers.len() == 1 {
                    self.pointing = Some(finger);
                    self.pointer = at;
                    events.extend(pointer(within(view, at), true));
                }
            }
            (Finger::Move(to, seconds), Some(from)) => {
                self.lasting = Some(self.motion(Some(finger), from, to, seconds));
            }
            (Finger::End, Some(at)) => {
                self.fingers.remove(&finger);
                events.push(touch(finger, TouchPhase::End, within(view, at)));
                if self.pointing.take_if(|pointing| *pointing == finger).is_some() {
                    events.extend(pointer(within(view, at), false));
                    events.push(Event::PointerGone);
                }
            }
            (Finger::Begin(_), Some(_)) => return Err(format!("expected finger {finger} up, found it down")),
            (_, None) => return Err(format!("expected finger {finger} down, found it up")),
        }
        Ok(())
    }
}

fn within(view: Rect, [x, y]: [f32; 2]) -> Pos2 {
    view.lerp_inside(egui::vec2(x, y))
}

fn touch(finger: u64, phase: TouchPhase, pos: Pos2) -> Event {
    Event::Touch { device_id: TouchDeviceId(0), id: TouchId(finger), phase, pos, force: None }
}

fn pointer(pos: Pos2, pressed: bool) -> [Event; 2] {
    let button = egui::PointerButton::Primary;
    let modifiers = egui::Modifiers::NONE;
    [Event::PointerMoved(pos), Event::PointerButton { pos, button, pressed, modifiers }]
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: Rect = Rect { min: Pos2::ZERO, max: egui::pos2(200.0, 100.0) };

    fn player(text: &str) -> Player {
        Player::new(Script::parse("a.script", text).expect("a script"))
    }

    /// Events and request of a frame.
    type Played = (Vec<Event>, Option<Ask>);

    /// Plays a script to its end.
    fn played(text: &str, rests: bool) -> Result<Vec<Played>, String> {
        let mut player = player(text);
        let mut frames = Vec::new();
        loop {
            let mut input = egui::RawInput::default();
            let ask = player
                .frame(&mut input, VIEW, rests, &|name| (name == "rays").then_some(Value::Number(3.0)))?;
            let quit = ask == Some(Ask::Quit);
            frames.push((input.events, ask));
            if quit {
                return Ok(frames);
            }
        }
    }

    #[test]
    fn a_script_ends_where_its_lines_do() {
        assert_eq!(played("", true).expect("played"), [(vec![], Some(Ask::Quit))]);
    }

    #[test]
    fn a_motion_takes_its_time_and_arrives() {
        let frames = played("move 1,0 over 0.5\npress", true).expect("played");
        let moves: Vec<_> = frames
            .iter()
            .flat_map(|(events, _)| events)
            .filter_map(|event| if let Event::PointerMoved(at) = event { Some(*at) } else { None })
            .collect();
        assert_eq!(moves.len(), 30);
        assert!(moves.windows(2).all(|pair| pair[0].x < pair[1].x && pair[0].y > pair[1].y));
        assert_eq!(moves.last(), Some(&egui::pos2(200.0, 0.0)));
    }

    #[test]
    fn waiting_takes_its_frames_and_settling_its_rest() {
        assert_eq!(played("wait 1", true).expect("played").len(), 61);
        assert_eq!(played("settle", true).expect("played").len(), 2);
        let error = played("\nsettle", false).unwrap_err();
        assert_eq!(error, "a.script:2: expected rest within 120 s, found none");
    }

    #[test]
    fn expectations_name_their_line() {
        assert!(played("expect rays = 3", true).is_ok());
        let error = played("wait 0\nexpect rays > 3", true).unwrap_err();
        assert_eq!(error, "a.script:2: expected rays > 3, found 3");
        let error = played("expect psnr > 3", true).unwrap_err();
        assert_eq!(error, "a.script:1: expected psnr > 3, found no value yet");
        let error = played("print psnr", true).unwrap_err();
        assert_eq!(error, "a.script:1: expected a value of psnr, found none yet");
    }

    #[test]
    fn a_picture_is_asked_for_with_its_bounds() {
        let frames = played("expect picture a.png --max-rmse 3", true).expect("played");
        assert_eq!(frames[0].1, Some(Ask::Compare("a.png".into(), "--max-rmse 3".to_owned())));
    }

    #[test]
    fn the_first_finger_is_a_pointer_and_the_second_is_not() {
        let script = "touch 0 begin 0.5,0.5\ntouch 1 begin 0.6,0.5\ntouch 1 move 0.7,0.5\ntouch 1 end\n\
            touch 0 move 0.25,0.5\ntouch 0 end";
        let frames = played(script, true).expect("played");
        let counts: Vec<_> = frames.iter().map(|(events, _)| events.len()).collect();
        // A motion's last event arrives in the frame of the following step.
        assert_eq!(counts, [3, 1, 0, 2, 0, 6, 0]);
        assert_eq!(frames[5].0[1], Event::PointerMoved(egui::pos2(50.0, 50.0)));
        assert!(played("touch 0 end", true).unwrap_err().contains("expected finger 0 down"));
        assert!(played("touch 0 begin 0,0\ntouch 0 begin 0,0", true).unwrap_err().contains("finger 0 up"));
    }
}
