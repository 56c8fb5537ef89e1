//! `glimpse report`: error against run time, and tables like those of the papers for other scenes.

use clap::Command;
use clap::builder::{PossibleValue, PossibleValuesParser};
use glimpse::Settings;
use glimpse_report::{Options, Program, TABLES, Table};

use crate::args::ReportOptions;
use crate::output::Verbosity;

/// Value of `--tables` that selects no table.
const NONE: &str = "none";

/// Adds the names of the tables to the values of `--tables`.
pub fn with_tables(command: Command) -> Command {
    let none = PossibleValue::new(NONE).help("None of them");
    let tables = TABLES.map(|table| PossibleValue::new(table.name()).help(table.summary()));
    let values = PossibleValuesParser::new(std::iter::once(none).chain(tables));
    command.mut_subcommand("report", |report| report.mut_arg("tables", |tables| tables.value_parser(values)))
}

/// Runs `glimpse report`.
pub fn run(options: &ReportOptions, adapter: Option<&str>, verbosity: Verbosity) -> anyhow::Result<()> {
    let program = Program {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        commit: option_env!("GLIMPSE_COMMIT").unwrap_or("unknown").to_owned(),
        command: std::env::args_os()
            .skip(1)
            .fold("glimpse".to_owned(), |line, word| line + " " + &word.to_string_lossy()),
    };
    let options = Options {
        scenes: options.scenes.clone(),
        output: options.output.clone(),
        size: options.size.0,
        camera: options.camera.clone(),
        base: options.recursion.settings(Settings::default().method)?,
        frames: options.frames as usize,
        tables: chosen(&options.tables),
        table5_sizes: options.table5_sizes.clone(),
        program,
        verbosity,
    };
    glimpse_report::run(&options, adapter)
}

/// Tables of these names, without duplicates.
fn chosen(names: &[String]) -> Vec<&'static dyn Table> {
    let mut tables: Vec<&'static dyn Table> = Vec::new();
    for table in names.iter().filter_map(|name| glimpse_report::named(name)) {
        if tables.iter().all(|known| known.name() != table.name()) {
            tables.push(table);
        }
    }
    tables
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, FromArgMatches};

    use super::*;
    use crate::args::{self, Arguments};

    fn tables(line: &str) -> Result<Vec<&'static str>, clap::Error> {
        let line = format!("glimpse report a.glb -o out {line}");
        let matches = with_tables(Arguments::command()).try_get_matches_from(line.split_whitespace())?;
        match Arguments::from_arg_matches(&matches)?.command {
            Some(args::Command::Report(options)) => {
                Ok(chosen(&options.tables).into_iter().map(Table::name).collect())
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn tables_are_named_as_the_report_names_them() {
        assert_eq!(tables("").unwrap(), ["5", "3a"]);
        assert_eq!(tables("--tables none").unwrap(), [""; 0]);
        assert_eq!(
            tables("--tables 3B,3c,4,Missing,4,phones").unwrap(),
            ["3b", "3c", "4", "missing", "phones"]
        );
        let all = TABLES.map(|table| table.name());
        assert_eq!(tables(&format!("--tables {}", all.join(","))).unwrap(), all);
        let wrong = tables("--tables 6").unwrap_err().to_string();
        assert!(wrong.contains("none, 5, 3a, 3b, 3c, 4, missing, jin2, jin7, vr, pan, phones"), "{wrong}");
    }
}
