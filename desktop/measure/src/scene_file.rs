//! Loads a scene by its name on the command line: `builtin:NAME` or a glTF file.

use std::ffi::{OsStr, OsString};
use std::path::{Component, Path, PathBuf};

use anyhow::Context;
use glimpse::Scene;
use glimpse::options::{similar, suggestion};
use glimpse::scene::{BUILTIN_NAMES, ImportOptions, NotShown, builtin};

use crate::files;

/// Fails early, without reading any content, where [`load`] cannot succeed; called before long work.
pub fn check(name: impl AsRef<Path>) -> anyhow::Result<()> {
    let path = name.as_ref();
    if let Some(builtin_name) = builtin_name(path) {
        return check_builtin(builtin_name);
    }
    if files::is_standard(path) {
        return files::readable(path);
    }
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    if !matches!(ending.as_deref(), Some("glb" | "gltf")) {
        let name = path.display().to_string();
        let builtin = name.split_once(':').and_then(|(prefix, _)| similar(prefix, ["builtin"]));
        let meant = builtin.map_or("", |_| " (did you mean builtin:?)");
        let expected = format!("a .glb or .gltf file, or builtin:NAME{meant}");
        return Err(glimpse::Error::setting("scene", expected, name).into());
    }
    files::readable(path)
}

/// Loads `builtin:NAME`, a `.glb`, or a `.gltf` with the files that it names beside it. `-` is either of both on the
/// standard input, with its files in the working folder.
pub fn load(name: impl AsRef<Path>) -> anyhow::Result<Scene> {
    load_seen(name, &ImportOptions::default(), &mut |_, _| ())
}

/// Loads a scene as [`load`] does, and passes the path and the bytes of every file read to `seen`; for a built-in scene,
/// its name. Without a budget of memory an import may take half of what is available.
pub fn load_seen(
    name: impl AsRef<Path>,
    options: &ImportOptions<'_>,
    seen: &mut dyn FnMut(&Path, &[u8]),
) -> anyhow::Result<Scene> {
    let path = name.as_ref();
    check(path)?;
    if let Some(scene) = builtin_name(path).and_then(builtin) {
        if let Some(variant) = options.variant {
            let expected = "none, as built-in scenes have no variants";
            return Err(glimpse::Error::setting("variant", expected, variant).into());
        }
        seen(path, path.as_os_str().as_encoded_bytes());
        return Ok(scene);
    }
    let bytes = files::read(path)?;
    seen(path, &bytes);
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut resolve = |uri: &str| {
        let (path, bytes) = read_beside(folder, uri)?;
        seen(&path, &bytes);
        Ok(bytes)
    };
    let memory = options.memory.or_else(|| available_memory().map(|bytes| bytes / 2));
    Scene::from_gltf_with(&bytes, &mut resolve, &ImportOptions { memory, ..*options })
        .with_context(|| path.display().to_string())
}

/// The name of a built-in scene.
fn builtin_name(path: &Path) -> Option<&str> {
    path.to_str()?.strip_prefix("builtin:")
}

/// Fails where the import of a scene left something out, replaced it or cannot show it.
pub fn check_whole(name: &Path, warnings: &[String], not_shown: &[NotShown]) -> anyhow::Result<()> {
    let not_shown = not_shown.iter().map(|not_shown| format!("not shown: {not_shown}"));
    let told: Vec<_> = warnings.iter().cloned().chain(not_shown).collect();
    if told.is_empty() {
        return Ok(());
    }
    anyhow::bail!("{}: --strict: {}", name.display(), told.join("; "))
}

/// Bytes of memory that the system can give without swapping; `None` where it does not say.
fn available_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

fn check_builtin(name: &str) -> anyhow::Result<()> {
    if BUILTIN_NAMES.contains(&name) {
        return Ok(());
    }
    let meant = suggestion(name, BUILTIN_NAMES.iter().copied());
    let expected = format!("a built-in scene{meant}; there are {}", BUILTIN_NAMES.join(", "));
    Err(glimpse::Error::setting("scene", expected, format!("builtin:{name}")).into())
}

