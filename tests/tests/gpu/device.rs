//! Device failures during rendering, and frames in several submissions.

use std::{sync::mpsc, thread, time::Duration};

use glimpse::{
    Camera, DisplayImage, Error, Gpu, GpuScene, Method, Renderer, Robustness, SAMPLES_PER_SUBMISSION,
    Settings, Tolerances,
    probe::{Probe, ProbeRay, peak_gflops},
    scene::builtin,
};
use glimpse_tests::{TestScene, assert_same};

const SIZE: [u32; 2] = [160, 120];

/// A device of the test's own, so that its failure does not affect other tests.
fn device() -> Gpu {
    Gpu::headless(None).expect("an adapter")
}

fn upload(gpu: &Gpu, name: &str) -> (GpuScene, Camera) {
    let scene = builtin(name).expect("a built-in scene");
    let camera = *scene.camera(None).expect("it has a camera");
    (GpuScene::upload(gpu, scene).expect("it fits"), camera)
}

/// The displayed picture, and the bits of the linear one.
fn picture(gpu: &Gpu, name: &str, size: [u32; 2]) -> (DisplayImage, Vec<u32>) {
    let (scene, camera) = upload(gpu, name);
    let mut renderer = Renderer::new(gpu, &scene, size, &Settings::default()).expect("it compiles");
    renderer.render(&camera).expect("it renders");
    let linear = renderer.linear_image(&camera).expect("it can be read");
    (renderer.display_image().expect("it can be read"), linear.as_raw().iter().map(|v| v.to_bits()).collect())
}

fn assert_lost<T>(result: glimpse::Result<T>, what: &str) {
    match result.map(drop) {
        Err(Error::Lost { .. }) => {}
        other => panic!("{what}: {other:?}"),
    }
}

#[test]
fn a_lost_device_fails_every_call_and_a_new_one_draws_the_same() {
    let gpu = device();
    let before = picture(&gpu, "cornell", SIZE);
    let (scene, camera) = upload(&gpu, "cornell");
    let new = || Renderer::new(&gpu, &scene, SIZE, &Settings::default());
    let mut fresh = new().unwrap();
    let mut used = new().unwrap();
    used.render(&camera).unwrap();
    used.linear_image(&camera).unwrap();
    used.inspect(&camera).unwrap();
    gpu.destroy();
    for (which, renderer) in [("fresh", &mut fresh), ("used", &mut used)] {
        assert_lost(renderer.display_image(), &format!("{which}: display_image"));
        assert_lost(renderer.render(&camera), &format!("{which}: render"));
        assert_lost(renderer.linear_image(&camera), &format!("{which}: linear_image"));
        assert_lost(renderer.inspect(&camera), &format!("{which}: inspect"));
    }
    assert_lost(new(), "new");
    assert_lost(GpuScene::upload(&gpu, builtin("room").unwrap()), "upload");
    let ray = ProbeRay { origin: [0.0; 3], t_max: 1.0, direction: [0.0, 0.0, 1.0], ..ProbeRay::default() };
    assert_lost(Probe::new(&gpu, &scene, Robustness::default()).trace(&[ray]), "trace");
    assert!(picture(&device(), "cornell", SIZE) == before, "the picture after the loss is another");
}

/// The device is lost while frames are in flight, in any phase, as the scheduler decides the moment.
#[test]
fn loss_in_the_middle_of_frames_is_an_error_in_every_thread() {
    let before = picture(&device(), "room", SIZE);
    for threads in [1, 3] {
        let gpu = device();
        let (scene, camera) = upload(&gpu, "room");
        let (started, starts) = mpsc::channel();
        thread::scope(|scope| {
            for _ in 0..threads {
                let (gpu, scene, started) = (&gpu, &scene, started.clone());
                scope.spawn(move || {
                    let mut renderer = Renderer::new(gpu, scene, [768, 512], &Settings::default()).unwrap();
                    renderer.render(&camera).unwrap();
                    started.send(()).unwrap();
                    let error = loop {
                        let frame = renderer.render(&camera).and_then(|_| renderer.display_image());
                        if let Err(error) = frame {
                            break error;
                        }
                    };
                    assert_lost::<()>(Err(error), "frame");
                });
            }
            for _ in 0..threads {
                starts.recv().unwrap();
            }
            gpu.destroy();
        });
    }
    assert!(picture(&device(), "room", SIZE) == before, "the picture after the loss is another");
}

