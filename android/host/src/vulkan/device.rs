//! Devices and their queues; a device can be lost.

use std::ffi::{CStr, c_char};
use std::sync::atomic::{AtomicU64, Ordering};

use ash::vk;

use super::{Void, faults, hook, instance, objects};

/// A device of the app.
pub struct Device {
    /// The driver's functions.
    pub functions: ash::Device,
    /// The driver's functions for swapchains.
    pub swapchain: ash::khr::swapchain::Device,
    /// Its memory.
    pub memory: vk::PhysicalDeviceMemoryProperties,
    /// Of the queue that the app presents with.
    pub family: u32,
    /// Every submission fails.
    pub is_lost: bool,
}

static CREATED: AtomicU64 = AtomicU64::new(0);

/// How many devices the app ever made.
pub fn created() -> u64 {
    CREATED.load(Ordering::SeqCst)
}

pub unsafe extern "system" fn get_proc_addr(device: vk::Device, name: *const c_char) -> Void {
    let functions = instance::functions()?;
    let found = (functions.fp_v1_0().get_device_proc_addr)(device, name)?;
    hook(CStr::from_ptr(name)).or(Some(found))
}

pub unsafe extern "system" fn create(
    physical: vk::PhysicalDevice,
    info: *const vk::DeviceCreateInfo<'_>,
    allocator: *const vk::AllocationCallbacks<'_>,
    device: *mut vk::Device,
) -> vk::Result {
    let Some(functions) = instance::functions() else { return vk::Result::ERROR_INITIALIZATION_FAILED };
    let result = (functions.fp_v1_0().create_device)(physical, info, allocator, device);
    if result == vk::Result::SUCCESS {
        let created = ash::Device::load(functions.fp_v1_0(), *device);
        let device_ = Device {
            swapchain: ash::khr::swapchain::Device::new(&functions, &created),
            functions: created,
            memory: functions.get_physical_device_memory_properties(physical),
            family: (*(*info).p_queue_create_infos).queue_family_index,
            is_lost: false,
        };
        CREATED.fetch_add(1, Ordering::SeqCst);
        objects().devices.insert(*device, device_);
    }
    result
}

pub unsafe extern "system" fn destroy(device: vk::Device, allocator: *const vk::AllocationCallbacks<'_>) {
    let mut objects = objects();
    objects.queues.retain(|_, of| *of != device);
    let Some(gone) = objects.devices.remove(&device) else { return };
    drop(objects);
    (gone.functions.fp_v1_0().destroy_device)(device, allocator);
}

pub unsafe extern "system" fn queue(device: vk::Device, family: u32, index: u32, queue: *mut vk::Queue) {
    let mut objects = objects();
    let Some(of) = objects.devices.get(&device) else { return };
    (of.functions.fp_v1_0().get_device_queue)(device, family, index, queue);
    objects.queues.insert(*queue, device);
}

/// The functions of the device that a queue belongs to, and whether it is lost.
pub fn of_queue(queue: vk::Queue) -> Option<(vk::Device, ash::Device, bool)> {
    let objects = objects();
    let device = *objects.queues.get(&queue)?;
    let of = objects.devices.get(&device)?;
    Some((device, of.functions.clone(), of.is_lost))
}

pub unsafe extern "system" fn submit(
    queue: vk::Queue,
    count: u32,
    submits: *const vk::SubmitInfo<'_>,
    fence: vk::Fence,
) -> vk::Result {
    let Some((device, functions, is_lost)) = of_queue(queue) else { return vk::Result::ERROR_DEVICE_LOST };
    if is_lost || faults::take(|faults| &mut faults.lost_devices) {
        if let Some(device) = objects().devices.get_mut(&device) {
            device.is_lost = true;
        }
        return vk::Result::ERROR_DEVICE_LOST;
    }
    (functions.fp_v1_0().queue_submit)(queue, count, submits, fence)
}