/// Reads the file of a relative URI (RFC 3986), whose percent codes are decoded once; not every exporter encodes names,
/// so that a file of the very name counts too. Files outside the scene's folder, also where a link leads there, and other
/// machines are refused, as scenes may come from untrusted sources.
fn read_beside(folder: &Path, uri: &str) -> Result<(PathBuf, Vec<u8>), String> {
    let decoded = percent_decoded(uri);
    let paths = [decoded.as_os_str(), uri.as_ref()].map(|name| below(name).map(|path| folder.join(path)));
    let there = paths.iter().flatten().find(|path| path.exists());
    let path = there.or(paths[0].as_ref()).ok_or_else(|| {
        format!("expected a file in the scene's folder or below it, found `{}`", decoded.display())
    })?;
    if leads_outside(folder, path) {
        let expected =
            "expected a file in the scene's folder or below it, found a link that leads elsewhere:";
        return Err(format!("{expected} `{}`", decoded.display()));
    }
    let bytes = files::read(path).map_err(|error| format!("{error:#}"))?;
    Ok((path.clone(), bytes))
}

/// Whether links lead from a path below a folder to a file that is not below it.
fn leads_outside(folder: &Path, path: &Path) -> bool {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    match (folder.canonicalize(), path.canonicalize()) {
        (Ok(folder), Ok(target)) => !target.starts_with(folder),
        // There is no such file, which reading it says.
        _ => false,
    }
}

/// The path below a folder that a name leads to, without its dot segments (RFC 3986, section 5.2.4); `None` where it
/// leads elsewhere: by a scheme, a root or more `..` than folders.
fn below(name: &OsStr) -> Option<PathBuf> {
    let text = name.to_string_lossy();
    let scheme = text.split_once(':').map(|(scheme, _)| scheme);
    let has_scheme = scheme
        .is_some_and(|s| !s.is_empty() && s.chars().all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c)));
    if has_scheme || text.contains('\0') {
        return None;
    }
    let mut path = PathBuf::new();
    for component in Path::new(name).components() {
        match component {
            Component::Normal(name) => path.push(name),
            Component::CurDir => {}
            Component::ParentDir if path.pop() => {}
            _ => return None,
        }
    }
    Some(path)
}

/// The name with its percent codes decoded, of which any bytes are a name where the system has such.
fn percent_decoded(uri: &str) -> OsString {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        let code = (first == b'%')
            .then(|| tail.get(..2).filter(|hex| hex.iter().all(u8::is_ascii_hexdigit)))
            .flatten()
            .and_then(|hex| std::str::from_utf8(hex).ok())
            .and_then(|hex| u8::from_str_radix(hex, 16).ok());
        bytes.push(code.unwrap_or(first));
        rest = if code.is_some() { &tail[2..] } else { tail };
    }
    String::from_utf8(bytes).map_or_else(|error| of_bytes(error.into_bytes(), uri), OsString::from)
}

#[cfg(unix)]
fn of_bytes(bytes: Vec<u8>, _: &str) -> OsString {
    use std::os::unix::ffi::OsStringExt;
    OsString::from_vec(bytes)
}

