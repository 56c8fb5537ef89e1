//! The native library of the Android activity.
//!
//! `android_main` runs a [`glimpse_shell::Session`], as the desktop does, on events of `android_activity`. It has the
//! platform's part only: life cycle, surface, input and system services.
//!
//! | event | what is done |
//! | --- | --- |
//! | window created | a surface is created; so is the device, where there is none |
//! | window destroyed | the surface is destroyed; the device and its resources stay |
//! | window resized, rotated | the surface is configured again; frames keep their size |
//! | resumed | the scene of an earlier activity that the system ended is opened again |
//! | paused | the driver's pipeline cache is stored for the next start |
//! | low memory | frames become smaller, the split view ends |
//! | destroyed | `android_main` returns; another activity may begin in the same process |
//!
//! On other systems this library has the parts that can be tested there: touches, thermal headroom, extras of the
//! intent, and the software rasteriser of the overlay.

pub mod canvas;
pub mod fingers;
pub mod intent_extras;
pub mod thermal_budget;

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
