//! libvulkan.so: the system's loader and its driver, with the surfaces of Android made out of
//! `VK_EXT_headless_surface`, every presented picture read back, and faults that scenarios ask for.

mod capture;
mod device;
pub mod faults;
mod instance;
mod surface;
mod swapchain;

use std::collections::HashMap;
use std::ffi::{CStr, c_char, c_void};
use std::sync::{LazyLock, Mutex, MutexGuard, OnceLock};

use ash::vk;

pub use capture::{last_presented, picture, presents};
pub use device::created as devices_created;
pub use swapchain::created as swapchains_created;

use crate::report;
use crate::sync::lock;

type Void = vk::PFN_vkVoidFunction;

/// What exists between the app and the driver.
#[derive(Default)]
struct Objects {
    instance: Option<ash::Instance>,
    devices: HashMap<vk::Device, device::Device>,
    queues: HashMap<vk::Queue, vk::Device>,
    surfaces: HashMap<vk::SurfaceKHR, surface::Surface>,
    swapchains: HashMap<vk::SwapchainKHR, swapchain::Swapchain>,
}

// SAFETY: what is behind the pointers of a mapped staging buffer is touched under the lock alone.
unsafe impl Send for Objects {}

static OBJECTS: LazyLock<Mutex<Objects>> = LazyLock::new(Mutex::default);

fn objects() -> MutexGuard<'static, Objects> {
    lock(&OBJECTS)
}

/// Devices and surfaces that the app has not destroyed.
pub fn alive() -> [usize; 2] {
    let objects = objects();
    [objects.devices.len(), objects.surfaces.len()]
}

/// The entry of the system's own loader.
fn loader() -> vk::PFN_vkGetInstanceProcAddr {
    static ENTRY: OnceLock<usize> = OnceLock::new();
    let entry = *ENTRY.get_or_init(|| {
        // SAFETY: opens a library that stays open, and looks up a symbol.
        let entry = unsafe {
            let handle = libc::dlopen(c"libvulkan.so.1".as_ptr(), libc::RTLD_NOW);
            match handle.is_null() {
                true => std::ptr::null_mut(),
                false => libc::dlsym(handle, c"vkGetInstanceProcAddr".as_ptr()),
            }
        };
        if entry.is_null() {
            report::say("FAIL  this machine has no Vulkan loader: expected libvulkan.so.1");
            // SAFETY: ends the process; nothing can be played without it.
            unsafe { libc::_exit(4) }
        }
        entry as usize
    });
    // SAFETY: the loader gives its entry this type.
    unsafe { std::mem::transmute(entry) }
}

/// A function of the loader that needs no instance, or one of `instance`.
unsafe fn real<F: Copy>(instance: vk::Instance, name: &CStr) -> Option<F> {
    let function = loader()(instance, name.as_ptr())?;
    Some(std::mem::transmute_copy(&function))
}

macro_rules! hooks {
    ($($name:literal => $function:path),* $(,)?) => {
        /// What stands between the app and the function of this name.
        fn hook(name: &CStr) -> Option<unsafe extern "system" fn()> {
            let function = match name.to_bytes() {
                $($name => $function as *const c_void,)*
                _ => return None,
            };
            // SAFETY: Vulkan hands out all functions under this type; callers cast them back.
            Some(unsafe { std::mem::transmute::<*const c_void, unsafe extern "system" fn()>(function) })
        }
    };
}
hooks! {
    b"vkGetInstanceProcAddr" => vkGetInstanceProcAddr,
    b"vkGetDeviceProcAddr" => device::get_proc_addr,
    b"vkEnumerateInstanceExtensionProperties" => instance::enumerate_extensions,
    b"vkCreateInstance" => instance::create,
    b"vkEnumeratePhysicalDevices" => instance::enumerate_devices,
    b"vkGetPhysicalDeviceProperties" => instance::properties,
    b"vkGetPhysicalDeviceProperties2" => instance::properties2,
    b"vkGetPhysicalDeviceProperties2KHR" => instance::properties2,
    b"vkCreateAndroidSurfaceKHR" => surface::create,
    b"vkDestroySurfaceKHR" => surface::destroy,
    b"vkGetPhysicalDeviceSurfaceCapabilitiesKHR" => surface::capabilities,
    b"vkGetPhysicalDeviceSurfaceFormatsKHR" => surface::formats,
    b"vkGetPhysicalDeviceSurfacePresentModesKHR" => surface::present_modes,
    b"vkCreateDevice" => device::create,
    b"vkDestroyDevice" => device::destroy,
    b"vkGetDeviceQueue" => device::queue,
    b"vkQueueSubmit" => device::submit,
    b"vkCreateSwapchainKHR" => swapchain::create,
    b"vkDestroySwapchainKHR" => swapchain::destroy,
    b"vkAcquireNextImageKHR" => swapchain::acquire,
    b"vkQueuePresentKHR" => swapchain::present,
}

#[unsafe(no_mangle)]
unsafe extern "system" fn vkGetInstanceProcAddr(instance: vk::Instance, name: *const c_char) -> Void {
    hook(CStr::from_ptr(name)).or_else(|| loader()(instance, name))
}
