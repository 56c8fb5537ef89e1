//! Insets of the screen's cutouts.

use std::sync::{Arc, Mutex, PoisonError};

use android_activity::AndroidApp;
use egui::epaint::MarginF32;

use crate::java;

/// Insets at the left, top, right and bottom in pixels, written on Java's main thread.
#[derive(Clone, Default)]
pub struct Insets(Arc<Mutex<[i32; 4]>>);

impl Insets {
    /// Hides the system bars and reads the insets on Java's main thread, which then wakes the activity.
    pub fn request(&self, android: &AndroidApp) {
        let (insets, waker) = (self.clone(), android.create_waker());
        java::on_main_thread(android, move |android| match java::immerse(android) {
            Ok(told) => {
                *insets.0.lock().unwrap_or_else(PoisonError::into_inner) = told;
                waker.wake();
            }
            Err(reason) => log::warn!("the system's bars stay: {reason}"),
        });
    }

    /// The insets in points; a point has `scale` pixels.
    pub fn safe_area(&self, scale: f32) -> egui::SafeAreaInsets {
        let insets = *self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let [left, top, right, bottom] = insets.map(|inset| inset as f32 / scale);
        egui::SafeAreaInsets(MarginF32 { left, right, top, bottom })
    }
}
