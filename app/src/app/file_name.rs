//! Names of files as text, from which the files are found again.

use std::path::{Path, PathBuf};

use super::App;

/// Precedes each byte of a name that is not UTF-8, which is written in two hexadecimal digits.
const ESCAPE: char = char::REPLACEMENT_CHARACTER;

impl App {
    /// The name of a file as text. Where a system's names are bytes, those that are not UTF-8 become U+FFFD and two
    /// hexadecimal digits each, and so do those of U+FFFD itself: [`App::file_path`] finds the file again.
    #[must_use]
    pub fn file_name(path: &Path) -> String {
        let mut name = String::new();
        for chunk in path.as_os_str().as_encoded_bytes().utf8_chunks() {
            for c in chunk.valid().chars() {
                if c == ESCAPE { escape(c.to_string().as_bytes(), &mut name) } else { name.push(c) }
            }
            escape(chunk.invalid(), &mut name);
        }
        name
    }

    /// The file of a name that [`App::file_name`] made, or that was typed.
    #[must_use]
    pub fn file_path(name: &str) -> PathBuf {
        let mut bytes = Vec::with_capacity(name.len());
        let mut rest = name;
        while let Some(c) = rest.chars().next() {
            let (own, tail) = rest.split_at(c.len_utf8());
            let digits = tail.get(..2).filter(|_| c == ESCAPE);
            let byte = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok());
            match byte {
                Some(byte) => bytes.push(byte),
                None => bytes.extend(own.bytes()),
            }
            rest = if byte.is_some() { &tail[2..] } else { tail };
        }
        of_bytes(bytes)
    }
}

fn escape(bytes: &[u8], name: &mut String) {
    for byte in bytes {
        name.push_str(&format!("{ESCAPE}{byte:02x}"));
    }
}

#[cfg(unix)]
fn of_bytes(bytes: Vec<u8>) -> PathBuf {
    use std::os::unix::ffi::OsStringExt;
    std::ffi::OsString::from_vec(bytes).into()
}

#[cfg(not(unix))]
fn of_bytes(bytes: Vec<u8>) -> PathBuf {
    String::from_utf8_lossy(&bytes).into_owned().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_as_they_are_where_they_are_text() {
        for name in ["", "a b.glb", "builtin:room", "zimmer/stühle.glb", "字\n"] {
            assert_eq!(App::file_name(Path::new(name)), name);
            assert_eq!(App::file_path(name), Path::new(name));
        }
    }

    #[cfg(unix)]
    #[test]
    fn every_file_is_found_again_by_its_name() {
        for bytes in [
            &b"a\xffb.glb"[..],
            b"\xc3",
            b"\xe5\xad\x97\xe5",
            "\u{fffd}.glb".as_bytes(),
            b"\xef\xbf\xbdff",
            b"ff\x80",
        ] {
            let path = of_bytes(bytes.to_vec());
            assert_eq!(App::file_path(&App::file_name(&path)), path, "{bytes:?}");
        }
        assert_eq!(App::file_name(&of_bytes(b"a\xffb".to_vec())), "a\u{fffd}ffb");
        assert_eq!(App::file_path("typed \u{fffd} by hand"), Path::new("typed \u{fffd} by hand"));
    }
}
