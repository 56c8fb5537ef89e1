//! Scripted input: a file of lines, one step each, played against a virtual clock.
//!
//! ```text
//! # Comments and empty lines are skipped. Points are shares of the view: 0,0 is top left, 1,1 bottom right.
//! open builtin:room            opens a scene
//! drop FILE                    drops a file on the window
//! move 0.5,0.5 [over 0.4]      moves the pointer, within 0.4 seconds
//! press [left|right|middle]    release [left|right|middle]
//! scroll 3                     wheel notches, up is positive
//! pinch 1.2                    pinches on a trackpad: a factor on the distance of the fingers
//! touch 0 begin 0.4,0.5        touch 0 move 0.3,0.5 [over 0.4]     touch 0 end
//! key ctrl+c                   presses and releases a key; hold KEY only presses it, let KEY releases it
//! set block 4                  sets an option of glimpse::options, or show, split (off or a share), scale,
//!                              lenses (none, cardboard), governor (off, 15, 30, 60), overlay (hidden, brief, full)
//! size 640x360                 minimise     restore     fullscreen on|off     rotate
//! pause   resume   lose-surface   lose-device   low-memory     thermal 0.5 (a factor on the time limit)
//! cost 40                      fixes the cost of frames, in nanoseconds per pixel
//! wait 0.5                     lets 0.5 seconds pass
//! settle                       waits until the view is at rest and its frame is complete
//! screenshot FILE              saves the frame, like the key S
//! window FILE                  saves the content of the window
//! expect NAME OP VALUE         compares; OP is = != < <= > >= or contains; an empty VALUE is the empty text
//! print NAME                   prints the line NAME = VALUE to the standard output
//! quit
//! ```

mod expectation;
mod parse;
mod player;

pub use expectation::{Expectation, Value};
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
