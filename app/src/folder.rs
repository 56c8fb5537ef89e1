//! Folders of scenes, for systems that have no file dialog.

use std::{
    fs::DirEntry,
    io,
    path::{Path, PathBuf},
};

/// What of a folder can be opened.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Folder {
    /// Absolute path of the folder.
    pub path: PathBuf,
    /// Folders, then scenes (`.glb`, `.gltf`), each in the order of their names, without hidden ones (`.name`).
    pub entries: Vec<FolderEntry>,
    /// Why it could not be read.
    pub problem: Option<String>,
}

/// A folder or a scene in a folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FolderEntry {
    /// Name for display, with U+FFFD for what is not UTF-8.
    pub name: String,
    /// Absolute path of the folder or of the scene's file.
    pub path: PathBuf,
    /// Whether it is a folder.
    pub is_folder: bool,
}

impl Folder {
    /// Reads a folder; one that cannot be read has no entries and the reason.
    #[must_use]
    pub fn read(path: &Path) -> Self {
        let absolute = path.canonicalize().or_else(|_| std::path::absolute(path));
        let path = absolute.unwrap_or_else(|_| path.to_owned());
        let (entries, problem) = match entries(&path) {
            Ok(entries) => (entries, None),
            Err(error) => (Vec::new(), Some(format!("cannot read {}: {error}", path.display()))),
        };
        Self { path, entries, problem }
    }
}

fn entries(folder: &Path) -> io::Result<Vec<FolderEntry>> {
    let mut entries = Vec::new();
    for entry in folder.read_dir()? {
        entries.extend(openable(&entry?));
    }
    entries.sort_by_cached_key(|entry| (!entry.is_folder, entry.name.to_lowercase(), entry.path.clone()));
    Ok(entries)
}

/// The entry, unless it is hidden, or neither a folder nor a scene. Links are what they lead to; one that leads nowhere is
/// none of both.
fn openable(entry: &DirEntry) -> Option<FolderEntry> {
    let path = entry.path();
    let kind = path.metadata().ok()?;
    let name = entry.file_name().to_string_lossy().replace(char::is_control, " ");
    let is_folder = kind.is_dir();
    let is_scene = || {
        let extension = path.extension().and_then(|extension| extension.to_str());
        extension.is_some_and(|extension| ["glb", "gltf"].iter().any(|e| extension.eq_ignore_ascii_case(e)))
    };
    let is_shown = !name.starts_with('.') && (is_folder || kind.is_file() && is_scene());
    is_shown.then_some(FolderEntry { name, path, is_folder })
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// A folder of a test's own, removed when dropped.
    struct Scratch(PathBuf);

    impl Scratch {
        fn new(test: &str) -> Self {
            let path = std::env::temp_dir().join(format!("glimpse-{test}-{}", std::process::id()));
            fs::create_dir(&path).expect("a folder");
            Self(path.canonicalize().expect("a path"))
        }
    }

    impl Drop for Scratch {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    fn names(folder: &Folder) -> Vec<&str> {
        folder.entries.iter().map(|entry| entry.name.as_str()).collect()
    }

    #[test]
    fn folders_come_before_scenes_and_nothing_else_is_listed() {
        let scratch = Scratch::new("list");
        for folder in ["b", "A", ".hidden", "c.glb"] {
            fs::create_dir(scratch.0.join(folder)).expect("a folder");
        }
        for file in ["z.glb", "Y.GLTF", ".x.glb", "w.png", "glb", "v\n.glb"] {
            fs::write(scratch.0.join(file), "").expect("a file");
        }
        let folder = Folder::read(&scratch.0.join("b/.."));
        assert_eq!((folder.path.as_path(), &folder.problem), (scratch.0.as_path(), &None));
        assert_eq!(names(&folder), ["A", "b", "c.glb", "v .glb", "Y.GLTF", "z.glb"]);
        assert_eq!(folder.entries.iter().filter(|entry| entry.is_folder).count(), 3);
    }

    #[cfg(unix)]
    #[test]
    fn names_that_are_not_utf8_are_listed_and_found_again() {
        use std::os::unix::{ffi::OsStrExt, fs::symlink};
        let scratch = Scratch::new("bytes");
        let file = scratch.0.join(std::ffi::OsStr::from_bytes(b"a\xff.glb"));
        fs::write(&file, "").expect("a file");
        symlink("nowhere.glb", scratch.0.join("dangling.glb")).expect("a link");
        symlink(&file, scratch.0.join("link.glb")).expect("a link");
        let folder = Folder::read(&scratch.0);
        assert_eq!(names(&folder), ["a\u{fffd}.glb", "link.glb"]);
        assert_eq!(folder.entries[0].path, file);
    }

    #[test]
    fn what_cannot_be_read_says_why() {
        let scratch = Scratch::new("unreadable");
        for name in ["missing", "file.glb"] {
            let path = scratch.0.join(name);
            if name == "file.glb" {
                fs::write(&path, "").expect("a file");
            }
            let folder = Folder::read(&path);
            let problem = folder.problem.expect("a reason");
            assert!(folder.entries.is_empty() && folder.path == path, "{name}");
            assert!(problem.starts_with(&format!("cannot read {}: ", path.display())), "{problem}");
        }
    }
}
