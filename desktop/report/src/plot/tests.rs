//! Tests of the scales, the ticks, and that every mark is drawn.

use super::*;

fn mark(label: &str, cost: f64, psnr_db: f64, front: bool) -> Mark {
    Mark { label: label.into(), family: Family::FIXED, point: Point { cost, psnr_db }, interval: None, front }
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
fn intervals_are_drawn_around_their_marks_within_the_area() {
    let mut marks = [mark("a", 10.0, 30.0, true), mark("b", 100.0, 40.0, true)];
    let bars = |svg: &str| svg.lines().filter(|line| line.contains("stroke-width=\"1.5\"")).count();
    assert_eq!(bars(&draw("s", "ms", &marks)), 0);
    marks[0].interval = Some([9.0, 12.0]);
    // Wider than the plot.
    marks[1].interval = Some([1e-3, 1e9]);
    let svg = draw("s", "ms", &marks);
    assert_eq!(bars(&svg), 2);
    let scales = Scales::of(&marks);
    let ends = [scales.x(9.0), scales.x(12.0)].map(|x| format!("{x:.1}"));
    assert!(svg.contains(&format!("M{} ", ends[0])) && svg.contains(&format!("H{}M", ends[1])), "{svg}");
    assert!(svg.contains(&format!("H{:.1}M", AREA[2])), "{svg}");
}

#[test]
fn one_point_and_equal_points_have_room() {
    for marks in [vec![mark("a", 5.0, 30.0, true)], vec![mark("a", 5.0, f64::INFINITY, true); 2]] {
        let svg = draw("s", "ms", &marks);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
}
