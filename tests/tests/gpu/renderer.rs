//! Renderers whose size and settings change, and cancelled frames.

use std::cell::Cell;

use glimpse::{Method, Postcorrect, Renderer, Settings, Tolerances};
use glimpse_tests::{TestScene, gpu};

fn settings(method: Method) -> Settings {
    Settings { method, ..Settings::default() }
}

#[test]
fn a_renderer_that_changes_draws_what_a_new_one_draws() {
    let test_scene = TestScene::builtin("cornell");
    let adaptive = settings(Method::Adaptive);
    let loose = Tolerances { pos: 0.3, norm: 0.5, ..Tolerances::default() };
    let wishes = [
        ([96, 64], adaptive),
        ([33, 47], adaptive),
        ([33, 47], Settings { tolerances: loose, ..adaptive }),
        ([64, 64], Settings { block: 4, ..adaptive }),
        ([64, 64], Settings { block: 4, postcorrect: Postcorrect::Off, depth: 1, ..adaptive }),
        ([32, 32], Settings { sampling: 2, ..adaptive }),
        ([96, 64], settings(Method::Full)),
        ([96, 64], settings(Method::Checkerboard)),
        ([1, 1], adaptive),
        ([96, 64], adaptive),
    ];
    let mut changing =
        Renderer::new(gpu(), &test_scene.scene, wishes[0].0, &wishes[0].1).expect("a renderer");
    for (size, settings) in wishes {
        changing.change(size, &settings).expect("a change");
        changing.render(&test_scene.camera).expect("a frame");
        let mut new = Renderer::new(gpu(), &test_scene.scene, size, &settings).expect("a renderer");
        new.render(&test_scene.camera).expect("a frame");
        let pictures = [&changing, &new].map(|renderer| renderer.display_image().expect("a picture"));
        assert_eq!(pictures[0].dimensions(), (size[0], size[1]));
        assert!(pictures[0] == pictures[1], "{size:?} {settings:?}");
        assert_eq!(changing.settings(), new.settings());
        let counts = [&mut changing, &mut new].map(|r| r.inspect(&test_scene.camera).expect("counts").counts);
        assert_eq!(counts[0], counts[1], "{size:?} {settings:?}");
    }
}

#[test]
fn kernels_are_compiled_once() {
    let test_scene = TestScene::builtin("cornell");
    let mut renderer =
        Renderer::new(gpu(), &test_scene.scene, [32, 32], &settings(Method::Adaptive)).expect("a renderer");
    let compiled = renderer.kernels();
    renderer.change([48, 16], &settings(Method::Adaptive)).expect("a change");
    assert_eq!(renderer.kernels(), compiled, "another size is no other kernel");
    renderer.change([48, 16], &settings(Method::Full)).expect("a change");
    assert_eq!(renderer.kernels(), compiled + 1);
    renderer.change([48, 16], &settings(Method::Adaptive)).expect("a change");
    assert_eq!(renderer.kernels(), compiled + 1);
}

#[test]
fn a_change_that_fails_changes_nothing() {
    let test_scene = TestScene::builtin("cornell");
    let before = settings(Method::Adaptive);
    let mut renderer = Renderer::new(gpu(), &test_scene.scene, [32, 24], &before).expect("a renderer");
    renderer.render(&test_scene.camera).expect("a frame");
    let picture = renderer.display_image().expect("a picture");
    assert!(renderer.change([0, 24], &before).is_err());
    assert!(renderer.change([32, 24], &Settings { block: 3, ..before }).is_err());
    renderer.render(&test_scene.camera).expect("a frame");
    assert!(renderer.display_image().expect("a picture") == picture);
}

#[test]
fn a_frame_that_is_given_up_leaves_the_next_one_whole() {
    let test_scene = TestScene::builtin("minray");
    let adaptive = settings(Method::Adaptive);
    let mut renderer = Renderer::new(gpu(), &test_scene.scene, [1024, 768], &adaptive).expect("a renderer");
    renderer.render(&test_scene.camera).expect("a frame");
    let whole = renderer.display_image().expect("a picture");
    let asked = Cell::new(0);
    let share = Cell::new(-1.0);
    let time = renderer.render_until(&test_scene.camera, &|submitted| {
        asked.set(asked.get() + 1);
        assert!(submitted > share.replace(submitted) && submitted < 1.0, "{submitted} after {}", share.get());
        false
    });
    assert!(time.expect("a frame").is_some());
    let submissions = asked.get();
    assert!(submissions > 2, "a frame of {submissions} submissions cannot be given up between them");
    for last in 0..submissions {
        let asked = Cell::new(0);
        let given_up = renderer.render_until(&test_scene.camera, &|_| {
            asked.set(asked.get() + 1);
            asked.get() > last
        });
        assert!(given_up.expect("no failure").is_none(), "after {last} submissions");
        assert_eq!(asked.get(), last + 1, "nothing is submitted after the frame was given up");
        assert!(renderer.render_until(&test_scene.camera, &|_| false).expect("a frame").is_some());
        assert!(renderer.display_image().expect("a picture") == whole, "after {last} submissions");
    }
}
