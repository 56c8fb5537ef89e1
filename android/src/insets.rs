//! The parts of the screen that its cutouts take.

use std::sync::{Arc, Mutex, PoisonError};

use android_activity::AndroidApp;
use egui::epaint::MarginF32;

use crate::java;

/// Pixels at the left, top, right and bottom of the screen that cutouts take; Java's main thread writes them.
#[derive(Clone, Default)]
pub struct Insets(Arc<Mutex<[i32; 4]>>);

impl Insets {
    /// Hides the system's bars and asks for the insets, on the thread that may. They are there when the activity is woken.
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

    /// The insets in points of the overlay, of which each has `scale` pixels.
    pub fn safe_area(&self, scale: f32) -> egui::SafeAreaInsets {
        let insets = *self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let [left, top, right, bottom] = insets.map(|inset| inset as f32 / scale);
        egui::SafeAreaInsets(MarginF32 { left, right, top, bottom })
    }
}
