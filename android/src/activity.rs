//! The entry point, and the life of an activity from there to its end.

use std::sync::{
    Arc, Mutex, MutexGuard, PoisonError,
    atomic::{AtomicBool, Ordering},
};

use android_activity::{AndroidApp, AndroidAppWaker, MainEvent, PollEvent, input::Axis};

use crate::{
    java,
    shell::{Shell, Stage},
};

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
    run(&app);
    log::info!("ends");
}

/// The activity that shows pictures now: an older one of the same process leaves when a new one begins.
static CURRENT: Mutex<Option<Arc<Leave>>> = Mutex::new(None);

/// Asks an activity to leave, from any thread.
struct Leave {
    asked: AtomicBool,
    waker: AndroidAppWaker,
}

/// Runs until the activity is destroyed or a person has enough of it.
fn run(android: &AndroidApp) {
    let leave = Arc::new(Leave { asked: AtomicBool::new(false), waker: android.create_waker() });
    if let Some(older) = current().replace(leave.clone()) {
        older.asked.store(true, Ordering::Release);
        older.waker.wake();
    }
    android.enable_motion_axis(Axis::Vscroll);
    android.enable_motion_axis(Axis::Hscroll);
    let mut shell = Shell::new(android.clone());
    while shell.stage() == Stage::Runs && !leave.asked.load(Ordering::Acquire) {
        android.poll_events(shell.patience(), |event| shell.hear(event));
        // Whatever came may have changed the picture.
        if shell.stage() == Stage::Runs {
            shell.frame();
        }
    }
    current().take_if(|newest| Arc::ptr_eq(newest, &leave));
    let mut destroyed = shell.stage() == Stage::Destroyed;
    drop(shell);
    if !destroyed {
        java::on_main_thread(android, |android| {
            java::finish(android).unwrap_or_else(|reason| log::warn!("the activity stays: {reason}"));
        });
    }
    // What returns before is never told, and android_activity keeps its files open then.
    while !destroyed {
        android.poll_events(None, |event| {
            destroyed |= matches!(event, PollEvent::Main(MainEvent::Destroy));
        });
    }
}

fn current() -> MutexGuard<'static, Option<Arc<Leave>>> {
    CURRENT.lock().unwrap_or_else(PoisonError::into_inner)
}
