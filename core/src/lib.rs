//! Ray tracing of glTF scenes in compute shaders on [wgpu]: Whitted's illumination model with adaptive sampling, and path
//! tracing for one eye or two.
//!
//! An adaptive frame traces rays through about a third of its pixels, interpolates those between whose neighbours are
//! similar, and traces the others ([`Method::Adaptive`]). Other [methods](Method) trace every pixel, add samples where
//! neighbouring pixels differ, or accumulate paths.
//!
//! # A frame
//!
//! ```no_run
//! use glimpse::{Gpu, GpuScene, Renderer, Scene, Settings};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let gpu = Gpu::headless(None)?;
//! let file = std::fs::read("scene.glb")?;
//! let scene = Scene::from_gltf(&file, &mut |uri| Err(format!("{uri} is not in the file")))?;
//! let camera = *scene.camera(None)?;
//! let scene = GpuScene::upload(&gpu, scene)?;
//! let mut renderer = Renderer::new(&gpu, &scene, [1280, 720], &Settings::default())?;
//! let time = renderer.render(&camera)?;
//! std::fs::write("frame.png", glimpse::to_png(&renderer.display_image()?)?)?;
//! println!("{:.1} ms", time.ms);
//! # Ok(())
//! # }
//! ```
//!
//! [`Scene`] is arrays in main memory, from a file, [built in](scene::builtin) or made in code. [`GpuScene::upload`] builds
//! the acceleration structure and moves everything to the device. A [`Renderer`] makes frames of one size by one method;
//! its kernels are linked from what the scene's [`Features`] and the [`Settings`] need. [`Gpu`], [`GpuScene`] and
//! [`Renderer`] hold handles and borrow nothing.
//!
//! # In another program
//!
//! [`Gpu::from_device`] renders on a device and queue of the caller's, made as [`Gpu::requirements`] says.
//! [`Renderer::frame`] gives a frame as command buffers of bounded work that the caller submits between others;
//! [`Renderer::set_target`] makes it render into a texture of the caller's. [`wgpu`] and [`glam`] are exported again, so that
//! both sides mean the same version. The folder `examples` has `one_frame`, `own_scene` and `own_device`.
//!
//! # Invariants
//!
//! - The crate opens no window and no file, reads no clock, starts no thread and has no global state. (It reads the
//!   environment where drivers do: in [`instance`], as wgpu does, and to refuse a setting of Mesa's that spoils pictures.)
//! - Bad input is an [`Error`] that says what was expected and what was found; no input panics.
//! - No command buffer traces more than [`SAMPLES_PER_SUBMISSION`] samples.
//! - The same scene, settings and [seed](Settings::seed) give the same bytes on the same adapter.
//! - What a scene does not need is not in its kernels, and leaving it out changes no pixel.
//! - Every step of the shaders is done a second time in f64, without sharing their arithmetic (module `reference`);
//!   stiff and extreme cases compare the two (modules `probe` and `stress`).
//!
//! # Features
//!
//! | feature | default | brings |
//! | --- | --- | --- |
//! | `vulkan` | yes | wgpu's Vulkan backend |
//! | `metal`, `dx12` | no | wgpu's other backends, on which nothing was tested |
//! | `gltf` | yes | `Scene::from_gltf` |
//! | `draco` | yes | meshes of files that Draco compressed |
//! | `images` | yes | PNG and JPEG textures of files; `to_png`, `to_exr` and `Picture` |
//! | `webp`, `ktx2` | yes | textures in WebP, and in KTX 2.0 with Basis Universal |
//! | `reference` | yes | the modules `reference` and `cpu_tracer`: f64 frames, and path samples on CPU threads |
//! | `stress` | yes | the modules `probe` and `stress`; needs `reference` |
//! | `flip` | no | `metrics::flip`, NVIDIA's error metric, in C++ |
//!
//! A program that brings its own scenes needs `vulkan` alone.
//!
//! # Versions
//!
//! Errors, [`Show`] and [`Origin`] are `#[non_exhaustive]`: whoever matches them has an answer for what is new.
//! [`Method`] is not, as a new method concerns whoever treats each by itself. [`Settings`] and what a frame is described by
//! ([`Counts`], [`FrameTime`] and their parts) gain fields from one version to the next; `..Settings::default()` and
//! `..Default::default()` fill those in.
//!
//! # Papers
//!
//! - *Kim 2016*: Kim, Seo, Kim, Lim, Nah, Ihm, "Adaptive Undersampling for Efficient Mobile Ray Tracing", The Visual
//!   Computer 32.
//! - *Jin 2009*: Jin, Ihm, Chang, Park, Lee, Jung, "Selective and Adaptive Supersampling for Real-Time Ray Tracing",
//!   High Performance Graphics.
//! - *Ylitie 2017*: Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs".
//! - *Woop 2013*: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1).
//! - *Ize 2013*: Ize, "Robust BVH Ray Traversal", JCGT 2(2).
//! - *Edelsbrunner 1990*: Edelsbrunner, Muecke, "Simulation of Simplicity", ACM Transactions on Graphics 9(1).
//! - *Kim & Sung 2021*: Kim, Sung, "Efficient Path Tracer for the Presence of Mobile Virtual Reality", Human-centric
//!   Computing and Information Sciences 11.
//! - *Dammertz et al. 2010*: Dammertz, Sewtz, Hanika, Lensch, "Edge-Avoiding A-Trous Wavelet Transform for Fast Global
//!   Illumination Filtering", High Performance Graphics.
//! - *lecture*: Akenine-Moller, Assarsson, "Ray Tracing I", Chalmers; with Heckbert's minimal ray tracer.

