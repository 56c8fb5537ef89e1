//! Generates `desktop/CLI.md` from the clap definition and the core's table of options.

use std::fmt::Write;

use clap::{Arg, Command, CommandFactory};
use glimpse::options::{Group, Kind, OPTIONS, OptionSpec};

use crate::args::{Arguments, default_text};

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/CLI.md");

/// If this variable is set, the test writes the page.
const UPDATE: &str = "UPDATE_CLI_MD";

const HEAD: &str = "\
<!-- Made from the program: UPDATE_CLI_MD=1 cargo test -p glimpse-desktop manual -->
# Command line

`SCENE` is a `.glb` or `.gltf` file, `builtin:NAME`, or `-` for the standard input. Results go to the standard output, diagnostics to the standard error.
The exit code is 0 when the work is done, 1 when it failed, and 2 for wrong usage; every failure is one line that names what
was expected and what was found. `glimpse COMMAND --help` prints the most useful options, `--help-all` all of them with
their values. Of an option that is repeated the last one counts.
";

const FRAME: &str = "
## Options of a frame

`view`, `render`, `check` and `bench` take them as `--NAME VALUE`, `report` some of them, `bench --vary` as `NAME=VALUE,VALUE`, scripts of the
window and the extra `set` of the phone as `set NAME VALUE`. The window has a control for each, and copies the command that
makes its frame. The statistics hold every value, `-` in names being `_`.
";

fn page() -> String {
    let mut program = Arguments::command();
    program.build();
    let mut page = HEAD.to_owned();
    let shared = |argument: &Arg| argument.is_global_set();
    let _ = write!(page, "\n## Options of every command\n\n{}", arguments(&program, shared));
    for command in program.get_subcommands() {
        let about = command.get_about().map(ToString::to_string).unwrap_or_default();
        let _ = write!(page, "\n## `glimpse {}`\n\n{about}.\n\n", command.get_name());
        page += &arguments(command, |argument| !shared(argument) && of_table(argument).is_none());
        let taken: Vec<_> = command.get_arguments().filter_map(of_table).collect();
        if taken.len() > 2 {
            page += "\nAnd the [options of a frame](#options-of-a-frame).\n";
        } else if !taken.is_empty() {
            let names: Vec<_> = taken.iter().map(|option| format!("`--{}`", option.name)).collect();
            let _ = writeln!(
                page,
                "\nAnd {} of the [options of a frame](#options-of-a-frame).",
                names.join(", ")
            );
        }
    }
    page += FRAME;
    for group in Group::ALL {
        let _ = write!(page, "\n### {}\n\n", group.title());
        page += "| option | what it does | values | default | paper |\n| --- | --- | --- | --- | --- |\n";
        group.options().for_each(|option| page += &row(option));
    }
    page + &renamed()
}

fn of_table(argument: &Arg) -> Option<&'static OptionSpec> {
    OPTIONS.iter().find(|option| argument.get_long() == Some(option.name))
}

fn arguments(command: &Command, chosen: impl Fn(&Arg) -> bool) -> String {
    let mut table = "| argument | what it does |\n| --- | --- |\n".to_owned();
    let hidden = |argument: &&Arg| ["help", "help_all", "version"].contains(&argument.get_id().as_str());
    for argument in command.get_arguments().filter(|argument| chosen(argument) && !hidden(argument)) {
        let help =
            argument.get_long_help().or(argument.get_help()).map(ToString::to_string).unwrap_or_default();
        let help = help.replace("\n\n", ". ");
        let defaults: Vec<_> = argument
            .get_default_values()
            .iter()
            .map(|value| format!("`{}`", value.to_string_lossy()))
            .collect();
        let default = if defaults.is_empty() || !argument.get_action().takes_values() {
            String::new()
        } else {
            format!(" (default {})", defaults.join(", "))
        };
        let _ = writeln!(table, "| `{argument}` | {help}{default} |");
    }
    table
}

fn row(option: &OptionSpec) -> String {
    let reason = option.applicability.reason;
    let effect = if reason.is_empty() { String::new() } else { format!("<br>*{reason}*") };
    let values = match &option.kind {
        Kind::Choice { choices, .. } => {
            let lines = choices.iter().map(|choice| format!("`{}`: {}", choice.name, choice.summary));
            lines.collect::<Vec<_>>().join("<br>")
        }
        kind => kind.expected(),
    };
    let published = option
        .published
        .map_or_else(String::new, |published| format!("`{}` ({})", published.value, published.paper));
    let default = default_text(option);
    let (name, does) = (option.name, option.summary);
    format!("| `--{name}` | {does}{effect} | {values} | `{default}` | {published} |\n")
}

fn renamed() -> String {
    let mut text = "\n## Names of the version before\n\nThey are still accepted everywhere.\n\n".to_owned();
    text += "| before | now |\n| --- | --- |\n";
    for option in OPTIONS {
        if let Some(old) = option.old_name {
            let _ = writeln!(text, "| `--{old}` | `--{}` |", option.name);
        }
        let Kind::Choice { choices, .. } = &option.kind else { continue };
        for choice in *choices {
            if let Some(old) = choice.old_name {
                let _ = writeln!(text, "| `--{0} {old}` | `--{0} {1}` |", option.name, choice.name);
            }
        }
    }
    text
}

#[test]
fn the_page_of_the_command_line_is_that_of_this_program() {
    let page = page();
    if std::env::var_os(UPDATE).is_some() {
        std::fs::write(PAGE, &page).unwrap();
    }
    let written = std::fs::read_to_string(PAGE).unwrap();
    let differing = written.lines().zip(page.lines()).find(|(written, made)| written != made);
    assert!(written == page, "{PAGE} is old, set {UPDATE}=1 and run this test: {differing:?}");
}

#[test]
fn the_page_has_every_option_and_command() {
    let page = page();
    for option in OPTIONS {
        assert!(page.contains(&format!("| `--{}` |", option.name)), "{}", option.name);
    }
    for command in Arguments::command().get_subcommands() {
        assert!(page.contains(&format!("## `glimpse {}`", command.get_name())), "{}", command.get_name());
    }
}
