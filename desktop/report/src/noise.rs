//! How much the times of one setting vary, from the control that is timed throughout a job.

use crate::bench::Measured;
use crate::interval::mean_and_deviation;

/// Variation of the control's times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Number of groups of settings in which the control was timed.
    pub groups: usize,
    /// Relative standard deviation between the groups' mean times; NaN for one group.
    pub between: f64,
    /// Relative standard deviation of single frames within a group; NaN for one frame a group.
    pub within: f64,
}

impl Noise {
    /// Reads the control's times from the frames of the other settings; `None` for a job without a control.
    pub fn of(measured: &Measured) -> Option<Self> {
        let control = measured.job.control?;
        // Settings of one group have the control's times in common.
        let mut groups: Vec<Vec<f64>> = Vec::new();
        for (index, record) in measured.records.iter().enumerate() {
            let times: Vec<f64> =
                record.frames.iter().filter_map(|frame| frame.control_ms).map(f64::ln).collect();
            if index != control && !times.is_empty() && !groups.contains(&times) {
                groups.push(times);
            }
        }
        if groups.is_empty() {
            return None;
        }
        let means: Vec<f64> = groups.iter().map(|times| mean_and_deviation(times)[0]).collect();
        let repeated: Vec<f64> = groups
            .iter()
            .filter(|times| times.len() > 1)
            .map(|times| mean_and_deviation(times)[1].powi(2))
            .collect();
        // Deviations of logarithms are relative deviations.
        let within = mean_and_deviation(&repeated)[0].sqrt();
        Some(Self { groups: groups.len(), between: mean_and_deviation(&means)[1], within })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Frame, Record, tests::example};
    use crate::rows::tests::ladder;

    #[test]
    fn noise_is_that_of_the_control_between_groups_and_within() {
        let mut measured = ladder();
        measured.job.control = Some(1);
        let record = |control: [f64; 2]| {
            let of = example("r", 7.0, Some(40.0));
            let frames = control.map(|ms| Frame { control_ms: Some(ms), ..of.frames[0].clone() }).to_vec();
            Record { frames, ..of }
        };
        // Two settings of one group, the control, and a setting of another group that is 10 % slower.
        let (first, second) = ([100.0, 102.0], [110.0, 112.2]);
        measured.records = vec![record(first), record([100.0, 102.0]), record(first), record(second)];
        let noise = Noise::of(&measured).unwrap();
        assert_eq!(noise.groups, 2);
        assert!((noise.between - 1.1_f64.ln() / 2.0_f64.sqrt()).abs() < 1e-9, "{noise:?}");
        assert!((noise.within - 1.02_f64.ln() / 2.0_f64.sqrt()).abs() < 1e-9, "{noise:?}");
        measured.job.control = None;
        assert_eq!(Noise::of(&measured), None);
    }
}
