//! Confidence intervals of ratios of times, by Student's t of their logarithms.

/// Geometric mean of repeated measurements with its confidence interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Geometric mean; NaN without measurements.
    pub mean: f64,
    /// 95 % confidence interval; `None` for fewer than two measurements.
    pub interval: Option<[f64; 2]>,
}

impl Estimate {
    /// Estimates a positive quantity from the natural logarithms of independent measurements of it, which are taken as
    /// normally distributed.
    pub fn of_logarithms(logarithms: &[f64]) -> Self {
        let [mean, deviation] = mean_and_deviation(logarithms);
        let n = logarithms.len();
        let half = (n > 1).then(|| t_975(n - 1) * deviation / (n as f64).sqrt());
        Self { mean: mean.exp(), interval: half.map(|half| [(mean - half).exp(), (mean + half).exp()]) }
    }

    /// Formats the interval as `0.44 to 0.52`; empty if there is none.
    pub fn range(&self, digits: usize) -> String {
        self.interval.map_or_else(String::new, |[low, high]| format!("{low:.digits$} to {high:.digits$}"))
    }
}

/// Mean and sample standard deviation; NaN without values, the deviation for one value too.
pub fn mean_and_deviation(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    [mean, (squares / (n - 1.0)).sqrt()]
}

/// 97.5th percentile of Student's t distribution: values of tables up to four degrees of freedom, above them the
/// expansion 26.7.5 of Abramowitz and Stegun (Handbook of Mathematical Functions, 1964), within 0.2 %.
fn t_975(degrees_of_freedom: usize) -> f64 {
    const SMALL: [f64; 4] = [12.706, 4.303, 3.182, 2.776];
    const NORMAL: f64 = 1.959_964;
    if let Some(t) = SMALL.get(degrees_of_freedom - 1) {
        return *t;
    }
    let (z, n) = (NORMAL, degrees_of_freedom as f64);
    let terms = [
        z,
        (z.powi(3) + z) / 4.0 / n,
        (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / 96.0 / n.powi(2),
        (3.0 * z.powi(7) + 19.0 * z.powi(5) + 17.0 * z.powi(3) - 15.0 * z) / 384.0 / n.powi(3),
    ];
    terms.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_those_of_tables() {
        let table = [(1, 12.706), (4, 2.776), (5, 2.571), (9, 2.262), (30, 2.042), (100, 1.984)];
        for (degrees, t) in table {
            assert!((t_975(degrees) / t - 1.0).abs() < 2e-3, "{degrees}: {}", t_975(degrees));
        }
    }

    #[test]
    fn intervals_are_symmetric_in_the_logarithm() {
        // Logarithms of mean 0 and deviation 1: the half width is t / sqrt(3).
        let estimate = Estimate::of_logarithms(&[-1.0, 0.0, 1.0]);
        let [low, high] = estimate.interval.unwrap();
        assert!((estimate.mean - 1.0).abs() < 1e-12 && (low * high - 1.0).abs() < 1e-12);
        assert!((high.ln() - 4.303 / 3.0_f64.sqrt()).abs() < 1e-9, "{high}");
        assert_eq!(estimate.range(1), format!("{low:.1} to {high:.1}"));
    }

    #[test]
    fn one_measurement_has_no_interval() {
        let estimate = Estimate::of_logarithms(&[2.0_f64.ln()]);
        assert!((estimate.mean - 2.0).abs() < 1e-12 && estimate.interval.is_none());
        assert_eq!(estimate.range(2), "");
        assert!(Estimate::of_logarithms(&[]).mean.is_nan());
    }
}
