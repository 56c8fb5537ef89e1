//! The core embedded in another program, with its device, texture and submissions; and the examples of
//! embedding.

use std::{env, fs, path::Path, process::Command};

use glimpse::{
    Camera, DisplayImage, Gpu, GpuScene, Method, Picture, Renderer, Settings,
    scene::builtin,
    wgpu::{self, TextureUsages},
};
use glimpse_tests::{TestScene, gpu};

const SIZE: [u32; 2] = [96, 64];

/// A program's own device, and a renderer on it.
fn embedded(method: Method) -> (wgpu::Device, wgpu::Queue, Renderer, Camera) {
    let adapter = gpu().adapter();
    let (device, queue) =
        pollster::block_on(adapter.request_device(&Gpu::requirements(adapter))).expect("a device");
    let gpu = Gpu::from_device(adapter, &device, &queue).expect("what was asked for suffices");
    let scene = builtin("cornell").expect("a built-in scene");
    let camera = *scene.camera(None).expect("it has a camera");
    let scene = GpuScene::upload(&gpu, scene).expect("it fits");
    let renderer = Renderer::new(&gpu, &scene, SIZE, &settings(method)).expect("it compiles");
    (device, queue, renderer, camera)
}

fn settings(method: Method) -> Settings {
    Settings { method, ..Settings::default() }
}

/// Picture of a renderer with its own device after as many frames.
fn rendered(method: Method, size: [u32; 2], frames: u32) -> DisplayImage {
    let test_scene = TestScene::builtin("cornell");
    let mut renderer = Renderer::new(gpu(), &test_scene.scene, size, &settings(method)).expect("it compiles");
    for _ in 0..frames {
        renderer.render(&test_scene.camera).expect("a frame");
    }
    renderer.display_image().expect("a picture")
}

#[test]
fn frames_that_the_caller_submits_are_those_that_render_makes() {
    for method in [Method::Adaptive, Method::Path] {
        let (_, queue, mut renderer, camera) = embedded(method);
        // Both are recorded before the first is submitted: each has its own constants.
        let first: Vec<_> = renderer.frame(&camera).expect("a frame").collect();
        let second: Vec<_> = renderer.frame(&camera).expect("a frame").collect();
        for commands in first.into_iter().chain(second) {
            queue.submit([commands]);
        }
        let found = renderer.display_image().expect("a picture");
        assert!(found == rendered(method, SIZE, 2), "{method:?}");
    }
}

#[test]
fn a_frame_of_paths_that_is_dropped_half_way_leaves_no_trace() {
    let test_scene = TestScene::builtin("cornell");
    let size = [1024, 768];
    let mut renderer =
        Renderer::new(gpu(), &test_scene.scene, size, &settings(Method::Path)).expect("it compiles");
    renderer.render(&test_scene.camera).expect("a frame");
    let mut frame = renderer.frame(&test_scene.camera).expect("a frame");
    assert!(frame.len() > 1, "a frame of one submission cannot be given up");
    gpu().queue().submit(frame.next());
    drop(frame);
    renderer.render(&test_scene.camera).expect("a frame");
    assert_eq!(renderer.samples(), 1);
    assert!(renderer.display_image().expect("a picture") == rendered(Method::Path, size, 1));
}

