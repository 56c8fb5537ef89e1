//! Tests of the comparison of pictures.

use glimpse::DisplayImage;
use glimpse_tests::{
    compare::{Tolerance, compare, difference_image},
    golden::TOLERANCE,
};
use image::Rgba;

/// A picture with gradients, an edge and a highlight.
fn picture() -> DisplayImage {
    DisplayImage::from_fn(61, 37, |x, y| {
        let shape = if (x as i32 - 30).pow(2) + (y as i32 - 18).pow(2) < 100 { 180 } else { 90 };
        Rgba([shape, shape + (x % 64) as u8, shape + (y % 64) as u8, 255])
    })
}

#[test]
fn a_picture_is_like_itself() {
    let difference = compare(&picture(), &picture(), &TOLERANCE).unwrap();
    assert_eq!((difference.failed_pixels, difference.largest), (0, 0));
    assert_eq!(difference.worst_tile_rmse, 0.0);
    assert!(difference.sweep.iter().all(|(_, count)| *count == 0));
}

#[test]
fn rounding_is_allowed() {
    let mut other = picture();
    for (i, pixel) in other.pixels_mut().enumerate().filter(|(i, _)| i % 16 == 0) {
        pixel[i % 3] += 1;
    }
    compare(&other, &picture(), &TOLERANCE).unwrap();
}

#[test]
fn two_swapped_pixels_are_found() {
    let mut other = picture();
    let (inside, outside) = (*other.get_pixel(30, 18), *other.get_pixel(2, 2));
    other.put_pixel(30, 18, outside);
    other.put_pixel(2, 2, inside);
    let error = compare(&other, &picture(), &TOLERANCE).unwrap_err();
    assert!(error.starts_with("2 pixels fail"), "{error}");
}

#[test]
fn a_shift_by_one_pixel_is_found() {
    let original = picture();
    let shifted = DisplayImage::from_fn(61, 37, |x, y| *original.get_pixel(x.saturating_sub(1), y));
    assert!(compare(&shifted, &original, &TOLERANCE).is_err());
}

#[test]
fn one_percent_less_light_is_found() {
    let mut dim = picture();
    for pixel in dim.pixels_mut() {
        for channel in 0..3 {
            pixel[channel] = (f64::from(pixel[channel]) * 0.99).round() as u8;
        }
    }
    let error = compare(&dim, &picture(), &TOLERANCE).unwrap_err();
    assert!(error.contains("worst tile RMSE"), "{error}");
}

#[test]
fn one_wrong_tile_is_found_however_large_the_picture() {
    let large = DisplayImage::from_pixel(512, 512, Rgba([100, 100, 100, 255]));
    let mut other = large.clone();
    for (x, y) in (0..8).flat_map(|x| (0..8).map(move |y| (x, y))) {
        other.put_pixel(256 + x, 128 + y, Rgba([102, 102, 102, 255]));
    }
    let error = compare(&other, &large, &TOLERANCE).unwrap_err();
    assert!(error.contains("worst tile RMSE 2.000 at (256, 128)"), "{error}");
}

#[test]
fn each_number_of_the_tolerance_counts() {
    let mut other = picture();
    other.get_pixel_mut(20, 20)[1] += 40;
    let check = |tolerance: &Tolerance| compare(&other, &picture(), tolerance).is_ok();
    let lenient = Tolerance { threshold: 40, max_failed_pixels: 1, worst_tile_rmse: 3.0 };
    assert!(check(&lenient));
    assert!(check(&Tolerance { max_failed_pixels: 0, ..lenient }), "40 is not beyond 40");
    assert!(check(&Tolerance { threshold: 39, ..lenient }));
    assert!(!check(&Tolerance { threshold: 39, max_failed_pixels: 0, ..lenient }));
    // 40 / sqrt(3 x 64) = 2.887
    assert!(!check(&Tolerance { worst_tile_rmse: 2.8, ..lenient }));
    assert!(!check(&Tolerance { worst_tile_rmse: f64::NAN, ..lenient }));
}

#[test]
fn pictures_of_other_sizes_differ() {
    let error = compare(&DisplayImage::new(61, 36), &picture(), &TOLERANCE).unwrap_err();
    assert!(error.contains("(61, 37)") && error.contains("(61, 36)"), "{error}");
    assert!(compare(&DisplayImage::new(0, 0), &DisplayImage::new(0, 0), &TOLERANCE).is_err());
}

#[test]
fn the_difference_shows_where() {
    let mut other = picture();
    other.get_pixel_mut(7, 9)[2] += 10;
    let shown = difference_image(&other, &picture());
    assert_eq!(shown.get_pixel(7, 9), &Rgba([0, 0, 80, 255]));
    assert_eq!(shown.get_pixel(8, 9), &Rgba([0, 0, 0, 255]));
}
