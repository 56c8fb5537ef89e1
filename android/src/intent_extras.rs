//! Parses the extras of an intent.

use std::str::FromStr;

use glimpse_app::{App, Change};

/// Parses a size as `2560x1440`, of 1 to 16384 pixels a side.
pub fn pixels(text: &str) -> Result<[u32; 2], String> {
    let sides =
        text.split_once('x').and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    sides
        .filter(|sides| sides.iter().all(|side| (1..=16384).contains(side)))
        .ok_or_else(|| format!("view: expected WIDTHxHEIGHT of 1 to 16384 pixels, found {text}"))
}

/// Applies changes of choices as in scripts, separated by semicolons, up to the first that is invalid: `method full;
/// overlay hidden`.
pub fn choose(app: &mut App, text: &str) -> Result<(), String> {
    for words in text.split(';').map(str::trim).filter(|words| !words.is_empty()) {
        let change = Change::from_str(words).map_err(|reason| format!("set: {words}: {reason}"))?;
        app.change(&change).map_err(|reason| format!("set: {words}: {reason}"))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glimpse::Method;
    use glimpse::options::OPTIONS;
    use glimpse_app::{Choices, Overlay};

    use super::*;

    fn app() -> App {
        let files: glimpse_app::Files = Arc::new(|_| Err("none".to_owned()));
        App::new(files, Arc::new(|| ()), "builtin:room", Vec::new(), Choices::default())
    }

    #[test]
    fn sizes_are_two_numbers_of_pixels() {
        assert_eq!(pixels("2560x1440"), Ok([2560, 1440]));
        for wrong in ["", "2560", "0x9", "2560X1440", "99999x1", "-1x3", "1x2x3"] {
            let line = pixels(wrong).expect_err(wrong);
            assert!(line.starts_with("view: expected WIDTHxHEIGHT") && line.ends_with(wrong), "{line}");
        }
    }

    #[test]
    fn choices_are_made_in_turn_until_one_is_wrong() {
        let mut app = app();
        assert_eq!(choose(&mut app, " overlay hidden; ;block 4 "), Ok(()));
        assert_eq!((app.choices().overlay, app.choices().settings.block), (Overlay::Hidden, 4));
        let line = choose(&mut app, "overlay full; block 3; method full").expect_err("a block of 3");
        assert!(line.starts_with("set: block 3:"), "{line}");
        assert_eq!(app.choices().overlay, Overlay::Full);
    }

    #[test]
    fn every_option_can_be_chosen_and_is_told_back() {
        for option in OPTIONS {
            for value in option.kind.examples() {
                let told: Vec<_> = Method::ALL
                    .into_iter()
                    .filter_map(|method| {
                        let mut app = app();
                        let words = format!("method {}; {} {value}", method.name(), option.name);
                        choose(&mut app, &words).ok()?;
                        assert!(app.look(option.name).is_some(), "{}", option.name);
                        Some(option.get(&app.choices().settings).to_string())
                    })
                    .collect();
                assert!(!told.is_empty(), "{} {value} goes with no method", option.name);
                assert!(told.iter().all(|text| *text == value), "{} {value}: {told:?}", option.name);
            }
        }
    }

    #[test]
    fn a_method_brings_its_depth() {
        let mut app = app();
        assert_eq!(choose(&mut app, "method path"), Ok(()));
        assert_eq!(app.choices().settings.depth, 64);
    }
}