fn target(device: &wgpu::Device, change: impl FnOnce(&mut wgpu::TextureDescriptor<'_>)) -> wgpu::Texture {
    let mut descriptor = wgpu::TextureDescriptor {
        label: Some("target"),
        size: wgpu::Extent3d { width: SIZE[0], height: SIZE[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: TextureUsages::STORAGE_BINDING | TextureUsages::COPY_SRC,
        view_formats: &[],
    };
    change(&mut descriptor);
    device.create_texture(&descriptor)
}

#[test]
fn a_frame_goes_into_the_callers_texture_until_its_size_changes() {
    let (device, _, mut renderer, camera) = embedded(Method::Full);
    let own = renderer.display().clone();
    let texture = target(&device, |_| ());
    renderer.set_target(&texture).expect("it is as it must be");
    renderer.render(&camera).expect("a frame");
    assert!(renderer.display_image().expect("a picture") == rendered(Method::Full, SIZE, 1));
    assert!(renderer.display() == &texture && renderer.display() != &own);

    renderer.change(SIZE, &settings(Method::Adaptive)).expect("it compiles");
    assert!(renderer.display() == &texture, "other settings go on with it");
    renderer.render(&camera).expect("a frame");
    assert!(renderer.display_image().expect("a picture") == rendered(Method::Adaptive, SIZE, 1));

    renderer.change([48, 32], &settings(Method::Adaptive)).expect("it fits");
    assert!(renderer.display() != &texture, "it is too large");
    renderer.render(&camera).expect("a frame");
}

#[test]
fn a_texture_that_cannot_be_a_target_is_refused_with_what_is_wrong() {
    let (device, _, mut renderer, camera) = embedded(Method::Full);
    let wrong = [
        (target(&device, |t| t.size.width += 1), ["96x64x1", "97x64x1"]),
        (target(&device, |t| t.size.depth_or_array_layers = 2), ["96x64x1", "96x64x2"]),
        (target(&device, |t| t.format = wgpu::TextureFormat::Rgba16Float), ["Rgba8Unorm", "Rgba16Float"]),
        (target(&device, |t| t.mip_level_count = 2), ["one mip level", "found 2"]),
        (target(&device, |t| t.usage = TextureUsages::COPY_SRC), ["STORAGE_BINDING", "COPY_SRC"]),
    ];
    for (texture, named) in &wrong {
        let error = renderer.set_target(texture).expect_err("it cannot be one").to_string();
        assert!(named.iter().all(|part| error.contains(part)), "{error}");
    }
    renderer.render(&camera).expect("frames go where they went before");
    let unreadable = target(&device, |t| t.usage = TextureUsages::STORAGE_BINDING);
    renderer.set_target(&unreadable).expect("it need not be read back");
    renderer.render(&camera).expect("a frame");
    let error = renderer.display_image().expect_err("it cannot be read back").to_string();
    assert!(error.contains("expected COPY_SRC"), "{error}");
}

/// Runs an example of the core, built beside this test, and reads its picture.
fn example(name: &str, arguments: &[&str]) -> DisplayImage {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out.png");
    let test = env::current_exe().expect("this test");
    let target = test.parent().and_then(Path::parent).expect("it is built in a folder of the target folder");
    let program = target.join("examples").join(name);
    let done =
        Command::new(&program).args(arguments).arg(&out).output().unwrap_or_else(|error| {
            panic!("{}: {error}; `cargo test --workspace` builds it", program.display())
        });
    assert!(done.status.success(), "{name}: {}", String::from_utf8_lossy(&done.stderr));
    Picture::decode(&fs::read(&out).expect("it wrote a picture")).expect("it is a picture").into_display()
}

#[test]
fn the_example_of_one_frame_renders_what_render_does() {
    let frame = example("one_frame", &["builtin:cornell"]);
    assert!(frame == rendered(Method::Adaptive, [640, 360], 1));
}

#[test]
fn the_example_of_a_scene_in_code_shows_floor_and_sky() {
    let frame = example("own_scene", &[]);
    let [sky, floor] = [[320, 5], [320, 350]].map(|[x, y]| frame.get_pixel(x, y).0);
    assert!(sky[2] > sky[0] && floor[0] > floor[2], "the sky {sky:?} is blue, the floor {floor:?} is not");
}

#[test]
fn the_example_of_an_own_device_draws_over_the_frame_alone_where_it_draws() {
    let (found, expected) = (example("own_device", &[]), rendered(Method::Adaptive, [640, 360], 1));
    let drawn = found.enumerate_pixels().filter(|(x, y, pixel)| *pixel != expected.get_pixel(*x, *y));
    let mut count = 0;
    for (x, y, pixel) in drawn {
        assert_eq!(pixel.0, [255; 4], "the overlay is white at {x}, {y}");
        assert!((16..=64).contains(&x) && (18..=72).contains(&y), "the overlay is at {x}, {y}");
        count += 1;
    }
    assert!(count > 1000, "{count} pixels were drawn over");
}
