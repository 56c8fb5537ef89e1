//! The worker thread, which renders frames. It owns the scene on the device and the renderers, takes the newest job
//! first, and cancels a frame at rest that is no longer needed. Scenes are loaded on separate threads.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    sync::{
        Arc,
        mpsc::{Receiver, Sender, channel},
    },
    thread,
};

use glam::Vec3;
use glimpse::{Camera, DisplayImage, Gpu};

use crate::{
    Folder,
    compiler::Compiler,
    loading::{Loaded, Opened, SceneFacts, load},
    mailbox::Mailbox,
    scene_renderer::{Counted, Job, RenderedFrame, SceneRenderer},
};

/// Reads the named scene: `builtin:NAME`, or a name that the shell gives to a file. Called on loader threads.
pub type Files = Arc<dyn Fn(&str) -> Result<Opened, String> + Send + Sync>;

/// Wakes the shell's event loop when the worker has sent a message. Called on any thread.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// Messages from the worker to the app.
pub enum WorkerEvent {
    /// Progress of loading a scene: description, current step and number of steps.
    Loading(String, [u32; 2]),
    /// Numbers of kernels that are compiled and of those that are needed for the picture.
    Compiling([u32; 2]),
    /// The scene is on the device; all later frames show it.
    Opened(Box<SceneFacts>),
    /// The scene could not be loaded, with the reason; the previous scene stays.
    OpenFailed(String),
    /// Share of the frame at rest of that number that is submitted, from 0 to 1.
    Rendering(u64, f32),
    /// A rendered frame.
    Frame(Box<RenderedFrame>),
    /// The frame of that number, or its counters, will not arrive: a newer request replaced it, or the view
    /// is hidden.
    Cancelled(u64),
    /// The counters of the frame of that number.
    Counted(u64, Box<Counted>),
    /// The picture that [`Worker::capture`] requested.
    Captured(DisplayImage),
    /// The surface point that [`Worker::pick`] requested, in world space; `None` if the ray hits nothing.
    Picked(Option<Vec3>),
    /// The folder of that number, as [`Worker::list`] requested it.
    Listed(u64, Folder),
    /// A request failed, with the reason. Later requests may succeed.
    Failed(String),
    /// The device was lost or the thread panicked, with the reason: device, painter and worker must be
    /// created again.
    Lost(String),
}

/// Handle to the worker thread. Dropping it stops the thread and waits for its end.
pub struct Worker {
    gpu: Arc<Gpu>,
    files: Files,
    mailbox: Arc<Mailbox>,
    events: Receiver<WorkerEvent>,
    event_sender: EventSender,
    thread: Option<thread::JoinHandle<()>>,
    jobs: u64,
    listings: u64,
}

impl Worker {
    /// Starts the thread, without a scene.
    ///
    /// # Errors
    /// Fails if the operating system cannot start a thread.
    pub fn start(gpu: Arc<Gpu>, files: Files, wake: Wake) -> std::io::Result<Self> {
        let mailbox = Arc::new(Mailbox::default());
        let (sender, events) = channel();
        let event_sender = EventSender { sender, wake };
        let thread = {
            let (gpu, mailbox, event_sender) = (gpu.clone(), mailbox.clone(), event_sender.clone());
            let compiler = Compiler::start(mailbox.clone(), event_sender.clone())?;
            thread::Builder::new()
                .name("glimpse-frames".to_owned())
                .spawn(move || work(&gpu, &mailbox, &compiler, &event_sender))?
        };
        Ok(Self { gpu, files, mailbox, events, event_sender, thread: Some(thread), jobs: 0, listings: 0 })
    }

    /// Starts loading a scene on a separate thread. Frames of the current scene are rendered meanwhile.
    pub fn open(&mut self, name: &str) {
        let asked = {
            let mut slots = self.mailbox.slots();
            slots.asked += 1;
            slots.asked
        };
        let (gpu, files, mailbox) = (self.gpu.clone(), self.files.clone(), self.mailbox.clone());
        let event_sender = self.event_sender.clone();
        let owned = name.to_owned();
        let spawned = thread::Builder::new().name("glimpse-load".to_owned()).spawn(move || {
            let loaded = caught(|| load(&gpu, &files, &owned, &event_sender))
                .unwrap_or_else(|bug| Err(format!("{owned} could not be opened: {bug}")));
            let mut slots = mailbox.slots();
            match loaded {
                _ if slots.asked != asked => {}
                Ok(loaded) => {
                    slots.scene = Some(loaded);
                    mailbox.posted.notify_one();
                }
                Err(line) => event_sender.send(WorkerEvent::OpenFailed(line)),
            }
        });
        if let Err(error) = spawned {
            self.event_sender.send(WorkerEvent::OpenFailed(format!("{name}: {error}")));
        }
    }

