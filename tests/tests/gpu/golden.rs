//! Golden frames of the built-in scenes (see `glimpse_tests::golden`).

use glimpse::{Method, Settings};
use glimpse_tests::{TestScene, golden::Goldens, gpu};

const SIZE: [u32; 2] = [128, 96];

fn check(scene: &str, method: Method) {
    let settings = Settings { method, ..Settings::default() };
    let shown = TestScene::builtin(scene).shown(SIZE, &settings);
    let name = format!("{scene}-{}", if method == Method::Full { "full" } else { "adaptive" });
    if let Err(error) = Goldens::of_project(&gpu().facts().info).check(&name, &shown) {
        panic!("{error}");
    }
}

macro_rules! goldens {
    ($($name:ident: $scene:literal, $method:ident;)*) => {
        $(#[test]
        fn $name() {
            check($scene, Method::$method);
        })*

        /// Every picture in the folder belongs to a test, and every test has a picture.
        #[test]
        fn folder_is_complete() {
            let mut expected = vec![$(format!("{}-{}", $scene, stringify!($method).to_lowercase())),*];
            expected.sort();
            let folder = glimpse_tests::workspace().join("tests/golden");
            let mut found: Vec<String> = std::fs::read_dir(folder)
                .into_iter()
                .flatten()
                .filter_map(|entry| entry.ok()?.file_name().to_str()?.strip_suffix(".png").map(str::to_owned))
                .collect();
            found.sort();
            assert_eq!(found, expected);
        }
    };
}

goldens! {
    room_full: "room", Full;
    room_adaptive: "room", Adaptive;
    cornell_full: "cornell", Full;
    cornell_adaptive: "cornell", Adaptive;
    minray_full: "minray", Full;
    minray_adaptive: "minray", Adaptive;
    furnace_full: "furnace", Full;
    furnace_adaptive: "furnace", Adaptive;
    wires_full: "wires", Full;
    wires_adaptive: "wires", Adaptive;
}
