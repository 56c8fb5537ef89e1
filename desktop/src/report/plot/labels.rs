//! Labels beside their points, where they cover the least.

/// Of text of 11 units; digits and small letters of common fonts are no wider.
const CHARACTER: f64 = 6.1;
const ASCENT: f64 = 9.0;
const DESCENT: f64 = 3.0;
/// Half of a symbol's side.
const SYMBOL: f64 = 6.0;

/// A box: left, top, right, bottom.
type Area = [f64; 4];

/// What is taken.
pub struct Labels {
    area: Area,
    taken: Vec<Area>,
}

impl Labels {
    /// Around points inside an area.
    pub fn around(points: &[[f64; 2]], area: Area) -> Self {
        let symbol = |[x, y]: &[f64; 2]| [x - SYMBOL, y - SYMBOL, x + SYMBOL, y + SYMBOL];
        Self { area, taken: points.iter().map(symbol).collect() }
    }

    /// The left end of the base line of a label for that point; the place is taken from now on.
    pub fn place(&mut self, [x, y]: [f64; 2], text: &str) -> [f64; 2] {
        let width = CHARACTER * text.chars().count() as f64;
        let mut best = (f64::INFINITY, [x, y]);
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
                // Near the point, unless something is there already.
                let cost = self.covered(&Self::extent(place, width)) + 0.5 * distance;
                if cost < best.0 {
                    best = (cost, place);
                }
            }
        }
        self.taken.push(Self::extent(best.1, width));
        best.1
    }

    fn extent([x, y]: [f64; 2], width: f64) -> Area {
        [x, y - ASCENT, x + width, y + DESCENT]
    }

    /// The area of what is taken, or outside, that a box covers.
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
        assert_eq!(Labels::around(&[[100.0, 100.0]], AREA).place([100.0, 100.0], "abc"), [109.0, 104.0]);
    }

    #[test]
    fn labels_stay_inside_and_cover_nothing() {
        let points: Vec<_> =
            (0..9).map(|i| [380.0 - 2.0 * f64::from(i), 20.0 + 14.0 * f64::from(i)]).collect();
        let mut labels = Labels::around(&points, AREA);
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
