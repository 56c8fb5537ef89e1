//! The bounds of frame tests find wrong pictures and let rounding pass.

use glimpse::{
    DisplayImage,
    metrics::{self, Bounds},
};
use image::Rgba;

/// A picture with gradients, an edge and a highlight.
fn picture() -> DisplayImage {
    DisplayImage::from_fn(61, 37, |x, y| {
        let shape = if (x as i32 - 30).pow(2) + (y as i32 - 18).pow(2) < 100 { 180 } else { 90 };
        Rgba([shape, shape + (x % 64) as u8, shape + (y % 64) as u8, 255])
    })
}

/// The bounds that do not hold, each with what was found.
fn violations(a: &DisplayImage, b: &DisplayImage, bounds: &Bounds) -> Vec<(String, f64)> {
    let report = metrics::compare(a, b).expect("one size");
    let failed = metrics::failed_pixels(a, b, bounds.threshold).expect("one size");
    let violations = bounds.violations(&report, failed).into_iter();
    violations.map(|violation| (violation.bound, violation.found.expect("measured"))).collect()
}

#[test]
fn a_picture_is_like_itself() {
    let exact = Bounds {
        max_rmse: Some(0.0),
        min_psnr: Some(1e6),
        max_failed_pixels: Some(0),
        threshold: 0,
        max_worst_tile: Some(0.0),
        ..Bounds::default()
    };
    assert_eq!(violations(&picture(), &picture(), &exact), []);
}

#[test]
fn rounding_is_allowed() {
    let mut other = picture();
    for (i, pixel) in other.pixels_mut().enumerate().filter(|(i, _)| i % 16 == 0) {
        pixel[i % 3] += 1;
    }
    assert_eq!(violations(&other, &picture(), &Bounds::rounding()), []);
}

#[test]
fn two_swapped_pixels_are_found() {
    let mut other = picture();
    let (inside, outside) = (*other.get_pixel(30, 18), *other.get_pixel(2, 2));
    other.put_pixel(30, 18, outside);
    other.put_pixel(2, 2, inside);
    let none = Bounds { max_failed_pixels: Some(0), ..Bounds::rounding() };
    assert_eq!(violations(&other, &picture(), &none)[0], ("max-failed-pixels".to_owned(), 2.0));
    assert_eq!(violations(&other, &picture(), &Bounds::rounding())[0].0, "max-worst-tile");
}

#[test]
fn a_shift_by_one_pixel_is_found() {
    let original = picture();
    let shifted = DisplayImage::from_fn(61, 37, |x, y| *original.get_pixel(x.saturating_sub(1), y));
    assert_eq!(violations(&shifted, &original, &Bounds::rounding()).len(), 2);
}

#[test]
fn one_percent_less_light_is_found() {
    let mut dim = picture();
    for pixel in dim.pixels_mut() {
        for channel in 0..3 {
            pixel[channel] = (f64::from(pixel[channel]) * 0.99).round() as u8;
        }
    }
    assert!(
        violations(&dim, &picture(), &Bounds::rounding()).iter().any(|(bound, _)| bound == "max-worst-tile")
    );
}

#[test]
fn one_wrong_tile_is_found_however_large_the_picture() {
    let large = DisplayImage::from_pixel(512, 512, Rgba([100, 100, 100, 255]));
    let mut other = large.clone();
    for (x, y) in (0..8).flat_map(|x| (0..8).map(move |y| (x, y))) {
        other.put_pixel(256 + x, 128 + y, Rgba([102, 102, 102, 255]));
    }
    assert_eq!(violations(&other, &large, &Bounds::rounding()), [("max-worst-tile".to_owned(), 2.0)]);
    assert_eq!(metrics::worst_tile(&other, &large).expect("one size").position, [256, 128]);
}

#[test]
fn each_number_of_the_bounds_counts() {
    let mut other = picture();
    other.get_pixel_mut(20, 20)[1] += 40;
    let holds = |bounds: &Bounds| violations(&other, &picture(), bounds).is_empty();
    let lenient =
        Bounds { max_failed_pixels: Some(1), threshold: 40, max_worst_tile: Some(3.0), ..Bounds::default() };
    assert!(holds(&lenient));
    assert!(holds(&Bounds { max_failed_pixels: Some(0), ..lenient }), "40 is not beyond 40");
    assert!(holds(&Bounds { threshold: 39, ..lenient }));
    assert!(!holds(&Bounds { threshold: 39, max_failed_pixels: Some(0), ..lenient }));
    // 40 / sqrt(3 x 64) = 2.887
    assert!(!holds(&Bounds { max_worst_tile: Some(2.8), ..lenient }));
    assert!(!holds(&Bounds { max_worst_tile: Some(f64::NAN), ..lenient }));
}

#[test]
fn pictures_of_other_sizes_cannot_be_compared() {
    let error =
        metrics::failed_pixels(&DisplayImage::new(61, 36), &picture(), 2).expect_err("sizes").to_string();
    assert!(error.contains("61x37") && error.contains("61x36"), "{error}");
    assert!(metrics::compare(&DisplayImage::new(0, 0), &DisplayImage::new(0, 0)).is_err());
}
