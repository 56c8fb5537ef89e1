//! Time of adaptive sampling over that of full ray tracing, at equal error.

use glimpse::Method;

use crate::bench::Measured;
use crate::interval::Estimate;
use crate::pareto::{self, Point};
use crate::record::Record;
use crate::rung::Rung;

/// Time of adaptive sampling over that of full ray tracing on a scene, at equal PSNR.
///
/// Each side is its Pareto front of PSNR and time. Along a front the logarithm of time is interpolated linearly in PSNR,
/// and the difference of the two is averaged over the PSNR that both fronts reach: the average of Bjøntegaard (VCEG-M33,
/// 2001), who fits cubics instead.
#[derive(Clone, Debug, PartialEq)]
pub struct EqualError {
    /// Logarithm of the ratio of times in each round of frames.
    pub log_ratios: Vec<f64>,
    /// Least and greatest PSNR in decibels that both reach.
    pub psnr_db: [f64; 2],
}

impl EqualError {
    /// Compares the settings of a ladder. The fronts are those of all frames; each round then gives a ratio.
    ///
    /// # Errors
    /// Says what PSNR each side reaches if no PSNR is reached by both.
    pub fn of(ladder: &Measured) -> Result<Self, String> {
        let settings = || ladder.job.rungs.iter().zip(&ladder.records);
        let full = Front::of(settings().filter(|(rung, _)| is_full(rung)).map(|(_, record)| record));
        let adaptive = Front::of(settings().filter(|(rung, _)| is_adaptive(rung)).map(|(_, record)| record));
        let (Some(full), Some(adaptive)) = (full, adaptive) else {
            return Err("no finite PSNR to compare".to_owned());
        };
        let ([full_low, full_high], [low, high]) = (full.range(), adaptive.range());
        let psnr_db = [full_low.max(low), full_high.min(high)];
        if psnr_db[0] > psnr_db[1] {
            return Err(format!(
                "full tracing reaches {full_low:.1} to {full_high:.1} dB, adaptive sampling {low:.1} to {high:.1} dB"
            ));
        }
        let rounds = full.rounds.min(adaptive.rounds);
        let log_ratios = (0..rounds).map(|round| mean_difference(&adaptive, &full, round, psnr_db)).collect();
        Ok(Self { log_ratios, psnr_db })
    }

    /// The ratio of times and its interval over the rounds.
    pub fn ratio(&self) -> Estimate {
        Estimate::of_logarithms(&self.log_ratios)
    }
}

/// Whether a setting is full ray tracing, of reduced resolution or with several samples too.
pub fn is_full(rung: &Rung) -> bool {
    rung.settings.method == Method::Full
}

/// Whether a setting places its samples by the picture's content.
pub fn is_adaptive(rung: &Rung) -> bool {
    !rung.family.is_baseline
}

/// Settings that no other of the same side beats, by increasing PSNR.
struct Front<'r> {
    settings: Vec<(f64, &'r Record)>,
    /// Number of frames that all of them have.
    rounds: usize,
}

impl<'r> Front<'r> {
    /// `None` if no setting has a finite PSNR. Equal pictures have none.
    fn of(records: impl Iterator<Item = &'r Record>) -> Option<Self> {
        let finite = |record: &&Record| record.psnr_db().is_some_and(f64::is_finite);
        let records: Vec<_> = records.filter(finite).collect();
        let point = |record: &&Record| Point {
            cost: Estimate::of_logarithms(&record.log_times()).mean,
            psnr_db: record.psnr_db().unwrap_or(f64::NAN),
        };
        let points: Vec<_> = records.iter().map(point).collect();
        let on_front = records.into_iter().zip(pareto::front(&points)).filter(|(_, front)| *front);
        let mut settings: Vec<_> =
            on_front.map(|(record, _)| (record.psnr_db().unwrap_or(f64::NAN), record)).collect();
        settings.sort_by(|a, b| a.0.total_cmp(&b.0));
        settings.dedup_by_key(|setting| setting.0);
        let rounds = settings.iter().map(|(_, record)| record.frames.len()).min()?;
        Some(Self { settings, rounds })
    }

    fn range(&self) -> [f64; 2] {
        let ends = [self.settings.first(), self.settings.last()];
        ends.map(|end| end.map_or(f64::NAN, |(psnr_db, _)| *psnr_db))
    }

    /// Logarithm of the time of a round at a PSNR within the range.
    fn log_time(&self, round: usize, psnr_db: f64) -> f64 {
        let time = |record: &Record| record.log_times()[round];
        let above = self.settings.iter().position(|(at, _)| *at >= psnr_db);
        let above = above.unwrap_or(self.settings.len() - 1);
        let (at, record) = self.settings[above];
        if above == 0 || at == psnr_db {
            return time(record);
        }
        let (from, below) = self.settings[above - 1];
        let share = (psnr_db - from) / (at - from);
        (1.0 - share) * time(below) + share * time(record)
    }
}

