//! Reads a scene and uploads it to the device.

use glam::{DVec3, Vec3};
use glimpse::scene::NotShown;
use glimpse::{Camera, Gpu, GpuScene, Method, Scene};

use crate::{Files, WorkerEvent, worker::EventSender};

/// A scene that was read, and the camera that shows it first.
pub struct Opened {
    /// The imported or built-in scene, in main memory.
    pub scene: Scene,
    /// The camera that the view starts from.
    pub camera: StartCamera,
}

/// The camera that shows a scene first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StartCamera {
    /// The scene's camera of this index.
    OfScene(usize),
    /// A camera of the user's own.
    Free(Camera),
}

impl Default for StartCamera {
    fn default() -> Self {
        Self::OfScene(0)
    }
}

impl From<Scene> for Opened {
    fn from(scene: Scene) -> Self {
        Self { scene, camera: StartCamera::default() }
    }
}

/// Properties of a loaded scene.
#[derive(Clone, Debug)]
pub struct SceneFacts {
    /// Name under which it was requested.
    pub name: String,
    /// Number of triangles and spheres.
    pub primitives: u64,
    /// Cameras of the scene with their names; at least one.
    pub cameras: Vec<(String, Camera)>,
    /// The camera that shows it first.
    pub start: StartCamera,
    /// The point of the file's coordinates where the scene's are zero.
    pub origin: DVec3,
    /// Lowest and highest corner of the bounding box, in world space.
    pub bounds: (Vec3, Vec3),
    /// One line for each element that the importer left out or replaced.
    pub warnings: Vec<String>,
    /// One line for each feature of the file that is not shown.
    pub not_shown: Vec<String>,
    /// The same of what the pictures of a method alone do not show.
    pub not_shown_by: Vec<(Method, Vec<String>)>,
    /// All optional features, each with whether the scene needs it.
    pub features: Vec<(&'static str, bool)>,
}

/// A scene on the device.
pub(crate) struct Loaded {
    pub scene: GpuScene,
    pub facts: SceneFacts,
}

/// What the user is told of a scene.
fn told(scene: &mut Scene) -> Vec<String> {
    let mut lines = std::mem::take(&mut scene.warnings);
    lines.extend(scene.is_lit_by_studio.then(|| Scene::STUDIO_LIT.to_owned()));
    lines
}

/// Reads the named scene, uploads it, and reports the progress. An error is a message of one line.
pub(crate) fn load(
    gpu: &Gpu,
    files: &Files,
    name: &str,
    event_sender: &EventSender,
) -> Result<Loaded, String> {
    event_sender.send(WorkerEvent::Loading(format!("reading {name}"), [1, 2]));
    let Opened { mut scene, camera } = files(name)?;
    let lines = |not_shown: &[NotShown]| not_shown.iter().map(ToString::to_string).collect();
    let features = glimpse::Features::of(&scene).list().to_vec();
    let facts = SceneFacts {
        name: name.to_owned(),
        primitives: (scene.triangle_objects.len() + scene.spheres.len()) as u64,
        cameras: scene.cameras.clone(),
        start: camera,
        origin: scene.origin,
        bounds: scene.bounds().unwrap_or_default(),
        warnings: told(&mut scene),
        not_shown: lines(&scene.not_shown),
        not_shown_by: Method::ALL.map(|method| (method, lines(&scene.not_shown_by(method)))).to_vec(),
        features,
    };
    event_sender.send(WorkerEvent::Loading(format!("building {name}"), [2, 2]));
    let scene = GpuScene::upload(gpu, scene).map_err(|error| format!("{name}: {error}"))?;
    Ok(Loaded { scene, facts })
}
