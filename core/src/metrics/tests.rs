//! Closed forms, and proof that each comparator sees a change.

use image::{Rgb, Rgba};

use super::*;
use crate::LinearImage;

const SIZE: (u32, u32) = (40, 27);

fn picture() -> DisplayImage {
    DisplayImage::from_fn(SIZE.0, SIZE.1, |x, y| {
        let v = |k: u32| ((x * 37 + y * 101 + x * y * k) % 200 + 40) as u8;
        Rgba([v(3), v(5), v(7), 255])
    })
}

fn flat(level: u8) -> DisplayImage {
    DisplayImage::from_pixel(SIZE.0, SIZE.1, Rgba([level, level, level, 255]))
}

fn swapped() -> DisplayImage {
    let mut image = picture();
    let (p, q) = (*image.get_pixel(10, 10), *image.get_pixel(11, 10));
    assert_ne!(p, q);
    image.put_pixel(10, 10, q);
    image.put_pixel(11, 10, p);
    image
}

fn shifted() -> DisplayImage {
    let original = picture();
    DisplayImage::from_fn(SIZE.0, SIZE.1, |x, y| *original.get_pixel((x + 1) % SIZE.0, y))
}

fn dimmed() -> DisplayImage {
    let mut image = picture();
    for Rgba([r, g, b, _]) in image.pixels_mut() {
        for v in [r, g, b] {
            *v = (f32::from(*v) * 0.99).round() as u8;
        }
    }
    image
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9, "expected {expected}, found {found}");
}

#[test]
fn equal_images_have_no_error() {
    let report = compare(&picture(), &picture()).unwrap();
    assert_eq!((report.rmse, report.psnr_db), (0.0, None));
    assert_eq!((report.worst_tile_rmse, report.worst_tile), (0.0, [0, 0]));
    close(report.ssim, 1.0);
    if cfg!(feature = "flip") {
        assert_eq!((report.flip_mean, report.flip_p99), (Some(0.0), Some(0.0)));
    }
}

#[test]
fn every_measure_sees_every_damage_and_knows_the_worse_one() {
    let report = |damaged| compare(&damaged, &picture()).unwrap();
    let [swap, shift, dim] = [report(swapped()), report(shifted()), report(dimmed())];
    for damaged in [swap, shift, dim] {
        assert!(damaged.rmse > 0.0 && damaged.worst_tile_rmse >= damaged.rmse && damaged.ssim < 1.0);
        assert!(damaged.psnr_db.unwrap().is_finite());
        #[cfg(feature = "flip")]
        assert!(damaged.flip_mean.unwrap() > 0.0 && damaged.flip_p99.unwrap() > 0.0);
        assert!(damaged.rmse <= shift.rmse && damaged.ssim >= shift.ssim && damaged.psnr_db >= shift.psnr_db);
        assert!(damaged.flip_mean <= shift.flip_mean);
    }
    assert_eq!(swap.worst_tile, [8, 8], "two wrong pixels are found where they are");
    close(swap.worst_tile_rmse, swap.rmse * (40.0 * 27.0 / 64.0_f64).sqrt());
}

#[test]
fn a_constant_offset_is_its_own_rmse() {
    let report = compare(&flat(100), &flat(105)).unwrap();
    close(report.rmse, 5.0);
    close(report.psnr_db.unwrap(), 20.0 * 51_f64.log10());
    close(report.worst_tile_rmse, 5.0);
    let c1 = 2.55_f64.powi(2);
    close(report.ssim, (2.0 * 100.0 * 105.0 + c1) / (100.0_f64.powi(2) + 105.0_f64.powi(2) + c1));
}

#[test]
fn one_wrong_channel_in_a_tile_that_the_border_cuts() {
    let mut image = flat(100);
    image.put_pixel(SIZE.0 - 1, SIZE.1 - 1, Rgba([100, 112, 100, 255]));
    let tile = worst_tile(&image, &flat(100)).unwrap();
    assert_eq!(tile.position, [32, 24]);
    close(tile.rmse, (144.0 / (3.0 * 8.0 * 3.0_f64)).sqrt());
    close(rmse(&image, &flat(100)).unwrap(), (144.0 / (3.0 * 40.0 * 27.0_f64)).sqrt());
}

