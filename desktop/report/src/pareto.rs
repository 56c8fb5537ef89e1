//! The Pareto front: the points that no other beats.

/// What a setting costs (milliseconds, or rays a pixel) and what it gives (PSNR in decibels).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Less is better.
    pub cost: f64,
    /// More is better; infinite for equal pictures.
    pub psnr_db: f64,
}

impl Point {
    /// It is at least as good in both, and better in one.
    pub fn beats(self, other: Self) -> bool {
        self.cost <= other.cost && self.psnr_db >= other.psnr_db && self != other
    }
}

/// Which points lie on the front of all of them.
pub fn front(points: &[Point]) -> Vec<bool> {
    points.iter().map(|point| !points.iter().any(|other| other.beats(*point))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(points: &[(f64, f64)]) -> Vec<bool> {
        front(&points.iter().map(|&(cost, psnr_db)| Point { cost, psnr_db }).collect::<Vec<_>>())
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        // Cheaper and worse, dearer and better: both stay; the third costs more than the second and gives less.
        assert_eq!(of(&[(1.0, 30.0), (2.0, 40.0), (3.0, 35.0)]), [true, true, false]);
        // Equal cost: the better one. Equal quality: the cheaper one.
        assert_eq!(of(&[(1.0, 30.0), (1.0, 31.0)]), [false, true]);
        assert_eq!(of(&[(1.0, 30.0), (2.0, 30.0)]), [true, false]);
        // The same point twice beats nobody.
        assert_eq!(of(&[(1.0, 30.0), (1.0, 30.0)]), [true, true]);
    }

    #[test]
    fn nothing_is_better_than_equal_pictures() {
        assert_eq!(of(&[(1.0, f64::INFINITY), (2.0, f64::INFINITY), (0.5, 60.0)]), [true, false, true]);
        assert!(of(&[]).is_empty());
    }
}
