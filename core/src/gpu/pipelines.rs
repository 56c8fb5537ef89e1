//! What drivers have compiled, to be kept from one run to the next.

use super::Gpu;

impl Gpu {
    /// Compiles with what [`Gpu::compiled`] gave in an earlier run, if anything: kernels that are in it need no compiler. Of
    /// another driver or version, or where the driver keeps nothing, it counts as nothing.
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

    /// What the driver has compiled so far, where it lends that and [`Gpu::with_compiled`] asked for it.
    #[must_use]
    pub fn compiled(&self) -> Option<Vec<u8>> {
        self.compiled.as_ref()?.get_data()
    }
}
