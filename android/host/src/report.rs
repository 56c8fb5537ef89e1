//! Output of a run: a line for each step, errors of the app, and the detection of hangs.

use std::fs::File;
use std::io::Write as _;
use std::os::fd::FromRawFd as _;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};

use crate::sync::lock;

/// Copies of standard output and error, as the app's glue code redirects the originals to the log.
struct Streams {
    output: Mutex<File>,
    errors: Mutex<File>,
}

static STREAMS: OnceLock<Streams> = OnceLock::new();

fn streams() -> &'static Streams {
    STREAMS.get_or_init(|| {
        // SAFETY: the descriptors are new, and owned by the files.
        let copy = |of| Mutex::new(unsafe { File::from_raw_fd(libc::fcntl(of, libc::F_DUPFD_CLOEXEC, 100)) });
        Streams { output: copy(1), errors: copy(2) }
    })
}

/// Copies the streams; must be called before the app is loaded.
pub fn open() {
    streams();
}

/// Writes a line to the standard output.
pub fn say(line: &str) {
    // A closed output is ignored.
    let _ = writeln!(lock(&streams().output), "{line}");
}

/// Writes a line of the log to the standard error.
pub fn say_log(line: &str) {
    let _ = writeln!(lock(&streams().errors), "{line}");
}

static COMPLAINTS: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// Records a behaviour of the app that Android does not tolerate; the run fails at its end.
pub fn complain(complaint: String) {
    say_log(&format!("host: {complaint}"));
    let mut complaints = lock(&COMPLAINTS);
    if complaints.len() < 100 {
        complaints.push(complaint);
    }
}

/// The recorded errors of the app.
pub fn complaints() -> Vec<String> {
    lock(&COMPLAINTS).clone()
}

struct Watched {
    what: String,
    since: Instant,
    bound: Duration,
}

static WATCHED: Mutex<Vec<Watched>> = Mutex::new(Vec::new());

static SLOW: AtomicU32 = AtomicU32::new(1);

/// Sets a factor on all time limits, for a machine that emulates the app's processor.
pub fn set_slow(factor: u32) {
    SLOW.store(factor, Ordering::Relaxed);
}

/// A time limit, scaled by that factor.
pub fn allowed(bound: Duration) -> Duration {
    bound * SLOW.load(Ordering::Relaxed)
}

/// A time limit that ends when this is dropped; see [`watch`].
pub struct Watch;

impl Drop for Watch {
    fn drop(&mut self) {
        lock(&WATCHED).pop();
    }
}

/// Starts a time limit: unless the result is dropped within `bound`, the process reports `what` and ends.
pub fn watch(what: &str, bound: Duration) -> Watch {
    static DOG: OnceLock<()> = OnceLock::new();
    lock(&WATCHED).push(Watched { what: what.to_owned(), since: Instant::now(), bound: allowed(bound) });
    DOG.get_or_init(|| {
        std::thread::spawn(|| {
            loop {
                std::thread::sleep(Duration::from_millis(100));
                bark();
            }
        });
    });
    Watch
}

fn bark() {
    let watched = lock(&WATCHED);
    let Some(late) = watched.iter().rev().find(|watched| watched.since.elapsed() > watched.bound) else {
        return;
    };
    let steps: Vec<&str> = watched.iter().map(|watched| watched.what.as_str()).collect();
    say(&format!("FAIL  {}: not back after {:.0} s", steps.join(" > "), late.bound.as_secs_f64()));
    // SAFETY: ends the process at once, as a thread that hangs cannot be ended alone.
    unsafe { libc::_exit(3) }
}