#[cfg(not(unix))]
fn of_bytes(_: Vec<u8>, uri: &str) -> OsString {
    uri.into()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn unknown_names_say_what_there_is() {
        let message = format!("{:#}", load("builtin:attic").unwrap_err());
        assert!(message.contains("builtin:attic") && message.contains("room, cornell"), "{message}");
        let message = format!("{:#}", load("builtin:rom").unwrap_err());
        assert!(message.contains("(did you mean room?)"), "{message}");
        let message = format!("{:#}", load("bulitin:room").unwrap_err());
        assert!(message.contains("(did you mean builtin:?)"), "{message}");
        let message = format!("{:#}", load("model.stl").unwrap_err());
        assert!(message.contains("model.stl") && message.contains(".glb"), "{message}");
        let message = format!("{:#}", load("nowhere/model.glb").unwrap_err());
        assert!(message.contains("cannot read nowhere/model.glb"), "{message}");
    }

    #[cfg(unix)]
    #[test]
    fn links_are_judged_by_where_they_lead() {
        use std::os::unix::fs::symlink;
        let all = tempfile::tempdir().unwrap();
        let scene = all.path().join("scene");
        fs::create_dir_all(scene.join("textures")).unwrap();
        fs::write(all.path().join("secret.png"), b"secret").unwrap();
        fs::write(scene.join("textures/a.png"), b"inside").unwrap();
        symlink("textures/a.png", scene.join("inside.png")).unwrap();
        symlink("../secret.png", scene.join("outside.png")).unwrap();
        symlink(all.path(), scene.join("folder")).unwrap();
        symlink("gone", scene.join("dangling.png")).unwrap();
        // The folder's own name may be a link.
        symlink(&scene, all.path().join("alias")).unwrap();
        for folder in [&scene, &all.path().join("alias")] {
            assert_eq!(read_beside(folder, "inside.png").unwrap().1, b"inside");
            for uri in ["outside.png", "folder/secret.png"] {
                let error = read_beside(folder, uri).unwrap_err();
                assert!(error.contains("a link that leads elsewhere") && error.contains(uri), "{error}");
            }
            assert!(read_beside(folder, "dangling.png").unwrap_err().contains("cannot read"));
        }
    }

    #[test]
    fn uris_are_files_beside_the_scene() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a b.bin"), b"spaced").unwrap();
        fs::write(folder.path().join("c%20d.bin"), b"literal").unwrap();
        assert_eq!(read_beside(folder.path(), "a%20b.bin").unwrap().1, b"spaced");
        assert_eq!(read_beside(folder.path(), "a b.bin").unwrap().1, b"spaced");
        assert_eq!(read_beside(folder.path(), "c%20d.bin").unwrap().1, b"literal");
        assert!(read_beside(folder.path(), "gone.bin").unwrap_err().contains("gone.bin"));
    }

    #[test]
    fn codes_are_decoded_once_and_dots_lead_through_folders() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("sub dir")).unwrap();
        for name in ["wood 10%.png", "a%20b.png", "a b.png", "sub dir/c.png", "d.png"] {
            fs::write(folder.path().join(name), name).unwrap();
        }
        for (uri, expected) in [
            ("wood 10%.png", "wood 10%.png"),
            ("wood%2010%25.png", "wood 10%.png"),
            ("a%20b.png", "a b.png"),
            ("a%2520b.png", "a%20b.png"),
            ("sub%20dir/c.png", "sub dir/c.png"),
            ("sub%20dir/../d.png", "d.png"),
            ("gone/../d.png", "d.png"),
            ("./gone/%2e%2E/./d.png", "d.png"),
        ] {
            let (path, bytes) = read_beside(folder.path(), uri).unwrap();
            assert_eq!((path, bytes), (folder.path().join(expected), expected.into()), "{uri}");
        }
    }

    #[test]
    fn nothing_outside_the_folder_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let scene = folder.path().join("scene");
        fs::create_dir_all(scene.join("textures")).unwrap();
        fs::write(folder.path().join("secret.bin"), b"secret").unwrap();
        fs::write(scene.join("textures/a.png"), b"inside").unwrap();
        for inside in ["textures/a.png", "./textures/a.png", "textures/./a.png", "textures%2Fa.png"] {
            assert_eq!(read_beside(&scene, inside).unwrap().1, b"inside", "{inside}");
        }
        let absolute = folder.path().join("secret.bin").display().to_string();
        for outside in [
            "../secret.bin",
            "%2e%2e/secret.bin",
            "..%2fsecret.bin",
            "textures/../../secret.bin",
            &absolute,
            &format!("file://{absolute}"),
            "file:secret.bin",
            "https://example.org/a.bin",
            "c:secret.bin",
            "/dev/zero",
            "a\0b",
        ] {
            let message = read_beside(&scene, outside).unwrap_err();
            assert!(message.contains("expected a file in the scene's folder"), "{outside}: {message}");
        }
        assert!(read_beside(&scene, "textures").unwrap_err().contains("found a folder"));
        assert!(read_beside(&scene, "").unwrap_err().contains("found a folder"));
    }

    #[test]
    fn broken_percent_codes_stay_as_they_are() {
        assert_eq!(percent_decoded("100%"), "100%");
        assert_eq!(percent_decoded("%zz%+4%4"), "%zz%+4%4");
        assert_eq!(percent_decoded("%C3%A4"), "ä");
    }

    #[cfg(unix)]
    #[test]
    fn names_need_not_be_text() {
        use std::os::unix::ffi::OsStrExt;
        let folder = tempfile::tempdir().unwrap();
        let name = OsStr::from_bytes(b"a\xffb.bin");
        fs::write(folder.path().join(name), b"bytes").unwrap();
        assert_eq!(percent_decoded("a%ffb.bin"), name);
        assert_eq!(
            read_beside(folder.path(), "a%FFb.bin").unwrap(),
            (folder.path().join(name), b"bytes".to_vec())
        );
        fs::write(folder.path().join("a%ffc.bin"), b"literal").unwrap();
        assert_eq!(read_beside(folder.path(), "a%ffc.bin").unwrap().1, b"literal");
        let scene = folder.path().join(OsStr::from_bytes(b"\xff.glb"));
        let message = format!("{:#}", load(&scene).unwrap_err());
        assert!(message.contains("cannot read"), "{message}");
    }
}
