//! Writing to the terminal, and the formatting of numbers there.

use std::borrow::Cow;
use std::io::{self, ErrorKind, Write};

use anyhow::Context;
pub use glimpse::show::grouped;
use serde::Serialize;

/// How much a command prints beside the results that it was asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verbosity {
    /// Errors.
    Quiet,
    /// What a person wants to know: sizes, times, errors, warnings, progress.
    #[default]
    Normal,
    /// All counters too.
    Verbose,
}

/// Prints a text to stdout, with control characters escaped. A closed pipe (`| head`) is not an error.
pub fn print(text: &str) -> anyhow::Result<()> {
    write_out(plain(text).as_bytes())
}

/// Writes bytes to stdout. A closed pipe is not an error.
pub fn write_out(bytes: &[u8]) -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error).context("cannot write to stdout"),
        _ => Ok(()),
    }
}

/// Prints a text to stderr as [`print()`] does to stdout, for where stdout carries a file. If stderr is closed, the text
/// is lost.
pub fn print_aside(text: &str) {
    let _ = io::stderr().write_all(plain(text).as_bytes());
}

/// Prints a line to stderr.
pub fn remark(line: &str) {
    print_aside(&format!("glimpse: {}\n", one_line(line)));
}

/// The text without what acts on a terminal or reorders what it shows: control characters except tabs and ends of
/// lines, and marks of bidirectional text (Unicode, UAX #9), are written as `\u{..}`.
pub fn plain(text: &str) -> Cow<'_, str> {
    escaped(text, |c| acts(c) && c != '\n' && c != '\t')
}

/// The text as [`plain`] makes it, with ends of lines and tabs escaped too.
pub fn one_line(text: &str) -> Cow<'_, str> {
    escaped(text, acts)
}

fn acts(c: char) -> bool {
    let is_mark =
        matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    c.is_control() || is_mark || matches!(c, '\u{2028}' | '\u{2029}')
}

fn escaped(text: &str, unfit: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&unfit) {
        return Cow::Borrowed(text);
    }
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        if unfit(c) { escaped.extend(c.escape_unicode()) } else { escaped.push(c) }
    }
    Cow::Owned(escaped)
}

/// Serialises a value as indented JSON that ends in a newline, the form of every JSON output of this program. What
/// [`plain`] escapes is escaped as JSON does it.
pub fn json(value: &impl Serialize) -> anyhow::Result<String> {
    let text = serde_json::to_string_pretty(value).context("JSON")? + "\n";
    let unfit = |c: char| acts(c) && c != '\n';
    if !text.contains(unfit) {
        return Ok(text);
    }
    // Within strings alone, as there are none of these characters outside of them; all are of 16 bits.
    let escape = |c: char| if unfit(c) { format!("\\u{:04x}", u32::from(c)) } else { c.to_string() };
    Ok(text.chars().map(escape).collect())
}

/// Formats a number of bytes in the largest fitting binary unit: `1.5 KiB`.
pub fn bytes(number: u64) -> String {
    let (mut value, mut unit) = (number as f64, 0);
    while value >= 1024.0 && unit < 4 {
        value /= 1024.0;
        unit += 1;
    }
    let unit = ["B", "KiB", "MiB", "GiB", "TiB"][unit];
    if unit == "B" { format!("{number} B") } else { format!("{value:.1} {unit}") }
}

/// Formats a count with its noun in singular or plural: `1 light`, `2 lights`.
pub fn counted(number: usize, noun: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{} {noun}{plural}", grouped(number as u64))
}

/// Joins the items with commas; `nothing` if there are none.
pub fn listed<S: AsRef<str>>(items: &[S]) -> String {
    if items.is_empty() {
        return "nothing".to_owned();
    }
    items.iter().map(AsRef::as_ref).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_acts_on_a_terminal_is_escaped() {
        let name = "a\u{1b}[2Jb\u{202e}c\u{7f}\u{85}é\n\t";
        assert_eq!(plain(name), "a\\u{1b}[2Jb\\u{202e}c\\u{7f}\\u{85}é\n\t");
        assert_eq!(one_line("a\nb\tc"), "a\\u{a}b\\u{9}c");
        assert!(matches!(plain("plain ünïcode 字"), Cow::Borrowed(_)));
        let text = json(&[name]).unwrap();
        assert_eq!(plain(&text), text, "{text}");
        assert_eq!(serde_json::from_str::<Vec<String>>(&text).unwrap(), [name]);
    }

    #[test]
    fn numbers_are_readable() {
        assert_eq!(
            ["0", "999", "1,000", "1,234,567"],
            [0, 999, 1000, 1_234_567].map(grouped).each_ref().map(|s| &**s)
        );
        assert_eq!(bytes(1023), "1023 B");
        assert_eq!(bytes(1536), "1.5 KiB");
        assert_eq!(bytes(u64::MAX), "16777216.0 TiB");
        assert_eq!(counted(1, "light"), "1 light");
        assert_eq!(counted(0, "light"), "0 lights");
        assert_eq!(listed::<&str>(&[]), "nothing");
    }
}
