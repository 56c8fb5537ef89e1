//! Glimpse: realtime adaptive ray tracing on wgpu.
//!
//! ```text
//! bytes --Scene::from_gltf--> Scene --GpuScene::upload--> GpuScene --Renderer::new--> Renderer --render--> frame
//!                               |                           |                           |
//!                               +-- Features: what it needs +-- BVH, atlas, buffers     +-- passes: linked kernels
//! ```
//!
//! [`Scene`] is flat arrays in main memory. [`GpuScene::upload`] consumes it. A [`Renderer`] makes frames of one size by
//! one [`Method`]; what its kernels are made of follows from the [`Features`] of the scene and the [`Settings`], in
//! `passes/spec.rs` and nowhere else. `plan.rs` puts the passes in order, in parts of bounded work; `frame.rs` records
//! them.
//!
//! [`mod@reference`] does every step of the shaders again in f64: it is what right means. [`probe`] runs the shaders' own
//! functions for rays of the caller's, and [`stress`] has the stiff and extreme cases that compare the two.
//!
//! This crate knows no window, no file, no clock and no thread that it was not given, and has no global state.
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

mod atlas;
mod bvh;
mod camera;
mod counters;
mod error;
mod frame;
pub mod gpu;
mod gpu_scene;
mod image;
mod inspection;
pub mod metrics;
mod mip;
mod missing;
mod passes;
mod plan;
pub mod planes;
mod pose;
pub mod probe;
pub mod reference;
mod renderer;
pub mod scene;
mod sequence;
mod settings;
pub mod show;
mod stats;
pub mod stress;
mod targets;

pub use camera::Camera;
pub use counters::{Check, Cost, Counts, FailedChecks, Origin, Rays, Samples};
pub use error::{Error, Result};
pub use gpu::{Gpu, instance};
pub use gpu_scene::GpuScene;
pub use image::{DisplayImage, LinearImage, Picture, encode_display, to_exr, to_png};
pub use missing::Missing;
pub use passes::{Demand, Demands, Linked, Tracing};
pub use plan::SAMPLES_PER_SUBMISSION;
pub use pose::{Lens, Pose};
pub use renderer::Renderer;
pub use scene::{Features, Scene};
pub use settings::{
    Crossing, Denoise, Direct, Filter, Focus, Inactive, Jitter, Linking, MAX_DEPTH, MAX_GAZE,
    MAX_LIGHT_SAMPLES, MAX_RAYS, MAX_SAMPLING, Method, Mip, Paths, Postcorrect, Preset, Refine, Robustness,
    Roulette, Sampler, Settings, Shining, Stopping, THRESHOLD_NAMES, Thresholds, Tolerances,
};
pub use show::Show;
pub use stats::{FrameTime, Inspection, Memory, PassTime, PixelRecord};
