//! Reads and writes whole files. A write replaces the file atomically: it succeeds in full or leaves the old
//! content. The path `-` is the standard input of what is read, and the standard output of what is written.

use std::fs;
use std::io::{self, IsTerminal, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use anyhow::Context;
use tempfile::NamedTempFile;

use crate::output;

/// The longest file that is read, in bytes: a `.glb` states its length in 32 bits.
const MAX_BYTES: u64 = u32::MAX as u64;

/// The standard input once it was read, as it can be read once and a scene may be loaded again.
static STANDARD_INPUT: Mutex<Option<Vec<u8>>> = Mutex::new(None);

/// Whether the path stands for the standard input or output.
pub fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// The most links that lead to a file, as on Linux.
const MAX_LINKS: usize = 40;

/// Checks before long work that [`write()`] can succeed for each output. Fails if a path cannot be written, if
/// two outputs are the same file, or if an output is one of the inputs.
pub fn check(outputs: &[&Path], inputs: &[&Path]) -> anyhow::Result<()> {
    let inputs = inputs.iter().filter(|input| !is_standard(input));
    let mut taken: Vec<_> = inputs.map(|input| resolved(input)).collect();
    for path in outputs {
        if is_standard(path) {
            if taken.iter().any(|taken| is_standard(taken)) {
                anyhow::bail!("cannot write -: the command names the standard output twice");
            }
            taken.push(path.to_path_buf());
            continue;
        }
        let resolved = resolved(path);
        writable(&resolved)?;
        if taken.contains(&resolved) && !is_special(&resolved) {
            anyhow::bail!("cannot write {}: the command names that file twice", path.display());
        }
        taken.push(resolved);
    }
    Ok(())
}

fn writable(path: &Path) -> anyhow::Result<()> {
    if is_special(path) {
        return Ok(());
    }
    if path.is_dir() {
        anyhow::bail!("cannot write {}: it is a folder", path.display());
    }
    nameable(path)?;
    // Renaming over a read-only file would succeed, against the intent of its owner.
    if fs::metadata(path).is_ok_and(|m| m.permissions().readonly()) {
        anyhow::bail!("cannot write {}: it is read-only", path.display());
    }
    temporary_beside(path).map(drop)
}

/// Fails where no file can have the name: it is too long, or a link that leads to itself.
fn nameable(path: &Path) -> anyhow::Result<()> {
    match fs::metadata(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(error).with_context(|| format!("cannot write {}", path.display()))
        }
        _ => Ok(()),
    }
}

/// Writes the file in one step, by renaming a temporary file: readers see the old content or the new, never a
/// part.
pub fn write(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    if is_standard(path) {
        return output::write_out(bytes);
    }
    let path = resolved(path);
    let failed = || format!("cannot write {}", path.display());
    if is_special(&path) {
        return fs::write(&path, bytes).with_context(failed);
    }
    nameable(&path)?;
    let mut file = temporary_beside(&path)?;
    file.write_all(bytes).and_then(|()| file.as_file().sync_all()).with_context(failed)?;
    file.persist(&path).map_err(|e| e.error).with_context(failed)?;
    Ok(())
}

/// Reads a whole file.
pub fn read(path: &Path) -> anyhow::Result<Vec<u8>> {
    readable(path)?;
    if is_standard(path) {
        return standard_input();
    }
    fs::read(path).with_context(|| format!("cannot read {}", path.display()))
}

/// Fails for folders, pipes, devices and files longer than 4 GiB, which [`read`] must not be given.
pub fn readable(path: &Path) -> anyhow::Result<()> {
    let failed = || format!("cannot read {}", path.display());
    if is_standard(path) {
        if io::stdin().is_terminal() {
            anyhow::bail!("{}: expected a file or a pipe as standard input, found a terminal", failed());
        }
        return Ok(());
    }
    let about = fs::metadata(path).with_context(failed)?;
    if !about.is_file() {
        let kind = if about.is_dir() { "folder" } else { "pipe or a device" };
        anyhow::bail!("{}: expected a file, found a {kind}", failed());
    }
    if about.len() > MAX_BYTES {
        anyhow::bail!("{}: expected at most {MAX_BYTES} bytes, found {}", failed(), about.len());
    }
    Ok(())
}

fn standard_input() -> anyhow::Result<Vec<u8>> {
    let mut kept = STANDARD_INPUT.lock().map_err(|_| anyhow::anyhow!("cannot read the standard input"))?;
    if let Some(bytes) = &*kept {
        return Ok(bytes.clone());
    }
    let mut bytes = Vec::new();
    let read = io::stdin().lock().take(MAX_BYTES + 1).read_to_end(&mut bytes);
    read.context("cannot read the standard input")?;
    if bytes.len() as u64 > MAX_BYTES {
        anyhow::bail!("cannot read the standard input: expected at most {MAX_BYTES} bytes");
    }
    Ok(kept.insert(bytes).clone())
}

