//! Methods measured on one scene: warmed up, then interleaved frame by frame so that they share the weather.

use anyhow::Context;
use glimpse::{
    Camera, DisplayImage, FrameTime, Gpu, GpuScene, Inspection, LinearImage, Memory, Renderer, Scene,
    Settings, Specialize, metrics, reference::Reference,
};
use glimpse_measure::statistics::{SceneStatistics, timed};

use crate::args::FrameOptions;
use crate::cpu_tracer::{Sides, Unfinished};
use crate::focus::FrameRequest;
use crate::pan::{Pan, Panned};
use crate::progress::Progress;
use crate::scene_file;
use crate::statistics::ErrorAgainst;

/// A scene on the device, a camera in it, and what is known of both.
pub struct Workbench<'g> {
    /// The device.
    pub gpu: &'g Gpu,
    /// The scene there.
    pub scene: GpuScene,
    /// The view.
    pub camera: Camera,
    /// Its index and name.
    pub camera_name: String,
    /// What the scene holds.
    pub statistics: SceneStatistics,
    /// What is measured there.
    pub methods: Vec<Settings>,
    /// Threads beside the GPU, of each.
    pub cpu_threads: Vec<u32>,
    /// The scene as they see it, where there are any.
    pub reference: Option<Reference>,
    /// What the import had to leave out.
    pub warnings: Vec<String>,
    /// Milliseconds for reading.
    pub load_ms: f64,
    /// Milliseconds for the acceleration structure and the way to the device.
    pub build_ms: f64,
}

impl<'g> Workbench<'g> {
    /// Loads the scene of that name and moves it to the device.
    pub fn set(
        gpu: &'g Gpu,
        name: &str,
        options: &FrameOptions,
        requests: &[FrameRequest],
        progress: &Progress,
    ) -> anyhow::Result<Self> {
        progress.doing(&format!("loading {name}"));
        let (scene, load_ms) = timed(|| scene_file::load(name))?;
        let (camera, camera_name) = chosen_camera(&scene, options).with_context(|| name.to_owned())?;
        let methods =
            requests.iter().map(|request| request.in_scene(&scene.objects)).collect::<glimpse::Result<_>>();
        let methods = methods.with_context(|| name.to_owned())?;
        let specialize = requests.first().map_or(Specialize::Auto, |request| request.settings.specialize);
        let statistics = SceneStatistics::of(name, &scene, specialize);
        let warnings = scene.warnings.clone();
        let cpu_threads: Vec<_> = requests.iter().map(|request| request.settings.paths.cpu_threads).collect();
        let reference = cpu_threads
            .iter()
            .any(|cpu_threads| *cpu_threads > 0)
            .then(|| Reference::new(&scene).with_wide_tree());
        progress.doing("building the acceleration structure");
        let (scene, build_ms) = timed(|| GpuScene::upload(gpu, scene).with_context(|| name.to_owned()))?;
        Ok(Self {
            gpu,
            scene,
            camera,
            camera_name,
            statistics,
            methods,
            cpu_threads,
            reference,
            warnings,
            load_ms,
            build_ms,
        })
    }
}

/// What was measured of one method.
pub struct Run {
    /// How the frames were made.
    pub settings: Settings,
    /// Milliseconds for compiling, the first frame included.
    pub compile_ms: f64,
    /// The warm frames.
    pub frames: Vec<FrameTime>,
    /// The frame as shown.
    pub picture: DisplayImage,
    /// The frame in linear radiance, where it was asked for.
    pub linear: Option<LinearImage>,
    /// The counters, from a frame of their own.
    pub inspection: Inspection,
    /// Bytes on the device.
    pub memory: Memory,
    /// The frames of a camera that turns.
    pub panned: Option<Panned>,
    /// Who brought the samples after the warm frames.
    pub sides: Option<Sides>,
}

