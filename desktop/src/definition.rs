//! The definition of the command line as the program has it: with what the modules of the commands know.

use std::fmt::Write;

use clap::{Command, CommandFactory};

use crate::args::Arguments;
use crate::{report, view};

/// The version, with the commit where it is known.
pub const VERSION: &str = env!("GLIMPSE_VERSION");

/// The definition of all commands.
pub fn definition() -> Command {
    let definition = Arguments::command().version(VERSION).long_version(VERSION);
    let definition = view::with_phones(report::with_tables(definition));
    definition.mut_subcommands(|command| {
        let (examples, more) = (command.get_after_help().cloned(), hidden(&command));
        match examples {
            Some(examples) if !more.is_empty() => {
                command.after_help(format!("{examples}\n\n{more}")).after_long_help(examples)
            }
            _ => command,
        }
    })
}

/// The number of options under each heading that the short help leaves out.
fn hidden(command: &Command) -> String {
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for argument in command.get_arguments().filter(|argument| argument.is_hide_short_help_set()) {
        let heading = argument.get_help_heading().unwrap_or("Options");
        match counts.iter_mut().find(|(known, _)| *known == heading) {
            Some((_, count)) => *count += 1,
            None => counts.push((heading, 1)),
        }
    }
    let mut text = String::new();
    for (index, (heading, count)) in counts.iter().enumerate() {
        let gap = if index == 0 { "--help-all lists more: " } else { ", " };
        // Writing to a String cannot fail.
        let _ = write!(text, "{gap}{heading} ({count})");
    }
    text
}

#[cfg(test)]
mod tests {
    use glimpse::options::Group;

    use super::*;

    /// The help of a command as a terminal of this width shows it.
    fn help(name: &str, width: usize) -> String {
        let mut definition = definition().term_width(width);
        definition.build();
        match name {
            "" => definition.render_help().to_string(),
            name => definition.find_subcommand_mut(name).unwrap().render_help().to_string(),
        }
    }

    #[test]
    fn help_fits_a_page_and_names_the_groups_of_the_table_in_their_order() {
        let names: Vec<_> = definition().get_subcommands().map(|c| c.get_name().to_owned()).collect();
        for name in names.iter().map(String::as_str).chain([""]) {
            for width in [80, 100] {
                let help = help(name, width);
                let lines = help.lines().count();
                assert!(lines <= 60, "{name}: {lines} lines\n{help}");
            }
        }
        for name in ["render", "view", "check", "bench"] {
            let help = help(name, 100);
            let of = |text: &str, before: &str, after: &str| {
                let place = |group: Group| text.find(&format!("{before}{}{after}", group.title()));
                Group::ALL.map(place).into_iter().flatten().collect::<Vec<_>>()
            };
            let (headings, hidden) = (of(&help, "\n", ":\n"), of(&help.replace('\n', " "), ", ", " ("));
            assert!(headings.len() >= 4 && headings.is_sorted(), "{name}: {headings:?}");
            assert!(hidden.len() == Group::ALL.len() && hidden.is_sorted(), "{name}: {hidden:?}");
        }
    }

    #[test]
    fn the_short_help_says_how_much_the_full_one_adds() {
        let mut definition = definition();
        definition.build();
        let render = definition.find_subcommand_mut("render").unwrap();
        let hidden =
            render.get_arguments().filter(|a| a.is_hide_short_help_set() && !a.is_global_set()).count();
        let (short, long) = (render.render_help().to_string(), render.render_long_help().to_string());
        let said = short.split_once("--help-all lists more: ").expect("a hint").1;
        let numbers =
            said.split(|c: char| !c.is_ascii_digit()).filter_map(|number| number.parse::<usize>().ok());
        assert_eq!(numbers.sum::<usize>(), hidden);
        assert!(hidden > 20 && !short.contains("--tau-col") && long.contains("--tau-col"));
        assert!(!long.contains("lists more"));
    }

    #[test]
    fn every_command_has_two_examples_which_are_right() {
        let definition = definition();
        let of = |command: &Command| {
            let text = command.get_after_help().expect("examples").to_string();
            let lines = text.lines().map(str::trim).filter(|line| line.starts_with("glimpse "));
            lines.map(str::to_owned).collect::<Vec<_>>()
        };
        for command in definition.get_subcommands().chain([&definition]) {
            let examples = of(command);
            assert_eq!(examples.len(), 2, "{}", command.get_name());
            for line in examples {
                // What follows is the shell's.
                let line = line.split(" > ").next().unwrap();
                let words = line.split_whitespace().map(Into::into).collect();
                match Arguments::of(definition.clone(), words) {
                    Ok(_) => {}
                    Err(error) => assert!(!error.use_stderr(), "{line}: {error}"),
                }
            }
        }
    }

    #[test]
    fn the_version_begins_with_the_packages() {
        let version = definition().render_version();
        assert!(version.starts_with(concat!("glimpse ", env!("CARGO_PKG_VERSION"))), "{version}");
    }
}
