//! Faults of drivers, loaders and windows that scenarios ask for.

use std::sync::Mutex;

use ash::vk;

use crate::sync::lock;

/// What goes wrong from now on.
#[derive(Clone, Copy, Default)]
pub struct Faults {
    /// The loader's library cannot be opened.
    pub no_loader: bool,
    /// The loader knows no physical device.
    pub no_device: bool,
    /// The device's limits are those of no usable phone.
    pub small_limits: bool,
    /// Every acquire and present answers SUBOPTIMAL, as when the display is turned and the app does not turn back.
    pub suboptimal: bool,
    /// So many swapchains become out of date, one after the other.
    pub outdated: u32,
    /// So many surfaces are lost, one after the other.
    pub lost_surfaces: u32,
    /// So many devices are lost at their next submission, one after the other.
    pub lost_devices: u32,
}

static FAULTS: Mutex<Faults> = Mutex::new(Faults {
    no_loader: false,
    no_device: false,
    small_limits: false,
    suboptimal: false,
    outdated: 0,
    lost_surfaces: 0,
    lost_devices: 0,
});

/// Reads or changes what goes wrong.
pub fn with<T>(act: impl FnOnce(&mut Faults) -> T) -> T {
    act(&mut lock(&FAULTS))
}

/// Whether the loader's library is missing.
pub fn no_loader() -> bool {
    with(|faults| faults.no_loader)
}

/// Takes one from a number of faults; says whether there was one.
pub fn take(which: impl FnOnce(&mut Faults) -> &mut u32) -> bool {
    with(|faults| {
        let left = which(faults);
        let is_any = *left > 0;
        *left -= u32::from(is_any);
        is_any
    })
}

/// Lowers what a shader may use below what the app needs.
pub fn lower(limits: &mut vk::PhysicalDeviceLimits) {
    if with(|faults| faults.small_limits) {
        limits.max_storage_buffer_range = 1 << 24;
        limits.max_compute_work_group_invocations = 64;
        limits.max_compute_work_group_size = [64, 64, 64];
    }
}
