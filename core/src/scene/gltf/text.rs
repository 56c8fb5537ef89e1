//! Text of the file on its way to people: short, and without what a terminal would obey.

use crate::Error;

/// The most bytes of a name that are kept.
pub(super) const MAX_NAME: usize = 64;

/// The most bytes of one sentence about a file.
const MAX_SENTENCE: usize = 400;

/// The text up to that many bytes; control characters become U+FFFD.
pub(super) fn clipped(text: &str, most: usize) -> String {
    let visible = |c: char| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c };
    match text.char_indices().find(|(start, c)| start + c.len_utf8() > most) {
        None => text.chars().map(visible).collect(),
        Some((end, _)) => text[..end].chars().map(visible).chain(['…']).collect(),
    }
}

/// A sentence that may quote the file.
pub(super) fn sentence(text: &str) -> String {
    clipped(text, MAX_SENTENCE)
}

/// Shortens an error that may quote text of the file.
pub(super) fn error(error: Error) -> Error {
    match error {
        Error::Scene { what, reason } => Error::scene(sentence(&what), sentence(&reason)),
        other => other,
    }
}
