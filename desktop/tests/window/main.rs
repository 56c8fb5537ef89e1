//! Tests of the window: the program plays scripts on an X server of the test's own (Xvfb).
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a test may fail wherever it is surprised")]

mod display;
mod events;
mod files;
mod frames;
mod governor;
mod harness;
mod input;
mod life_cycle;
mod phones;
mod scripts;
mod title;
