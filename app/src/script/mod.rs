//! Scripted input: a file of lines, one step each, played against a virtual clock.
//!
//! Comments begin with `#`. Points are shares of the view: 0,0 is top left, 1,1 bottom right. [`help`] lists every step
//! and every value.

mod expectation;
mod help;
mod parse;
mod player;
mod words;

pub use expectation::{Expectation, Value};
pub use help::help;
pub use player::{Ask, Player};

use std::path::PathBuf;

use crate::Change;

/// A parsed script: its steps in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Script {
    /// Name of the file, for messages.
    pub(crate) file: String,
    /// Line number, from 1, and step.
    pub(crate) steps: Vec<(usize, Step)>,
}

/// A step of a script.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// Opens a scene by its name.
    Open(String),
    /// Drops a file on the window.
    Drop(PathBuf),
    /// Moves the pointer to a position within seconds. Positions are shares of the view's width and height.
    Move([f32; 2], f64),
    /// Presses or releases a mouse button.
    Button(egui::PointerButton, bool),
    /// Scrolls by notches of the wheel, positive upwards.
    Scroll(f32),
    /// Pinches on a trackpad, by a factor on the distance of the fingers.
    Pinch(f32),
    /// Moves a finger, identified by a number.
    Touch(u64, Finger),
    /// Presses or releases a key, or both.
    Key(egui::Key, egui::Modifiers, Stroke),
    /// Applies a change of the choices.
    Set(Change),
    /// Simulates an event of the window or the phone.
    Shell(ShellEvent),
    /// Fixes the cost of frames in nanoseconds per pixel.
    Cost(f64),
    /// Lets seconds pass.
    Wait(f64),
    /// Waits until the view is at rest with its frame complete.
    Settle,
    /// Saves the frame.
    Screenshot(PathBuf),
    /// Saves the window's content.
    Window(PathBuf),
    /// Compares a value with an expectation; the script fails if it does not hold.
    Expect(Expectation),
    /// Compares the frame with the picture in a file, within bounds as they are typed.
    ExpectPicture(PathBuf, String),
    /// Prints the value of a name.
    Print(String),
    /// Ends the program.
    Quit,
}

/// Movement of a finger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finger {
    /// Touches a position, given as shares of the view.
    Begin([f32; 2]),
    /// Moves to a position within seconds.
    Move([f32; 2], f64),
    /// Lifts the finger.
    End,
}

/// Stroke of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stroke {
    /// Presses and releases the key.
    Tap,
    /// Presses the key.
    Hold,
    /// Releases the key.
    Let,
}

/// An event of the window or the phone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShellEvent {
    /// Resizes the window to that width and height in pixels.
    Size([u32; 2]),
    /// Minimises the window to an icon.
    Minimise,
    /// Restores the window from an icon.
    Restore,
    /// Enters or leaves full screen.
    FullScreen(bool),
    /// Rotates the phone by 90 degrees.
    Rotate,
    /// Brings another app to the front, which destroys the surface.
    Pause,
    /// Brings the app to the front again.
    Resume,
    /// Loses the surface, which must be created again.
    LoseSurface,
    /// Loses the device.
    LoseDevice,
    /// The system reports low memory.
    LowMemory,
    /// Changes the temperature: a factor on the time limit of frames, 1 when cool.
    Thermal(f32),
}
