//! Creates all pipelines and records whole frames on a device with the limits of a phone and without a
//! driver.

use std::thread;

use glimpse::{
    Camera, Denoise, Error, Gpu, GpuScene, Method, Renderer, Settings, Specialize, scene::builtin,
};
use glimpse_app::Phone;

/// A device without a driver that enforces the limits.
pub fn device(limits: wgpu::Limits) -> glimpse::Result<Gpu> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::NOOP;
    descriptor.backend_options.noop = wgpu::NoopBackendOptions {
        limits: Some(limits),
        features: Some(wgpu::Features::empty()),
        ..wgpu::NoopBackendOptions::enabled()
    };
    Gpu::from_instance(&wgpu::Instance::new(descriptor), None)
}

/// Default limits of WebGPU: 8 storage buffers per stage, 16 KiB and 256 invocations per workgroup, 128 MiB
/// per binding.
pub fn phone() -> wgpu::Limits {
    let limits = wgpu::Limits::default();
    assert_eq!(limits.max_storage_buffers_per_shader_stage, 8);
    assert_eq!(limits.max_compute_workgroup_storage_size, 16 << 10);
    assert_eq!(limits.max_compute_invocations_per_workgroup, 256);
    assert_eq!(limits.max_storage_buffer_binding_size, 128 << 20);
    limits
}

#[test]
fn the_least_phone_takes_every_pass_at_qhd() {
    takes_every_pass(&device(phone()).unwrap(), &["room", "cornell", "minray"]).unwrap();
}

#[test]
fn every_phone_takes_every_pass_at_qhd() {
    let phones = Phone::all().unwrap();
    assert!(phones.len() >= 9, "{} phones", phones.len());
    // Phones with the same limits are tested once.
    let mut devices: Vec<(wgpu::Limits, String)> = Vec::new();
    for phone in phones {
        match devices.iter_mut().find(|(limits, _)| *limits == phone.limits()) {
            Some((_, names)) => *names = format!("{names}, {}", phone.name),
            None => devices.push((phone.limits(), phone.name)),
        }
    }
    // Two devices at a time, as the buffers of one take a gigabyte.
    let (first, second) = devices.split_at(devices.len() / 2);
    thread::scope(|scope| {
        for devices in [first, second] {
            scope.spawn(move || {
                for (limits, names) in devices {
                    let gpu = device(limits.clone()).unwrap_or_else(|error| panic!("{names}: {error}"));
                    takes_every_pass(&gpu, &["room"]).unwrap_or_else(|error| panic!("{names}: {error}"));
                }
            });
        }
    });
}

fn takes_every_pass(gpu: &Gpu, scenes: &[&str]) -> Result<(), String> {
    scenes.iter().try_for_each(|name| every_pass(gpu, name).map_err(|error| format!("{name}: {error}")))
}

fn uploaded(gpu: &Gpu, name: &str) -> glimpse::Result<(GpuScene, Camera)> {
    let scene = builtin(name).expect("a built-in scene");
    let camera = *scene.camera(None)?;
    Ok((GpuScene::upload(gpu, scene)?, camera))
}

fn every_pass(gpu: &Gpu, name: &str) -> glimpse::Result<()> {
    let (scene, camera) = uploaded(gpu, name)?;
    for method in Method::ALL {
        for features in [Specialize::Auto, Specialize::All] {
            let settings = Settings { method, specialize: features, ..Settings::default() };
            let mut renderer = Renderer::new(gpu, &scene, [2560, 1440], &settings)?;
            renderer.render(&camera)?;
            renderer.inspect(&camera)?;
            renderer.linear_image(&camera)?;
        }
    }
    Ok(())
}

#[test]
fn the_least_phone_takes_the_passes_that_treat_noise() {
    let gpu = device(phone()).unwrap();
    let (scene, camera) = uploaded(&gpu, "room").unwrap();
    for denoise in Denoise::ALL {
        let mut settings = Settings { method: Method::Path, ..Settings::default() };
        settings.paths.denoise = denoise;
        let mut renderer = Renderer::new(&gpu, &scene, [2560, 1440], &settings).unwrap();
        renderer.render(&camera).unwrap();
        renderer.inspect(&camera).unwrap();
        renderer.linear_image(&camera).unwrap();
        // 16 bytes per pixel exceed the size of a binding.
        let error = renderer.change([4096, 2160], &settings).err();
        match (denoise, error) {
            (Denoise::Off, None) => {}
            (_, Some(Error::Missing { what, .. })) => assert!(what.contains("gbuffer"), "{what}"),
            (denoise, error) => panic!("{denoise:?}: {error:?}"),
        }
    }
}

#[test]
fn frames_are_counted_whose_records_one_binding_cannot_hold() {
    let gpu = device(phone()).unwrap();
    let (scene, camera) = uploaded(&gpu, "room").unwrap();
    let settings = Settings { method: Method::Full, ..Settings::default() };
    for (size, recorded) in [([2560, 1440], true), ([4096, 2160], false)] {
        let mut renderer = Renderer::new(&gpu, &scene, size, &settings).unwrap();
        renderer.render(&camera).unwrap();
        assert_eq!(!renderer.inspect(&camera).unwrap().pixels.is_empty(), recorded, "{size:?}");
    }
}

#[test]
fn too_few_storage_buffers_are_named() {
    let error = device(wgpu::Limits { max_storage_buffers_per_shader_stage: 4, ..phone() }).err();
    let Some(Error::Missing { need, have, .. }) = &error else { panic!("{error:?}") };
    assert_eq!((need.as_str(), have.as_str()), ("max_storage_buffers_per_shader_stage 8", "4"));
}

/// 67 million samples, in bands whose buffers fit the bindings of a phone.
#[test]
fn the_largest_frame_is_made_in_bands() {
    let gpu = device(phone()).unwrap();
    let scene = builtin("room").unwrap();
    let scene = GpuScene::upload(&gpu, scene).unwrap();
    let largest = Renderer::new(&gpu, &scene, [8192, 8192], &Settings::default()).unwrap();
    let samples = 8192_u64 * 8192;
    assert!(largest.memory().targets < 8 * samples, "{:?}", largest.memory());
    let settings = Settings { sampling: 16, ..Settings::default() };
    for (size, settings) in [
        ([0, 10], &Settings::default()),
        ([10, 0], &Settings::default()),
        ([8193, 10], &Settings::default()),
        ([4097, 1], &settings),
    ] {
        let error = Renderer::new(&gpu, &scene, size, settings).err();
        assert!(matches!(error, Some(Error::Setting { .. })), "{size:?}: {error:?}");
    }
}
