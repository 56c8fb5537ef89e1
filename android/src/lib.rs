//! The library of the Android activity.
//!
//! `android_main` runs a [`glimpse_shell::Session`], which the desktop runs too, on what `android_activity` tells. No logic
//! but the shell: life cycle, surface, input, and what the system lends.
//!
//! | event | what is done |
//! | --- | --- |
//! | window created, destroyed | a surface, none; the device and all that is on it stay |
//! | window resized, turned | the surface is configured once, the frame keeps its pixels |
//! | resumed | the bars of the system are hidden, an intent's file is opened |
//! | paused | what the driver has compiled is kept for the next start |
//! | low memory | frames become smaller, the split view ends |
//! | destroyed | `android_main` returns; another may begin in the same process |
//!
//! On other systems this library holds what can be tested there: touches and the painter of last resort.

pub mod canvas;
pub mod fingers;
pub mod heat;
pub mod wishes;

#[cfg(target_os = "android")]
mod activity;
#[cfg(target_os = "android")]
mod compiled;
#[cfg(target_os = "android")]
mod feedback;
#[cfg(target_os = "android")]
mod files;
#[cfg(target_os = "android")]
mod input;
#[cfg(target_os = "android")]
mod insets;
#[cfg(target_os = "android")]
mod java;
#[cfg(target_os = "android")]
mod lend;
#[cfg(target_os = "android")]
mod ndk_late;
#[cfg(target_os = "android")]
mod pace;
#[cfg(target_os = "android")]
mod screen;
#[cfg(target_os = "android")]
mod shell;
