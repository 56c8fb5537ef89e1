//! The Pareto front: the points that no other point beats.

/// Cost of a setting (milliseconds or rays per pixel) and its quality (PSNR in decibels).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Milliseconds or rays per pixel; less is better.
    pub cost: f64,
    /// PSNR in decibels; more is better, infinite for equal pictures.
    pub psnr_db: f64,
}

impl Point {
    /// Whether this point is at least as good in cost and PSNR, and better in one of them.
    pub fn beats(self, other: Self) -> bool {
        self.cost <= other.cost && self.psnr_db >= other.psnr_db && self != other
    }
}

/// Marks each point that no other point beats.
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
        // Equal points do not beat each other.
        assert_eq!(of(&[(1.0, 30.0), (1.0, 30.0)]), [true, true]);
    }

    #[test]
    fn nothing_is_better_than_equal_pictures() {
        assert_eq!(of(&[(1.0, f64::INFINITY), (2.0, f64::INFINITY), (0.5, 60.0)]), [true, false, true]);
        assert!(of(&[]).is_empty());
    }
}
