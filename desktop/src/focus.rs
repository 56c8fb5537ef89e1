//! `--focus`: finds the objects of a scene by index or name.

use glimpse::scene::Object;
use glimpse::{Error, Focus, Method, Settings};

use crate::args::FrameOptions;

/// Number of objects listed in an error message.
const NAMED: usize = 8;

/// Settings of a frame before the scene is loaded.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameRequest {
    /// Validated settings; the objects in focus are set only if typed as indices.
    pub settings: Settings,
    /// Objects in focus as typed.
    pub focus: Option<String>,
}

impl FrameRequest {
    /// Request for the typed options with one method.
    ///
    /// # Errors
    /// Fails as [`FrameOptions::settings`].
    pub fn of(options: &FrameOptions, method: Method) -> glimpse::Result<Self> {
        Ok(Self { settings: options.settings(method)?, focus: options.focus().map(str::to_owned) })
    }

    /// Request for one of several methods; options that do not affect it are reset.
    ///
    /// # Errors
    /// Fails as [`FrameOptions::settings_beside`].
    pub fn beside(options: &FrameOptions, method: Method) -> glimpse::Result<Self> {
        Ok(Self { settings: options.settings_beside(method)?, focus: options.focus().map(str::to_owned) })
    }

    /// Settings with the objects in focus found among the scene's objects.
    ///
    /// # Errors
    /// Fails if no object matches, or if the matches are not consecutive.
    pub fn in_scene(&self, objects: &[Object]) -> glimpse::Result<Settings> {
        let focus = self.focus.as_deref().filter(|text| *text != "none");
        let focus = focus.map(|text| run(text, objects)).transpose()?;
        Ok(Settings { focus, ..self.settings })
    }
}

/// Objects of the typed indices, or all whose names contain the text, which must be consecutive.
fn run(text: &str, objects: &[Object]) -> glimpse::Result<Focus> {
    let wrong = |expected: String| Error::setting("focus", expected, text);
    if let Ok(focus) = text.parse::<Focus>() {
        let known = (focus.last as usize) < objects.len();
        let expected = || format!("indices below the scene's number of objects, which is {}", objects.len());
        return if known { Ok(focus) } else { Err(wrong(expected())) };
    }
    let all = || objects.iter().enumerate();
    let found: Vec<_> = all().filter(|(_, o)| !text.is_empty() && o.name.contains(text)).collect();
    let (Some((first, _)), Some((last, _))) = (found.first(), found.last()) else {
        let names = named(&all().collect::<Vec<_>>());
        return Err(wrong(format!("a part of an object's name; the scene has {names}")));
    };
    if last - first + 1 != found.len() {
        return Err(wrong(format!("objects that follow each other; these have the name: {}", named(&found))));
    }
    Ok(Focus { first: *first as u32, last: *last as u32 })
}

/// Indices and names of the first few objects.
fn named(objects: &[(usize, &Object)]) -> String {
    let mut names: Vec<_> =
        objects.iter().take(NAMED).map(|(index, object)| format!("{index} ({})", object.name)).collect();
    if objects.len() > names.len() {
        names.push(format!("{} more", objects.len() - names.len()));
    }
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn objects() -> Vec<Object> {
        let names = ["floor", "chair/seat", "chair/back", "table", "lamp", "lamp-2", "table/leg"];
        names.map(|name| Object { name: name.to_owned(), material: 0 }).to_vec()
    }

    fn request(focus: &str) -> FrameRequest {
        let options = FrameOptions::default().with("focus", focus).unwrap();
        FrameRequest::of(&options, Method::Supersample).unwrap()
    }

    #[test]
    fn objects_are_found_by_index_and_by_a_part_of_their_names() {
        for (text, first, last) in
            [("3", 3, 3), ("1-6", 1, 6), ("chair", 1, 2), ("back", 2, 2), ("lamp", 4, 5), ("lamp-2", 5, 5)]
        {
            let settings = request(text).in_scene(&objects()).unwrap();
            assert_eq!(settings.focus, Some(Focus { first, last }), "{text}");
        }
        let nothing = FrameRequest::of(&FrameOptions::default(), Method::Adaptive).unwrap();
        assert_eq!(nothing.in_scene(&objects()).unwrap(), Settings::default());
    }

    #[test]
    fn what_is_not_there_is_named_with_what_is() {
        for (text, expected) in [
            ("7", "indices below the scene's number of objects, which is 7"),
            ("2-9", "indices below"),
            ("sofa", "the scene has 0 (floor), 1 (chair/seat), 2 (chair/back), 3 (table), 4 (lamp)"),
            ("Chair", "the scene has 0 (floor)"),
            ("", "the scene has 0"),
            ("table", "objects that follow each other; these have the name: 3 (table), 6 (table/leg)"),
        ] {
            let error = request(text).in_scene(&objects()).unwrap_err().to_string();
            assert!(error.starts_with("focus: ") && error.contains(expected), "{error}");
            assert!(error.ends_with(&format!(", found {text}")), "{error}");
        }
        let error = request("sofa").in_scene(&[objects(), objects()].concat()).unwrap_err().to_string();
        assert!(error.ends_with("7 (floor), 6 more, found sofa"), "{error}");
    }
}
