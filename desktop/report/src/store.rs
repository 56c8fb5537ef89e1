//! Stores measurements in files, from which an interrupted report resumes.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

use anyhow::Context;
use glimpse::{DisplayImage, Picture, to_png};
use glimpse_measure::{files, output};

use crate::identity::Fingerprint;
use crate::record::Record;

/// Subfolder of the report's folder.
const FOLDER: &str = "measured";

/// Records and pictures in files named by the fingerprints of their identities.
pub struct Store {
    folder: PathBuf,
    /// Locked while the store is open: a second run would measure the same and disturb the times.
    _lock: File,
}

impl Store {
    /// Opens the store in the report's folder and creates the folders if necessary.
    ///
    /// # Errors
    /// Fails if the path is a file or is not writable, or if another run writes there.
    pub fn open(report: &Path) -> anyhow::Result<Self> {
        let folder = report.join(FOLDER);
        for path in [report, &folder] {
            if path.exists() && !path.is_dir() {
                anyhow::bail!("cannot write into {}: expected a folder, found a file", path.display());
            }
        }
        fs::create_dir_all(&folder)
            .with_context(|| format!("cannot make the folder {}", folder.display()))?;
        files::check(&[&folder.join("probe.json")], &[])?;
        let path = folder.join("lock");
        let failed = || format!("cannot write {}", path.display());
        let lock = File::create(&path).with_context(failed)?;
        match lock.try_lock() {
            Ok(()) => Ok(Self { folder, _lock: lock }),
            Err(TryLockError::WouldBlock) => {
                anyhow::bail!("cannot write into {}: another report is being made there", report.display())
            }
            Err(TryLockError::Error(error)) => Err(error).with_context(failed),
        }
    }

    /// Reads the record of an identity. A file that is damaged or belongs to another identity counts as
    /// missing.
    pub fn record(&self, identity: &str) -> Option<Record> {
        let path = self.path(identity, "json");
        let parse = |bytes: Vec<u8>| {
            let record: Record = serde_json::from_slice(&bytes).context("expected a measurement")?;
            anyhow::ensure!(record.identity == identity, "expected this measurement, found another");
            Ok(record)
        };
        kept(&path, parse)
    }

    /// Stores a record under its identity.
    pub fn keep(&self, record: &Record) -> anyhow::Result<()> {
        files::write(&self.path(&record.identity, "json"), output::json(record)?.as_bytes())
    }

    /// Reads the picture of an identity; a picture of another size counts as missing.
    pub fn picture(&self, identity: &str, [width, height]: [u32; 2]) -> Option<DisplayImage> {
        let path = self.path(identity, "png");
        let parse = |bytes: Vec<u8>| {
            let picture = Picture::decode(&bytes).context("expected a picture")?.into_display();
            anyhow::ensure!(
                picture.dimensions() == (width, height),
                "expected {width}x{height} pixels, found {}x{}",
                picture.width(),
                picture.height()
            );
            Ok(picture)
        };
        kept(&path, parse)
    }

    /// Stores a picture under an identity.
    pub fn keep_picture(&self, identity: &str, picture: &DisplayImage) -> anyhow::Result<()> {
        files::write(&self.path(identity, "png"), &to_png(picture)?)
    }

    fn path(&self, identity: &str, ending: &str) -> PathBuf {
        self.folder.join(format!("{}.{ending}", Fingerprint::new().and(identity.as_bytes())))
    }
}

fn kept<T>(path: &Path, parse: impl FnOnce(Vec<u8>) -> anyhow::Result<T>) -> Option<T> {
    if !path.exists() {
        return None;
    }
    match files::read(path).and_then(parse) {
        Ok(found) => Some(found),
        Err(error) => {
            log::warn!("{} is made again: {error:#}", path.display());
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use glimpse::Missing;

    use super::*;
    use crate::record::tests::example;

    #[test]
    fn a_folder_is_one_runs_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let message = Store::open(folder.path()).err().unwrap().to_string();
        assert!(message.ends_with("another report is being made there"), "{message}");
        drop(store);
        Store::open(folder.path()).unwrap();
    }

    #[test]
    fn what_is_kept_comes_back_under_its_identity_alone() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(&folder.path().join("new/report")).unwrap();
        let record = example("one", 10.0, Some(40.0));
        assert!(store.record("one").is_none());
        store.keep(&record).unwrap();
        assert_eq!(store.record("one"), Some(record));
        assert!(store.record("two").is_none());
        let picture = DisplayImage::from_raw(2, 1, vec![1, 2, 3, 255, 4, 5, 6, 255]).unwrap();
        store.keep_picture("one", &picture).unwrap();
        assert_eq!(store.picture("one", [2, 1]), Some(picture));
        assert!(store.picture("one", [1, 2]).is_none() && store.picture("two", [2, 1]).is_none());
    }

    #[test]
    fn missing_objects_are_kept_and_files_that_do_not_speak_of_them_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let missing =
            Missing { objects_shown: 3, objects_lost: 1, mean_share_lost: 0.5, ..Missing::default() };
        let record = Record { missing: Some(missing), ..example("one", 10.0, Some(40.0)) };
        store.keep(&record).unwrap();
        assert_eq!(store.record("one"), Some(record.clone()));
        let mut older = serde_json::to_value(&record).unwrap();
        older.as_object_mut().unwrap().remove("missing").unwrap();
        fs::write(store.path("one", "json"), older.to_string()).unwrap();
        assert_eq!(store.record("one"), Some(Record { missing: None, ..record }));
    }

    #[test]
    fn broken_files_are_as_good_as_none() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let record = example("one", 10.0, None);
        store.keep(&record).unwrap();
        let other = store.path("two", "json");
        fs::copy(store.path("one", "json"), &other).unwrap();
        assert!(store.record("two").is_none(), "another's measurement");
        for broken in ["", "{", "[1]", "{\"identity\": \"one\"}"] {
            fs::write(store.path("one", "json"), broken).unwrap();
            assert!(store.record("one").is_none(), "{broken}");
        }
        fs::write(store.path("one", "png"), "GIF89a").unwrap();
        assert!(store.picture("one", [1, 1]).is_none());
        fs::remove_file(&other).unwrap();
        fs::create_dir(&other).unwrap();
        assert!(store.record("two").is_none(), "a folder");
    }

    #[test]
    fn a_file_is_no_folder() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("taken");
        fs::write(&path, b"").unwrap();
        let message = format!("{:#}", Store::open(&path).err().unwrap());
        assert!(message.contains("taken: expected a folder, found a file"), "{message}");
        let below = format!("{:#}", Store::open(&path.join("below")).err().unwrap());
        assert!(below.contains("taken/below"), "{below}");
    }
}
