//! The thread that compiles kernels while the worker renders others.

use std::{
    collections::VecDeque,
    sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError},
    thread,
};

use glimpse::{Compilation, Error, Result};

use crate::{
    mailbox::Mailbox,
    worker::{BUG, EventSender, WorkerEvent, caught},
};

/// Kernels to compile, in order.
pub(crate) struct CompileRequest {
    /// Kernels of renderers, those needed first in front.
    pub renderers: VecDeque<Compilation>,
    /// Whether somebody waits for a picture, and progress is reported.
    pub is_told: bool,
}

#[derive(Default)]
struct Slots {
    request: Option<CompileRequest>,
    stop: bool,
}

/// Handle to the thread. Dropping it stops the thread after the kernel that it compiles.
pub(crate) struct Compiler {
    shared: Arc<Shared>,
    thread: Option<thread::JoinHandle<()>>,
}

#[derive(Default)]
struct Shared {
    slots: Mutex<Slots>,
    posted: Condvar,
}

impl Compiler {
    /// Starts the thread. It posts in the mailbox whenever all kernels of a renderer are compiled.
    ///
    /// # Errors
    /// The operating system cannot start a thread.
    pub fn start(mailbox: Arc<Mailbox>, event_sender: EventSender) -> std::io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let of_thread = shared.clone();
        let thread = thread::Builder::new()
            .name("glimpse-kernels".to_owned())
            .spawn(move || of_thread.work(&mailbox, &event_sender))?;
        Ok(Self { shared, thread: Some(thread) })
    }

    /// Requests kernels, in place of those requested before.
    pub fn request(&self, request: CompileRequest) {
        self.shared.slots().request = Some(request);
        self.shared.posted.notify_one();
    }
}

impl Drop for Compiler {
    fn drop(&mut self) {
        self.shared.slots().stop = true;
        self.shared.posted.notify_one();
        if let Some(thread) = self.thread.take() {
            // A panic has already been posted as an error.
            let _ = thread.join();
        }
    }
}

impl Shared {
    fn slots(&self) -> MutexGuard<'_, Slots> {
        self.slots.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits for a request; `None` when the thread must end.
    fn next(&self) -> Option<CompileRequest> {
        let mut slots = self.slots();
        loop {
            if slots.stop {
                return None;
            }
            if let Some(request) = slots.request.take() {
                return Some(request);
            }
            slots = self.posted.wait(slots).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Whether a request waits or the thread must end.
    fn is_urgent(&self) -> bool {
        let slots = self.slots();
        slots.stop || slots.request.is_some()
    }

    fn work(&self, mailbox: &Mailbox, event_sender: &EventSender) {
        while let Some(mut request) = self.next() {
            let total: usize = request.renderers.iter().map(Compilation::total).sum();
            while let Some(kernels) = request.renderers.front_mut().filter(|_| !self.is_urgent()) {
                let compiled = compile_next(kernels);
                let is_over = compiled.is_err() || kernels.remaining() == 0;
                if is_over {
                    request.renderers.pop_front();
                }
                let remaining: usize = request.renderers.iter().map(Compilation::remaining).sum();
                if request.is_told {
                    event_sender.send(WorkerEvent::Compiling([total - remaining, total].map(|n| n as u32)));
                }
                if is_over {
                    mailbox.kernels_compiled(compiled);
                }
            }
        }
    }
}

/// Takes the next kernel and compiles it, by its two steps side by side.
fn compile_next(kernels: &mut Compilation) -> Result<()> {
    let Some(kernel) = kernels.take_next() else { return Ok(()) };
    let [apart, created] = thread::scope(|scope| {
        let apart = scope.spawn(|| caught(|| kernel.dispatch_apart()));
        let created = caught(|| kernel.create());
        [apart.join().unwrap_or(Err(BUG)), created]
    });
    let known = |result: std::result::Result<_, &str>| {
        result.unwrap_or_else(|bug| Err(Error::Device(bug.to_owned())))
    };
    known(apart).and(known(created))
}
