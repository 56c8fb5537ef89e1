//! The worker thread, which renders frames. It owns the scene on the device and the renderers, takes the newest job
//! first, and cancels a frame at rest that is no longer needed. Scenes are loaded on separate threads.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc,
        mpsc::{Receiver, Sender, channel},
    },
    thread,
};

use glam::Vec3;
use glimpse::{Camera, DisplayImage, Gpu, Scene};

use crate::{
    loading::{Loaded, SceneFacts, load},
    office::Office,
    studio::{Counted, Frame, Job, Studio},
};

/// Reads the scene of a name: `builtin:NAME`, or a name that the shell gives to a file. Called on loader threads.
pub type Files = Arc<dyn Fn(&str) -> Result<Scene, String> + Send + Sync>;

/// Wakes the shell's event loop when the worker has sent a message. Called on any thread.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// Messages from the worker to the app.
pub enum News {
    /// Progress of loading a scene: a description, and the step of how many.
    Loading(String, [u32; 2]),
    /// The scene is on the device; all later frames show it.
    Opened(Box<SceneFacts>),
    /// The scene could not be loaded, with the reason; the previous scene stays.
    NotOpened(String),
    /// A rendered frame.
    Frame(Box<Frame>),
    /// The frame of that number, or its counters, will not arrive: a newer request came first, or the view is hidden.
    GivenUp(u64),
    /// The counters of the frame of that number.
    Counted(u64, Box<Counted>),
    /// The picture that [`Worker::capture`] requested.
    Captured(DisplayImage),
    /// The surface point that [`Worker::pick`] requested, in world space; `None` where the ray hits nothing.
    Picked(Option<Vec3>),
    /// A request failed, with the reason. Later requests may succeed.
    Failed(String),
    /// The device was lost or the thread panicked, with the reason: device, painter and worker have to be created
    /// again.
    Lost(String),
}

/// Handle to the worker thread. Dropping it stops the thread and waits for its end.
pub struct Worker {
    gpu: Arc<Gpu>,
    files: Files,
    office: Arc<Office>,
    news: Receiver<News>,
    teller: Teller,
    thread: Option<thread::JoinHandle<()>>,
    jobs: u64,
}

impl Worker {
    /// Starts the thread, with no scene.
    ///
    /// # Errors
    /// The operating system could not start a thread.
    pub fn start(gpu: Arc<Gpu>, files: Files, wake: Wake) -> std::io::Result<Self> {
        let office = Arc::new(Office::default());
        let (sender, news) = channel();
        let teller = Teller { sender, wake };
        let thread = {
            let (gpu, office, teller) = (gpu.clone(), office.clone(), teller.clone());
            thread::Builder::new()
                .name("glimpse-frames".to_owned())
                .spawn(move || work(&gpu, &office, &teller))?
        };
        Ok(Self { gpu, files, office, news, teller, thread: Some(thread), jobs: 0 })
    }

    /// Starts loading a scene on a thread of its own. Frames of the present scene are rendered meanwhile.
    pub fn open(&mut self, name: &str) {
        let asked = {
            let mut desk = self.office.desk();
            desk.asked += 1;
            desk.asked
        };
        let (gpu, files, office) = (self.gpu.clone(), self.files.clone(), self.office.clone());
        let teller = self.teller.clone();
        let owned = name.to_owned();
        let spawned = thread::Builder::new().name("glimpse-load".to_owned()).spawn(move || {
            let loaded = caught(|| load(&gpu, &files, &owned, &teller))
                .unwrap_or_else(|bug| Err(format!("{owned} could not be opened: {bug}")));
            let mut desk = office.desk();
            match loaded {
                _ if desk.asked != asked => {}
                Ok(loaded) => {
                    desk.scene = Some(loaded);
                    office.bell.notify_one();
                }
                Err(line) => teller.tell(News::NotOpened(line)),
            }
        });
        if let Err(error) = spawned {
            self.teller.tell(News::NotOpened(format!("{name}: {error}")));
        }
    }

    /// Requests a frame, in place of a requested frame that has not been started; returns the number of the request.
    pub fn order(&mut self, job: Job) -> u64 {
        self.jobs += 1;
        self.office.desk().job = Some((self.jobs, job));
        self.office.bell.notify_one();
        self.jobs
    }

    /// Requests a frame as a picture in main memory.
    pub fn capture(&self, job: Job) {
        self.office.desk().capture = Some(job);
        self.office.bell.notify_one();
    }

    /// Requests the surface point at a position of the view, in the coordinates of [`Camera::through`].
    pub fn pick(&self, camera: Camera, at: [f32; 2]) {
        self.office.desk().pick = Some((camera, at));
        self.office.bell.notify_one();
    }

    /// Sets whether the view is hidden: frames at rest are cancelled while it is.
    pub fn set_hidden(&self, hidden: bool) {
        self.office.desk().hidden = hidden;
    }

    /// The next message, without waiting.
    pub fn news(&mut self) -> Option<News> {
        // The channel cannot be disconnected, as `self.teller` is a sender: an error means that it is empty.
        self.news.try_recv().ok()
    }

    /// Waits for the next message.
    pub fn wait(&mut self) -> Option<News> {
        self.news.recv().ok()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.office.desk().stop = true;
        self.office.bell.notify_one();
        if let Some(thread) = self.thread.take() {
            // A panic has been reported as a message already.
            let _ = thread.join();
        }
    }
}

/// Sends messages to the app and wakes the shell.
#[derive(Clone)]
pub(crate) struct Teller {
    sender: Sender<News>,
    wake: Wake,
}

impl Teller {
    pub fn tell(&self, news: News) {
        // The receiver is gone only while the worker is being dropped.
        let _ = self.sender.send(news);
        (self.wake)();
    }
}

/// The main function of the worker thread: serves one scene after the other.
fn work(gpu: &Gpu, office: &Office, teller: &Teller) {
    let ended = caught(|| {
        while let Some(Loaded { scene, facts }) = office.scene() {
            teller.tell(News::Loading(format!("compiling for {}", facts.name), [3, 3]));
            teller.tell(News::Opened(Box::new(facts)));
            if let Err(reason) = Studio::new(gpu, &scene).serve(office, teller) {
                return teller.tell(News::Lost(reason));
            }
        }
    });
    if let Err(bug) = ended {
        teller.tell(News::Lost(format!("a frame could not be made: {bug}")));
    }
}

/// Runs `work` and turns a panic into an error, so that the app does not wait for an answer forever.
fn caught<T>(work: impl FnOnce() -> T) -> Result<T, &'static str> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|_| "this is a bug, please report it")
}
