//! Sanitises text of a file for messages: short, and without control characters.

use crate::Error;

/// The most bytes that are kept of a name.
pub(super) const MAX_NAME: usize = 64;

/// The most bytes of a message about a file.
const MAX_SENTENCE: usize = 400;

/// The text, cut to at most `most` bytes; control characters become U+FFFD.
pub(super) fn clipped(text: &str, most: usize) -> String {
    let visible = |c: char| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c };
    match text.char_indices().find(|(start, c)| start + c.len_utf8() > most) {
        None => text.chars().map(visible).collect(),
        Some((end, _)) => text[..end].chars().map(visible).chain(['…']).collect(),
    }
}

/// Sanitises a message that may quote the file.
pub(super) fn sentence(text: &str) -> String {
    clipped(text, MAX_SENTENCE)
}

/// Sanitises an error that may quote the file.
pub(super) fn error(error: Error) -> Error {
    match error {
        Error::Scene { what, reason } => Error::scene(sentence(&what), sentence(&reason)),
        other => other,
    }
}