impl Run {
    /// The error of this run's picture against a full frame.
    pub fn error_against(&self, full: &Self) -> glimpse::Result<ErrorAgainst> {
        let mut report = metrics::compare(&self.picture, &full.picture)?;
        if let (Some(linear), Some(reference)) = (&self.linear, &full.linear) {
            report.linear_rmse = Some(metrics::linear_rmse(linear, reference)?);
        }
        Ok(ErrorAgainst { against: "full", report })
    }
}

/// How methods are measured.
pub struct Plan {
    /// Width and height, of what an eye sees.
    pub size: [u32; 2],
    /// Warm frames of each.
    pub frames: u32,
    /// Linear radiance too.
    pub linear: bool,
    /// How the camera turns.
    pub pan: Option<Pan>,
}

impl Plan {
    /// Steps of the progress bar that [`Plan::measure`] takes for so many methods.
    pub fn steps(&self, methods: usize) -> u64 {
        methods as u64 * (2 + u64::from(self.frames))
    }

    /// Measures every method of the workbench, in their order.
    pub fn measure(&self, workbench: &Workbench<'_>, progress: &Progress) -> anyhow::Result<Vec<Run>> {
        let name = &workbench.statistics.file;
        let mut camera = workbench.camera;
        let mut renderers = Vec::with_capacity(workbench.methods.len());
        for settings in &workbench.methods {
            progress.doing(&format!("{name}: compiling"));
            renderers.push(timed(|| {
                let mut renderer = Renderer::new(
                    workbench.gpu,
                    &workbench.scene,
                    settings.method.picture(self.size),
                    settings,
                )?;
                renderer.render(&camera)?;
                anyhow::Ok(renderer)
            })?);
            progress.step();
        }
        let mut frames = vec![Vec::with_capacity(self.frames as usize); renderers.len()];
        let mut panned = vec![self.pan.as_ref().map(Panned::new); renderers.len()];
        for frame in 1..=self.frames {
            progress.doing(&format!("{name}: frame {frame}"));
            if let Some(pan) = &self.pan {
                camera = workbench.camera.panned(f64::from(frame) * pan.degrees);
            }
            for ((renderer, _), times) in renderers.iter_mut().zip(&mut frames) {
                times.push(renderer.render(&camera)?);
                progress.step();
            }
            if let Some(pan) = &self.pan {
                pan.compare(&mut renderers, &camera, &mut panned)?;
            }
        }
        let mut runs = Vec::with_capacity(renderers.len());
        let measured = renderers.into_iter().zip(frames).zip(panned).zip(&workbench.cpu_threads);
        for ((((mut renderer, compile_ms), frames), panned), &cpu_threads) in measured {
            let unfinished = Unfinished {
                renderer: &mut renderer,
                camera: &camera,
                size: self.size,
                reference: workbench.reference.as_ref(),
                cpu_threads,
            };
            let sides = unfinished.finish(|samples| progress.doing(&format!("{name}: sample {samples}")))?;
            progress.doing(&format!("{name}: counting"));
            let settings = *renderer.settings();
            let picture = renderer.display_image()?;
            let memory = renderer.memory();
            let inspection = renderer.inspect(&camera)?;
            let linear = self.linear.then(|| renderer.linear_image(&camera)).transpose()?;
            runs.push(Run {
                settings,
                compile_ms,
                frames,
                picture,
                linear,
                inspection,
                memory,
                panned,
                sides,
            });
            progress.step();
        }
        Ok(runs)
    }
}

/// The camera of the command line, or the one of the scene that it names, and what to call it.
fn chosen_camera(scene: &Scene, options: &FrameOptions) -> glimpse::Result<(Camera, String)> {
    if let Some(camera) = options.look_at.camera()? {
        return Ok((camera, "--eye".to_owned()));
    }
    let camera = scene.camera(options.camera.as_deref())?;
    let index = scene.cameras.iter().position(|(_, c)| std::ptr::eq(c, camera)).unwrap_or_default();
    Ok((*camera, format!("{index} ({})", scene.cameras[index].0)))
}
