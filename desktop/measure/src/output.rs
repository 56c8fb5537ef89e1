//! Writing to stdout, and the formatting of numbers there.

use std::io::{ErrorKind, Write};

use anyhow::Context;
pub use glimpse::show::grouped;
use serde::Serialize;

/// Prints a text to stdout. A closed pipe (`| head`) is not an error.
pub fn print(text: &str) -> anyhow::Result<()> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error).context("cannot write to stdout"),
        _ => Ok(()),
    }
}

/// Prints a line to stderr.
pub fn remark(line: &str) {
    // If stderr is closed, the line is lost.
    let _ = writeln!(std::io::stderr(), "glimpse: {line}");
}

/// Serialises a value as indented JSON that ends in a newline, the form of every JSON output of this program.
pub fn json(value: &impl Serialize) -> anyhow::Result<String> {
    Ok(serde_json::to_string_pretty(value).context("JSON")? + "\n")
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
