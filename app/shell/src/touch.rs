//! Emulates touches with a mouse.

use egui::{Event, Pos2, TouchDeviceId, TouchId, TouchPhase};

/// Converts mouse events into touches: the left button is a finger; with Ctrl, a second finger mirrors it about the
/// centre of the view. Without a button, the mouse is no finger.
#[derive(Debug, Default)]
pub struct Finger {
    /// Number of fingers that are down.
    down: u64,
}

impl Finger {
    /// Replaces mouse events by touches. Positions are multiplied by `scale`; `middle` is the centre of the view in
    /// scaled points.
    pub fn translate(&mut self, events: &mut Vec<Event>, scale: f32, middle: Pos2) {
        let events_before = std::mem::take(events);
        for event in events_before {
            match event {
                Event::PointerMoved(at) if self.down > 0 => self.moved(events, scaled(at, scale), middle),
                Event::PointerMoved(_) => {}
                Event::PointerButton { pos, button: egui::PointerButton::Primary, pressed, modifiers } => {
                    let at = scaled(pos, scale);
                    match (pressed, self.down) {
                        (true, 0) => self.pressed(events, at, if modifiers.ctrl { 2 } else { 1 }, middle),
                        (false, 1..) => self.released(events, at, middle),
                        _ => {}
                    }
                }
                Event::PointerButton { .. } => {}
                Event::Touch { device_id, id, phase, pos, force } => {
                    events.push(Event::Touch { device_id, id, phase, pos: scaled(pos, scale), force });
                }
                other => events.push(other),
            }
        }
    }

    fn pressed(&mut self, events: &mut Vec<Event>, at: Pos2, fingers: u64, middle: Pos2) {
        self.down = fingers;
        self.touch(events, TouchPhase::Start, at, middle);
        events.push(Event::PointerMoved(at));
        events.push(button(at, true));
    }

    fn moved(&mut self, events: &mut Vec<Event>, at: Pos2, middle: Pos2) {
        self.touch(events, TouchPhase::Move, at, middle);
        events.push(Event::PointerMoved(at));
    }

    fn released(&mut self, events: &mut Vec<Event>, at: Pos2, middle: Pos2) {
        self.touch(events, TouchPhase::End, at, middle);
        events.push(button(at, false));
        events.push(Event::PointerGone);
        self.down = 0;
    }

    fn touch(&self, events: &mut Vec<Event>, phase: TouchPhase, at: Pos2, middle: Pos2) {
        let places = [at, middle + (middle - at)];
        for (id, pos) in (0..self.down).zip(places) {
            events.push(Event::Touch {
                device_id: TouchDeviceId(0),
                id: TouchId(id),
                phase,
                pos,
                force: None,
            });
        }
    }
}

fn scaled(at: Pos2, scale: f32) -> Pos2 {
    (scale * at.to_vec2()).to_pos2()
}

fn button(pos: Pos2, pressed: bool) -> Event {
    let modifiers = egui::Modifiers::NONE;
    Event::PointerButton { pos, button: egui::PointerButton::Primary, pressed, modifiers }
}

#[cfg(test)]
mod tests {
    use egui::{Modifiers, PointerButton, pos2};

    use super::*;

    const MIDDLE: Pos2 = pos2(50.0, 100.0);

    fn mouse(pos: Pos2, pressed: bool, modifiers: Modifiers) -> Event {
        Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers }
    }

    fn touches(events: &[Event]) -> Vec<(u64, TouchPhase, Pos2)> {
        let touch = |event: &Event| match event {
            Event::Touch { id, phase, pos, .. } => Some((id.0, *phase, *pos)),
            _ => None,
        };
        events.iter().filter_map(touch).collect()
    }

    #[test]
    fn a_button_is_a_finger_and_a_mouse_alone_is_none() {
        let mut finger = Finger::default();
        let at = pos2(10.0, 20.0);
        let mut events = vec![
            Event::PointerMoved(at),
            mouse(at, true, Modifiers::NONE),
            Event::PointerMoved(pos2(12.0, 20.0)),
            mouse(pos2(12.0, 20.0), false, Modifiers::NONE),
            Event::PointerMoved(at),
        ];
        finger.translate(&mut events, 2.0, MIDDLE);
        assert_eq!(
            touches(&events),
            [
                (0, TouchPhase::Start, pos2(20.0, 40.0)),
                (0, TouchPhase::Move, pos2(24.0, 40.0)),
                (0, TouchPhase::End, pos2(24.0, 40.0)),
            ]
        );
        assert!(matches!(events[0], Event::Touch { .. }), "the mouse that only moved is dropped");
        assert!(matches!(events.last(), Some(Event::PointerGone)));
    }

    #[test]
    fn ctrl_is_a_second_finger_on_the_other_side() {
        let mut finger = Finger::default();
        let mut events = vec![mouse(pos2(40.0, 100.0), true, Modifiers::CTRL)];
        finger.translate(&mut events, 1.0, MIDDLE);
        assert_eq!(
            touches(&events),
            [(0, TouchPhase::Start, pos2(40.0, 100.0)), (1, TouchPhase::Start, pos2(60.0, 100.0))]
        );
        let mut events = vec![mouse(pos2(30.0, 100.0), false, Modifiers::NONE)];
        finger.translate(&mut events, 1.0, MIDDLE);
        assert_eq!(touches(&events).len(), 2, "both leave, Ctrl or not");
    }

    #[test]
    fn other_buttons_do_nothing_on_a_phone() {
        let mut events = vec![Event::PointerButton {
            pos: MIDDLE,
            button: PointerButton::Secondary,
            pressed: true,
            modifiers: Modifiers::NONE,
        }];
        Finger::default().translate(&mut events, 1.0, MIDDLE);
        assert!(events.is_empty());
    }
}
