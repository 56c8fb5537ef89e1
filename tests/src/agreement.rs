//! The comparison of f32 answers with the f64 reference, which is asked again with displaced numbers where they differ.
//! An answer is the same; or it is sensitive: the reference itself moves as far when rounding displaces it; or it is the
//! other answer to a tie, which the displaced reference gives too; or it is wrong. All are counted, none is masked.

use std::{collections::BTreeMap, iter, num::NonZero, thread};

use glam::DVec3;
use glimpse::reference::{Cause, Rounding};

use crate::note;

/// How far off radiance may be without an explanation, of the larger of itself and [`DIM`]: 2^-13, a thousand roundings.
pub const RADIANCE: f64 = 1.0 / 8192.0;
/// Radiance that dark is not told from black by its digits.
pub const DIM: f64 = 0.1;

/// Answers that lie farther apart than so many tolerances (5 % of a radiance) are different answers.
const SMOOTH: f64 = 400.0;

/// How often the reference is asked again before a cause is ruled out.
fn tries(cause: Cause) -> u64 {
    if cause == Cause::Several { 512 } else { 24 }
}

/// An answer to one question: what must be equal, and numbers with how far off they may be.
#[derive(Clone, Debug)]
pub struct Answer<const N: usize> {
    /// Objects, bits, whatever is right or wrong.
    pub labels: [u32; 2],
    /// Values that are compared with a tolerance.
    pub values: [f64; N],
    /// How far off each of the values may be.
    pub tolerances: [f64; N],
}

impl Answer<3> {
    /// An item of three channels of linear radiance.
    #[must_use]
    pub fn radiance(color: DVec3) -> Self {
        let tolerance = RADIANCE * color.abs().max_element().max(DIM);
        Self { labels: [0; 2], values: color.to_array(), tolerances: [tolerance; 3] }
    }
}

impl<const N: usize> Answer<N> {
    /// The largest difference of the values in units of their tolerances; infinite where labels differ or something is
    /// not a number.
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

/// Whether an answer lies between displaced ones that are nearly the same as it.
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
    /// Within the tolerance, by this part of it.
    Same(f64),
    /// It lies between displaced answers, and nearly where the exact one is.
    Sensitive,
    /// It lies between displaced answers, and the exact one is another.
    Tie(Cause),
    /// The difference has no explanation; the text describes it.
    Wrong(String),
}

/// Judges an answer by the reference, which is asked again with displaced numbers where they differ.
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

/// The outcomes of many comparisons, counted.
#[derive(Debug, Default)]
pub struct Tally {
    /// Comparisons within the tolerance.
    pub same: usize,
    /// Comparisons beyond the tolerance that small changes of the input explain.
    pub sensitive: usize,
    /// Comparisons that a tie decided otherwise, by cause.
    pub ties: BTreeMap<Cause, usize>,
    /// A description of each unexplained difference.
    pub wrong: Vec<String>,
    /// The largest difference of those that are the same, in units of the tolerance.
    pub worst: f64,
}

impl Tally {
    /// Judges all items on all processor cores.
    pub fn of<T: Sync>(items: &[T], judge: impl Fn(&T) -> Outcome + Sync) -> Self {
        let workers = thread::available_parallelism().map_or(2, NonZero::get);
        let mut tally = Self::default();
        // Interleaved: neighbours cost about the same.
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

    /// Says what was counted, and insists that nothing is wrong and that no larger shares than these are sensitive and
    /// ties.
    ///
    /// # Panics
    /// Where that is not so.
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
