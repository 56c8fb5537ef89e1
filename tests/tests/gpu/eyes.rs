//! Two eyes against the reference, and what is asked of them that is not usual.

use glam::{DVec3, Vec3};
use glimpse::{
    Crossing, Linking, Method, Renderer, Settings,
    reference::{Frame, Reference, Rounding},
    scene::builtin,
};
use glimpse_tests::{
    Stage,
    gallery::{orthographic, stereo},
    gpu, note,
};

/// The right eye lacks a column.
const SIZE: [u32; 2] = [121, 40];

fn settings(crossing: Crossing) -> Settings {
    let mut settings = Settings { method: Method::Vr, depth: 6, ..Settings::default() };
    settings.paths.crossing = crossing;
    (settings.paths.eye_distance, settings.paths.convergence) = (0.3, Some(2.5));
    settings
}

/// A frame of one sample, in linear radiance.
fn frame(stage: &Stage, settings: &Settings, size: [u32; 2]) -> Vec<DVec3> {
    let mut renderer = Renderer::new(gpu(), &stage.scene, size, settings).expect("a renderer");
    let image = renderer.linear_image(&stage.camera).expect("a picture");
    image.pixels().map(|pixel| DVec3::from(pixel.0.map(f64::from))).collect()
}

/// The same by the reference.
fn expected(frame: &Frame<'_>) -> Vec<DVec3> {
    let [width, height] = frame.size;
    let index = |[x, y]: [u32; 2]| (y * width + x) as usize;
    let (mut sums, mut counts) = (vec![DVec3::ZERO; index([0, height])], vec![1.0; index([0, height])]);
    for pixel in (0..height).flat_map(|y| (0..width).map(move |x| [x, y])) {
        let path = frame.path(pixel, 0, &mut Rounding::none());
        sums[index(pixel)] += path.own * path.radiance;
        if let Some(landing) = path.landing {
            sums[index(landing.pixel)] += landing.share * path.radiance;
            counts[index(landing.pixel)] += 1.0;
        }
    }
    match frame.settings.paths.crossing {
        Crossing::Paper => sums.into_iter().zip(counts).map(|(sum, count)| sum / count).collect(),
        Crossing::Off | Crossing::Weighted => sums,
    }
}

/// Where f32 decides otherwise than f64, two pixels differ. Everywhere else one sample is the same but for rounding.
#[test]
fn a_sample_is_that_of_the_reference() {
    let scenes = [("stereo", stereo()), ("cornell", builtin("cornell").expect("built in"))];
    for (name, scene) in scenes {
        let (reference, stage) = (Reference::new(&scene), Stage::new(scene));
        for crossing in [Crossing::Weighted, Crossing::Paper] {
            let settings = settings(crossing);
            let found = frame(&stage, &settings, SIZE);
            let right =
                expected(&Frame { reference: &reference, camera: stage.camera, size: SIZE, settings });
            let differs = |(found, right): &(&DVec3, &DVec3)| {
                (**found - **right).length() > 1e-3 * (right.length() + 0.01)
            };
            let wrong = found.iter().zip(&right).filter(differs).count() as f64 / found.len() as f64;
            note(&format!("{name} {crossing:?}: {wrong:.4} of the pixels differ"));
            assert!(wrong < 0.03, "{name} {crossing:?}: {wrong}");
        }
    }
}

#[test]
fn leaving_out_and_counting_change_nothing() {
    let stage = Stage::new(stereo());
    let auto = settings(Crossing::Weighted);
    let all = Settings { features: Linking::All, ..auto };
    assert!(frame(&stage, &auto, SIZE) == frame(&stage, &all, SIZE));
    let make = || Renderer::new(gpu(), &stage.scene, SIZE, &auto).expect("a renderer");
    let (mut counting, mut plain) = (make(), make());
    for renderer in [&mut counting, &mut plain] {
        renderer.render(&stage.camera).expect("a frame");
    }
    let rays = counting.inspect(&stage.camera).expect("counts").counts.rays;
    assert_eq!(rays.primary, u64::from(SIZE[0] * SIZE[1]));
    for renderer in [&mut counting, &mut plain] {
        renderer.render(&stage.camera).expect("a frame");
    }
    let shown = |renderer: &Renderer<'_>| renderer.display_image().expect("a picture");
    assert!(shown(&counting) == shown(&plain));
}

/// One column, one pixel, eyes in one place, inside of what they look at, farther apart than the scene is wide.
#[test]
fn unusual_eyes_see_something_defined() {
    let stage = Stage::new(stereo());
    let usual = settings(Crossing::Weighted);
    let eyes = |distance, convergence| {
        let mut settings = usual;
        (settings.paths.eye_distance, settings.paths.convergence) = (distance, convergence);
        settings
    };
    for (size, settings) in [
        ([1, 7], usual),
        ([2, 1], usual),
        (SIZE, eyes(0.0, None)),
        (SIZE, eyes(0.8, Some(0.1))),
        (SIZE, eyes(1e4, None)),
        (SIZE, eyes(1e-30, Some(1e-20))),
    ] {
        let found = frame(&stage, &settings, size);
        assert!(
            found.iter().all(|c| c.is_finite() && c.min_element() >= 0.0),
            "{size:?} {:?}",
            settings.paths
        );
    }
    let inside = stage.camera;
    let inside = glimpse::Camera { origin: Vec3::new(0.0, -0.32, 0.2), ..inside };
    let stage = Stage { camera: inside, ..stage };
    let found = frame(&stage, &usual, SIZE);
    assert!(found.iter().all(|c| c.is_finite() && c.min_element() >= 0.0));
}

#[test]
fn an_orthographic_camera_has_no_eyes() {
    let stage = Stage::new(orthographic());
    let mut renderer =
        Renderer::new(gpu(), &stage.scene, SIZE, &settings(Crossing::Weighted)).expect("a renderer");
    let error = renderer.render(&stage.camera).expect_err("no eyes").to_string();
    assert!(error.contains("--method vr") && error.contains("orthographic"), "{error}");
}
