//! The Markdown pages: their links are valid, the README's map lists the existing folders, and its program is
//! one that is compiled.

use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

use glimpse::{Check, Method, Tracing};
use glimpse_tests::workspace;

/// Largest number of lines of the README.
const README_LINES: usize = 150;

/// Collects every page below a folder, except build output.
fn pages(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry")) {
        let path = entry.path();
        let name = entry.file_name().to_string_lossy().into_owned();
        if path.is_dir() && name != "target" && name != "node_modules" && !name.starts_with('.') {
            pages(&path, found);
        } else if name.ends_with(".md") {
            found.push(path);
        }
    }
}

/// The text outside fenced code blocks.
fn prose(text: &str) -> String {
    let mut fenced = false;
    let mut lines = Vec::new();
    for line in text.lines() {
        if line.starts_with("```") {
            fenced = !fenced;
        } else if !fenced {
            lines.push(line);
        }
    }
    lines.join("\n")
}

/// Targets of `[text](target)` and `![text](target)`.
fn links(text: &str) -> Vec<String> {
    let ends = prose(text);
    ends.split("](")
        .skip(1)
        .filter_map(|rest| rest.split_once(')'))
        .map(|(link, _)| link.to_owned())
        .collect()
}

/// Anchors of a page's headings, as GitHub derives them.
fn anchors(text: &str) -> BTreeSet<String> {
    let heading = |line: &str| Some(line.trim_start_matches('#').strip_prefix(' ')?.to_lowercase());
    let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
    prose(text)
        .lines()
        .filter(|line| line.starts_with('#'))
        .filter_map(heading)
        .map(|title| title.chars().filter(kept).map(|c| if c == ' ' { '-' } else { c }).collect())
        .collect()
}

/// Broken links of a page.
fn broken(page: &Path, text: &str) -> Vec<String> {
    let folder = page.parent().unwrap_or(Path::new("."));
    let wrong = |link: &String| {
        if link.starts_with("http") {
            return false;
        }
        let (file, anchor) = link.split_once('#').map_or((link.as_str(), None), |(f, a)| (f, Some(a)));
        let target = if file.is_empty() { page.to_path_buf() } else { folder.join(file) };
        let leads =
            |anchor: &str| fs::read_to_string(&target).is_ok_and(|text| anchors(&text).contains(anchor));
        !target.exists() || anchor.is_some_and(|anchor| !leads(anchor))
    };
    let name = |link: String| format!("{}: {link}", page.display());
    links(text).into_iter().filter(wrong).map(name).collect()
}

#[test]
fn links_of_pages_lead_to_files_and_headings() {
    let mut all = Vec::new();
    pages(workspace(), &mut all);
    assert!(all.len() > 8, "found only {all:?}");
    let broken: Vec<_> =
        all.iter().flat_map(|page| broken(page, &fs::read_to_string(page).expect("a page"))).collect();
    assert!(broken.is_empty(), "these links lead nowhere:\n{}", broken.join("\n"));
}

#[test]
fn a_link_to_a_missing_file_or_heading_is_found() {
    let page = workspace().join("README.md");
    let text =
        "# A title, with marks\n[a](nowhere.md) [b](#no-heading) [c](#a-title-with-marks) [d](README.md)";
    let found = broken(&page, text);
    // The second page is that of the file, not of `text`.
    assert_eq!(found.len(), 3, "{found:?}");
    assert!(anchors(text).contains("a-title-with-marks"));
}

#[test]
fn the_readme_is_short_and_its_map_shows_every_folder() {
    let readme = fs::read_to_string(workspace().join("README.md")).expect("a README");
    let lines = readme.lines().count();
    assert!(lines <= README_LINES, "expected at most {README_LINES} lines, found {lines}");
    let shown: BTreeSet<_> = readme
        .lines()
        .filter_map(|line| line.strip_prefix("| [`")?.split_once("/`](").map(|(name, _)| name.to_owned()))
        .collect();
    let manifest = fs::read_to_string(workspace().join("Cargo.toml")).expect("a manifest");
    let members = manifest.lines().find(|line| line.starts_with("members")).expect("members in one line");
    let folders: BTreeSet<_> =
        members.split('"').skip(1).step_by(2).map(|m| m.split('/').next().unwrap_or(m).to_owned()).collect();
    assert_eq!(shown, folders, "the map against the workspace's members");
}

/// The README's program is the one on the crate's front page, which is tested.
#[test]
fn the_readme_shows_the_program_of_the_crates_front_page() {
    let read = |file: &str| fs::read_to_string(workspace().join(file)).expect("a file");
    let (readme, front) = (read("README.md"), read("core/src/lib.rs"));
    let (_, program) = readme.split_once("```rust\n").expect("a program");
    let (program, _) = program.split_once("```").expect("its end");
    let lines: Vec<_> = program.lines().filter(|line| !line.is_empty()).collect();
    assert!(lines.len() > 5, "found only {lines:?}");
    for line in lines {
        assert!(front.contains(&format!("//! {line}\n")), "not in core/src/lib.rs: {line}");
    }
}

/// The passes listed in the architecture page are the existing ones.
#[test]
fn the_architecture_names_passes_that_exist() {
    let page = fs::read_to_string(workspace().join("core/ARCHITECTURE.md")).expect("a page");
    let (_, section) = page.split_once("\n## Passes by method\n").expect("a section");
    let (section, _) = section.split_once("\n## ").expect("its end");
    let cells = section.lines().filter_map(|line| line.strip_prefix("| `")?.split_once(" |"));
    let passes: Vec<_> =
        cells.flat_map(|(cell, _)| cell.split(['`', ',', ' '])).filter(|n| !n.is_empty()).collect();
    assert!(passes.len() > 15, "found only {passes:?}");
    let unknown: Vec<_> = passes.iter().filter(|name| Tracing::of_pass(name).is_none()).collect();
    assert!(unknown.is_empty(), "no such passes: {unknown:?}");
}

/// Whoever adds a method or a check says in the page of the architecture what it is.
#[test]
fn the_architecture_describes_every_method_and_check() {
    let page = fs::read_to_string(workspace().join("core/ARCHITECTURE.md")).expect("a page");
    let (_, section) = page.split_once("\n## Passes by method\n").expect("a section");
    let (section, _) = section.split_once("\n## ").expect("its end");
    let methods = Method::ALL.into_iter().map(Method::name);
    let missing: Vec<_> = methods.filter(|name| !section.contains(&format!("`{name}`"))).collect();
    assert!(missing.is_empty(), "methods without a description: {missing:?}");
    for check in Check::ALL {
        let row = format!("| {} | `{}` |", check.letters(), check.name());
        assert!(page.contains(&row), "no row of the check {}", check.name());
    }
}
