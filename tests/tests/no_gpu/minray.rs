//! Tests of the f64 minray program itself.

use glam::{DVec3, dvec3};
use glimpse_tests::minray::{AMBIENT, LEVELS, SIZE, at_edge, picture, pixel};

#[test]
fn corners_show_the_background() {
    for (i, j) in [(0, 0), (SIZE - 1, 0), (0, SIZE - 1), (SIZE - 1, SIZE - 1)] {
        let corner = pixel(i, j, LEVELS);
        assert_eq!((corner.object, corner.radiance), (None, AMBIENT));
    }
}

#[test]
fn no_level_is_black_and_more_levels_add_light() {
    assert_eq!(pixel(16, 16, 0).radiance, DVec3::ZERO);
    let levels = [1, 2, 3, 4].map(|levels| pixel(16, 16, levels).radiance);
    for pair in levels.windows(2) {
        assert!(pair[0].cmple(pair[1]).all(), "{levels:?}");
    }
}

/// Hand calculation: the ray of the middle pixel is (0, 1, 0). It hits the glass sphere at t = 6 - sqrt(0.56)
/// = 5.251669, where the normal towards the viewer is (0, -0.831479, -0.555556). The upper lights are
/// visible: N.U = 0.053831 of 0.6, and 0.013068 of 0.5; the orange sphere's weak light is behind. So the
/// first level has 0.05 x ((0.02, 0.02, 0.02) + 0.032298 x (1, 0.8, 1) + 0.006534 x (0.8, 1, 1)).
#[test]
fn the_middle_pixel_is_as_computed_by_hand() {
    let expected = 0.05
        * (dvec3(0.02, 0.02, 0.02) + 0.032_298 * dvec3(1.0, 0.8, 1.0) + 0.006_534 * dvec3(0.8, 1.0, 1.0));
    let middle = pixel(16, 16, 1);
    assert_eq!(middle.object, Some(0));
    assert!((middle.radiance - expected).abs().max_element() < 1e-6, "{} {expected}", middle.radiance);
}

/// The two lower spheres are mirror images at x = 0, and column 16 looks along x = 0.
#[test]
fn the_outlines_are_symmetric() {
    let picture = picture();
    let object = |i: u32, j: u32| picture[(j * SIZE + i) as usize].object;
    for j in 0..SIZE {
        for k in 1..16 {
            let mirrored = match object(16 - k, j) {
                Some(1) => Some(2),
                Some(2) => Some(1),
                other => other,
            };
            assert_eq!(object(16 + k, j), mirrored, "row {j}, {k} from the middle");
        }
    }
    for sphere in 0..3 {
        let seen = picture.iter().filter(|p| p.object == Some(sphere)).count();
        assert!(seen > 50, "sphere {sphere} covers {seen} pixels");
    }
}

#[test]
fn edges_are_where_something_changes() {
    let picture = picture();
    let edges = (0..SIZE * SIZE).filter(|k| at_edge(&picture, k % SIZE, k / SIZE)).count();
    assert!(!at_edge(&picture, 0, 0));
    assert!((100..900).contains(&edges), "{edges} pixels of 1024 lie at an edge");
    assert!(picture.iter().all(|p| p.radiance.is_finite() && p.radiance.cmpge(DVec3::ZERO).all()));
}
