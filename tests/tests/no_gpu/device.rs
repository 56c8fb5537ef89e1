//! Devices that are missing or lost, without a driver.

use glimpse::{
    Error, Gpu, GpuScene, Renderer, Robustness, Settings,
    probe::{Probe, ProbeRay},
    scene::builtin,
};

use super::limits::{device, phone};

#[test]
fn no_adapter_at_all_says_what_to_do() {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::empty();
    let instance = wgpu::Instance::new(descriptor);
    for wanted in [None, Some("anything")] {
        let line = Gpu::from_instance(&instance, wanted).err().expect("there is none").to_string();
        assert!(line.contains("setup.sh"), "{line}");
    }
}

#[test]
fn an_adapter_of_another_name_lists_those_that_are_there() {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::NOOP;
    descriptor.backend_options.noop = wgpu::NoopBackendOptions::enabled();
    let error = Gpu::from_instance(&wgpu::Instance::new(descriptor), Some("nonsense")).err();
    let Some(Error::NoAdapter(text)) = &error else { panic!("{error:?}") };
    assert!(text.contains("`nonsense`") && text.contains("noop"), "{text}");
}

#[test]
fn a_lost_device_fails_every_call_and_a_new_one_works() {
    let gpu = device(phone()).unwrap();
    let load = || builtin("room").unwrap();
    let camera = *load().camera(None).unwrap();
    let scene = GpuScene::upload(&gpu, load()).unwrap();
    let new = |gpu| Renderer::new(gpu, &scene, [64, 48], &Settings::default());
    let mut renderer = new(&gpu).unwrap();
    renderer.render(&camera).unwrap();
    gpu.destroy();
    let errors = [
        ("render", renderer.render(&camera).err()),
        ("display_image", renderer.display_image().err()),
        ("linear_image", renderer.linear_image(&camera).err()),
        ("inspect", renderer.inspect(&camera).err()),
        ("new", new(&gpu).err()),
        ("upload", GpuScene::upload(&gpu, load()).err()),
        ("trace", Probe::new(&gpu, &scene, Robustness::default()).trace(&[ProbeRay::default()]).err()),
    ];
    for (call, error) in errors {
        assert!(matches!(&error, Some(Error::Lost { .. })), "{call}: {error:?}");
    }
    let gpu = device(phone()).unwrap();
    let scene = GpuScene::upload(&gpu, load()).unwrap();
    Renderer::new(&gpu, &scene, [64, 48], &Settings::default()).unwrap().render(&camera).unwrap();
}
