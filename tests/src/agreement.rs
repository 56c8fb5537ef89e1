//! Compares f32 answers with the f64 reference, which is evaluated again with displaced numbers where they
//! differ. An answer is either the same; or sensitive: the reference itself moves as far if rounding
//! displaces it; or the other outcome of a tie, which the displaced reference gives as well; or wrong. All
//! are counted, none is masked.

use std::{collections::BTreeMap, iter, num::NonZero, thread};

use glam::DVec3;
use glimpse::reference::{Cause, Rounding};

use crate::note;

/// Tolerance of radiance, relative to the larger of itself and [`DIM`]: 2^-13, a thousand roundings.
pub const RADIANCE: f64 = 1.0 / 8192.0;
/// Radiance below which the tolerance is absolute.
pub const DIM: f64 = 0.1;

/// Number of tolerances (5 % of a radiance) beyond which answers count as different.
const SMOOTH: f64 = 400.0;

/// Number of evaluations of the displaced reference before a cause is ruled out.
fn tries(cause: Cause) -> u64 {
    if cause == Cause::Several { 512 } else { 24 }
}

/// An answer: labels that must be equal, and values with tolerances.
#[derive(Clone, Debug)]
pub struct Answer<const N: usize> {
    /// Objects, bits and other discrete results.
    pub labels: [u32; 2],
    /// Values compared with a tolerance.
    pub values: [f64; N],
    /// Tolerance of each value.
    pub tolerances: [f64; N],
}

impl Answer<3> {
    /// An answer of three channels of linear radiance.
    #[must_use]
    pub fn radiance(color: DVec3) -> Self {
        let tolerance = RADIANCE * color.abs().max_element().max(DIM);
        Self { labels: [0; 2], values: color.to_array(), tolerances: [tolerance; 3] }
    }
}

impl<const N: usize> Answer<N> {
    /// Largest difference of the values in units of their tolerances; infinite if labels differ or a value is
    /// NaN.
    fn distance(&self, exact: &Self) -> f64 {
        if self.labels != exact.labels {
            return f64::INFINITY;
        }
        let each = (0..N).map(|i| {
            let (found, right) = (self.values[i], exact.values[i]);
            if found == right { 0.0 } else { (found - right).abs() / exact.tolerances[i] }
        });
        each.map(|d| if d.is_nan() { f64::INFINITY } else { d }).fold(0.0, f64::max)
    }
}

/// Whether an answer lies between displaced answers that are nearly the same as it.
fn surrounded<const N: usize>(
    found: &Answer<N>,
    exact: &Answer<N>,
    displaced: impl IntoIterator<Item = Answer<N>>,
) -> bool {
    let (mut low, mut high) = ([f64::INFINITY; N], [f64::NEG_INFINITY; N]);
    iter::once(exact.clone()).chain(displaced).any(|other| {
        if found.distance(&other) > SMOOTH {
            return false;
        }
        for i in 0..N {
            low[i] = low[i].min(other.values[i] - other.tolerances[i]);
            high[i] = high[i].max(other.values[i] + other.tolerances[i]);
        }
        (0..N).all(|i| found.values[i] == other.values[i] || (low[i]..=high[i]).contains(&found.values[i]))
    })
}

/// The result of one comparison.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Within the tolerance; the difference in units of the tolerance.
    Same(f64),
    /// Between displaced answers, and near the exact one.
    Sensitive,
    /// Between displaced answers, but far from the exact one: another outcome of a tie, with its cause.
    Tie(Cause),
    /// Unexplained difference, with a description.
    Wrong(String),
}

/// Compares an answer with the reference, which is evaluated again with displaced numbers where they differ.
pub fn judge<const N: usize>(found: &Answer<N>, reference: impl Fn(&mut Rounding) -> Answer<N>) -> Outcome {
    let exact = reference(&mut Rounding::none());
    let distance = found.distance(&exact);
    if distance <= 1.0 {
        return Outcome::Same(distance);
    }
    let explained = |cause: Cause, tries: u64| {
        let displaced = (1..=tries).map(|seed| reference(&mut Rounding::of(cause, seed)));
        surrounded(found, &exact, displaced)
    };
    if let Some(cause) = Cause::ALL.into_iter().find(|cause| explained(*cause, tries(*cause))) {
        return if distance <= SMOOTH { Outcome::Sensitive } else { Outcome::Tie(cause) };
    }
    Outcome::Wrong(format!(
        "{:?} {:?}, the reference says {:?} {:?}",
        found.labels, found.values, exact.labels, exact.values
    ))
}

/// Counts of the outcomes of many comparisons.
#[derive(Debug, Default)]
pub struct Tally {
    /// Number of comparisons within the tolerance.
    pub same: usize,
    /// Number of comparisons beyond the tolerance that small changes of the input explain.
    pub sensitive: usize,
    /// Number of ties with another outcome, by cause.
    pub ties: BTreeMap<Cause, usize>,
    /// Descriptions of the unexplained differences.
    pub wrong: Vec<String>,
    /// Largest difference within the tolerance, in units of the tolerance.
    pub worst: f64,
}

impl Tally {
    /// Compares all items, on all processor cores.
    pub fn of<T: Sync>(items: &[T], judge: impl Fn(&T) -> Outcome + Sync) -> Self {
        let workers = thread::available_parallelism().map_or(2, NonZero::get);
        let mut tally = Self::default();
        // Interleaved among threads, as neighbours cost about the same.
        let share = |w| items.iter().skip(w).step_by(workers).map(&judge).collect::<Vec<_>>();
        thread::scope(|scope| {
            let share = &share;
            let threads: Vec<_> = (0..workers).map(|w| scope.spawn(move || share(w))).collect();
            threads.into_iter().flat_map(|t| t.join().expect("a judge")).for_each(|o| tally.add(o));
        });
        tally
    }

    fn add(&mut self, outcome: Outcome) {
        match outcome {
            Outcome::Same(distance) => {
                self.same += 1;
                self.worst = self.worst.max(distance);
            }
            Outcome::Sensitive => self.sensitive += 1,
            Outcome::Tie(cause) => *self.ties.entry(cause).or_default() += 1,
            Outcome::Wrong(line) => self.wrong.push(line),
        }
    }

    /// Prints the counts, and asserts that nothing is wrong and that the shares of sensitive answers and of
    /// ties are at most the given ones.
    ///
    /// # Panics
    /// If the assertion fails.
    pub fn check(&self, what: &str, [sensitive_share, tie_share]: [f64; 2]) {
        let (sensitive, ties) = (self.sensitive, self.ties.values().sum::<usize>());
        let total = self.same + sensitive + ties + self.wrong.len();
        note(&format!(
            "{what}: {total} compared, {} same (largest difference {:.2} of the tolerance), {sensitive} sensitive, \
             {ties} ties {:?}, {} wrong",
            self.same,
            self.worst,
            self.ties,
            self.wrong.len()
        ));
        let first: Vec<_> = self.wrong.iter().take(8).map(String::as_str).collect();
        assert!(
            self.wrong.is_empty(),
            "{what}: {} wrong, the first:\n{}",
            self.wrong.len(),
            first.join("\n")
        );
        for (name, count, share) in [("sensitive", sensitive, sensitive_share), ("ties", ties, tie_share)] {
            assert!(
                count as f64 <= share * total as f64,
                "{what}: {count} of {total} {name}, {share} may be"
            );
        }
    }
}
