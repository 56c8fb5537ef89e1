//! Fingers on the screen and keys, as Android's input system would send them.

use std::time::Duration;

use super::harness::Stage;
use crate::input::{KEY_BACK, Pointer, action};

/// Time between two events of a gesture.
const PACE: Duration = Duration::from_millis(20);

/// Sends a touch and waits for the next.
pub fn touch(stage: &mut Stage, action: i32, pointers: &[Pointer], history: &[Vec<Pointer>]) {
    if let Some(queue) = stage.activity.as_ref().and_then(|activity| activity.input()) {
        queue.touch(action, pointers, history);
    }
    stage.wait(PACE);
}

/// Sends a key going down and up.
pub fn press(stage: &mut Stage, code: i32) {
    for action in [action::DOWN, action::UP] {
        if let Some(queue) = stage.activity.as_ref().and_then(|activity| activity.input()) {
            queue.key(action, code);
        }
        stage.wait(PACE);
    }
}

/// The back key, or the gesture that stands for it.
pub fn back(stage: &mut Stage) {
    press(stage, KEY_BACK);
}

/// A place on the screen as fractions of its width and height.
fn at(stage: &Stage, id: i32, place: [f32; 2]) -> Pointer {
    Pointer { id, x: place[0] * stage.size[0] as f32, y: place[1] * stage.size[1] as f32 }
}

/// One finger from one place to another in so many moves; places are fractions of the screen.
pub fn drag(stage: &mut Stage, from: [f32; 2], to: [f32; 2], moves: u32) {
    let along = |t: f32| [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * t);
    let start = at(stage, 0, from);
    touch(stage, action::DOWN, &[start], &[]);
    for step in 1..=moves {
        let finger = at(stage, 0, along(step as f32 / moves as f32));
        touch(stage, action::MOVE, &[finger], &[]);
    }
    let end = at(stage, 0, to);
    touch(stage, action::UP, &[end], &[]);
}

/// One finger whose moves all arrive in one event.
pub fn drag_in_a_batch(stage: &mut Stage, from: [f32; 2], to: [f32; 2]) {
    let along = |t: f32| [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * t);
    let places: Vec<Pointer> = [0.0, 0.25, 0.5, 0.75, 1.0].iter().map(|t| at(stage, 0, along(*t))).collect();
    let history: Vec<Vec<Pointer>> = places[1..4].iter().map(|finger| vec![*finger]).collect();
    touch(stage, action::DOWN, &places[..1], &[]);
    touch(stage, action::MOVE, &places[4..], &history);
    touch(stage, action::UP, &places[4..], &[]);
}

/// A gesture of one finger that the system takes away from the app.
pub fn cancelled_drag(stage: &mut Stage) {
    let finger = at(stage, 0, [0.5, 0.5]);
    touch(stage, action::DOWN, &[finger], &[]);
    touch(stage, action::CANCEL, &[finger], &[]);
}

/// Two fingers whose distance changes from one share of the width to another; the first finger leaves first.
pub fn pinch(stage: &mut Stage, from: f32, to: f32, moves: u32) {
    // The numbers of fingers need not begin at nought, nor follow each other.
    let fingers = |stage: &Stage, apart: f32| {
        [at(stage, 3, [0.5 - apart / 2.0, 0.5]), at(stage, 7, [0.5 + apart / 2.0, 0.5])]
    };
    let index = |index: i32| index << 8;
    let start = fingers(stage, from);
    touch(stage, action::DOWN, &start[..1], &[]);
    touch(stage, action::POINTER_DOWN | index(1), &start, &[]);
    for step in 1..=moves {
        let now = fingers(stage, from + (to - from) * step as f32 / moves as f32);
        touch(stage, action::MOVE, &now, &[]);
    }
    let end = fingers(stage, to);
    touch(stage, action::POINTER_UP | index(0), &end, &[]);
    touch(stage, action::UP, &end[1..], &[]);
}
