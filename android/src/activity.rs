//! The entry point.

use android_activity::AndroidApp;

use crate::shell;

/// Called by `android_activity` on a thread of its own once the activity exists; the activity is finished when this
/// returns.
#[allow(unsafe_code, reason = "android_activity finds the entry point by its unmangled name")]
#[unsafe(no_mangle)]
fn android_main(app: AndroidApp) {
    android_logger::init_once(
        android_logger::Config::default()
            .with_max_level(log::LevelFilter::Info)
            .with_filter(android_logger::FilterBuilder::new().parse("warn,glimpse=info").build())
            .with_tag("glimpse"),
    );
    log::info!("begins on Android API {}", AndroidApp::sdk_version());
    shell::run(&app);
    log::info!("ends");
}
