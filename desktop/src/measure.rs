//! Measures methods on one scene: all are warmed up, then take turns frame by frame, so that changes in the
//! device's load affect them alike.

use std::path::{Path, PathBuf};

use anyhow::Context;
use glimpse::scene::NotShown;
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

/// A scene on the device with a camera and the methods to measure.
pub struct Workbench<'g> {
    /// Device that renders.
    pub gpu: &'g Gpu,
    /// Scene in device buffers.
    pub scene: GpuScene,
    /// Camera of the frames.
    pub camera: Camera,
    /// Index and name of the camera.
    pub camera_name: String,
    /// Contents of the scene.
    pub statistics: SceneStatistics,
    /// Settings of each method to measure.
    pub methods: Vec<Settings>,
    /// Number of CPU threads of each method.
    pub cpu_threads: Vec<u32>,
    /// Scene for the CPU threads; `None` if there are none.
    pub reference: Option<Reference>,
    /// Warnings of the import.
    pub warnings: Vec<String>,
    /// The files that the scene was read from.
    pub inputs: Vec<PathBuf>,
    /// Features of the file that the frames do not show.
    pub not_shown: Vec<NotShown>,
    /// Time to load the scene, in milliseconds.
    pub load_ms: f64,
    /// Time to build the acceleration structure and upload the scene, in milliseconds.
    pub build_ms: f64,
}

impl<'g> Workbench<'g> {
    /// Loads the named scene and uploads it.
    pub fn set(
        gpu: &'g Gpu,
        path: &Path,
        options: &FrameOptions,
        requests: &[FrameRequest],
        progress: &Progress,
    ) -> anyhow::Result<Self> {
        let name = &path.display().to_string();
        progress.doing(&format!("loading {name}"));
        let surroundings = options.environment.surroundings();
        let mut inputs = Vec::new();
        let mut seen = |path: &Path, _: &[u8]| inputs.push(path.to_owned());
        let (scene, load_ms) = timed(|| {
            let mut scene = options.file.load(path, &mut seen)?;
            surroundings.apply(&mut scene)?;
            anyhow::Ok(scene)
        })?;
        inputs.extend(surroundings.file().map(Path::to_owned));
        let (camera, camera_name) = chosen_camera(&scene, options).with_context(|| name.to_owned())?;
        let methods =
            requests.iter().map(|request| request.in_scene(&scene.objects)).collect::<glimpse::Result<_>>();
        let methods = methods.with_context(|| name.to_owned())?;
        let specialize = requests.first().map_or(Specialize::Auto, |request| request.settings.specialize);
        let statistics = SceneStatistics::of(name, &scene, specialize);
        let (mut warnings, mut not_shown) = (scene.warnings.clone(), scene.not_shown.clone());
        for request in requests {
            let of_method = scene.not_shown_by(request.settings.method);
            if options.file.strict {
                scene_file::check_whole(path, &[], &of_method)?;
            }
            not_shown
                .extend(of_method.into_iter().filter(|one| !not_shown.contains(one)).collect::<Vec<_>>());
        }
        warnings.extend(scene.is_lit_by_studio.then(|| Scene::STUDIO_LIT.to_owned()));
        let exposure = |request: &FrameRequest| request.settings.exposure.unwrap_or(scene.auto_exposure());
        let cpu_threads: Vec<_> = requests.iter().map(|request| request.settings.paths.cpu_threads).collect();
        let reference = cpu_threads.iter().any(|cpu_threads| *cpu_threads > 0).then(|| {
            Reference::of(scene.clone().exposed(requests.first().map_or(0.0, exposure))).with_wide_tree()
        });
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
            inputs,
            not_shown,
            load_ms,
            build_ms,
        })
    }
}

/// Measurements of one method.
pub struct Run {
    /// Settings of the renderer.
    pub settings: Settings,
    /// Time to compile the kernels and render the first frame, in milliseconds.
    pub compile_ms: f64,
    /// Times of the warm frames.
    pub frames: Vec<FrameTime>,
    /// Picture encoded for display.
    pub picture: DisplayImage,
    /// Picture in linear radiance, if the plan asks for it.
    pub linear: Option<LinearImage>,
    /// Counters and data of each pixel, from a separate frame.
    pub inspection: Inspection,
    /// Bytes of device memory.
    pub memory: Memory,
    /// Errors of the frames of a panning camera, if the plan has one.
    pub panned: Option<Panned>,
    /// Samples by GPU and CPU thread after the warm frames, if any remained.
    pub sides: Option<Sides>,
}

impl Run {
    /// Error of this run's picture against that of `full`.
    pub fn error_against(&self, full: &Self) -> glimpse::Result<ErrorAgainst> {
        let mut report = metrics::compare(&self.picture, &full.picture)?;
        if let (Some(linear), Some(reference)) = (&self.linear, &full.linear) {
            report.linear_rmse = Some(metrics::linear_rmse(linear, reference)?);
        }
        Ok(ErrorAgainst { against: "full", report })
    }
}

/// Parameters of a measurement.
pub struct Plan {
    /// Width and height of one eye's picture in pixels.
    pub size: [u32; 2],
    /// Number of warm frames of each method.
    pub frames: u32,
    /// Whether to read linear radiance as well.
    pub linear: bool,
    /// Pan of the camera, if any.
    pub pan: Option<Pan>,
}

impl Plan {
    /// Number of progress steps that [`Plan::measure`] takes for `methods` methods.
    pub fn steps(&self, methods: usize) -> u64 {
        methods as u64 * (2 + u64::from(self.frames))
    }

    /// Renders the picture of the workbench's first method, without measuring anything.
    pub fn picture(&self, workbench: &Workbench<'_>) -> anyhow::Result<DisplayImage> {
        let settings = workbench.methods.first().context("expected a method, found none")?;
        let size = settings.method.picture(self.size);
        let mut renderer = Renderer::new(workbench.gpu, &workbench.scene, size, settings)?;
        renderer.render(&workbench.camera)?;
        let unfinished = Unfinished {
            renderer: &mut renderer,
            camera: &workbench.camera,
            size: self.size,
            reference: workbench.reference.as_ref(),
            cpu_threads: workbench.cpu_threads[0],
        };
        unfinished.finish(|_| ())?;
        Ok(renderer.display_image()?)
    }

    /// Measures all methods of the workbench, in their order.
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

/// Camera given by `--eye` or `--camera`, and its name in the output.
fn chosen_camera(scene: &Scene, options: &FrameOptions) -> glimpse::Result<(Camera, String)> {
    if let Some(camera) = options.look_at.camera(scene.origin)? {
        return Ok((camera, "--eye".to_owned()));
    }
    let camera = scene.camera(options.camera.as_deref())?;
    let index = scene.cameras.iter().position(|(_, c)| std::ptr::eq(c, camera)).unwrap_or_default();
    Ok((*camera, format!("{index} ({})", scene.cameras[index].0)))
}
