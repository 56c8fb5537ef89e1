//! The thread that makes frames. It holds the scene on the device and the renderers, always takes the newest job, and
//! gives up one that nobody waits for any more. Scenes are loaded by threads of their own meanwhile.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc,
        mpsc::{Receiver, Sender, channel},
    },
    thread,
};

use glam::Vec3;
use glimpse::{Camera, DisplayImage, Gpu, GpuScene, Scene};

use crate::{
    office::{Loaded, Office},
    studio::{Counted, Frame, Job, Studio},
};

/// Gives the scene of a name: `builtin:NAME`, or what a shell calls a file. Called on threads of the app's.
pub type Files = Arc<dyn Fn(&str) -> Result<Scene, String> + Send + Sync>;

/// Tells the shell that there is news.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// What is known of a scene that was loaded.
#[derive(Clone, Debug)]
pub struct SceneFacts {
    /// As it was asked for.
    pub name: String,
    /// Triangles and spheres.
    pub primitives: u64,
    /// Its cameras; one at least.
    pub cameras: Vec<(String, Camera)>,
    /// The box around it, world space.
    pub bounds: (Vec3, Vec3),
    /// What the importer left out or replaced.
    pub warnings: Vec<String>,
    /// Every feature, and whether the scene needs it.
    pub features: Vec<(&'static str, bool)>,
}

/// What became of what was ordered.
pub enum News {
    /// That much of a scene has been done: what, and which step of how many.
    Loading(String, [u32; 2]),
    /// The scene is on the device; frames are of it from now on.
    Opened(Box<SceneFacts>),
    /// It cannot be shown; the one before stays.
    NotOpened(String),
    /// A frame.
    Frame(Box<Frame>),
    /// The frame of that number will not come, or not what is counted in it: something is more urgent.
    GivenUp(u64),
    /// What was counted in it.
    Counted(u64, Box<Counted>),
    /// The frame that was asked for, in main memory.
    Captured(DisplayImage),
    /// The surface point that was asked for, world space; `None` where the ray meets nothing.
    Picked(Option<Vec3>),
    /// What was ordered failed; the next may not.
    Failed(String),
    /// The device is gone, or the thread is: all that was made with it must be made again.
    Lost(String),
}

/// The worker as the app sees it.
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
    /// Starts the thread.
    ///
    /// # Errors
    /// A system that gives no thread.
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

    /// Begins to load a scene. Frames go on meanwhile.
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

    /// Orders a frame, in place of one that was ordered and not begun; returns its number.
    pub fn order(&mut self, job: Job) -> u64 {
        self.jobs += 1;
        self.office.desk().job = Some((self.jobs, job));
        self.office.bell.notify_one();
        self.jobs
    }

    /// Orders a frame in main memory.
    pub fn capture(&self, job: Job) {
        self.office.desk().capture = Some(job);
        self.office.bell.notify_one();
    }

    /// Asks what lies at a point of the view, as [`Camera::through`] takes it.
    pub fn pick(&self, camera: Camera, at: [f32; 2]) {
        self.office.desk().pick = Some((camera, at));
        self.office.bell.notify_one();
    }

    /// Whether nobody sees the frames, from now on.
    pub fn set_hidden(&self, hidden: bool) {
        self.office.desk().hidden = hidden;
    }

    /// What has been told since; does not wait.
    pub fn news(&mut self) -> Option<News> {
        // This worker can tell itself: there is none, or none yet.
        self.news.try_recv().ok()
    }

    /// The next that is told, waited for.
    pub fn wait(&mut self) -> Option<News> {
        self.news.recv().ok()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.office.desk().stop = true;
        self.office.bell.notify_one();
        if let Some(thread) = self.thread.take() {
            // It told what it died of.
            let _ = thread.join();
        }
    }
}

/// Tells news and wakes the shell.
#[derive(Clone)]
pub(crate) struct Teller {
    sender: Sender<News>,
    wake: Wake,
}

impl Teller {
    pub fn tell(&self, news: News) {
        // Where nobody listens any more, the worker is being dropped.
        let _ = self.sender.send(news);
        (self.wake)();
    }
}

fn load(gpu: &Gpu, files: &Files, name: &str, teller: &Teller) -> Result<Loaded, String> {
    teller.tell(News::Loading(format!("reading {name}"), [1, 3]));
    let mut scene = files(name)?;
    let features = glimpse::Features::of(&scene).list().to_vec();
    let facts = SceneFacts {
        name: name.to_owned(),
        primitives: (scene.triangle_objects.len() + scene.spheres.len()) as u64,
        cameras: scene.cameras.clone(),
        bounds: scene.bounds().unwrap_or_default(),
        warnings: std::mem::take(&mut scene.warnings),
        features,
    };
    teller.tell(News::Loading(format!("building {name}"), [2, 3]));
    let scene = GpuScene::upload(gpu, scene).map_err(|error| format!("{name}: {error}"))?;
    Ok(Loaded { scene, facts })
}

/// The thread: a scene after the other.
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

/// Does work of a thread whose panic must not leave the app waiting for ever.
fn caught<T>(work: impl FnOnce() -> T) -> Result<T, &'static str> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|_| "this is a bug, please report it")
}
