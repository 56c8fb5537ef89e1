//! Results as JUnit XML, which CI servers read.

use std::fmt::Write as _;

use super::Outcome;

/// The document of these outcomes.
pub fn report(outcomes: &[Outcome]) -> String {
    let failures = outcomes.iter().filter(|outcome| outcome.verdict.is_err()).count();
    let seconds: f64 = outcomes.iter().map(|outcome| outcome.seconds).sum();
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "<testsuites><testsuite name=\"glimpse check\" tests=\"{}\" failures=\"{failures}\" time=\"{seconds:.3}\">",
        outcomes.len()
    );
    for Outcome { name, seconds, verdict } in outcomes {
        let _ =
            write!(text, "<testcase classname=\"check\" name=\"{}\" time=\"{seconds:.3}\">", escaped(name));
        let _ = match verdict {
            Ok(found) => write!(text, "<system-out>{}</system-out>", escaped(found)),
            Err(reason) => write!(text, "<failure message=\"{}\"/>", escaped(reason)),
        };
        text += "</testcase>\n";
    }
    text += "</testsuite></testsuites>\n";
    text
}

/// Text for an attribute or an element; characters that XML cannot hold are replaced.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\t' | '\n' | '\r' => escaped.push(' '),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outcomes_are_well_formed_xml() {
        let outcome = |name: &str, verdict: Result<&str, &str>| Outcome {
            name: name.to_owned(),
            seconds: 0.25,
            verdict: verdict.map(str::to_owned).map_err(str::to_owned),
        };
        let text = report(&[outcome("a<b", Ok("RMSE 0")), outcome("\"c\" & d", Err("e\u{1b}\nf"))]);
        assert!(text.contains("tests=\"2\" failures=\"1\" time=\"0.500\""), "{text}");
        assert!(
            text.contains("name=\"a&lt;b\" time=\"0.250\"><system-out>RMSE 0</system-out></testcase>"),
            "{text}"
        );
        assert!(text.contains("name=\"&quot;c&quot; &amp; d\""), "{text}");
        assert!(text.contains("<failure message=\"e\u{fffd} f\"/></testcase>"), "{text}");
    }
}
