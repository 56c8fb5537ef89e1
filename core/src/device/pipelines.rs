//! The driver's pipeline cache, kept from one run to the next.

use super::Gpu;

impl Gpu {
    /// Uses the pipeline cache that [`Gpu::compiled`] returned in an earlier run: kernels in it are not compiled again. A
    /// cache of another driver or version is ignored, as is any where the driver has none.
    ///
    /// # Safety
    /// `before` came from [`Gpu::compiled`], unchanged: drivers trust it.
    #[allow(unsafe_code, reason = "the caller vouches for the bytes")]
    #[must_use]
    pub unsafe fn with_compiled(mut self, before: Option<&[u8]>) -> Self {
        if self.device.features().contains(wgpu::Features::PIPELINE_CACHE) {
            let descriptor =
                wgpu::PipelineCacheDescriptor { label: Some("kernels"), data: before, fallback: true };
            // SAFETY: as the caller promises.
            self.compiled = Some(unsafe { self.device.create_pipeline_cache(&descriptor) });
        }
        self
    }

    /// The driver's pipeline cache so far, where it has one and [`Gpu::with_compiled`] asked for it.
    #[must_use]
    pub fn compiled(&self) -> Option<Vec<u8>> {
        self.compiled.as_ref()?.get_data()
    }
}