/// Mean of the difference of the logarithms of two fronts' times over a range of PSNR. Both are linear between the
/// settings, where the trapezoidal rule is exact.
fn mean_difference(a: &Front<'_>, b: &Front<'_>, round: usize, [low, high]: [f64; 2]) -> f64 {
    let difference = |psnr_db: f64| a.log_time(round, psnr_db) - b.log_time(round, psnr_db);
    if low == high {
        return difference(low);
    }
    let settings = a.settings.iter().chain(&b.settings).map(|(psnr_db, _)| *psnr_db);
    let mut nodes: Vec<f64> = settings.filter(|at| (low..=high).contains(at)).collect();
    nodes.sort_by(f64::total_cmp);
    let area = |pair: &[f64]| 0.5 * (pair[1] - pair[0]) * (difference(pair[0]) + difference(pair[1]));
    nodes.windows(2).map(area).sum::<f64>() / (high - low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Frame, tests::example};
    use crate::rows::tests::ladder;

    /// A ladder of the settings of full tracing and of adaptive sampling, each given by its times and its PSNR.
    fn measured(full: &[(&[f64], f64)], adaptive: &[(&[f64], f64)]) -> Measured {
        let Measured { mut job, identities, converged, .. } = ladder();
        let chosen = |wanted: fn(&Rung) -> bool, count| {
            job.rungs.iter().filter(|rung| wanted(rung)).take(count).cloned().collect::<Vec<_>>()
        };
        let rungs = [chosen(is_full, full.len()), chosen(is_adaptive, adaptive.len())].concat();
        let record = |&(times, psnr_db): &(&[f64], f64)| {
            let of = example("r", 1.0, Some(psnr_db));
            let frames = times.iter().map(|ms| Frame { ms: *ms, ..of.frames[0].clone() }).collect();
            Record { frames, ..of }
        };
        let records = full.iter().chain(adaptive).map(record).collect();
        job.rungs = rungs;
        Measured { job, identities, converged, records }
    }

    #[test]
    fn half_the_time_at_every_error_is_half() {
        let full: &[(&[f64], f64)] = &[(&[10.0, 20.0], 30.0), (&[40.0, 80.0], 40.0)];
        let adaptive: &[(&[f64], f64)] = &[(&[10.0, 20.0], 35.0), (&[20.0, 40.0], 40.0)];
        let compared = EqualError::of(&measured(full, adaptive)).unwrap();
        assert_eq!(compared.psnr_db, [35.0, 40.0]);
        // At 35 dB full tracing takes the geometric mean of 10 and 40.
        for ratio in &compared.log_ratios {
            assert!((ratio.exp() - 0.5).abs() < 1e-12, "{compared:?}");
        }
        let ratio = compared.ratio();
        assert!((ratio.mean - 0.5).abs() < 1e-12 && ratio.interval.is_some());
    }

    #[test]
    fn settings_that_others_beat_do_not_count() {
        let full: &[(&[f64], f64)] = &[(&[10.0], 30.0), (&[40.0], 40.0)];
        let adaptive: &[(&[f64], f64)] = &[(&[5.0], 30.0), (&[99.0], 32.0), (&[20.0], 40.0)];
        let compared = EqualError::of(&measured(full, adaptive)).unwrap();
        assert!((compared.ratio().mean - 0.5).abs() < 1e-12, "{compared:?}");
        assert_eq!(compared.ratio().interval, None, "of one frame");
    }

    #[test]
    fn the_mean_is_over_decibels() {
        // Twice the time at 30 dB, half of it at 40 dB, in between the logarithm is linear: 1 on average.
        let full: &[(&[f64], f64)] = &[(&[10.0], 30.0), (&[100.0], 40.0)];
        let adaptive: &[(&[f64], f64)] = &[(&[20.0], 30.0), (&[50.0], 40.0)];
        let compared = EqualError::of(&measured(full, adaptive)).unwrap();
        assert!((compared.ratio().mean - 1.0).abs() < 1e-12, "{compared:?}");
    }

    #[test]
    fn errors_that_only_one_reaches_are_not_compared() {
        let full: &[(&[f64], f64)] = &[(&[10.0], 30.0), (&[100.0], 40.0)];
        let reason = EqualError::of(&measured(full, &[(&[1.0], 41.0)])).unwrap_err();
        assert_eq!(reason, "full tracing reaches 30.0 to 40.0 dB, adaptive sampling 41.0 to 41.0 dB");
        let touching = EqualError::of(&measured(full, &[(&[50.0], 40.0)])).unwrap();
        assert!((touching.ratio().mean - 0.5).abs() < 1e-12);
        let equal = EqualError::of(&measured(full, &[(&[1.0], f64::INFINITY)]));
        assert_eq!(equal.unwrap_err(), "no finite PSNR to compare");
    }
}
