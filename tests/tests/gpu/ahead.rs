//! Kernels that are compiled before the frames that need them, and what is shown meanwhile.

use std::{collections::HashSet, sync::Arc};

use glam::vec3;
use glimpse::{
    Compilation, Denoise, Gpu, GpuScene, Method, Paths, Purpose, Renderer, Settings, Show,
    scene::{EnvironmentMap, builtin},
};
use glimpse_app::{Files, Job, RenderedFrame, Worker, WorkerEvent};
use glimpse_tests::{
    TestScene,
    builder::{Builder, front_camera, matte},
    gpu,
};

const SIZE: [u32; 2] = [48, 32];

fn compile(mut kernels: Compilation) {
    while kernels.remaining() > 0 {
        kernels.compile_next().expect("the kernel compiles");
    }
}

/// Every kind of resource that kernels use has a placeholder, and the frames are those of kernels that were compiled
/// when they were first needed.
#[test]
fn compiling_ahead_changes_no_frame() {
    let gpu = Gpu::headless(None).expect("a device");
    let mut scene = builtin("room").expect("the room");
    scene.environment_map = Some(EnvironmentMap::studio());
    let camera = *scene.camera(None).expect("a camera");
    let scene = GpuScene::upload(&gpu, scene).expect("the scene fits the device");
    let paths = Paths { denoise: Denoise::Atrous, ..Paths::default() };
    for method in [Method::Adaptive, Method::Path] {
        let settings = Settings { method, paths, ..Settings::default() };
        let kernels =
            |purpose| Renderer::compilation(&gpu, &scene, SIZE, &settings, purpose).expect("valid settings");
        for purpose in [Purpose::Frame, Purpose::Counters] {
            assert!(kernels(purpose).remaining() > 0, "{method:?}, {purpose:?}");
            compile(kernels(purpose));
            assert_eq!(kernels(purpose).remaining(), 0, "{method:?}, {purpose:?}");
        }
        let mut ahead = Renderer::new(&gpu, &scene, SIZE, &settings).expect("a renderer");
        assert_eq!(kernels(Purpose::Frame).remaining(), 0, "{method:?} needs no other kernels");
        ahead.render(&camera).expect("a frame");
        let counts = ahead.inspect(&camera).expect("counters").counts;
        assert_eq!(kernels(Purpose::Counters).remaining(), 0, "{method:?} counts with no other kernels");
        let other = Gpu::headless(None).expect("a device");
        let mut room = builtin("room").expect("the room");
        room.environment_map = Some(EnvironmentMap::studio());
        let room = GpuScene::upload(&other, room).expect("the scene fits the device");
        let mut late = Renderer::new(&other, &room, SIZE, &settings).expect("a renderer");
        late.render(&camera).expect("a frame");
        let [found, expected] =
            [&ahead, &late].map(|renderer| renderer.display_image().expect("the frame can be read"));
        assert!(found == expected, "{method:?}: the frames differ");
        assert_eq!(counts, late.inspect(&camera).expect("counters").counts, "{method:?}");
    }
}

/// What a run left in the driver's cache is known by the same numbers in the next.
#[test]
fn kernels_have_the_same_fingerprints_on_another_device() {
    let fingerprints = |known: &[u64]| {
        let gpu = Gpu::headless(None).expect("a device");
        gpu.add_cached_kernels(known.iter().copied());
        let scene = GpuScene::upload(&gpu, builtin("wires").expect("the wires")).expect("the scene fits");
        let settings = Settings { method: Method::Full, ..Settings::default() };
        compile(
            Renderer::compilation(&gpu, &scene, SIZE, &settings, Purpose::Frame).expect("valid settings"),
        );
        gpu.cached_kernels()
    };
    let first = fingerprints(&[]);
    let on_cpu = gpu().facts().info.device_type == wgpu::DeviceType::Cpu;
    assert_eq!(first.len(), usize::from(on_cpu), "only software drivers need this");
    assert_eq!(fingerprints(&first), first);
}

/// A preview shows base colours, brighter where surfaces face the eye, without the scene's light.
#[test]
fn a_preview_shows_base_colours_lit_from_the_eye() {
    let mut builder = Builder::new();
    let green = builder.object(matte(vec3(0.0, 0.5, 0.0)));
    builder.sphere(green, vec3(0.0, 0.0, 0.0), 0.5);
    let test_scene = TestScene::new(builder.seen_by(front_camera()));
    let mut preview = Renderer::preview(gpu(), &test_scene.scene, SIZE).expect("a renderer");
    preview.render(&test_scene.camera).expect("a frame");
    let image = preview.display_image().expect("the frame can be read");
    let [middle, rim, beside] = [[24, 16], [24, 8], [2, 16]].map(|[x, y]| image.get_pixel(x, y).0);
    // sRGB of 0.5 where the surface faces the eye.
    assert!(middle[1].abs_diff(188) <= 2 && middle[0] == 0 && middle[2] == 0, "{middle:?}");
    assert!(rim[1] > 100 && rim[1] < middle[1], "{rim:?}");
    assert_eq!(beside, [0, 0, 0, 255]);
}

/// The next frame that the worker sends, and whether counters came.
fn next(worker: &mut Worker) -> Box<RenderedFrame> {
    loop {
        match worker.wait().expect("the worker answers") {
            WorkerEvent::Frame(frame) => return frame,
            WorkerEvent::Failed(line) | WorkerEvent::OpenFailed(line) | WorkerEvent::Lost(line) => {
                panic!("{line}")
            }
            _ => {}
        }
    }
}

/// While kernels of another method are compiled, the last method shows the new camera; then the frame asked for comes.
#[test]
fn the_last_method_stands_in_while_kernels_are_compiled() {
    let gpu = Arc::new(Gpu::headless(None).expect("a device"));
    let files: Files = Arc::new(|_| builtin("wires").map(Into::into).ok_or_else(String::new));
    let mut worker = Worker::start(gpu, files, Arc::new(|| {})).expect("a thread");
    worker.open("builtin:wires");
    while !matches!(worker.wait(), Some(WorkerEvent::Opened(_))) {}
    let camera = *builtin("wires").expect("the wires").camera(None).expect("a camera");
    let job = |method| Job {
        camera,
        size: SIZE,
        settings: Settings { method, ..Settings::default() },
        show: Show::Final,
        split: false,
        is_refined: false,
        level: None,
    };
    let first = worker.order(job(Method::Full));
    let mut frame = next(&mut worker);
    while frame.is_stand_in {
        assert!(frame.number == first && !frame.settled);
        frame = next(&mut worker);
    }
    assert!(frame.number == first && frame.settled);
    loop {
        if let Some(WorkerEvent::Counted(number, counted)) = worker.wait() {
            assert!(number == first && counted.counts.rays.primary == u64::from(SIZE[0] * SIZE[1]));
            break;
        }
    }
    let mut moved = job(Method::Adaptive);
    moved.camera.origin += vec3(0.1, 0.0, 0.0);
    let second = worker.order(moved.clone());
    let stand_in = next(&mut worker);
    assert!(stand_in.is_stand_in && stand_in.number == second && stand_in.job == moved);
    assert_eq!([stand_in.picture.width(), stand_in.picture.height()], SIZE);
    assert_eq!(names(&stand_in), HashSet::from(["full"]));
    let mut frame = next(&mut worker);
    while frame.is_stand_in {
        frame = next(&mut worker);
    }
    assert!(frame.number == second && names(&frame).contains("base"));
}

fn names(frame: &RenderedFrame) -> HashSet<&'static str> {
    frame.passes.iter().map(|pass| pass.name).collect()
}
