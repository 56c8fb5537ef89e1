//! Completes partial measurements with interleaved frames, and stores each result as soon as it exists.

use crate::record::{Frame, Record};
use crate::store::Store;

/// The most settings that are open at a time: each holds its targets and its kernels in memory.
const OPEN: usize = 3;

/// Number of groups in which `lacking` settings are measured, beside a control or without one.
pub fn groups(lacking: usize, has_control: bool) -> usize {
    lacking.div_ceil(OPEN - usize::from(has_control))
}

/// How [`complete`] measures the setting of an index.
pub trait Measure {
    /// A setting that is ready to be measured.
    type Open;

    /// Makes a setting ready and warms it up.
    fn open(&self, index: usize) -> anyhow::Result<Self::Open>;
    /// Makes its record, without timed frames.
    fn look(&self, index: usize, setting: &mut Self::Open) -> anyhow::Result<Record>;
    /// Renders a frame of an open setting and measures its time.
    fn time(&self, index: usize, setting: &mut Self::Open) -> anyhow::Result<Frame>;
    /// Is told that a group of settings is open, and no earlier one. Until then both have their kernels in common.
    fn opened(&self);
}

/// Completes the record of each setting and times frames until it has `frames` of them. Up to [`OPEN`] settings take
/// turns frame by frame, and groups are taken from all over the list, so that changes in the device's load affect all of
/// them, and all families of settings, alike. A `control` stays open and takes its turn first in every round of every
/// group: its times tell how the device's speed changed between the groups.
pub fn complete<M: Measure>(
    store: &Store,
    recalled: Vec<Option<Record>>,
    frames: usize,
    control: Option<usize>,
    measure: &M,
) -> anyhow::Result<Vec<Record>> {
    let mut records = recalled;
    let is_lacking =
        |record: &Option<Record>| record.as_ref().is_none_or(|record| record.frames.len() < frames);
    let mut lacking: Vec<usize> = (0..records.len()).filter(|index| is_lacking(&records[*index])).collect();
    let mut opened = |index: usize| {
        let mut setting = measure.open(index)?;
        let record = match records[index].take() {
            Some(record) => record,
            None => measure.look(index, &mut setting)?,
        };
        store.keep(&record)?;
        anyhow::Ok(Turn { index, setting, record })
    };
    let mut control = match control.filter(|_| !lacking.is_empty()) {
        Some(index) => Some(opened(index)?),
        None => None,
    };
    lacking.retain(|index| control.as_ref().is_none_or(|control| control.index != *index));
    let mut done = Vec::new();
    let groups = groups(lacking.len(), control.is_some());
    for first in 0..groups {
        let group = lacking.iter().copied().skip(first).step_by(groups);
        let mut unfinished = group.map(&mut opened).collect::<anyhow::Result<Vec<_>>>()?;
        measure.opened();
        while !unfinished.is_empty() {
            let control_ms =
                control.as_mut().map(|control| control.take(store, measure, frames)).transpose()?;
            for turn in &mut unfinished {
                if turn.record.frames.len() < frames {
                    let frame = measure.time(turn.index, &mut turn.setting)?;
                    turn.record.frames.push(Frame { control_ms, ..frame });
                    store.keep(&turn.record)?;
                }
            }
            let finished = unfinished.extract_if(.., |turn| turn.record.frames.len() >= frames);
            done.extend(finished.map(|turn| (turn.index, turn.record)));
        }
    }
    if let Some(mut control) = control {
        while control.record.frames.len() < frames {
            control.take(store, measure, frames)?;
        }
        done.push((control.index, control.record));
    }
    for (index, record) in done {
        records[index] = Some(record);
    }
    // Reads the records back, as a float may differ in its last bit after storing: an interrupted report
    // equals an uninterrupted one.
    let as_kept = |record: Record| store.record(&record.identity).unwrap_or(record);
    Ok(records.into_iter().flatten().map(as_kept).collect())
}

/// A setting that takes its turn in every round.
struct Turn<S> {
    index: usize,
    setting: S,
    record: Record,
}

impl<S> Turn<S> {
    /// Times a frame of the control and returns its milliseconds; a record that has `frames` takes no more.
    fn take<M: Measure<Open = S>>(
        &mut self,
        store: &Store,
        measure: &M,
        frames: usize,
    ) -> anyhow::Result<f64> {
        let frame = measure.time(self.index, &mut self.setting)?;
        let ms = frame.ms;
        if self.record.frames.len() < frames {
            self.record.frames.push(Frame { control_ms: Some(ms), ..frame });
            store.keep(&self.record)?;
        }
        Ok(ms)
    }
}

#[cfg(test)]
mod tests {
    use std::cell::{Cell, RefCell};

    use super::*;
    use crate::record::tests::example;

    /// Writes a log of the calls; the frame of index `interrupted` fails. Each frame takes 1 ms more than the last.
    struct Log {
        calls: RefCell<Vec<String>>,
        timed: Cell<usize>,
        interrupted: usize,
    }

