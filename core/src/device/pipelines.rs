//! Reuses the driver's pipeline cache across runs.

use super::Gpu;

impl Gpu {
    /// Uses a pipeline cache that [`Gpu::compiled`] returned in an earlier run, so that its kernels are not
    /// compiled again. A cache of another driver or version is ignored; without support of the device this does
    /// nothing.
    ///
    /// # Safety
    /// `before` must be the unchanged result of [`Gpu::compiled`]: drivers trust its content.
    #[allow(unsafe_code, reason = "the caller vouches for the bytes")]
    #[must_use]
    pub unsafe fn with_compiled(mut self, before: Option<&[u8]>) -> Self {
        if self.device.features().contains(wgpu::Features::PIPELINE_CACHE) {
            let descriptor =
                wgpu::PipelineCacheDescriptor { label: Some("kernels"), data: before, fallback: true };
            // SAFETY: the caller guarantees that the data comes from `Gpu::compiled`.
            self.compiled = Some(unsafe { self.device.create_pipeline_cache(&descriptor) });
        }
        self
    }

    /// The driver's current pipeline cache; `None` without [`Gpu::with_compiled`] or support of the device.
    #[must_use]
    pub fn compiled(&self) -> Option<Vec<u8>> {
        self.compiled.as_ref()?.get_data()
    }
}
