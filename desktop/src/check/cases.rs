//! A file of cases for `glimpse check`.

use std::ffi::OsString;
use std::path::Path;

use anyhow::{Context, bail};
use serde::Deserialize;

use super::{Case, parsed, stem};
use crate::files;

/// The content of the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Cases {
    /// Options of all cases, as typed on the command line.
    #[serde(default)]
    arguments: Vec<String>,
    #[serde(default)]
    case: Vec<Entry>,
}

/// One case of the file; paths are relative to the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    /// The reference's file name without its ending by default.
    name: Option<String>,
    scene: String,
    reference: String,
    /// Options of this case, which come after those of all and replace them.
    #[serde(default)]
    arguments: Vec<String>,
}

/// The cases of a file, in its order.
pub fn read(path: &Path) -> anyhow::Result<Vec<Case>> {
    let bytes = files::read(path)?;
    cases(path, &bytes).with_context(|| path.display().to_string())
}

fn cases(path: &Path, bytes: &[u8]) -> anyhow::Result<Vec<Case>> {
    let text = std::str::from_utf8(bytes).context("expected UTF-8")?;
    let cases: Cases = toml::from_str(text.trim_start_matches('\u{feff}'))?;
    if cases.case.is_empty() {
        bail!("expected at least one [[case]], found none");
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut read: Vec<Case> = Vec::with_capacity(cases.case.len());
    for entry in cases.case {
        let case = entry.case(folder, &cases.arguments)?;
        if read.iter().any(|other| other.name == case.name) {
            bail!("expected a name of its own for each case, found `{}` twice", case.name);
        }
        read.push(case);
    }
    Ok(read)
}

impl Entry {
    fn case(self, folder: &Path, of_all: &[String]) -> anyhow::Result<Case> {
        let reference = folder.join(&self.reference);
        let name = self.name.unwrap_or_else(|| stem(&reference));
        let is_path = !self.scene.starts_with("builtin:");
        let scene = if is_path { folder.join(&self.scene).into() } else { self.scene.into() };
        let typed = of_all.iter().cloned().chain(self.arguments).map(OsString::from);
        let arguments: Vec<_> = typed.chain([scene]).collect();
        let options = parsed(&arguments).with_context(|| format!("case {name}"))?;
        if options.update
            || options.junit.is_some()
            || options.failures.is_some()
            || options.reference.is_some()
        {
            bail!(
                "case {name}: --update, --junit and --failures belong to the command line, a picture to `reference`"
            );
        }
        Ok(Case { name, reference, options })
    }
}

#[cfg(test)]
mod tests {
    use glimpse::Method;

    use super::*;
    use crate::args::Size;

    fn told(text: &str) -> String {
        let error = cases(Path::new("a/cases.toml"), text.as_bytes()).err().expect("refused");
        crate::errors::told(&error)
    }

    #[test]
    fn cases_have_the_options_of_all_and_their_own() {
        let text = r#"
            arguments = ["--size", "64x48", "--max-rmse", "3"]
            [[case]]
            scene = "builtin:room"
            reference = "golden/room-full.png"
            arguments = ["--method", "full", "--max-rmse", "1"]
            [[case]]
            name = "own"
            scene = "../own.glb"
            reference = "own.png"
        "#;
        let cases = cases(Path::new("a/cases.toml"), text.as_bytes()).unwrap();
        let [room, own] = &cases[..] else { panic!("two cases") };
        assert_eq!((room.name.as_str(), room.options.scene.to_str()), ("room-full", Some("builtin:room")));
        assert_eq!(room.reference, Path::new("a/golden/room-full.png"));
        assert_eq!((room.options.method, room.options.bounds.max_rmse), (Method::Full, Some(1.0)));
        assert_eq!((own.name.as_str(), own.options.scene.to_str()), ("own", Some("a/../own.glb")));
        assert_eq!((own.options.bounds.max_rmse, own.options.size), (Some(3.0), Size([64, 48])));
    }

    #[test]
    fn what_is_wrong_is_named() {
        let case =
            |line: &str| format!("[[case]]\nscene = \"builtin:room\"\nreference = \"r.png\"\n{line}\n");
        for (text, words) in [
            (String::new(), "at least one [[case]]"),
            (case("tolerance = 3"), "tolerance"),
            (case("arguments = [\"--max-rsme\", \"3\"]"), "--max-rsme"),
            (case("arguments = [\"--max-rmse\", \"nan\"]"), "nan"),
            (case("arguments = [\"--update\"]"), "command line"),
            (case("") + &case(""), "`r` twice"),
            ("[[case]]\nscene = \"a.glb\"\n".to_owned(), "reference"),
        ] {
            let told = told(&text);
            assert!(told.contains(words), "{text}: {told}");
        }
    }
}