    impl Log {
        fn new(interrupted: usize) -> Self {
            Self { calls: RefCell::default(), timed: Cell::new(0), interrupted }
        }

        fn say(&self, what: &str, index: usize) {
            self.calls.borrow_mut().push(format!("{what} {index}"));
        }
    }

    impl Measure for Log {
        type Open = ();

        fn open(&self, index: usize) -> anyhow::Result<()> {
            self.say("open", index);
            Ok(())
        }

        fn look(&self, index: usize, (): &mut ()) -> anyhow::Result<Record> {
            self.say("look", index);
            Ok(Record { frames: vec![], ..example(&index.to_string(), 1.0, None) })
        }

        fn time(&self, index: usize, (): &mut ()) -> anyhow::Result<Frame> {
            anyhow::ensure!(self.timed.get() < self.interrupted, "interrupted");
            self.timed.set(self.timed.get() + 1);
            self.say("time", index);
            Ok(example("", self.timed.get() as f64, None).frames.remove(0))
        }

        fn opened(&self) {
            self.calls.borrow_mut().push("opened".to_owned());
        }
    }

    /// Completes `count` settings and returns the log of calls.
    fn done(
        store: &Store,
        count: usize,
        frames: usize,
        control: Option<usize>,
        interrupted: usize,
    ) -> (Vec<String>, Option<Vec<Record>>) {
        let log = Log::new(interrupted);
        let recalled = (0..count).map(|index| store.record(&index.to_string())).collect();
        let records = complete(store, recalled, frames, control, &log);
        (log.calls.into_inner(), records.ok())
    }

    #[test]
    fn frames_are_interleaved_and_nothing_is_measured_twice() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let (log, records) = done(&store, 2, 2, None, usize::MAX);
        assert_eq!(
            log,
            ["open 0", "look 0", "open 1", "look 1", "opened", "time 0", "time 1", "time 0", "time 1"]
        );
        let (again, same) = done(&store, 2, 2, None, 0);
        assert!(again.is_empty(), "{again:?}");
        assert_eq!(records, same);
        let (more, _) = done(&store, 2, 3, None, usize::MAX);
        assert_eq!(more, ["open 0", "open 1", "opened", "time 0", "time 1"]);
    }

    /// Every setting is completed once, in its place, however many there are, and few are open at a time.
    #[test]
    fn few_settings_are_open_at_a_time_and_groups_are_spread() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let count = 2 * OPEN + 3;
        let (log, records) = done(&store, count, 2, None, usize::MAX);
        let identities: Vec<_> = records.unwrap().into_iter().map(|record| record.identity).collect();
        assert_eq!(identities, (0..count).map(|i| i.to_string()).collect::<Vec<_>>());
        let indices = |calls: &[String]| -> Vec<String> {
            calls.iter().filter_map(|call| call.strip_prefix("open ").map(str::to_owned)).collect()
        };
        let groups: Vec<_> = log.split(|call| call == "opened").map(indices).collect();
        assert_eq!(groups[0], ["0", "3", "6"]);
        assert!(groups.len() == 4 && groups.iter().all(|group| group.len() <= OPEN), "{groups:?}");
    }

    #[test]
    fn a_control_is_timed_before_the_others_in_every_round() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let (log, records) = done(&store, 4, 1, Some(1), usize::MAX);
        let timed: Vec<_> = log.iter().filter(|call| call.starts_with("time")).collect();
        assert_eq!(timed, ["time 1", "time 0", "time 3", "time 1", "time 2"]);
        let frames: Vec<_> = records
            .unwrap()
            .iter()
            .map(|r| (r.frames.len(), r.frames[0].ms, r.frames[0].control_ms))
            .collect();
        let expected = [(2.0, 1.0), (1.0, 1.0), (5.0, 4.0), (3.0, 1.0)];
        assert_eq!(frames, expected.map(|(ms, control)| (1, ms, Some(control))));
        assert_eq!(log.iter().filter(|call| *call == "open 1").count(), 1);
        let (again, _) = done(&store, 4, 1, Some(1), 0);
        assert!(again.is_empty(), "{again:?}");
    }

    #[test]
    fn an_interrupted_run_goes_on_where_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let (_, stopped) = done(&store, 2, 2, None, 3);
        assert!(stopped.is_none());
        let (log, records) = done(&store, 2, 2, None, usize::MAX);
        assert_eq!(log, ["open 1", "opened", "time 1"], "three of four frames were kept");
        assert!(records.unwrap().iter().all(|r| r.frames.len() == 2));
    }

    #[test]
    fn an_interrupted_control_is_completed() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        done(&store, 2, 2, Some(0), 1);
        let (_, records) = done(&store, 2, 2, Some(0), usize::MAX);
        assert_eq!(records.unwrap().iter().map(|r| r.frames.len()).collect::<Vec<_>>(), [2, 2]);
    }
}
