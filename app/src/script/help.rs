//! The help of scripts.

use std::fmt::Write;

use glimpse::options::OPTIONS;

use super::{expectation::Operator, words::WORDS};
use crate::script_values::VALUES;

/// Every step, every operator and every value of scripts, one per line.
#[must_use]
pub fn help() -> String {
    let mut text = "Scripts have a step on each line; # begins a comment. Points are shares of the view, 0,0 is top left.\n\
                    Time is simulated, at 60 frames a second.\n\nSteps:\n"
        .to_owned();
    // Writing to a String cannot fail.
    for word in WORDS {
        let _ =
            writeln!(text, "  {}\n      {}", format!("{} {}", word.name, word.form).trim_end(), word.summary);
    }
    let operators: Vec<_> = Operator::ALL.iter().map(|(text, _)| *text).collect();
    let _ =
        writeln!(text, "\nOperators of expect: {}; an empty VALUE is the empty text.", operators.join(" "));
    text += "\nValues of expect and print:\n";
    for value in VALUES {
        let _ = writeln!(text, "  {:20} {}", value.name, value.summary);
    }
    text += "\nValues of set, expect and print:\n";
    for option in OPTIONS {
        let _ = writeln!(text, "  {:20} {} ({})", option.name, option.summary, option.kind.expected());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_and_every_value_is_listed() {
        let help = help();
        let names = WORDS.iter().map(|word| word.name).chain(crate::script_values::names());
        for name in names {
            assert!(help.lines().any(|line| line.split_whitespace().next() == Some(name)), "{name}");
        }
    }
}
