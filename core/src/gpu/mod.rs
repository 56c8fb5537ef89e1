//! The device.
pub mod shader;

use crate::Result;

/// What `glimpse devices` says of an adapter.
#[derive(Clone, Debug)]
pub struct AdapterFacts {
    /// Name, backend, driver, as wgpu reports them.
    pub info: wgpu::AdapterInfo,
    /// What the adapter offers.
    pub limits: wgpu::Limits,
    /// Whether frames are timed on the GPU.
    pub timestamps: bool,
}

/// A device and its queue.
pub struct Gpu {}

impl Gpu {
    /// The best adapter whose name contains `wanted` (any case), without a window.
    ///
    /// # Errors
    /// [`crate::Error::NoAdapter`] lists what there is.
    pub fn headless(_wanted: Option<&str>) -> Result<Self> {
        unimplemented!()
    }

    /// All adapters.
    #[must_use]
    pub fn adapters() -> Vec<AdapterFacts> {
        unimplemented!()
    }

    /// This device's adapter.
    #[must_use]
    pub fn facts(&self) -> &AdapterFacts {
        unimplemented!()
    }
}
