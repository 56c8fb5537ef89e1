//! A scene by its name on the command line: `builtin:NAME` or a file.

use std::fs;
use std::path::Path;

use anyhow::Context;
use glimpse::Scene;
use glimpse::scene::{BUILTIN_NAMES, builtin};

use crate::files;

/// Fails early, and without reading anything, where [`load`] cannot succeed: long work asks first.
pub fn check(name: &str) -> anyhow::Result<()> {
    if let Some(builtin_name) = name.strip_prefix("builtin:") {
        return check_builtin(builtin_name);
    }
    let path = Path::new(name);
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    if !matches!(ending.as_deref(), Some("glb" | "gltf")) {
        return Err(glimpse::Error::setting(name, "expected a .glb or .gltf file, or builtin:NAME").into());
    }
    fs::metadata(path).map(drop).with_context(|| format!("cannot read {name}"))
}

/// Loads `builtin:NAME`, a `.glb`, or a `.gltf` with the files that it names beside it.
pub fn load(name: &str) -> anyhow::Result<Scene> {
    check(name)?;
    if let Some(scene) = name.strip_prefix("builtin:").and_then(builtin) {
        return Ok(scene);
    }
    let path = Path::new(name);
    let bytes = files::read(path)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    Scene::from_gltf(&bytes, &mut |uri| read_beside(folder, uri)).with_context(|| name.to_owned())
}

fn check_builtin(name: &str) -> anyhow::Result<()> {
    if BUILTIN_NAMES.contains(&name) {
        return Ok(());
    }
    let reason = format!("no such scene; there are {}", BUILTIN_NAMES.join(", "));
    Err(glimpse::Error::setting(format!("builtin:{name}"), reason).into())
}

/// The bytes of a relative URI (RFC 3986: percent-encoded, though not every exporter does it).
fn read_beside(folder: &Path, uri: &str) -> Result<Vec<u8>, String> {
    let scheme = uri.split_once(':').map(|(scheme, _)| scheme);
    if scheme
        .is_some_and(|s| s.len() > 1 && s.chars().all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c)))
    {
        return Err(format!("expected a file beside the scene, found the address `{uri}`"));
    }
    let literal = folder.join(uri);
    let path = if literal.exists() { literal } else { folder.join(percent_decoded(uri)) };
    fs::read(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))
}

fn percent_decoded(uri: &str) -> String {
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
    String::from_utf8(bytes).unwrap_or_else(|_| uri.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_names_say_what_there_is() {
        let message = format!("{:#}", load("builtin:attic").unwrap_err());
        assert!(message.contains("builtin:attic") && message.contains("room, cornell"), "{message}");
        let message = format!("{:#}", load("model.stl").unwrap_err());
        assert!(message.contains("model.stl") && message.contains(".glb"), "{message}");
        let message = format!("{:#}", load("nowhere/model.glb").unwrap_err());
        assert!(message.contains("cannot read nowhere/model.glb"), "{message}");
    }

    #[test]
    fn uris_are_files_beside_the_scene() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a b.bin"), b"spaced").unwrap();
        fs::write(folder.path().join("c%20d.bin"), b"literal").unwrap();
        assert_eq!(read_beside(folder.path(), "a%20b.bin").unwrap(), b"spaced");
        assert_eq!(read_beside(folder.path(), "a b.bin").unwrap(), b"spaced");
        assert_eq!(read_beside(folder.path(), "c%20d.bin").unwrap(), b"literal");
        assert!(read_beside(folder.path(), "gone.bin").unwrap_err().contains("gone.bin"));
        assert!(read_beside(folder.path(), "https://example.org/a.bin").unwrap_err().contains("address"));
    }

    #[test]
    fn broken_percent_codes_stay_as_they_are() {
        assert_eq!(percent_decoded("100%"), "100%");
        assert_eq!(percent_decoded("%zz%+4%4"), "%zz%+4%4");
        assert_eq!(percent_decoded("%C3%A4"), "ä");
        assert_eq!(percent_decoded("%ff"), "%ff");
    }
}
