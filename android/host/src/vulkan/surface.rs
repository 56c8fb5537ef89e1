//! Surfaces: headless ones that look like a phone's and follow their `ANativeWindow`.

use ash::vk;

use super::{instance, objects, real};
use crate::window::{self, ANativeWindow};

/// A surface of the app.
pub struct Surface {
    /// The window it was made for.
    pub window: *mut ANativeWindow,
    /// Nothing can be presented any more.
    pub is_lost: bool,
    /// The swapchain that is not retired.
    pub swapchain: vk::SwapchainKHR,
}

/// Of phones: red first.
const FORMATS: [vk::Format; 2] = [vk::Format::R8G8B8A8_UNORM, vk::Format::R8G8B8A8_SRGB];
const PRESENT_MODES: [vk::PresentModeKHR; 2] = [vk::PresentModeKHR::FIFO, vk::PresentModeKHR::MAILBOX];

pub unsafe extern "system" fn create(
    instance: vk::Instance,
    info: *const vk::AndroidSurfaceCreateInfoKHR<'_>,
    allocator: *const vk::AllocationCallbacks<'_>,
    surface: *mut vk::SurfaceKHR,
) -> vk::Result {
    let window = (*info).window.cast::<ANativeWindow>();
    let Some(create) = real::<vk::PFN_vkCreateHeadlessSurfaceEXT>(instance, c"vkCreateHeadlessSurfaceEXT")
    else {
        return vk::Result::ERROR_EXTENSION_NOT_PRESENT;
    };
    if !window::connect_vulkan(window) {
        return vk::Result::ERROR_NATIVE_WINDOW_IN_USE_KHR;
    }
    let headless = vk::HeadlessSurfaceCreateInfoEXT::default();
    let result = create(instance, &raw const headless, allocator, surface);
    if result == vk::Result::SUCCESS {
        let created = Surface { window, is_lost: false, swapchain: vk::SwapchainKHR::null() };
        objects().surfaces.insert(*surface, created);
    } else {
        window::disconnect_vulkan(window);
    }
    result
}

pub unsafe extern "system" fn destroy(
    instance: vk::Instance,
    surface: vk::SurfaceKHR,
    allocator: *const vk::AllocationCallbacks<'_>,
) {
    if let Some(gone) = objects().surfaces.remove(&surface) {
        window::disconnect_vulkan(gone.window);
    }
    if let Some(destroy) = real::<vk::PFN_vkDestroySurfaceKHR>(instance, c"vkDestroySurfaceKHR") {
        destroy(instance, surface, allocator);
    }
}

/// Pixels of the window behind a surface.
pub fn size(surface: vk::SurfaceKHR) -> Option<[u32; 2]> {
    let window = objects().surfaces.get(&surface)?.window;
    window::size(window)
}

fn instance_functions() -> Option<ash::khr::surface::Instance> {
    let instance = instance::functions()?;
    let entry = ash::StaticFn { get_instance_proc_addr: super::loader() };
    // SAFETY: the entry is the loader's own.
    let entry = unsafe { ash::Entry::from_static_fn(entry) };
    Some(ash::khr::surface::Instance::new(&entry, &instance))
}

pub unsafe extern "system" fn capabilities(
    device: vk::PhysicalDevice,
    surface: vk::SurfaceKHR,
    capabilities: *mut vk::SurfaceCapabilitiesKHR,
) -> vk::Result {
    let Some(functions) = instance_functions() else { return vk::Result::ERROR_INITIALIZATION_FAILED };
    if objects().surfaces.get(&surface).is_none_or(|surface| surface.is_lost) {
        return vk::Result::ERROR_SURFACE_LOST_KHR;
    }
    let result = (functions.fp().get_physical_device_surface_capabilities_khr)(device, surface, capabilities);
    if let Some([width, height]) = size(surface) {
        (*capabilities).current_extent = vk::Extent2D { width, height };
        (*capabilities).supported_composite_alpha = vk::CompositeAlphaFlagsKHR::INHERIT;
    }
    result
}

/// Hands a list over as Vulkan does: first its length, then as much as there is room for.
unsafe fn list<T: Copy>(found: &[T], count: *mut u32, to: *mut T) -> vk::Result {
    if to.is_null() {
        *count = found.len() as u32;
        return vk::Result::SUCCESS;
    }
    let fits = found.len().min(*count as usize);
    std::ptr::copy_nonoverlapping(found.as_ptr(), to, fits);
    *count = fits as u32;
    if fits < found.len() { vk::Result::INCOMPLETE } else { vk::Result::SUCCESS }
}

pub unsafe extern "system" fn formats(
    device: vk::PhysicalDevice,
    surface: vk::SurfaceKHR,
    count: *mut u32,
    formats: *mut vk::SurfaceFormatKHR,
) -> vk::Result {
    let Some(functions) = instance_functions() else { return vk::Result::ERROR_INITIALIZATION_FAILED };
    match functions.get_physical_device_surface_formats(device, surface) {
        Ok(mut found) => {
            found.retain(|format| FORMATS.contains(&format.format));
            list(&found, count, formats)
        }
        Err(problem) => problem,
    }
}

pub unsafe extern "system" fn present_modes(
    device: vk::PhysicalDevice,
    surface: vk::SurfaceKHR,
    count: *mut u32,
    modes: *mut vk::PresentModeKHR,
) -> vk::Result {
    let Some(functions) = instance_functions() else { return vk::Result::ERROR_INITIALIZATION_FAILED };
    match functions.get_physical_device_surface_present_modes(device, surface) {
        Ok(mut found) => {
            found.retain(|mode| PRESENT_MODES.contains(mode));
            list(&found, count, modes)
        }
        Err(problem) => problem,
    }
}