#[test]
fn threads_that_share_a_device_draw_the_same() {
    let gpu = device();
    let names = ["room", "cornell"];
    let alone = names.map(|name| picture(&gpu, name, SIZE));
    thread::scope(|scope| {
        for (name, alone) in names.iter().zip(&alone).cycle().take(4) {
            let gpu = &gpu;
            scope.spawn(move || {
                for _ in 0..2 {
                    assert!(
                        picture(gpu, name, SIZE) == *alone,
                        "{name}: the picture depends on other threads"
                    );
                }
            });
        }
    });
}

#[test]
fn a_device_that_is_not_done_in_time_is_an_error() {
    let gpu = device().with_timeout(Duration::ZERO);
    let (scene, camera) = upload(&gpu, "room");
    let settings = Settings { method: Method::Full, ..Settings::default() };
    let mut renderer = Renderer::new(&gpu, &scene, [1024, 1024], &settings).unwrap();
    let error = renderer.render(&camera).expect_err("a million samples take more than no time");
    assert!(matches!(error, Error::Timeout { waited: Duration::ZERO, .. }), "{error}");
    assert!(error.to_string().contains("after 0 s"), "{error}");
}

/// Bands of rows (full, base) and chunks of lists (the other passes), at a size with several of each.
#[test]
fn frames_in_several_submissions_are_whole() {
    let size = [1051, 1003];
    assert!(size[0] / 2 * size[1] > SAMPLES_PER_SUBMISSION, "too small for several chunks");
    let full = Settings { method: Method::Full, ..Settings::default() };
    let strict =
        Settings { tolerances: Tolerances { pos: 0.0, ..Tolerances::default() }, ..Settings::default() };
    let cornell = TestScene::builtin("cornell");
    assert!(cornell.frame(size, &strict) == cornell.frame(size, &full), "bands and chunks differ");
    let counts = cornell.inspect(size, &strict).counts;
    assert_eq!(counts.rays.primary, u64::from(size[0] * size[1]), "each pixel once");
}

/// The time of a pass spans its submissions: the passes of a frame add up to its time, except for the gaps
/// between them.
#[test]
fn times_of_passes_in_several_submissions_are_in_order() {
    let test_scene = TestScene::builtin("cornell");
    let gpu = glimpse_tests::gpu();
    let mut renderer = Renderer::new(gpu, &test_scene.scene, [1051, 1003], &Settings::default()).unwrap();
    renderer.render(&test_scene.camera).unwrap();
    let time = renderer.render(&test_scene.camera).unwrap();
    if gpu.facts().timestamps {
        let names: Vec<_> = time.passes.iter().map(|pass| pass.name).collect();
        assert_eq!(names.len(), 7, "{names:?}");
        let sum: f64 = time.passes.iter().map(|pass| pass.ms).sum();
        assert!(time.passes.iter().all(|pass| pass.ms > 0.0) && sum <= time.ms, "{time:?}");
    }
}

/// Every current device is within these limits.
#[test]
fn the_peak_of_a_device_is_a_rate_of_its_size() {
    let peak = peak_gflops(&device()).expect("it runs").expect("it is timed");
    assert!((0.1..1e6).contains(&peak), "{peak} billion operations a second");
}

#[test]
fn kernels_of_gpus_and_of_cpus_make_the_same_picture() {
    let size = [64, 48];
    let [own, hardware] = [device(), device().as_hardware()].map(|gpu| {
        let (scene, camera) = upload(&gpu, "room");
        [Method::Full, Method::Adaptive, Method::Path].map(|method| {
            let settings = Settings { method, ..Settings::default() };
            let mut renderer = Renderer::new(&gpu, &scene, size, &settings).expect("it compiles");
            renderer.linear_image(&camera).expect("it can be read")
        })
    });
    for (own, hardware) in own.iter().zip(&hardware) {
        assert_same(own, hardware, "kernels of GPUs");
    }
}
