//! Heckbert's picture by the renderer, against the f64 program.

use glimpse::{Method, Settings};
use glimpse_tests::{
    TestScene,
    minray::{LEVELS, SIZE, at_edge, picture},
    note,
};

/// Rounding of f32 through three levels of spheres: a few hundred roundings of numbers up to 16 (the lights' distance).
const TOLERANCE: f64 = 2e-4;

/// Allowed number of pixels at edges, where f32 and f64 hit different surfaces.
const MAX_EDGE_PIXELS: usize = 3;

#[test]
fn the_picture_is_heckberts() {
    let settings = Settings { method: Method::Full, depth: LEVELS, min_weight: 0.0, ..Settings::default() };
    let frame = TestScene::builtin("minray").frame([SIZE, SIZE], &settings);
    let expected = picture();
    let (mut off, mut worst, mut wrong) = (Vec::new(), 0.0_f64, Vec::new());
    for (x, y, pixel) in frame.enumerate_pixels() {
        let expected_pixel = expected[(y * SIZE + x) as usize].radiance.to_array();
        let error = (0..3).map(|c| (f64::from(pixel[c]) - expected_pixel[c]).abs()).fold(0.0, f64::max);
        // Written so that NaN counts as wrong.
        if error <= TOLERANCE {
            worst = worst.max(error);
            continue;
        }
        let line = format!("({x}, {y}): {:?}, expected {expected_pixel:?}", pixel.0);
        if at_edge(&expected, x, y) { off.push(line) } else { wrong.push(line) }
    }
    assert!(wrong.is_empty(), "{} pixels away from every edge are wrong:\n{}", wrong.len(), wrong.join("\n"));
    assert!(
        off.len() <= MAX_EDGE_PIXELS,
        "{} pixels at edges differ, {MAX_EDGE_PIXELS} may:\n{}",
        off.len(),
        off.join("\n")
    );
    for line in &off {
        note(&format!("minray: at an edge, {line}"));
    }
    note(&format!("minray: largest error {worst:.2e}, {} pixels at edges differ", off.len()));
}
