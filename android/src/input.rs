//! Converts the system's input events into the overlay's events.

use android_activity::{
    AndroidApp, InputStatus,
    input::{Axis, InputEvent, KeyAction, KeyEvent, Keycode, MotionAction, MotionEvent, Pointer},
};
use egui::{Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, Pos2, TouchPhase, vec2};

use crate::fingers::Fingers;

/// Input events that the session has not been given yet.
#[derive(Default)]
pub struct Input {
    fingers: Fingers,
    events: Vec<Event>,
    /// How often the back key was released.
    backs: u32,
}

impl Input {
    /// Reads all events that are waiting; the overlay has one point for `pixels_per_point` pixels.
    pub fn read(&mut self, app: &AndroidApp, pixels_per_point: f32) {
        match app.input_events_iter() {
            Ok(mut events) => while events.next(|event| self.handle_event(event, pixels_per_point)) {},
            Err(error) => log::warn!("input is lost: {error}"),
        }
    }

    /// Takes the events.
    pub fn take(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }

    /// Takes the number of times that the back key was released.
    pub fn take_backs(&mut self) -> u32 {
        std::mem::take(&mut self.backs)
    }

    fn handle_event(&mut self, event: &InputEvent<'_>, pixels_per_point: f32) -> InputStatus {
        match event {
            InputEvent::MotionEvent(motion) => self.motion(motion, pixels_per_point),
            InputEvent::KeyEvent(key) => self.key(key),
            _ => InputStatus::Unhandled,
        }
    }

    fn motion(&mut self, motion: &MotionEvent<'_>, pixels_per_point: f32) -> InputStatus {
        let mut touch = |pointer: Pointer<'_>, phase| {
            let at = Pos2::new(pointer.x(), pointer.y()) / pixels_per_point;
            self.fingers.touch(&mut self.events, pointer.pointer_id() as u64, phase, at, pointer.pressure());
        };
        match motion.action() {
            MotionAction::Down | MotionAction::PointerDown => {
                touch(motion.pointer_at_index(motion.pointer_index()), TouchPhase::Start);
            }
            MotionAction::Up | MotionAction::PointerUp => {
                touch(motion.pointer_at_index(motion.pointer_index()), TouchPhase::End);
            }
            MotionAction::Move => motion.pointers().for_each(|pointer| touch(pointer, TouchPhase::Move)),
            MotionAction::Cancel => motion.pointers().for_each(|pointer| touch(pointer, TouchPhase::Cancel)),
            MotionAction::Scroll => self.wheel(motion),
            _ => return InputStatus::Unhandled,
        }
        InputStatus::Handled
    }

    fn wheel(&mut self, motion: &MotionEvent<'_>) {
        if let Some(pointer) = motion.pointers().next() {
            self.events.push(Event::MouseWheel {
                source: MouseWheelSource::Unknown,
                unit: MouseWheelUnit::Line,
                delta: vec2(pointer.axis_value(Axis::Hscroll), pointer.axis_value(Axis::Vscroll)),
                phase: TouchPhase::Move,
                modifiers: Modifiers::NONE,
            });
        }
    }

    fn key(&mut self, event: &KeyEvent<'_>) -> InputStatus {
        let pressed = match event.action() {
            KeyAction::Down => true,
            KeyAction::Up => false,
            _ => return InputStatus::Unhandled,
        };
        if event.key_code() == Keycode::Back {
            self.backs += u32::from(!pressed);
            return InputStatus::Handled;
        }
        let Some(key) = key(event.key_code()) else { return InputStatus::Unhandled };
        let meta = event.meta_state();
        let modifiers = Modifiers {
            alt: meta.alt_on(),
            ctrl: meta.ctrl_on(),
            shift: meta.shift_on(),
            mac_cmd: false,
            command: meta.ctrl_on(),
        };
        let repeat = event.repeat_count() > 0;
        self.events.push(Event::Key { key, physical_key: None, pressed, repeat, modifiers });
        InputStatus::Handled
    }
}

/// The key of a hardware keyboard. Letters and function keys have the same names in egui and Android.
fn key(code: Keycode) -> Option<Key> {
    Some(match code {
        Keycode::DpadLeft => Key::ArrowLeft,
        Keycode::DpadRight => Key::ArrowRight,
        Keycode::DpadUp => Key::ArrowUp,
        Keycode::DpadDown => Key::ArrowDown,
        Keycode::Keycode0 => Key::Num0,
        Keycode::Keycode1 => Key::Num1,
        Keycode::Keycode2 => Key::Num2,
        Keycode::Keycode3 => Key::Num3,
        Keycode::Keycode4 => Key::Num4,
        Keycode::Keycode5 => Key::Num5,
        Keycode::Keycode6 => Key::Num6,
        Keycode::Keycode7 => Key::Num7,
        Keycode::Keycode8 => Key::Num8,
        Keycode::Keycode9 => Key::Num9,
        other => Key::from_name(&format!("{other:?}"))?,
    })
}