// Without the optional modules some of what they share with the renderer has no user.
#![cfg_attr(
    not(all(feature = "reference", feature = "stress")),
    allow(dead_code, unused_imports, reason = "what optional modules use")
)]
// Lists of what is not allowed are in .clippy.toml.
#![cfg_attr(not(test), warn(clippy::disallowed_macros, clippy::disallowed_methods, clippy::disallowed_types))]

mod acceleration;
#[cfg(feature = "reference")]
pub mod cpu_tracer;
pub mod device;
mod error;
mod frame;
mod image;
pub mod metrics;
mod passes;
#[cfg(feature = "stress")]
pub mod probe;
#[cfg(feature = "reference")]
mod random;
#[cfg(feature = "reference")]
pub mod reference;
pub mod scene;
mod settings;
#[cfg(feature = "stress")]
pub mod stress;

// Types of both crates are part of the interface of this one.
pub use glam;
pub use wgpu;

pub use device::gpu_scene::GpuScene;
pub use device::{Compilation, Gpu, Uncompiled, instance};
pub use error::{Error, Result};
pub use frame::counters::{Check, Cost, Counts, FailedChecks, Origin, Rays, Samples};
pub use frame::plan::SAMPLES_PER_SUBMISSION;
pub use frame::renderer::{FrameCommands, Purpose, Renderer};
pub use frame::show;
pub use frame::show::Show;
pub use frame::stats::{FrameTime, Inspection, Memory, PassTime, PixelRecord};
pub use image::{DisplayImage, LinearImage, encode_display};
#[cfg(feature = "images")]
pub use image::{Picture, to_exr, to_png};
pub use metrics::missing::Missing;
pub use passes::{Demand, Demands, Linked, Tracing};
pub use scene::camera::Camera;
pub use scene::look_at::{Lens, LookAt};
pub use scene::{Features, Scene};
pub use settings::{
    Denoise, DirectLight, Filter, Focus, Foveation, Jitter, LightSelection, MAX_CPU_THREADS, MAX_DEPTH,
    MAX_EXPOSURE, MAX_GAZE, MAX_LIGHT_SAMPLES, MAX_RAYS, MAX_SAMPLING, Method, Mip, Paths, Postcorrect,
    Preset, Refine, Robustness, Roulette, Sampler, Settings, Specialize, StereoReuse, THRESHOLD_NAMES,
    Thresholds, Tolerances, Tonemap, Unsampled, options,
};
