//! Completes partial measurements with interleaved frames, and stores each result as soon as it exists.

use crate::record::{Frame, Record};
use crate::store::Store;

/// The most settings that are open at a time: each holds its targets and its kernels in memory.
const OPEN: usize = 3;

/// Completes the record of each setting and times frames until it has `frames` of them. `open` warms up the
/// setting of an index, `look` makes its record, `time` times a frame, `closed` is called when a group of settings is
/// closed. Up to [`OPEN`] settings take turns frame by frame, and groups are taken from all over the list, so that
/// changes in the device's load affect all of them, and all families of settings, alike.
pub fn complete<S>(
    store: &Store,
    recalled: Vec<Option<Record>>,
    frames: usize,
    open: impl Fn(usize) -> anyhow::Result<S>,
    look: impl Fn(usize, &mut S) -> anyhow::Result<Record>,
    time: impl Fn(usize, &mut S) -> anyhow::Result<Frame>,
    closed: impl Fn(),
) -> anyhow::Result<Vec<Record>> {
    let mut records = recalled;
    let is_lacking =
        |record: &Option<Record>| record.as_ref().is_none_or(|record| record.frames.len() < frames);
    let lacking: Vec<usize> = (0..records.len()).filter(|index| is_lacking(&records[*index])).collect();
    let groups = lacking.len().div_ceil(OPEN);
    for first in 0..groups {
        let mut unfinished = Vec::new();
        for index in lacking.iter().copied().skip(first).step_by(groups) {
            let mut setting = open(index)?;
            let record = match records[index].take() {
                Some(record) => record,
                None => look(index, &mut setting)?,
            };
            store.keep(&record)?;
            unfinished.push((index, setting, record));
        }
        while !unfinished.is_empty() {
            for (index, setting, record) in &mut unfinished {
                if record.frames.len() < frames {
                    record.frames.push(time(*index, setting)?);
                    store.keep(record)?;
                }
            }
            for (index, _, record) in
                unfinished.extract_if(.., |(_, _, record)| record.frames.len() >= frames)
            {
                records[index] = Some(record);
            }
        }
        closed();
    }
    // Reads the records back, as a float may differ in its last bit after storing: an interrupted report
    // equals an uninterrupted one.
    let as_kept = |record: Record| store.record(&record.identity).unwrap_or(record);
    Ok(records.into_iter().flatten().map(as_kept).collect())
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;
    use crate::record::tests::example;

    const NAMES: [&str; 2] = ["a", "b"];

    /// Completes `a` and `b` and returns the log of calls; the frame of index `interrupted` fails.
    fn done(store: &Store, frames: usize, interrupted: usize) -> (Vec<String>, Option<Vec<Record>>) {
        let log = RefCell::new(Vec::new());
        let count = RefCell::new(0);
        let say = |what: &str, i: usize| log.borrow_mut().push(format!("{what} {}", NAMES[i]));
        let records = complete(
            store,
            NAMES.map(|name| store.record(name)).to_vec(),
            frames,
            |i| {
                say("open", i);
                Ok(())
            },
            |i, ()| {
                say("look", i);
                Ok(Record { frames: vec![], ..example(NAMES[i], 1.0, None) })
            },
            |i, ()| {
                anyhow::ensure!(*count.borrow() < interrupted, "interrupted");
                *count.borrow_mut() += 1;
                say("time", i);
                Ok(example(NAMES[i], 1.0, None).frames.remove(0))
            },
            || (),
        );
        (log.into_inner(), records.ok())
    }

    #[test]
    fn frames_are_interleaved_and_nothing_is_measured_twice() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let (log, records) = done(&store, 2, usize::MAX);
        assert_eq!(
            log,
            ["open a", "look a", "open b", "look b", "time a", "time b", "time a", "time b"]
                .map(str::to_owned)
        );
        let (again, same) = done(&store, 2, 0);
        assert!(again.is_empty(), "{again:?}");
        assert_eq!(records, same);
        let (more, _) = done(&store, 3, usize::MAX);
        assert_eq!(more, ["open a", "open b", "time a", "time b"].map(str::to_owned));
    }

    /// Every setting is completed once, in its place, however many there are, and few are open at a time.
    #[test]
    fn few_settings_are_open_at_a_time_and_groups_are_spread() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let opened = RefCell::new(vec![Vec::new()]);
        let count = 2 * OPEN + 3;
        let records = complete(
            &store,
            vec![None; count],
            2,
            |i| {
                opened.borrow_mut().last_mut().unwrap().push(i);
                Ok(())
            },
            |i, ()| Ok(Record { frames: vec![], ..example(&i.to_string(), 1.0, None) }),
            |i, ()| Ok(example(&i.to_string(), 1.0, None).frames.remove(0)),
            || opened.borrow_mut().push(Vec::new()),
        );
        let identities: Vec<_> = records.unwrap().into_iter().map(|record| record.identity).collect();
        assert_eq!(identities, (0..count).map(|i| i.to_string()).collect::<Vec<_>>());
        let groups = opened.into_inner();
        assert_eq!(groups[0], [0, 3, 6]);
        assert!(groups.len() == 4 && groups.iter().all(|group| group.len() <= OPEN), "{groups:?}");
    }

    #[test]
    fn an_interrupted_run_goes_on_where_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let (_, stopped) = done(&store, 2, 3);
        assert!(stopped.is_none());
        let (log, records) = done(&store, 2, usize::MAX);
        assert_eq!(log, ["open b", "time b"].map(str::to_owned), "three of four frames were kept");
        assert!(records.unwrap().iter().all(|r| r.frames.len() == 2));
    }
}
