//! Tests of device failures that need internals of this crate, on the noop backend.

use std::sync::{
    Arc,
    atomic::{AtomicU32, Ordering},
};

use super::{
    Gpu, Kernel, Kernels,
    shader::{ShaderError, Source},
};
use crate::{Error, Result};

fn instance() -> wgpu::Instance {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::NOOP;
    // Validation of indirect dispatches would lower the limits set below.
    descriptor.flags = wgpu::InstanceFlags::empty();
    descriptor.backend_options.noop = wgpu::NoopBackendOptions {
        limits: Some(wgpu::Limits {
            max_buffer_size: u64::MAX,
            max_storage_buffer_binding_size: u64::MAX,
            ..wgpu::Limits::default()
        }),
        features: Some(wgpu::Features::empty()),
        ..wgpu::NoopBackendOptions::enabled()
    };
    wgpu::Instance::new(descriptor)
}

fn device() -> Gpu {
    Gpu::from_instance(&instance(), None).expect("the noop adapter")
}

/// A device created by a caller with these limits.
fn foreign(limits: wgpu::Limits) -> (wgpu::Adapter, wgpu::Device, wgpu::Queue) {
    let adapters = pollster::block_on(instance().enumerate_adapters(wgpu::Backends::NOOP));
    let adapter = adapters.into_iter().next().expect("the noop adapter");
    let descriptor = wgpu::DeviceDescriptor { required_limits: limits, ..Gpu::requirements(&adapter) };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).expect("a device");
    (adapter, device, queue)
}

#[test]
fn a_callers_device_keeps_its_handler_and_tells_of_its_loss() {
    let (adapter, device, queue) = foreign(wgpu::Limits::default());
    let uncaught = Arc::new(AtomicU32::new(0));
    let count = uncaught.clone();
    device.on_uncaptured_error(Arc::new(move |_| {
        count.fetch_add(1, Ordering::Relaxed);
    }));
    let gpu = Gpu::from_device(&adapter, &device, &queue).expect("WebGPU's defaults suffice");
    device.set_device_lost_callback(gpu.on_lost());

    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 16,
        usage: wgpu::BufferUsages::STORAGE,
        mapped_at_creation: false,
    });
    let invalid = || {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        // The buffer lacks the usage that clearing needs.
        encoder.clear_buffer(&buffer, 0, None);
        encoder
    };
    let error = gpu.submit_and_wait(invalid()).expect_err("invalid commands");
    assert!(matches!(error, Error::Device(_)), "{error}");
    assert_eq!(uncaught.load(Ordering::Relaxed), 0, "an error of this crate's calls came to the caller");
    drop(invalid().finish());
    assert_eq!(uncaught.load(Ordering::Relaxed), 1, "an error of the caller's did not come to it");

    gpu.submit_all_and_wait([commands(&gpu)]).expect("the device is still usable");
    device.destroy();
    // Polling the device runs the callbacks.
    let _ = device.poll(wgpu::PollType::Poll);
    let result = gpu.submit_all_and_wait([commands(&gpu)]);
    assert!(matches!(result, Err(Error::Lost { .. })), "{result:?}");
}

#[test]
fn a_callers_device_that_lacks_something_is_refused_with_all_of_it() {
    let limits = wgpu::Limits {
        max_storage_buffers_per_shader_stage: 4,
        max_compute_invocations_per_workgroup: 128,
        ..wgpu::Limits::default()
    };
    let (adapter, device, queue) = foreign(limits);
    let error = Gpu::from_device(&adapter, &device, &queue).map(drop).expect_err("it lacks two limits");
    let Error::Missing { need, have, .. } = &error else { panic!("{error}") };
    assert!(need.contains("max_storage_buffers_per_shader_stage 8"), "{need}");
    assert!(need.contains("max_compute_invocations_per_workgroup 256"), "{need}");
    assert!(have.contains('4') && have.contains("128"), "{have}");
}

fn commands(gpu: &Gpu) -> wgpu::CommandBuffer {
    gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default()).finish()
}

#[test]
fn nothing_is_submitted_after_a_loss_between_submissions() {
    let gpu = device();
    gpu.submit_all_and_wait((0..3).map(|_| commands(&gpu))).expect("a healthy device");
    let mut recorded = 0;
    let result = gpu.submit_all_and_wait((0..3).map(|i| {
        recorded = i;
        if i == 1 {
            gpu.destroy();
        }
        commands(&gpu)
    }));
    assert!(matches!(&result, Err(Error::Lost { reason, .. }) if reason == "it was destroyed"), "{result:?}");
    assert_eq!(recorded, 1);
}

