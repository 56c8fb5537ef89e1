//! What of a file the picture does not show.

use std::fmt::{self, Display, Formatter};

use serde::Serialize;

/// A feature of a file's format that the picture does not show as the format's specification has it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NotShown {
    /// The property as `object.property`, or the extension's name.
    pub feature: String,
    /// Number of its occurrences in what the scene shows.
    pub count: usize,
    /// The first few elements of the file that have it.
    #[serde(rename = "where")]
    pub places: Vec<String>,
}

/// One line: the feature, how many times it occurs, and where.
impl Display for NotShown {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let times = if self.count == 1 { "once" } else { &format!("{} times", self.count) };
        let more = if self.count > self.places.len() { ", ..." } else { "" };
        write!(f, "{}, {times}: {}{more}", self.feature, self.places.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_says_what_how_often_and_where() {
        let (feature, places) = ("KHR_materials_sheen".to_owned(), vec!["material 0 `A`".to_owned()]);
        let once = NotShown { feature, count: 1, places };
        assert_eq!(once.to_string(), "KHR_materials_sheen, once: material 0 `A`");
        let twice = NotShown { count: 2, ..once };
        assert_eq!(twice.to_string(), "KHR_materials_sheen, 2 times: material 0 `A`, ...");
    }
}
