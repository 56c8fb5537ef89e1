//! Places labels beside their points, where they cover the least.

/// Width of a character in SVG units: that of bold text of size 12, whose digits and small letters are no
/// wider in common fonts.
const CHARACTER: f64 = 7.3;
const ASCENT: f64 = 10.0;
const DESCENT: f64 = 3.0;
/// Half the side of a symbol.
const SYMBOL: f64 = 6.0;

/// An axis-aligned box: left, top, right, bottom.
type Area = [f64; 4];

/// Distance from which a leader line connects the point with its label.
const FAR: f64 = 26.0;
/// Spacing of the boxes that occupy a line.
const STEP: f64 = 5.0;

/// Position of a label.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Label {
    /// Left end of the baseline.
    pub at: [f64; 2],
    /// End of the leader line at the label, if the label is far from its point.
    pub leader: Option<[f64; 2]>,
}

/// Places labels one by one and keeps track of the occupied boxes.
pub struct Labels {
    area: Area,
    taken: Vec<Area>,
}

impl Labels {
    /// Starts with the symbols of the points and a polyline occupied, inside an area.
    pub fn around(points: &[[f64; 2]], line: &[[f64; 2]], area: Area) -> Self {
        let around = |[x, y]: [f64; 2], reach: f64| [x - reach, y - reach, x + reach, y + reach];
        let mut taken: Vec<_> = points.iter().map(|point| around(*point, SYMBOL)).collect();
        for ends in line.windows(2) {
            let [from, to] = [ends[0], ends[1]];
            let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / STEP).ceil();
            let between = |i: usize, share: f64| from[i] + share * (to[i] - from[i]);
            let shares = (0..steps as u32).map(|i| f64::from(i) / steps);
            taken.extend(shares.map(|share| around([between(0, share), between(1, share)], 0.5 * STEP)));
        }
        Self { area, taken }
    }

    /// Finds the best position for the label of a point and marks it occupied.
    pub fn place(&mut self, [x, y]: [f64; 2], text: &str) -> Label {
        let width = CHARACTER * text.chars().count() as f64;
        let mut best = (f64::INFINITY, [x, y], 0.0);
        for distance in [9.0, 16.0, 26.0, 38.0] {
            let [left, middle, right] = [x - distance - width, x - 0.5 * width, x + distance];
            let [above, level, below] = [y - distance, y + 4.0, y + distance + ASCENT];
            let around = [
                [right, level],
                [left, level],
                [middle, above],
                [middle, below],
                [right, above],
                [right, below],
                [left, above],
                [left, below],
            ];
            for place in around {
                // The cost is the covered area, plus a term that prefers positions near the point.
                let cost = self.covered(&Self::extent(place, width)) + 0.5 * distance;
                if cost < best.0 {
                    best = (cost, place, distance);
                }
            }
        }
        let (_, at, distance) = best;
        let [left, top, right, bottom] = Self::extent(at, width);
        self.taken.push([left, top, right, bottom]);
        let leader = (distance >= FAR).then(|| [x.clamp(left, right), y.clamp(top, bottom)]);
        Label { at, leader }
    }

    fn extent([x, y]: [f64; 2], width: f64) -> Area {
        [x, y - ASCENT, x + width, y + DESCENT]
    }

    /// Area of a box that is occupied or outside the plot area; overlaps count repeatedly.
    fn covered(&self, label: &Area) -> f64 {
        let size = |a: &Area| (a[2] - a[0]) * (a[3] - a[1]);
        let outside = size(label) - overlap(label, &self.area);
        outside + self.taken.iter().map(|taken| overlap(label, taken)).sum::<f64>()
    }
}

fn overlap(a: &Area, b: &Area) -> f64 {
    let side = |i: usize| (a[i + 2].min(b[i + 2]) - a[i].max(b[i])).max(0.0);
    side(0) * side(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    const AREA: Area = [0.0, 0.0, 400.0, 300.0];

    #[test]
    fn alone_a_label_stands_right_of_its_point() {
        let label = Labels::around(&[[100.0, 100.0]], &[], AREA).place([100.0, 100.0], "abc");
        assert_eq!(label, Label { at: [109.0, 104.0], leader: None });
    }

    #[test]
    fn labels_give_way_to_the_line() {
        let mut labels = Labels::around(&[[100.0, 100.0]], &[[100.0, 100.0], [300.0, 100.0]], AREA);
        let [x, y] = labels.place([100.0, 100.0], "abc").at;
        assert!(x < 100.0 || !(100.0 - DESCENT..=100.0 + ASCENT).contains(&y), "{x} {y}");
    }

    #[test]
    fn a_line_leads_to_labels_that_are_far_off() {
        let crowd = [[100.0, 100.0]; 24];
        let mut labels = Labels::around(&crowd, &[], AREA);
        let leaders: Vec<_> = crowd.iter().map(|point| labels.place(*point, "abc").leader).collect();
        assert!(leaders[0].is_none() && leaders.iter().any(Option::is_some), "{leaders:?}");
    }

    #[test]
    fn labels_stay_inside_and_cover_nothing() {
        let points: Vec<_> =
            (0..9).map(|i| [380.0 - 2.0 * f64::from(i), 20.0 + 14.0 * f64::from(i)]).collect();
        let mut labels = Labels::around(&points, &[], AREA);
        for point in &points {
            labels.place(*point, "twelve chars");
        }
        for (i, a) in labels.taken.iter().enumerate().skip(points.len()) {
            assert!(overlap(a, &AREA) > 0.999 * (a[2] - a[0]) * (a[3] - a[1]), "{a:?} leaves the area");
            assert!(labels.taken[..i].iter().all(|b| overlap(a, b) < 1.0), "{a:?} covers something");
        }
    }

    #[test]
    fn overlaps_are_areas() {
        assert_eq!(overlap(&[0.0, 0.0, 2.0, 2.0], &[1.0, 1.0, 4.0, 5.0]), 1.0);
        assert_eq!(overlap(&[0.0, 0.0, 2.0, 2.0], &[3.0, 0.0, 4.0, 2.0]), 0.0);
    }
}
