//! Files are written whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;
use tempfile::NamedTempFile;

/// Fails where [`write`] would: long work asks first.
pub fn check(path: &Path) -> anyhow::Result<()> {
    let path = resolved(path);
    if is_special(&path) {
        return Ok(());
    }
    if path.is_dir() {
        anyhow::bail!("cannot write {}: it is a folder", path.display());
    }
    temporary_beside(&path).map(drop)
}

/// Writes the file in one step: readers see the old content or the new one, never a part.
pub fn write(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    let path = resolved(path);
    let failed = || format!("cannot write {}", path.display());
    if is_special(&path) {
        return fs::write(&path, bytes).with_context(failed);
    }
    let mut file = temporary_beside(&path)?;
    file.write_all(bytes).and_then(|()| file.as_file().sync_all()).with_context(failed)?;
    file.persist(&path).map_err(|e| e.error).with_context(failed)?;
    Ok(())
}

/// Reads a whole file.
pub fn read(path: &Path) -> anyhow::Result<Vec<u8>> {
    fs::read(path).with_context(|| format!("cannot read {}", path.display()))
}

/// Behind links: a link is kept and what it names is replaced.
fn resolved(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())
}

/// A pipe or a device cannot be replaced by a file.
fn is_special(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir())
}

fn temporary_beside(path: &Path) -> anyhow::Result<NamedTempFile> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        anyhow::bail!("cannot write {}: its folder does not exist", path.display());
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".glimpse-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    // The error's own text speaks of the temporary file, which nobody knows.
    let temporary = builder.tempfile_in(folder).map_err(|error| io::Error::from(error.kind()));
    temporary.with_context(|| format!("cannot write {} into its folder", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn writing_replaces_and_leaves_nothing_else_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        check(&path).unwrap();
        assert!(names(folder.path()).is_empty(), "checking leaves nothing");
        write(&path, b"one").unwrap();
        write(&path, b"two").unwrap();
        assert_eq!(read(&path).unwrap(), b"two");
        assert_eq!(names(folder.path()), ["a.png"]);
    }

    #[test]
    fn a_missing_folder_and_a_folder_as_target_are_refused_by_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("missing/a.png");
        for refused in [check(&path), write(&path, b"")] {
            let message = format!("{:#}", refused.unwrap_err());
            assert!(message.contains("missing/a.png: its folder does not exist"), "{message}");
        }
        assert!(check(folder.path()).unwrap_err().to_string().contains("it is a folder"));
        assert!(write(folder.path(), b"").is_err());
        assert!(folder.path().is_dir());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_kept_and_a_file_is_readable_for_others() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, b"old").unwrap();
        let expected = fs::metadata(&file).unwrap().permissions().mode();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write(&link, b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(read(&file).unwrap(), b"new");
        assert_eq!(fs::metadata(&file).unwrap().permissions().mode(), expected);
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_written_to_and_not_replaced() {
        write(Path::new("/dev/null"), b"x").unwrap();
        assert!(is_special(Path::new("/dev/null")));
    }
}
