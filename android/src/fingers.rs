//! Converts touches into the overlay's events.

use egui::{Event, Modifiers, PointerButton, Pos2, TouchDeviceId, TouchId, TouchPhase};

/// The finger that is reported as the pointer: the first that came down, until it is lifted.
#[derive(Debug, Default)]
pub struct Fingers {
    pointer: Option<u64>,
}

impl Fingers {
    /// Appends the events of a finger at a position in points; `force` is the pressure that the screen reports.
    pub fn touch(&mut self, events: &mut Vec<Event>, id: u64, phase: TouchPhase, pos: Pos2, force: f32) {
        events.push(Event::Touch {
            device_id: TouchDeviceId(0),
            id: TouchId(id),
            phase,
            pos,
            force: Some(force),
        });
        match (phase, self.pointer) {
            (TouchPhase::Start, None) => {
                self.pointer = Some(id);
                events.extend([Event::PointerMoved(pos), button(pos, true)]);
            }
            (TouchPhase::Move, Some(pointer)) if pointer == id => events.push(Event::PointerMoved(pos)),
            (TouchPhase::End, Some(pointer)) if pointer == id => {
                self.pointer = None;
                events.extend([button(pos, false), Event::PointerGone]);
            }
            (TouchPhase::Cancel, Some(pointer)) if pointer == id => {
                self.pointer = None;
                events.push(Event::PointerGone);
            }
            _ => {}
        }
    }
}

fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    fn after(touches: &[(u64, TouchPhase)]) -> Vec<Event> {
        let (mut fingers, mut events) = (Fingers::default(), Vec::new());
        for (id, phase) in touches {
            fingers.touch(&mut events, *id, *phase, pos2(*id as f32, 1.0), 0.5);
        }
        events.retain(|event| !matches!(event, Event::Touch { .. }));
        events
    }

    #[test]
    fn the_first_finger_is_the_pointer_and_the_second_is_not() {
        let first = pos2(4.0, 1.0);
        let events = after(&[
            (4, TouchPhase::Start),
            (5, TouchPhase::Start),
            (5, TouchPhase::Move),
            (4, TouchPhase::Move),
            (5, TouchPhase::End),
            (4, TouchPhase::End),
        ]);
        let expected = [
            Event::PointerMoved(first),
            button(first, true),
            Event::PointerMoved(first),
            button(first, false),
            Event::PointerGone,
        ];
        assert_eq!(events, expected);
    }

    #[test]
    fn a_touch_that_is_taken_away_presses_nothing() {
        let events = after(&[(1, TouchPhase::Start), (1, TouchPhase::Cancel), (2, TouchPhase::Start)]);
        assert!(!events.contains(&button(pos2(1.0, 1.0), false)));
        assert_eq!(events.last(), Some(&button(pos2(2.0, 1.0), true)), "the next finger is the pointer");
    }
}
