//! The library of the Android activity.
//!
//! The phone app is not there yet: the activity starts, says so in the system's log, and ends. On other systems this
//! library is empty.

#[cfg(target_os = "android")]
mod activity {
    use winit::platform::android::activity::{AndroidApp, MainEvent, PollEvent};

    /// Called by `android_activity` on a thread of its own once the activity exists; it ends when this returns.
    #[allow(unsafe_code, reason = "android_activity finds the entry point by its unmangled name")]
    #[unsafe(no_mangle)]
    fn android_main(app: AndroidApp) {
        android_logger::init_once(
            android_logger::Config::default().with_max_level(log::LevelFilter::Info).with_tag("glimpse"),
        );
        log::info!(
            "the phone app is not there yet; scenes: {}",
            glimpse_app::scenes().collect::<Vec<_>>().join(", ")
        );
        let mut destroyed = false;
        while !destroyed {
            app.poll_events(None, |event| {
                destroyed |= matches!(event, PollEvent::Main(MainEvent::Destroy));
            });
        }
    }
}
