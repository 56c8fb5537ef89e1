//! Fingers on the screen and keys, as Android's input system would send them.

use std::time::Duration;

use super::harness::Harness;
use crate::input::{KEY_BACK, Pointer, action};

/// Time between two events of a gesture.
const PACE: Duration = Duration::from_millis(20);

/// Sends a touch and waits for the next.
pub fn touch(harness: &mut Harness, action: i32, pointers: &[Pointer], history: &[Vec<Pointer>]) {
    if let Some(queue) = harness.activity.as_ref().and_then(|activity| activity.input()) {
        queue.touch(action, pointers, history);
    }
    harness.wait(PACE);
}

/// Sends a key going down and up.
pub fn press(harness: &mut Harness, code: i32) {
    for action in [action::DOWN, action::UP] {
        if let Some(queue) = harness.activity.as_ref().and_then(|activity| activity.input()) {
            queue.key(action, code);
        }
        harness.wait(PACE);
    }
}

/// The back key, or the gesture that stands for it.
pub fn back(harness: &mut Harness) {
    press(harness, KEY_BACK);
}

/// A place on the screen as fractions of its width and height.
fn at(harness: &Harness, id: i32, place: [f32; 2]) -> Pointer {
    Pointer { id, x: place[0] * harness.size[0] as f32, y: place[1] * harness.size[1] as f32 }
}

/// One finger from one place to another in so many moves; places are fractions of the screen.
pub fn drag(harness: &mut Harness, from: [f32; 2], to: [f32; 2], moves: u32) {
    let along = |t: f32| [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * t);
    let start = at(harness, 0, from);
    touch(harness, action::DOWN, &[start], &[]);
    for step in 1..=moves {
        let finger = at(harness, 0, along(step as f32 / moves as f32));
        touch(harness, action::MOVE, &[finger], &[]);
    }
    let end = at(harness, 0, to);
    touch(harness, action::UP, &[end], &[]);
}

/// One finger whose moves all arrive in one event.
pub fn drag_in_a_batch(harness: &mut Harness, from: [f32; 2], to: [f32; 2]) {
    let along = |t: f32| [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * t);
    let places: Vec<Pointer> =
        [0.0, 0.25, 0.5, 0.75, 1.0].iter().map(|t| at(harness, 0, along(*t))).collect();
    let history: Vec<Vec<Pointer>> = places[1..4].iter().map(|finger| vec![*finger]).collect();
    touch(harness, action::DOWN, &places[..1], &[]);
    touch(harness, action::MOVE, &places[4..], &history);
    touch(harness, action::UP, &places[4..], &[]);
}

/// A gesture of one finger that the system takes away from the app.
pub fn cancelled_drag(harness: &mut Harness) {
    let finger = at(harness, 0, [0.5, 0.5]);
    touch(harness, action::DOWN, &[finger], &[]);
    touch(harness, action::CANCEL, &[finger], &[]);
}

/// Two fingers whose distance changes from one share of the width to another; the first finger leaves first.
pub fn pinch(harness: &mut Harness, from: f32, to: f32, moves: u32) {
    // The numbers of fingers need not begin at nought, nor follow each other.
    let fingers = |harness: &Harness, apart: f32| {
        [at(harness, 3, [0.5 - apart / 2.0, 0.5]), at(harness, 7, [0.5 + apart / 2.0, 0.5])]
    };
    let index = |index: i32| index << 8;
    let start = fingers(harness, from);
    touch(harness, action::DOWN, &start[..1], &[]);
    touch(harness, action::POINTER_DOWN | index(1), &start, &[]);
    for step in 1..=moves {
        let now = fingers(harness, from + (to - from) * step as f32 / moves as f32);
        touch(harness, action::MOVE, &now, &[]);
    }
    let end = fingers(harness, to);
    touch(harness, action::POINTER_UP | index(0), &end, &[]);
    touch(harness, action::UP, &end[1..], &[]);
}