#[test]
fn loss_before_a_readback_is_an_error() {
    let gpu = device();
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    let buffer = gpu.buffer("data", 16, usage).expect("a buffer");
    assert_eq!(gpu.read_buffer(&buffer).expect("a healthy device"), [0; 16]);
    gpu.destroy();
    let lost =
        |result: Result<()>, what| assert!(matches!(result, Err(Error::Lost { .. })), "{what}: {result:?}");
    lost(gpu.read_buffer(&buffer).map(drop), "readback");
    lost(gpu.buffer("more", 16, usage).map(drop), "buffer");
    lost(gpu.filled("more", &[1; 16], usage).map(drop), "buffer with content");
    lost(
        Kernel::new(&gpu, "empty", &[source("@compute @workgroup_size(1) fn main() {}")]).map(drop),
        "kernel",
    );
}

#[test]
fn a_buffer_without_memory_is_named_with_its_size() {
    let gpu = device();
    // Larger than any machine's address space.
    let size = 1 << 60;
    let result = gpu.checked("buffer `attributes`", Some(size), |device| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        })
    });
    let error = result.expect_err("no machine has that");
    let Error::OutOfMemory { what, bytes: Some(found), .. } = &error else { panic!("{error}") };
    assert_eq!((what.as_str(), *found), ("buffer `attributes`", size));
    assert!(error.to_string().ends_with(&format!("buffer `attributes` ({size} bytes)")), "{error}");
    gpu.buffer("small", 16, wgpu::BufferUsages::STORAGE).expect("the device is still usable");
}

#[test]
fn corners_beyond_a_device_are_an_error_by_image_and_by_buffer() {
    // The noop device counts as a CPU.
    let (images, buffers) = (device(), device().as_hardware());
    // 8,192 rows of 4,096 texels.
    let most = 8192 * 4096 / 3;
    images.check_corners("primitives", most).expect("it fits");
    let error = images.check_corners("primitives", most + 1).expect_err("a corner too many").to_string();
    assert!(error.contains("image `primitives` needs") && error.contains("in one image"), "{error}");
    buffers.check_corners("primitives", most + 1).expect("buffers have no limit here");
    for count in [1, 1365, 1366, 3000] {
        for gpu in [&buffers, &images] {
            gpu.corners("primitives", &vec![[[1.0; 3]; 3]; count]).expect("it fits");
        }
    }
}

fn source(text: &'static str) -> Source {
    Source { file: "test.wgsl", text: text.into() }
}

/// A language extension that naga accepts but that was not requested of the device.
#[test]
fn a_kernel_that_the_device_refuses_is_named() {
    let gpu = device();
    let text = "@compute @workgroup_size(1) fn main() { var x = 1.0lf; x += 1.0lf; }";
    let error = Kernel::new(&gpu, "broken", &[source(text)]).map(drop).expect_err("no f64 on this device");
    let Error::Shader(ShaderError::Refused { kernel, message, .. }) = &error else { panic!("{error}") };
    assert_eq!(kernel, "broken");
    assert!(message.contains("FLOAT64"), "{message}");
}

#[test]
fn a_kernel_larger_than_the_device_is_named() {
    let gpu = device();
    let text = "@compute @workgroup_size(1024) fn main() {}";
    let error =
        Kernel::new(&gpu, "wide", &[source(text)]).map(drop).expect_err("256 invocations are the most");
    assert!(
        matches!(&error, Error::Shader(ShaderError::Refused { kernel, .. }) if kernel == "wide"),
        "{error}"
    );
}

#[test]
fn renderers_of_a_device_share_kernels_until_it_is_short_of_memory() {
    let gpu = device();
    let kernel = |gpu: &Gpu, text: &'static str| {
        Kernels::default().get(gpu, "a kernel", vec![source(text)]).expect("compiles")
    };
    let [empty, other] = ["fn main() {}", "fn main() { workgroupBarrier(); }"]
        .map(|text| -> &'static str { format!("@compute @workgroup_size(1) {text}").leak() });
    let (first, second) = (kernel(&gpu, empty), kernel(&gpu.clone(), empty));
    assert!(Arc::ptr_eq(&first, &second), "compiled once");
    assert!(!Arc::ptr_eq(&first, &kernel(&gpu, other)));
    assert!(!Arc::ptr_eq(&first, &kernel(&device(), empty)), "another device's");

    let unused = Arc::downgrade(&kernel(&gpu, other));
    gpu.trim();
    assert!(unused.upgrade().is_none(), "no renderer uses it");
    assert!(Arc::ptr_eq(&first, &kernel(&gpu, empty)), "a renderer uses it");
}

#[test]
fn a_device_keeps_the_kernels_that_were_asked_for_last() {
    let gpu = device();
    let kernel = |number: usize| {
        let text = format!("@compute @workgroup_size(1) fn main() {{ var x = {number}; x += 1; }}");
        let source = Source { file: "test.wgsl", text: text.into() };
        Arc::downgrade(&Kernels::default().get(&gpu, "a kernel", vec![source]).expect("compiles"))
    };
    let (first, second) = (kernel(0), kernel(1));
    for number in 2..=super::kernel::KEPT {
        kernel(0);
        kernel(number);
    }
    assert!(first.upgrade().is_some());
    assert!(second.upgrade().is_none(), "one too many");
}
