//! Swapchains: counted, and out of date, suboptimal or lost when the window or the scenario says so.

use std::sync::atomic::{AtomicU64, Ordering};

use ash::vk;

use super::capture::{self, Staging};
use super::{device, faults, objects};
use crate::{report, window};

/// A swapchain of the app.
pub struct Swapchain {
    /// Its device.
    pub device: vk::Device,
    /// What it presents to.
    pub surface: vk::SurfaceKHR,
    /// In pixels.
    pub extent: vk::Extent2D,
    /// Its pictures.
    pub images: Vec<vk::Image>,
    is_outdated: bool,
    staging: Staging,
}

static CREATED: AtomicU64 = AtomicU64::new(0);

/// How many swapchains the app ever made.
pub fn created() -> u64 {
    CREATED.load(Ordering::SeqCst)
}

pub unsafe extern "system" fn create(
    device: vk::Device,
    info: *const vk::SwapchainCreateInfoKHR<'_>,
    _allocator: *const vk::AllocationCallbacks<'_>,
    swapchain: *mut vk::SwapchainKHR,
) -> vk::Result {
    let mut objects = objects();
    let Some(surface) = objects.surfaces.get(&(*info).surface) else {
        return vk::Result::ERROR_SURFACE_LOST_KHR;
    };
    if surface.is_lost {
        return vk::Result::ERROR_SURFACE_LOST_KHR;
    }
    if surface.swapchain != vk::SwapchainKHR::null() && surface.swapchain != (*info).old_swapchain {
        return vk::Result::ERROR_NATIVE_WINDOW_IN_USE_KHR;
    }
    let Some(of) = objects.devices.get(&device) else { return vk::Result::ERROR_DEVICE_LOST };
    let mut info = *info;
    // What headless surfaces have, and what reading back needs.
    info.composite_alpha = vk::CompositeAlphaFlagsKHR::OPAQUE;
    info.image_usage |= vk::ImageUsageFlags::TRANSFER_SRC;
    let made = of.swapchain.create_swapchain(&info, None).and_then(|made| {
        let images = of.swapchain.get_swapchain_images(made)?;
        Ok((made, images, Staging::new(of, info.image_extent)?))
    });
    match made {
        Ok((made, images, staging)) => {
            CREATED.fetch_add(1, Ordering::SeqCst);
            *swapchain = made;
            if let Some(surface) = objects.surfaces.get_mut(&info.surface) {
                surface.swapchain = made;
            }
            let (surface, extent) = (info.surface, info.image_extent);
            let made_ = Swapchain { device, surface, extent, images, is_outdated: false, staging };
            objects.swapchains.insert(made, made_);
            vk::Result::SUCCESS
        }
        Err(problem) => problem,
    }
}

pub unsafe extern "system" fn destroy(
    device: vk::Device,
    swapchain: vk::SwapchainKHR,
    _allocator: *const vk::AllocationCallbacks<'_>,
) {
    let mut objects = objects();
    let Some(gone) = objects.swapchains.remove(&swapchain) else { return };
    if let Some(surface) = objects.surfaces.get_mut(&gone.surface).filter(|of| of.swapchain == swapchain) {
        surface.swapchain = vk::SwapchainKHR::null();
    }
    if let Some(of) = objects.devices.get(&device) {
        gone.staging.destroy(&of.functions);
        of.swapchain.destroy_swapchain(swapchain, None);
    }
}

/// What is wrong with presenting to this swapchain now, by the window, the device, and the faults.
fn state(swapchain: vk::SwapchainKHR) -> vk::Result {
    let mut objects = objects();
    let objects = &mut *objects;
    let Some(of) = objects.swapchains.get_mut(&swapchain) else { return vk::Result::ERROR_SURFACE_LOST_KHR };
    if objects.devices.get(&of.device).is_none_or(|device| device.is_lost) {
        return vk::Result::ERROR_DEVICE_LOST;
    }
    let Some(surface) = objects.surfaces.get_mut(&of.surface) else {
        return vk::Result::ERROR_SURFACE_LOST_KHR;
    };
    surface.is_lost |= faults::take(|faults| &mut faults.lost_surfaces);
    if surface.is_lost {
        return vk::Result::ERROR_SURFACE_LOST_KHR;
    }
    of.is_outdated |= faults::take(|faults| &mut faults.outdated);
    if of.is_outdated {
        return vk::Result::ERROR_OUT_OF_DATE_KHR;
    }
    let fits = window::size(surface.window) == Some([of.extent.width, of.extent.height]);
    match fits && !faults::with(|faults| faults.suboptimal) {
        true => vk::Result::SUCCESS,
        false => vk::Result::SUBOPTIMAL_KHR,
    }
}

/// The driver's answer, unless it is good and the state is worse.
fn worse(result: vk::Result, state: vk::Result) -> vk::Result {
    if result == vk::Result::SUCCESS { state } else { result }
}

pub unsafe extern "system" fn acquire(
    device: vk::Device,
    swapchain: vk::SwapchainKHR,
    timeout: u64,
    semaphore: vk::Semaphore,
    fence: vk::Fence,
    image: *mut u32,
) -> vk::Result {
    let state = state(swapchain);
    if state.as_raw() < 0 {
        return state;
    }
    let functions = objects().devices.get(&device).map(|of| of.swapchain.clone());
    let Some(functions) = functions else { return vk::Result::ERROR_DEVICE_LOST };
    worse((functions.fp().acquire_next_image_khr)(device, swapchain, timeout, semaphore, fence, image), state)
}

/// Reads the picture back, then presents it.
pub unsafe extern "system" fn present(queue: vk::Queue, info: *const vk::PresentInfoKHR<'_>) -> vk::Result {
    let Some((device, functions, is_lost)) = device::of_queue(queue) else {
        return vk::Result::ERROR_DEVICE_LOST;
    };
    if is_lost {
        return vk::Result::ERROR_DEVICE_LOST;
    }
    let mut info = *info;
    let (swapchain, image) = (*info.p_swapchains, *info.p_image_indices);
    let waits = std::slice::from_raw_parts(info.p_wait_semaphores, info.wait_semaphore_count as usize);
    let objects = objects();
    let Some(of) = objects.swapchains.get(&swapchain) else { return vk::Result::ERROR_SURFACE_LOST_KHR };
    let window = objects.surfaces.get(&of.surface).map(|surface| surface.window);
    if window.is_none_or(window::is_taken_back) {
        report::complain("a picture was presented to a window that was taken back".to_owned());
    }
    let Some(present) = objects.devices.get(&device).map(|of| of.swapchain.clone()) else {
        return vk::Result::ERROR_DEVICE_LOST;
    };
    match of.staging.read(&functions, queue, waits, of.images[image as usize], of.extent) {
        Ok(picture) => capture::keep(picture),
        Err(problem) => return problem,
    }
    drop(objects);
    // The reading has waited for them.
    info.wait_semaphore_count = 0;
    worse((present.fp().queue_present_khr)(queue, &raw const info), state(swapchain))
}
