//! What a run says: a line a step on the output, complaints about the app, and the watch over hangs.

use std::fs::File;
use std::io::Write as _;
use std::os::fd::FromRawFd as _;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};

use crate::sync::lock;

/// The app's glue sends the process's own output to the log, so what is said here goes through copies.
struct Streams {
    output: Mutex<File>,
    errors: Mutex<File>,
}

static STREAMS: OnceLock<Streams> = OnceLock::new();

fn streams() -> &'static Streams {
    STREAMS.get_or_init(|| {
        // SAFETY: the copies are fresh descriptors that the files own.
        let copy = |of| Mutex::new(unsafe { File::from_raw_fd(libc::fcntl(of, libc::F_DUPFD_CLOEXEC, 100)) });
        Streams { output: copy(1), errors: copy(2) }
    })
}

/// Takes the copies of the output; called before the app is loaded.
pub fn open() {
    streams();
}

/// Says a line on the output.
pub fn say(line: &str) {
    // Nobody is left to be told when the output is closed.
    let _ = writeln!(lock(&streams().output), "{line}");
}

/// Says a line of the log on the error output.
pub fn say_log(line: &str) {
    let _ = writeln!(lock(&streams().errors), "{line}");
}

static COMPLAINTS: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// Notes something that the app did and that Android would not stand; it fails the run.
pub fn complain(complaint: String) {
    say_log(&format!("host: {complaint}"));
    let mut complaints = lock(&COMPLAINTS);
    if complaints.len() < 100 {
        complaints.push(complaint);
    }
}

/// What was complained of so far.
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

/// This machine is so many times slower than one that runs the library itself: an emulated processor.
pub fn set_slow(factor: u32) {
    SLOW.store(factor, Ordering::Relaxed);
}

/// A bound, as long as it is on this machine.
pub fn allowed(bound: Duration) -> Duration {
    bound * SLOW.load(Ordering::Relaxed)
}

/// Something that must end within a bound; see [`watch`].
pub struct Watch;

impl Drop for Watch {
    fn drop(&mut self) {
        lock(&WATCHED).pop();
    }
}

/// Until the answer is dropped, `what` may take no longer than `bound`: if it does, the process ends and says so.
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
    // SAFETY: ends the process at once; the thread that hangs cannot be ended otherwise.
    unsafe { libc::_exit(3) }
}
