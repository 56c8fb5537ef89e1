//! Error messages of the command line: they name options with their dashes and suggest what to try.

use std::fmt;

use clap::{Arg, Command, CommandFactory};
use glimpse::Error;

use crate::args::Arguments;

/// Wrong usage other than an option's value; gives the exit code for wrong usage.
#[derive(Debug)]
pub struct Usage(pub String);

impl fmt::Display for Usage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Usage {}

/// Whether the error is wrong usage of the command line.
pub fn is_usage(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        cause.is::<Usage>() || matches!(cause.downcast_ref::<Error>(), Some(Error::Setting { .. }))
    })
}

/// What the parser of the command line says is wrong, as one line without the usage.
pub fn of_usage(error: &clap::Error) -> String {
    let text = error.to_string();
    let of_error = |line: &&str| !line.starts_with("Usage:") && !line.starts_with("For more information");
    let lines: Vec<_> =
        text.lines().take_while(of_error).map(str::trim).filter(|line| !line.is_empty()).collect();
    lines.join(" ").trim_start_matches("error: ").to_owned()
}

/// Formats the error with its causes as one line, with a suggestion if there is one.
pub fn told(error: &anyhow::Error) -> String {
    let causes = error.chain().map(|cause| cause.downcast_ref().map_or_else(|| cause.to_string(), of_core));
    // Some errors have their causes in their own text.
    let text = causes.fold(String::new(), |text, cause| match text.as_str() {
        "" => cause,
        _ if text.contains(&cause) => text,
        _ => format!("{text}: {cause}"),
    });
    let advice = error.chain().find_map(|cause| cause.downcast_ref().and_then(advice));
    let text = advice.map_or_else(|| text.clone(), |advice| format!("{text}: try {advice}"));
    let lines: Vec<_> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    lines.join(" ")
}

/// Formats an error of the core; settings appear as they were typed.
fn of_core(error: &Error) -> String {
    let Error::Setting { option, expected, found } = error else { return error.to_string() };
    let program = Arguments::command();
    let mut arguments = program.get_subcommands().flat_map(Command::get_arguments);
    match arguments.find(|argument| argument.get_id() == option.as_str()).map(Arg::is_positional) {
        Some(true) => format!("{found}: expected {expected}"),
        Some(false) => format!("--{option} {found}: expected {expected}"),
        None => error.to_string(),
    }
}

fn advice(error: &Error) -> Option<&'static str> {
    match error {
        Error::NoAdapter(_) => Some("another --adapter, `glimpse devices` lists them"),
        Error::Missing { .. } | Error::OutOfMemory { .. } => {
            Some("a smaller --size, a smaller scene or another --adapter")
        }
        Error::Lost { .. } => Some("again; if it is lost again, a smaller --size or another --adapter"),
        Error::Timeout { .. } => Some("a smaller --size, a smaller --depth or another --adapter"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use anyhow::Context;

    use super::*;

    #[test]
    fn options_are_told_as_they_are_typed() {
        let error = |option: &str| Err::<(), _>(Error::setting(option, "1 to 64", "0")).context("a.glb");
        let told = |option: &str| told(&error(option).unwrap_err());
        assert_eq!(told("depth"), "a.glb: --depth 0: expected 1 to 64");
        assert_eq!(told("size"), "a.glb: --size 0: expected 1 to 64");
        assert_eq!(told("scene"), "a.glb: 0: expected 1 to 64");
        assert_eq!(told("images"), "a.glb: images: expected 1 to 64, found 0");
    }

    #[test]
    fn devices_that_fail_come_with_advice() {
        let adapter = || "card".to_owned();
        let waited = Duration::from_secs(3);
        for (error, expected) in [
            (Error::NoAdapter("there is none".to_owned()), "another --adapter"),
            (Error::Lost { adapter: adapter(), reason: "reset".to_owned() }, "try again; if"),
            (
                Error::OutOfMemory { what: "rays".to_owned(), bytes: Some(9), adapter: adapter() },
                "smaller --size",
            ),
            (Error::Timeout { adapter: adapter(), waited }, "a smaller --depth"),
        ] {
            let text = told(&error.into());
            assert!(text.contains(": try ") || text.contains("try again"), "{text}");
            assert!(text.contains(expected), "{text}");
        }
    }

    #[test]
    fn wrong_usage_is_found_however_deep() {
        let deep = |error: anyhow::Error| error.context("scene.glb").context("render");
        assert!(is_usage(&deep(Error::setting("depth", "1 to 64", "0").into())));
        assert!(is_usage(&deep(Usage("CASE: expected one of two".to_owned()).into())));
        assert!(!is_usage(&deep(Error::scene("mesh 0", "no positions").into())));
    }

    #[test]
    fn wrong_usage_is_one_line_with_its_tip() {
        let of = |words: &str| {
            let words = words.split_whitespace().map(Into::into).collect();
            of_usage(&Arguments::of(Arguments::command(), words).unwrap_err())
        };
        let line = of("glimpse render a.glb -o a.png --method ful");
        assert!(
            line.starts_with("invalid value 'ful' for '--method <NAME>' [possible values: full, "),
            "{line}"
        );
        assert!(line.ends_with("tip: a similar value exists: 'full'"), "{line}");
        let line = of("glimpse render a.glb");
        assert_eq!(line, "the following required arguments were not provided: --output <OUT>");
    }

    #[test]
    fn errors_stay_on_one_line() {
        assert_eq!(told(&anyhow::anyhow!("a\n  b\n\nc")), "a b c");
    }
}
