//! The renderer: scene on the GPU, kernels for it, targets of one size.

use crate::{
    Camera, DisplayImage, Features, FrameTime, Gpu, Inspection, LinearImage, Memory, Result, Scene, Settings,
};

/// A scene on the GPU.
pub struct GpuScene {}

impl GpuScene {
    /// Builds the acceleration structure and moves everything to the device; the scene's own memory is freed.
    ///
    /// # Errors
    /// [`crate::Error::Missing`] where the device cannot hold it.
    pub fn upload(_gpu: &Gpu, _scene: Scene) -> Result<Self> {
        unimplemented!()
    }

    /// What the scene needs.
    #[must_use]
    pub fn features(&self) -> Features {
        unimplemented!()
    }
}

/// Renders frames of one size of one scene.
pub struct Renderer<'a> {
    _scene: &'a GpuScene,
}

impl<'a> Renderer<'a> {
    /// Links and compiles the kernels, makes the targets.
    ///
    /// # Errors
    /// Invalid settings or size, or a device that cannot.
    pub fn new(_gpu: &'a Gpu, _scene: &'a GpuScene, _size: [u32; 2], _settings: &Settings) -> Result<Self> {
        unimplemented!()
    }

    /// Renders a frame and waits for it; the timed path: nothing is counted.
    ///
    /// # Errors
    /// A device that failed.
    pub fn render(&mut self, _camera: &Camera) -> Result<FrameTime> {
        unimplemented!()
    }

    /// Renders the same frame with counting kernels (they are linked on the first call).
    ///
    /// # Errors
    /// A device that failed.
    pub fn inspect(&mut self, _camera: &Camera) -> Result<Inspection> {
        unimplemented!()
    }

    /// The last frame as shown.
    ///
    /// # Errors
    /// A device that failed.
    pub fn display_image(&self) -> Result<DisplayImage> {
        unimplemented!()
    }

    /// The frame of this camera in linear radiance (kernels that write it are linked on the first call).
    ///
    /// # Errors
    /// A device that failed.
    pub fn linear_image(&mut self, _camera: &Camera) -> Result<LinearImage> {
        unimplemented!()
    }

    /// Bytes on the device.
    #[must_use]
    pub fn memory(&self) -> Memory {
        unimplemented!()
    }
}
