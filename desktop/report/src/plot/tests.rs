//! Tests of the scales, the ticks, and that every mark is drawn.

use super::*;

fn mark(label: &str, cost: f64, psnr_db: f64, front: bool) -> Mark {
    Mark { label: label.into(), family: Family::FIXED, point: Point { cost, psnr_db }, front }
}

#[test]
fn ticks_are_round_and_inside() {
    assert_eq!(logarithmic_ticks([0.9, 2.1]), [10.0, 20.0, 50.0, 100.0]);
    assert_eq!(linear_ticks([29.5, 50.0]), [30.0, 35.0, 40.0, 45.0, 50.0]);
    assert_eq!(linear_ticks([0.25, 0.75]), [0.3, 0.4, 0.5, 0.6, 0.7]);
}

#[test]
fn places_follow_the_scales() {
    let marks =
        [mark("a", 1.0, 30.0, true), mark("b", 10.0, 40.0, true), mark("c", 100.0, f64::INFINITY, true)];
    let scales = Scales::of(&marks);
    let [a, b, c] = [0, 1, 2].map(|i| scales.place(marks[i].point));
    assert!((b[0] - a[0] - (c[0] - b[0])).abs() < 1e-9, "a decade is a decade");
    assert!(a[1] > b[1] && b[1] > c[1] && c[1] == AREA[1], "more is higher, equal pictures are at the top");
}

#[test]
fn every_mark_has_its_label_and_the_front_its_line() {
    let marks = [mark("<a>", 1.0, 30.0, true), mark("b", 2.0, 29.0, false), mark("c", 3.0, 35.0, true)];
    let svg = draw("x & y", "ms", &marks);
    for text in [">&lt;a&gt;<", ">b<", ">c<", "x &amp; y: PSNR against ms", "full, fixed samples"] {
        assert!(svg.contains(text), "{text} in {svg}");
    }
    let line = svg.lines().find(|line| line.starts_with("<polyline")).unwrap();
    assert_eq!(line.matches(',').count(), 2, "two points: {line}");
    assert!(!svg.contains("NaN"));
}

#[test]
fn one_point_and_equal_points_have_room() {
    for marks in [vec![mark("a", 5.0, 30.0, true)], vec![mark("a", 5.0, f64::INFINITY, true); 2]] {
        let svg = draw("s", "ms", &marks);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
}
