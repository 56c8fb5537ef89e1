//! Instances and physical devices.

use std::ffi::{CStr, c_char};

use ash::vk;

use super::{faults, loader, objects, real};

const ANDROID: &CStr = c"VK_KHR_android_surface";
const HEADLESS: &CStr = c"VK_EXT_headless_surface";

/// The list of the loader, with Android's surfaces in the place of headless ones.
pub unsafe extern "system" fn enumerate_extensions(
    layer: *const c_char,
    count: *mut u32,
    properties: *mut vk::ExtensionProperties,
) -> vk::Result {
    type Enumerate = vk::PFN_vkEnumerateInstanceExtensionProperties;
    let Some(enumerate) = real::<Enumerate>(vk::Instance::null(), c"vkEnumerateInstanceExtensionProperties")
    else {
        return vk::Result::ERROR_INITIALIZATION_FAILED;
    };
    let result = enumerate(layer, count, properties);
    if !properties.is_null() {
        for extension in std::slice::from_raw_parts_mut(properties, *count as usize) {
            if CStr::from_ptr(extension.extension_name.as_ptr()) == HEADLESS {
                for (to, from) in extension.extension_name.iter_mut().zip(ANDROID.to_bytes_with_nul()) {
                    *to = *from as c_char;
                }
            }
        }
    }
    result
}

pub unsafe extern "system" fn create(
    info: *const vk::InstanceCreateInfo<'_>,
    allocator: *const vk::AllocationCallbacks<'_>,
    instance: *mut vk::Instance,
) -> vk::Result {
    let mut info = *info;
    let names =
        std::slice::from_raw_parts(info.pp_enabled_extension_names, info.enabled_extension_count as usize);
    let names: Vec<*const c_char> = names
        .iter()
        .map(|name| if CStr::from_ptr(*name) == ANDROID { HEADLESS.as_ptr() } else { *name })
        .collect();
    info.pp_enabled_extension_names = names.as_ptr();
    let Some(create) = real::<vk::PFN_vkCreateInstance>(vk::Instance::null(), c"vkCreateInstance") else {
        return vk::Result::ERROR_INITIALIZATION_FAILED;
    };
    let result = create(&raw const info, allocator, instance);
    if result == vk::Result::SUCCESS {
        let entry = ash::StaticFn { get_instance_proc_addr: loader() };
        objects().instance = Some(ash::Instance::load(&entry, *instance));
    }
    result
}

/// The functions of the last instance; they serve objects of any.
pub fn functions() -> Option<ash::Instance> {
    objects().instance.clone()
}

pub unsafe extern "system" fn enumerate_devices(
    instance: vk::Instance,
    count: *mut u32,
    devices: *mut vk::PhysicalDevice,
) -> vk::Result {
    if faults::with(|faults| faults.no_device) {
        *count = 0;
        return vk::Result::SUCCESS;
    }
    match functions() {
        Some(functions) => (functions.fp_v1_0().enumerate_physical_devices)(instance, count, devices),
        None => vk::Result::ERROR_INITIALIZATION_FAILED,
    }
}

pub unsafe extern "system" fn properties(
    device: vk::PhysicalDevice,
    properties: *mut vk::PhysicalDeviceProperties,
) {
    if let Some(functions) = functions() {
        (functions.fp_v1_0().get_physical_device_properties)(device, properties);
        faults::lower(&mut (*properties).limits);
    }
}

pub unsafe extern "system" fn properties2(
    device: vk::PhysicalDevice,
    properties: *mut vk::PhysicalDeviceProperties2<'_>,
) {
    if let Some(functions) = functions() {
        (functions.fp_v1_1().get_physical_device_properties2)(device, properties);
        faults::lower(&mut (*properties).properties.limits);
    }
}
