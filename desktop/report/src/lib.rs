//! Error against run time for any scene, and tables like those of the papers beside their published figures.
//!
//! [`run`] measures a ladder of settings of each scene and the requested [`TABLES`], keeps every measurement
//! in the report's folder, and writes an HTML page, CSV files and SVG plots.
//!
//! A module uses only modules of its own and earlier layers:
//!
//! - settings and plots: `rung`, `pareto`, `plot`, `upscale`, `identity`, `interval`;
//! - jobs and results: `work`, `record`, `store`, `subject`, `job`, `key`;
//! - measuring: `complete`, `bench`, `rows`, `scene`, `ladder`;
//! - comparisons of times: `equal_error`, `headline`, `noise`;
//! - tables: `table` is the interface, `tables` has a file for each of them;
//! - output: `page`, `run`.

mod bench;
mod complete;
mod equal_error;
mod headline;
mod identity;
mod interval;
mod job;
mod key;
mod ladder;
mod noise;
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

    /// All modules in order: each uses only those before it.
    const ORDER: [&str; 24] = [
        "identity",
        "interval",
        "pareto",
        "rung",
        "upscale",
        "work",
        "record",
        "store",
        "subject",
        "plot",
        "job",
        "key",
        "complete",
        "bench",
        "equal_error",
        "headline",
        "noise",
        "rows",
        "scene",
        "ladder",
        "table",
        "tables",
        "page",
        "run",
    ];

    /// Source of a module and of the files in its folder, without tests.
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
