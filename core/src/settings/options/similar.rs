//! Suggests a name where another one was typed.

/// Longest text for which a name is suggested, in characters.
const MAX_LENGTH: usize = 64;

/// The name that the text was probably meant to be, whatever its case: the nearest one from which at most a third of the
/// letters are wrong, missing, superfluous or swapped (optimal string alignment), or the only one that begins so.
#[must_use]
pub fn similar<'a>(text: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let text: Vec<char> = text.to_lowercase().chars().take(MAX_LENGTH + 1).collect();
    if text.is_empty() || text.len() > MAX_LENGTH {
        return None;
    }
    let names: Vec<_> = names.into_iter().collect();
    let measured =
        names.iter().map(|name| (distance(&text, &name.to_lowercase().chars().collect::<Vec<_>>()), *name));
    let near = measured
        .filter(|(distance, _)| *distance <= (text.len() / 3).max(1))
        .min_by_key(|(distance, _)| *distance);
    let beginning: String = text.iter().collect();
    let mut begun = names.iter().filter(|name| name.to_lowercase().starts_with(&beginning));
    near.map(|(_, name)| name).or_else(|| begun.next().copied().filter(|_| begun.next().is_none()))
}

/// A question that follows a list of names in an error message, ` (did you mean NAME?)`; empty where no name is similar.
#[must_use]
pub fn suggestion<'a>(text: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    similar(text, names).map_or_else(String::new, |name| format!(" (did you mean {name}?)"))
}

/// Number of letters to replace, insert, delete or swap with the next one, no letter twice.
fn distance(a: &[char], b: &[char]) -> usize {
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for (i, letter) in a.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, other) in b.iter().enumerate() {
            let replaced = rows[i][j] + usize::from(letter != other);
            let mut least = replaced.min(rows[i][j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i - 1] == *other && *letter == b[j - 1] {
                least = least.min(rows[i - 1][j - 1] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_that_are_replaced_inserted_deleted_or_swapped_are_counted() {
        let of = |a: &str, b: &str| distance(&a.chars().collect::<Vec<_>>(), &b.chars().collect::<Vec<_>>());
        for (a, b, expected) in [
            ("", "", 0),
            ("", "abc", 3),
            ("render", "rendr", 1),
            ("render", "redner", 1),
            ("kitten", "sitting", 3),
        ] {
            assert_eq!((of(a, b), of(b, a)), (expected, expected), "{a} {b}");
        }
    }

    #[test]
    fn the_nearest_name_is_suggested_and_no_other_word() {
        let names = ["full", "adaptive", "checkerboard", "path", "vr"];
        for (text, expected) in [
            ("ful", Some("full")),
            ("Adaptiv", Some("adaptive")),
            ("apth", Some("path")),
            ("check", Some("checkerboard")),
            ("fast", None),
            ("raytracer", None),
            ("", None),
        ] {
            assert_eq!(similar(text, names), expected, "{text}");
        }
        assert_eq!(similar("t", ["tau", "tex"]), None, "two begin so");
        assert_eq!(similar(&"a".repeat(1 << 20), names), None);
        assert_eq!(suggestion("pth", names), " (did you mean path?)");
        assert_eq!(suggestion("fast", names), "");
    }
}
