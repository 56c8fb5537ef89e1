//! Glimpse: realtime adaptive ray tracing on wgpu.

mod atlas;
mod bvh;
mod camera;
mod error;
mod frame;
pub mod gpu;
mod gpu_scene;
mod image;
pub mod metrics;
mod passes;
pub mod probe;
mod renderer;
pub mod scene;
mod settings;
mod stats;

pub use camera::Camera;
pub use error::{Error, Result};
pub use gpu::Gpu;
pub use gpu_scene::GpuScene;
pub use image::{DisplayImage, LinearImage, Picture, encode_display, to_exr, to_png};
pub use renderer::Renderer;
pub use scene::{Features, Scene};
pub use settings::{Linking, MAX_DEPTH, Method, Settings, Tolerances};
pub use stats::{
    CHECK_NAMES, Cost, Counts, FailedChecks, FrameTime, Inspection, Memory, Origin, PassTime, PixelRecord,
    Rays, Samples,
};
