//! The shared scenes, if present: each loads, and a small adaptive frame of it is not empty.

use glimpse::Settings;
use glimpse_tests::{TestScene, note, shared_scene};

const FILES: [&str; 4] =
    ["japanese_classroom.glb", "coffee_maker.glb", "vr_bunny.glb", "contemporary_bathroom.glb"];

#[test]
fn small_frames_of_shared_scenes() {
    for file in FILES {
        let Some(scene) = shared_scene(file) else { continue };
        let test_scene = TestScene::new(scene);
        let size = [96, 54];
        let frame = test_scene.frame(size, &Settings::default());
        let lit = frame.pixels().filter(|p| p.0.iter().any(|v| *v > 0.0)).count();
        assert!(frame.as_raw().iter().all(|v| v.is_finite() && *v >= 0.0), "{file}");
        assert!(lit * 4 > frame.pixels().count(), "{file}: {lit} pixels are not black");
        let ratio = test_scene.inspect(size, &Settings::default()).counts.rt_ratio();
        note(&format!("{file}: RT ratio {ratio:.3} at {size:?}"));
        assert!((0.25..=1.0).contains(&ratio), "{file}: RT ratio {ratio}");
    }
}