/// Resolves symbolic links, so that writing replaces the target and keeps the link. The file itself need not exist, nor
/// need the target of a link.
fn resolved(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..MAX_LINKS {
        match fs::read_link(&path) {
            Ok(target) => path = folder(&path).join(target),
            Err(_) => break,
        }
    }
    let new = || Some(fs::canonicalize(folder(&path)).ok()?.join(path.file_name()?));
    fs::canonicalize(&path).ok().or_else(new).unwrap_or(path)
}

fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Whether the path is a pipe or a device, which must be written to in place instead of being replaced.
fn is_special(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir())
}

fn temporary_beside(path: &Path) -> anyhow::Result<NamedTempFile> {
    let folder = folder(path);
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
    // The error's own text names the temporary file, which means nothing to the user.
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
        check(&[&path], &[Path::new("builtin:room")]).unwrap();
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
        for refused in [writable(&path), write(&path, b"")] {
            let message = format!("{:#}", refused.unwrap_err());
            assert!(message.contains("missing/a.png: its folder does not exist"), "{message}");
        }
        assert!(writable(folder.path()).unwrap_err().to_string().contains("it is a folder"));
        assert!(write(folder.path(), b"").is_err());
        assert!(folder.path().is_dir());
    }

    #[test]
    fn no_file_is_written_twice_nor_over_the_input() {
        let folder = tempfile::tempdir().unwrap();
        let [scene, other, picture, new] =
            ["scene.glb", "tex.png", "a.png", "new.json"].map(|n| folder.path().join(n));
        fs::write(&scene, b"").unwrap();
        fs::write(&picture, b"").unwrap();
        check(&[&picture, &new], &[&scene]).unwrap();
        let around = folder.path().join("../").join(folder.path().file_name().unwrap()).join("new.json");
        for outputs in [[&picture, &scene], [&picture, &picture], [&new, &new], [&new, &around]] {
            let message = check(&outputs.map(PathBuf::as_path), &[&other, &scene]).unwrap_err().to_string();
            assert!(message.contains("twice"), "{message}");
        }
        check(&[Path::new("/dev/null"), Path::new("/dev/null")], &[&scene]).unwrap();
    }

    #[test]
    fn what_is_no_file_is_not_read() {
        let folder = tempfile::tempdir().unwrap();
        let message = read(folder.path()).unwrap_err().to_string();
        assert!(message.contains("found a folder"), "{message}");
        let long = folder.path().join("long.glb");
        fs::File::create(&long).unwrap().set_len(MAX_BYTES + 1).unwrap();
        let message = read(&long).unwrap_err().to_string();
        assert!(message.contains("found 4294967296"), "{message}");
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
    fn a_link_to_a_file_that_is_not_there_yet_stays_a_link() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("sub")).unwrap();
        let [link, second, target] = ["link", "second", "sub/target"].map(|name| folder.path().join(name));
        symlink("sub/target", &link).unwrap();
        symlink("link", &second).unwrap();
        check(&[&second], &[]).unwrap();
        let message = check(&[&second, &target], &[]).unwrap_err().to_string();
        assert!(message.contains("twice"), "{message}");
        write(&second, b"new").unwrap();
        assert!([&link, &second].iter().all(|link| fs::symlink_metadata(link).unwrap().is_symlink()));
        assert_eq!(read(&target).unwrap(), b"new");
        symlink("gone/target", folder.path().join("lost")).unwrap();
        assert!(check(&[&folder.path().join("lost")], &[]).is_err());
        symlink("circle", folder.path().join("circle")).unwrap();
        assert!(check(&[&folder.path().join("circle")], &[]).is_err());
        assert!(write(&folder.path().join("circle"), b"").is_err());
    }

    #[test]
    fn a_name_that_is_too_long_is_refused_before_it_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a".repeat(300) + ".png");
        let message = format!("{:#}", check(&[&path], &[]).unwrap_err());
        assert!(message.contains("too long"), "{message}");
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_written_to_and_not_replaced() {
        write(Path::new("/dev/null"), b"x").unwrap();
        assert!(is_special(Path::new("/dev/null")));
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_not_read_nor_a_read_only_file_replaced() {
        let message = read(Path::new("/dev/zero")).unwrap_err().to_string();
        assert!(message.contains("found a pipe or a device"), "{message}");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        fs::write(&path, b"precious").unwrap();
        let mut permissions = fs::metadata(&path).unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&path, permissions).unwrap();
        let message = writable(&path).unwrap_err().to_string();
        assert!(message.contains("a.png: it is read-only"), "{message}");
    }
}