    /// Requests a frame, replacing a request that has not been started; returns the number of the request.
    pub fn order(&mut self, job: Job) -> u64 {
        self.jobs += 1;
        self.mailbox.slots().job = Some((self.jobs, job));
        self.mailbox.posted.notify_one();
        self.jobs
    }

    /// Requests a frame as an image in main memory.
    pub fn capture(&self, job: Job) {
        self.mailbox.slots().capture = Some(job);
        self.mailbox.posted.notify_one();
    }

    /// Requests the surface point at a position of the view, in the coordinates of [`Camera::through`].
    pub fn pick(&self, camera: Camera, at: [f32; 2]) {
        self.mailbox.slots().pick = Some((camera, at));
        self.mailbox.posted.notify_one();
    }

    /// Reads a folder on a separate thread, as folders of a network can take long; returns the number of the request.
    pub fn list(&mut self, folder: &Path) -> u64 {
        self.listings += 1;
        let (number, event_sender, path) = (self.listings, self.event_sender.clone(), folder.to_owned());
        let read = move || event_sender.send(WorkerEvent::Listed(number, Folder::read(&path)));
        if let Err(error) = thread::Builder::new().name("glimpse-list".to_owned()).spawn(read) {
            let problem = Some(format!("cannot read {}: {error}", folder.display()));
            let folder = Folder { path: folder.to_owned(), entries: Vec::new(), problem };
            self.event_sender.send(WorkerEvent::Listed(number, folder));
        }
        number
    }

    /// Sets whether the view is hidden: while it is, frames at rest are cancelled.
    pub fn set_hidden(&self, hidden: bool) {
        self.mailbox.slots().hidden = hidden;
    }

    /// The next message, without waiting; `None` if there is none.
    pub fn poll(&mut self) -> Option<WorkerEvent> {
        // The channel cannot be disconnected, as `self.event_sender` holds a sender: an error means that it
        // is empty.
        self.events.try_recv().ok()
    }

    /// Waits for the next message.
    pub fn wait(&mut self) -> Option<WorkerEvent> {
        self.events.recv().ok()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.mailbox.slots().stop = true;
        self.mailbox.posted.notify_one();
        if let Some(thread) = self.thread.take() {
            // A panic has already been reported as a message.
            let _ = thread.join();
        }
    }
}

/// Sends messages to the app and wakes the shell.
#[derive(Clone)]
pub(crate) struct EventSender {
    sender: Sender<WorkerEvent>,
    wake: Wake,
}

impl EventSender {
    pub fn send(&self, event: WorkerEvent) {
        // The receiver is gone only while the worker is being dropped, so an error is harmless.
        let _ = self.sender.send(event);
        (self.wake)();
    }
}

/// The main function of the worker thread: serves one scene after the other.
fn work(gpu: &Gpu, mailbox: &Mailbox, compiler: &Compiler, event_sender: &EventSender) {
    let ended = caught(|| {
        while let Some(Loaded { scene, facts }) = mailbox.scene() {
            event_sender.send(WorkerEvent::Opened(Box::new(facts)));
            let renderer = SceneRenderer::new(gpu, &scene, mailbox, compiler, event_sender);
            if let Err(reason) = renderer.serve() {
                return event_sender.send(WorkerEvent::Lost(reason));
            }
        }
    });
    if let Err(bug) = ended {
        event_sender.send(WorkerEvent::Lost(format!("a frame could not be made: {bug}")));
    }
}

/// What a panic is told as.
pub(crate) const BUG: &str = "this is a bug, please report it";

/// Runs `work` and turns a panic into an error, so that the app does not wait for an answer forever.
pub(crate) fn caught<T>(work: impl FnOnce() -> T) -> Result<T, &'static str> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|_| BUG)
}
