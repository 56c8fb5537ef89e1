//! Distributes pointer events over updates, so that a gesture between two updates is not lost.
//!
//! egui measures a drag from update to update. When a press, moves and the release arrive together, as they do while
//! frames are slow or when a touchscreen delivers its events in batches, it sees a click at most.

use std::collections::VecDeque;

use egui::{Event, TouchPhase};

/// Events that wait for the next updates.
#[derive(Clone, Debug, Default)]
pub(crate) struct InputQueue {
    waiting: VecDeque<Event>,
    /// Buttons that are pressed, after the events that were taken.
    pressed: u32,
}

/// What a pointer does in an event.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Contact {
    Begins,
    Moves,
    Ends,
}

impl InputQueue {
    /// Appends events and takes those of one update: a move after a contact has begun, and the end of a contact after a
    /// move, wait for the next.
    pub fn next(&mut self, arrived: Vec<Event>) -> Vec<Event> {
        self.waiting.extend(arrived);
        let (mut began, mut moved) = (false, false);
        let mut taken = Vec::new();
        while let Some(event) = self.waiting.front() {
            match self.contact(event) {
                Some(Contact::Moves) if began => break,
                Some(Contact::Ends) if moved => break,
                contact => {
                    began |= contact == Some(Contact::Begins);
                    moved |= contact == Some(Contact::Moves);
                }
            }
            match event {
                Event::PointerButton { pressed: true, .. } => self.pressed += 1,
                Event::PointerButton { pressed: false, .. } => self.pressed = self.pressed.saturating_sub(1),
                Event::PointerGone => self.pressed = 0,
                _ => {}
            }
            taken.extend(self.waiting.pop_front());
        }
        taken
    }

    /// Whether another update has to follow for the events that wait.
    pub fn is_waiting(&self) -> bool {
        !self.waiting.is_empty()
    }

    fn contact(&self, event: &Event) -> Option<Contact> {
        match event {
            Event::PointerButton { pressed: true, .. } | Event::Touch { phase: TouchPhase::Start, .. } => {
                Some(Contact::Begins)
            }
            Event::Touch { phase: TouchPhase::Move, .. } => Some(Contact::Moves),
            Event::PointerMoved(_) if self.pressed > 0 => Some(Contact::Moves),
            Event::PointerButton { pressed: false, .. } | Event::PointerGone | Event::Touch { .. } => {
                Some(Contact::Ends)
            }
            _ => None,
        }
    }
}
