//! The entry point of an activity, and its main loop until it is destroyed.

use std::sync::{
    Arc, Mutex, MutexGuard, PoisonError,
    atomic::{AtomicBool, Ordering},
};

use android_activity::{AndroidApp, AndroidAppWaker, MainEvent, PollEvent, input::Axis};

use crate::{
    java,
    shell::{Lifecycle, Shell},
};

/// Called by `android_activity` on a separate thread once the activity exists; the activity is finished when this
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
    run(&app);
    log::info!("ends");
}

/// The activity in the foreground: when a new one begins, the one before in the same process ends.
static CURRENT: Mutex<Option<Arc<Leave>>> = Mutex::new(None);

/// A request to an activity to end, from any thread.
struct Leave {
    asked: AtomicBool,
    waker: AndroidAppWaker,
}

/// Runs until the activity is destroyed, is left by its user, or another one begins.
fn run(android: &AndroidApp) {
    let leave = Arc::new(Leave { asked: AtomicBool::new(false), waker: android.create_waker() });
    if let Some(older) = current().replace(leave.clone()) {
        older.asked.store(true, Ordering::Release);
        older.waker.wake();
    }
    android.enable_motion_axis(Axis::Vscroll);
    android.enable_motion_axis(Axis::Hscroll);
    let mut shell = Shell::new(android.clone());
    while shell.lifecycle() == Lifecycle::Runs && !leave.asked.load(Ordering::Acquire) {
        android.poll_events(shell.poll_timeout(), |event| shell.handle_event(event));
        // Any event may have changed what is to be shown.
        if shell.lifecycle() == Lifecycle::Runs {
            shell.frame();
        }
    }
    current().take_if(|newest| Arc::ptr_eq(newest, &leave));
    let mut destroyed = shell.lifecycle() == Lifecycle::Destroyed;
    drop(shell);
    if !destroyed {
        java::on_main_thread(android, |android| {
            java::finish(android).unwrap_or_else(|reason| log::warn!("the activity stays: {reason}"));
        });
    }
    // `android_activity` delivers no Destroy event to a thread that has returned, and then leaks its file descriptors.
    while !destroyed {
        android.poll_events(None, |event| {
            destroyed |= matches!(event, PollEvent::Main(MainEvent::Destroy));
        });
    }
}

fn current() -> MutexGuard<'static, Option<Arc<Leave>>> {
    CURRENT.lock().unwrap_or_else(PoisonError::into_inner)
}
