//! Error against run time for any scene, and the tables of the papers beside their published figures.
//!
//! [`run`] measures a ladder of settings of each scene and the [`TABLES`] that are asked for, keeps every measurement in the
//! report's folder, and writes a page, rows of comma-separated values and plots.
//!
//! A module uses those of the layers above it alone:
//!
//! - what a setting and a plot are: `rung`, `pareto`, `plot`, `upscale`, `identity`;
//! - what is measured and kept: `work`, `record`, `store`, `subject`, `job`;
//! - measuring: `complete`, `bench`, `rows`, `scene`, `ladder`;
//! - what a table of a paper is: `table`; the tables, a file each: `tables`;
//! - the whole: `page`, `run`.

mod bench;
mod complete;
mod identity;
mod job;
mod ladder;
mod page;
mod pareto;
mod plot;
mod record;
mod rows;
mod run;
mod rung;
mod scene;
mod store;
mod subject;
mod table;
mod tables;
mod upscale;
mod work;

pub use run::{Options, Program, run};
pub use table::Table;
pub use tables::{TABLES, named};

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    /// Every module, each below those that it may use.
    const ORDER: [&str; 19] = [
        "identity", "pareto", "rung", "upscale", "work", "record", "store", "subject", "plot", "job",
        "complete", "bench", "rows", "scene", "ladder", "table", "tables", "page", "run",
    ];

    /// The code of a module and of those in its folder, without tests.
    fn code(path: &Path) -> String {
        if path.is_dir() {
            return fs::read_dir(path).unwrap().map(|entry| code(&entry.unwrap().path())).collect();
        }
        let text = fs::read_to_string(path).unwrap();
        let of_tests = path.file_name().is_some_and(|name| name == "tests.rs");
        let end = if of_tests { 0 } else { text.find("mod tests {").unwrap_or(text.len()) };
        text[..end].to_owned()
    }

    #[test]
    fn modules_use_those_above_them_alone() {
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let mut used = 0;
        for entry in fs::read_dir(&source).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_stem().unwrap().to_str().unwrap();
            if name == "lib" {
                continue;
            }
            let place = ORDER.iter().position(|module| *module == name);
            let place = place.unwrap_or_else(|| panic!("{name} has no place in the order"));
            for uses in code(&path).split("use crate::").skip(1) {
                let uses = uses.split(';').next().unwrap().trim_start_matches('{');
                let uses = if uses.contains("::") { uses.split("::").next().unwrap() } else { uses };
                for module in uses.trim_end_matches('}').split(", ").map(|module| module.trim()) {
                    let above = ORDER[..place].contains(&module) || module == name;
                    assert!(above, "{name} uses {module}, which stands below it");
                    used += 1;
                }
            }
        }
        assert!(used > 50, "only {used} uses were found");
    }
}
