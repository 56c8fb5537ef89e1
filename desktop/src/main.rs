//! The `glimpse` command: parses arguments, runs one command, prints one line for an error and sets the exit
//! code.

mod args;
mod bench;
mod check;
mod compare;
mod cpu_tracer;
mod definition;
mod devices;
mod diff;
mod errors;
mod file_dialog;
mod focus;
mod info;
mod loading;
#[cfg(test)]
mod manual;
mod measure;
mod pan;
mod render;
mod report;
mod shell;
mod statistics;
mod stress;
mod summary;
mod view;
mod warm;

use std::cell::RefCell;
use std::io::Write;
use std::panic::{PanicHookInfo, UnwindSafe, catch_unwind};
use std::process::ExitCode;

use args::{Arguments, Command};
use glimpse_measure::output::Verbosity;
use glimpse_measure::{files, output, progress, scene_file};

const FAILED: u8 = 1;
const WRONG_USAGE: u8 = 2;

fn main() -> ExitCode {
    std::panic::set_hook(Box::new(|panic| LAST_PANIC.set(bug(panic))));
    let arguments = match Arguments::of(definition::definition(), std::env::args_os().collect()) {
        Ok(arguments) => arguments,
        Err(error) => return told(&error),
    };
    let verbosity = match arguments {
        Arguments { quiet: true, .. } => Verbosity::Quiet,
        Arguments { verbose: 0, .. } => Verbosity::Normal,
        Arguments { .. } => Verbosity::Verbose,
    };
    start_log(verbosity, arguments.verbose);
    match reporting_panics(|| run(arguments, verbosity)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            complain(&errors::told(&error));
            ExitCode::from(if errors::is_usage(&error) { WRONG_USAGE } else { FAILED })
        }
    }
}

fn run(arguments: Arguments, verbosity: Verbosity) -> anyhow::Result<()> {
    let adapter = arguments.adapter.as_deref();
    match arguments.command {
        Some(Command::View(options)) => view::run(&options, adapter, verbosity),
        Some(Command::Render(options)) => render::run(&options, adapter, verbosity),
        Some(Command::Compare(options)) => compare::run(&options),
        Some(Command::Check(options)) => check::run(&options, adapter, verbosity),
        Some(Command::Info(options)) => info::run(&options),
        Some(Command::Devices(options)) => devices::run(&options, adapter),
        Some(Command::Bench(options)) => bench::run(&options, adapter, verbosity),
        Some(Command::Report(options)) => report::run(&options, adapter, verbosity),
        Some(Command::Stress(options)) => stress::run(&options, adapter, verbosity),
        Some(Command::Warm(options)) => warm::run(&options, adapter, verbosity),
        Some(Command::Completions(options)) => shell::completions(options.shell),
        Some(Command::Man(options)) => shell::manual_page(options.command.as_deref()),
        // The parser replaces them.
        None | Some(Command::Help(_) | Command::Other(_)) => Ok(()),
    }
}

/// Prints help and versions, and what is wrong with the command line.
fn told(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        return if error.print().is_ok() { ExitCode::SUCCESS } else { ExitCode::from(FAILED) };
    }
    complain(&errors::of_usage(error));
    ExitCode::from(WRONG_USAGE)
}

fn complain(line: &str) {
    output::remark(&format!("error: {line}"));
}

thread_local! {
    /// Message of the last panic. The hook prints nothing, as the library catches the panic by which wgpu
    /// reports a lost device.
    static LAST_PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Turns an uncaught panic into an error.
fn reporting_panics(work: impl FnOnce() -> anyhow::Result<()> + UnwindSafe) -> anyhow::Result<()> {
    catch_unwind(work).unwrap_or_else(|_| Err(anyhow::Error::msg(LAST_PANIC.take())))
}

fn bug(panic: &PanicHookInfo<'_>) -> String {
    let place = panic.location().map_or_else(String::new, |at| format!(" at {}:{}", at.file(), at.line()));
    let message = panic.payload_as_str().unwrap_or("no message");
    format!("this is a bug, please report it: {message}{place}")
}

/// Starts the log: `-v` shows information, `-vv` debug messages, `-vvv` everything, `--quiet` errors alone; `RUST_LOG`
/// overrides it.
fn start_log(verbosity: Verbosity, verbose: u8) {
    let filter = match verbose {
        0 if verbosity == Verbosity::Quiet => "glimpse=error",
        0 => "glimpse=warn",
        1 => "warn,glimpse=info",
        2 => "info,glimpse=debug",
        _ => "trace",
    };
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or(filter))
        .format(|line, record| {
            let (level, target) = (record.level(), record.target());
            let style = line.default_level_style(level);
            let text = record.args().to_string();
            writeln!(line, "[{style}{level:<5}{style:#} {target}] {}", output::one_line(&text))
        })
        .init();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panics_are_reported_unless_they_are_caught() {
        std::panic::set_hook(Box::new(|panic| LAST_PANIC.set(bug(panic))));
        let error = reporting_panics(|| {
            let _ = catch_unwind(|| panic!("caught"));
            panic!("not\ncaught")
        });
        let line = errors::told(&error.unwrap_err());
        assert!(line.starts_with("this is a bug, please report it: not caught at "), "{line}");
        assert!(reporting_panics(|| catch_unwind(|| panic!("caught")).or(Ok(()))).is_ok());
        drop(std::panic::take_hook());
    }
}
