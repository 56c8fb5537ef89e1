//! Shared harness of the headless tests.
//!
//! `tests/no_gpu.rs` needs no graphics driver; `tests/gpu.rs` renders on the best adapter (lavapipe if there
//! is no other) and fails without one: `desktop/setup.sh` installs it.

pub mod agreement;
pub mod builder;
pub mod gallery;
pub mod minray;

use std::{
    io::Write,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

use glam::DVec3;
use glimpse::{
    Camera, DisplayImage, Gpu, GpuScene, Inspection, LinearImage, Method, Renderer, Scene, Settings,
};

/// A device that this thread has to itself until it ends. Drivers compile kernels of a device one after the
/// other, which is most of the tests' time.
///
/// # Panics
/// If there is no adapter: a run that cannot render has not passed.
pub fn gpu() -> &'static Gpu {
    thread_local!(static DEVICE: Lent = Lent::new());
    DEVICE.with(|device| device.0)
}

/// A device that is returned to the pool when its thread ends.
struct Lent(&'static Gpu);

static FREE: Mutex<Vec<&'static Gpu>> = Mutex::new(Vec::new());

impl Lent {
    fn new() -> Self {
        let free = FREE.lock().unwrap_or_else(PoisonError::into_inner).pop();
        Self(free.unwrap_or_else(|| match Gpu::headless(None) {
            Ok(gpu) => {
                let info = &gpu.facts().info;
                note(&format!("adapter: {} ({:?}, {})", info.name, info.backend, info.driver_info));
                Box::leak(Box::new(gpu))
            }
            Err(error) => {
                panic!(
                    "{error}\nrun `sh desktop/setup.sh`: it installs Mesa's lavapipe where there is no driver"
                )
            }
        }))
    }
}

impl Drop for Lent {
    fn drop(&mut self) {
        FREE.lock().unwrap_or_else(PoisonError::into_inner).push(self.0);
    }
}

/// A scene on the device with a camera.
pub struct TestScene {
    /// The scene in device buffers.
    pub scene: GpuScene,
    /// The scene's first camera, unless set otherwise.
    pub camera: Camera,
}

impl TestScene {
    /// Uploads a scene and takes its first camera.
    ///
    /// # Panics
    /// If the scene has no camera or the upload fails.
    #[must_use]
    pub fn new(scene: Scene) -> Self {
        let camera = *scene.camera(None).expect("the scene has a camera");
        Self { scene: GpuScene::upload(gpu(), scene).expect("the scene fits the device"), camera }
    }

    /// Uploads a built-in scene.
    ///
    /// # Panics
    /// If there is no such scene.
    #[must_use]
    pub fn builtin(name: &str) -> Self {
        Self::new(glimpse::scene::builtin(name).unwrap_or_else(|| panic!("builtin:{name} is missing")))
    }

    /// Renders a frame and returns its linear radiance.
    ///
    /// # Panics
    /// If the renderer fails.
    #[must_use]
    pub fn frame(&self, size: [u32; 2], settings: &Settings) -> LinearImage {
        let frame = self.renderer(size, settings).linear_image(&self.camera).expect("the frame can be read");
        assert_eq!(frame.dimensions(), size.into(), "size of the linear image");
        frame
    }

    /// Renders a frame encoded for display. This compiles another set of kernels than [`TestScene::frame`].
    ///
    /// # Panics
    /// If the renderer fails.
    #[must_use]
    pub fn shown(&self, size: [u32; 2], settings: &Settings) -> DisplayImage {
        let mut renderer = self.renderer(size, settings);
        renderer.render(&self.camera).expect("the frame renders");
        let shown = renderer.display_image().expect("the frame can be read");
        assert_eq!(shown.dimensions(), size.into(), "size of the display image");
        shown
    }

    /// Renders a frame by `full` and returns its linear radiance.
    #[must_use]
    pub fn full(&self, size: [u32; 2]) -> LinearImage {
        self.frame(size, &full())
    }

    /// Renders a frame with the counting kernels.
    ///
    /// # Panics
    /// If the renderer fails.
    #[must_use]
    pub fn inspect(&self, size: [u32; 2], settings: &Settings) -> Inspection {
        let inspection = self.renderer(size, settings).inspect(&self.camera).expect("the frame is counted");
        let records = if settings.sampling == 1 { size[0] * size[1] } else { 0 };
        assert_eq!(inspection.pixels.len(), records as usize, "one record a pixel of one sample");
        inspection
    }

    fn renderer(&self, size: [u32; 2], settings: &Settings) -> Renderer {
        Renderer::new(gpu(), &self.scene, size, settings).expect("the kernels compile")
    }
}

/// Asserts that two frames are equal bit for bit and all radiances are finite and not negative.
///
/// # Panics
/// If they are not.
pub fn assert_same(found: &LinearImage, expected: &LinearImage, what: &str) {
    let bits = |frame: &LinearImage| frame.as_raw().iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    assert!(bits(found) == bits(expected), "{what}: the frames differ");
    assert!(found.as_raw().iter().all(|v| v.is_finite() && *v >= 0.0), "{what}: radiance is finite");
}

/// Settings of full ray tracing without a minimum weight: all rays are followed to the depth limit.
#[must_use]
pub fn full() -> Settings {
    Settings { method: Method::Full, min_weight: 0.0, ..Settings::default() }
}

/// Origin and unit direction, in f64, of the ray through the centre of pixel `(x, y)`.
#[must_use]
pub fn pixel_ray(camera: &Camera, size: [u32; 2], x: u32, y: u32) -> (DVec3, DVec3) {
    let [w, h] = size.map(f64::from);
    let right = (2.0 * (f64::from(x) + 0.5) - w) / h;
    let up = (h - 2.0 * (f64::from(y) + 0.5)) / h;
    let spread = right * camera.right.as_dvec3() + up * camera.up.as_dvec3();
    let (origin, forward) = (camera.origin.as_dvec3(), camera.forward.as_dvec3());
    if camera.orthographic {
        (origin + spread, forward.normalize())
    } else {
        (origin, (forward + spread).normalize())
    }
}

/// Loads a scene of the shared collection: in `$GLIMPSE_SCENES`, else `../shared/scenes` beside the
/// workspace. If it is missing, prints a line and returns `None`.
///
/// # Panics
/// If the file cannot be loaded or needs other files.
#[must_use]
pub fn shared_scene(name: &str) -> Option<Scene> {
    let folder = std::env::var_os("GLIMPSE_SCENES")
        .map_or_else(|| workspace().join("../shared/scenes"), PathBuf::from);
    let path = folder.join(name);
    if !path.is_file() {
        note(&format!("SKIPPED: {} is not there (set GLIMPSE_SCENES)", path.display()));
        return None;
    }
    let bytes = std::fs::read(&path).expect("the file can be read");
    let scene = Scene::from_gltf(&bytes, &mut |uri| Err(format!("{name} refers to {uri}")));
    Some(scene.unwrap_or_else(|error| panic!("{name}: {error}")))
}

/// Root folder of the workspace.
#[must_use]
pub fn workspace() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// Prints a line that is seen whether or not the test passes (the test runner captures `eprintln!`).
pub fn note(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}