#[test]
fn inverted_contrast_has_negative_similarity() {
    let stripes = |even: u8, odd: u8| {
        DisplayImage::from_fn(SIZE.0, SIZE.1, |x, _| {
            let v = if x % 2 == 0 { even } else { odd };
            Rgba([v, v, v, 255])
        })
    };
    assert!(ssim(&stripes(50, 200), &stripes(200, 50)).unwrap() < -0.9);
}

#[test]
fn alpha_does_not_count() {
    let mut image = picture();
    image.pixels_mut().for_each(|p| p.0[3] = 7);
    assert_eq!(compare(&image, &picture()).unwrap(), compare(&picture(), &picture()).unwrap());
}

/// The HyAB distance of black and white after the Hunt adjustment is 100^0.7 = 25.12; the greatest distance,
/// of green and blue, is 41.28: the piecewise map of section 5.1 gives 0.95 + 0.05 (25.12 - 0.4 41.28) / (0.6 41.28).
#[cfg(feature = "flip")]
#[test]
fn flip_of_black_and_white() {
    let found = flip(&flat(0), &flat(255)).unwrap();
    assert!((found.mean - 0.9674).abs() < 1e-3, "{found:?}");
    assert!((found.p99 - found.mean).abs() < 1e-3, "{found:?}");
}

#[cfg(feature = "flip")]
#[test]
fn the_percentile_ignores_one_pixel_in_a_thousand_and_sees_a_tenth() {
    let damage = |columns: u32| {
        let mut image = flat(20);
        for x in 0..columns {
            for y in 0..SIZE.1 {
                image.put_pixel(x, y, Rgba([255, 255, 255, 255]));
            }
        }
        flip(&image, &flat(20)).unwrap()
    };
    assert!(damage(4).p99 > 0.8, "{:?}", damage(4));
    assert!(damage(4).mean < 0.5 && damage(4).mean > damage(1).mean);
}

#[test]
fn images_of_different_sizes_are_an_error_with_both_sizes() {
    let small = DisplayImage::new(3, 4);
    let message = compare(&small, &picture()).unwrap_err().to_string();
    assert!(message.contains("3x4") && message.contains("40x27"), "{message}");
    assert!(compare(&DisplayImage::new(0, 4), &DisplayImage::new(0, 4)).is_err());
}

#[test]
fn tiny_images_are_measured() {
    for (width, height) in [(1, 1), (2, 9), (11, 10)] {
        let grey = |v| DisplayImage::from_pixel(width, height, Rgba([v, v, v, 255]));
        let report = compare(&grey(10), &grey(13)).unwrap();
        close(report.rmse, 3.0);
        assert!(report.ssim < 1.0);
    }
}

#[test]
fn linear_radiance() {
    let flat = |v: f32| LinearImage::from_pixel(5, 3, Rgb([v, v, v]));
    assert_eq!(linear_rmse(&flat(4.0), &flat(4.0)).unwrap(), 0.0);
    assert_eq!(linear_rmse(&flat(4.0), &flat(4.5)).unwrap(), 0.5);
    let mut one = flat(4.0);
    one.put_pixel(2, 1, Rgb([4.0, 4.0, 7.0]));
    close(linear_rmse(&one, &flat(4.0)).unwrap(), (9.0_f64 / 45.0).sqrt());
    assert!(linear_rmse(&flat(4.0 * 0.99), &flat(4.0)).unwrap() > 0.039);
    one.put_pixel(2, 1, Rgb([4.0, f32::NAN, 7.0]));
    assert!(linear_rmse(&flat(4.0), &one).unwrap_err().to_string().contains("(2, 1) of the second"));
    assert!(linear_rmse(&LinearImage::new(2, 2), &one).is_err());
}
