//! Scripted input: a file of lines, one step each, played against a virtual clock.
//!
//! ```text
//! # Comments and empty lines are skipped. Points are shares of the view: 0,0 is top left, 1,1 bottom right.
//! open builtin:room            a scene
//! drop FILE                    a file is dropped on the window
//! move 0.5,0.5 [over 0.4]      the pointer goes there, in so many seconds
//! press [left|right|middle]    release [left|right|middle]
//! scroll 3                     wheel notches, up is positive
//! pinch 1.2                    a factor on the distance of two fingers of a trackpad
//! touch 0 begin 0.4,0.5        touch 0 move 0.3,0.5 [over 0.4]     touch 0 end
//! key ctrl+c                   a key, pressed and released; hold KEY and let KEY do one of both
//! set block 4                  an option of glimpse::options, or show, split (off or a share), lenses (none, cardboard),
//!                              scale, governor (off, 15, 30, 60), overlay (hidden, brief, full)
//! size 640x360                 minimise     restore     fullscreen on|off     rotate
//! pause   resume   lose-surface   lose-device   low-memory     thermal 0.5 (a factor on the time budget)
//! cost 40                      frames take that many nanoseconds a pixel, whatever they took
//! wait 0.5                     so many seconds pass
//! settle                       until the view rests and its frame is complete
//! screenshot FILE              the frame, as the key S saves it
//! window FILE                  what the window shows
//! expect NAME OP VALUE         OP is = != < <= > >= or contains; nothing after = is the empty text
//! print NAME                   a line NAME = VALUE on the standard output
//! quit
//! ```

mod expectation;
mod parse;
mod player;

pub use expectation::{Expectation, Value};
pub use player::{Ask, Player};

use std::path::PathBuf;

use crate::Change;

/// A script: what happens, in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Script {
    /// For messages.
    pub(crate) file: String,
    /// The line of each, from 1, and the step.
    pub(crate) steps: Vec<(usize, Step)>,
}

/// Something that happens.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// A scene is opened.
    Open(String),
    /// A file is dropped on the window.
    Drop(PathBuf),
    /// The pointer moves to a share of the view within seconds.
    Move([f32; 2], f64),
    /// A button goes down or up.
    Button(egui::PointerButton, bool),
    /// Wheel notches.
    Scroll(f32),
    /// A trackpad's pinch.
    Pinch(f32),
    /// A finger.
    Touch(u64, Finger),
    /// A key goes down, up, or both.
    Key(egui::Key, egui::Modifiers, Stroke),
    /// Something is chosen.
    Set(Change),
    /// Something befalls the window or the phone.
    Shell(ShellEvent),
    /// Nanoseconds a pixel that frames are taken to need.
    Cost(f64),
    /// Seconds pass.
    Wait(f64),
    /// Until everything rests.
    Settle,
    /// The frame into a file.
    Screenshot(PathBuf),
    /// The window into a file.
    Window(PathBuf),
    /// Something must be so.
    Expect(Expectation),
    /// What is known by a name is told.
    Print(String),
    /// The end.
    Quit,
}

/// What a finger does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finger {
    /// It comes down there.
    Begin([f32; 2]),
    /// It goes there within seconds.
    Move([f32; 2], f64),
    /// It leaves.
    End,
}

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stroke {
    /// Down and up.
    Tap,
    /// Down.
    Hold,
    /// Up.
    Let,
}

/// What befalls the window or the phone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShellEvent {
    /// The window gets that size in pixels.
    Size([u32; 2]),
    /// The window goes away and stays an icon.
    Minimise,
    /// It comes back.
    Restore,
    /// It covers the screen, or not.
    FullScreen(bool),
    /// The phone is turned.
    Rotate,
    /// Another app is in front: the surface goes.
    Pause,
    /// The app is in front again.
    Resume,
    /// The surface is lost and made again.
    LoseSurface,
    /// The device is lost.
    LoseDevice,
    /// The system wants memory back.
    LowMemory,
    /// The device is hot: a factor on the time that a frame may take, 1 when cool.
    Thermal(f32),
}
