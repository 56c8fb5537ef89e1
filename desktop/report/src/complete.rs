//! Completes partial measurements with interleaved frames, and stores each result as soon as it exists.

use crate::record::{Frame, Record};
use crate::store::Store;

/// Completes the record of each setting and times frames until it has `frames` of them. `open` warms up the
/// setting of an index, `look` makes its record, `time` times a frame. The settings take turns frame by
/// frame, so that changes in the device's load affect all of them alike.
pub fn complete<S>(
    store: &Store,
    recalled: Vec<Option<Record>>,
    frames: usize,
    open: impl Fn(usize) -> anyhow::Result<S>,
    look: impl Fn(usize, &mut S) -> anyhow::Result<Record>,
    time: impl Fn(usize, &mut S) -> anyhow::Result<Frame>,
) -> anyhow::Result<Vec<Record>> {
    let mut records = Vec::with_capacity(recalled.len());
    let mut unfinished = Vec::new();
    for (index, recalled) in recalled.into_iter().enumerate() {
        let record = match recalled {
            Some(record) if record.frames.len() >= frames => record,
            recalled => {
                let mut setting = open(index)?;
                let record = match recalled {
                    Some(record) => record,
                    None => look(index, &mut setting)?,
                };
                store.keep(&record)?;
                unfinished.push((index, setting));
                record
            }
        };
        records.push(record);
    }
    while !unfinished.is_empty() {
        for (index, setting) in &mut unfinished {
            let record: &mut Record = &mut records[*index];
            record.frames.push(time(*index, setting)?);
            store.keep(record)?;
        }
        unfinished.retain(|(index, _)| records[*index].frames.len() < frames);
    }
    // Reads the records back, as a float may differ in its last bit after storing: an interrupted report
    // equals an uninterrupted one.
    let as_kept = |record: Record| store.record(&record.identity).unwrap_or(record);
    Ok(records.into_iter().map(as_kept).collect())
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
