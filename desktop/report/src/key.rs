//! Short names of the settings, unique in a report.

use glimpse::Settings;

use crate::job::Job;
use crate::rung::{Family, Rung};

/// Gives every setting its short name: the letters of its family and a number that counts from 1. A setting that several
/// jobs measure, of frames of any size, has one short name.
pub fn assign<'j>(jobs: impl IntoIterator<Item = &'j mut Job>) {
    let mut named: Vec<Named> = Vec::new();
    for job in jobs {
        let shown = job.shown;
        for rung in &mut job.rungs {
            let new = Named {
                code: String::new(),
                letters: rung.family.letters,
                settings: rung.settings,
                reduced: (rung.rendered != shown).then(|| rung.name.clone()),
            };
            let is_same = |known: &&Named| Named { code: String::new(), ..(*known).clone() } == new;
            if let Some(known) = named.iter().find(is_same) {
                rung.code.clone_from(&known.code);
                continue;
            }
            let before = named.iter().filter(|known| known.letters == new.letters).count();
            rung.code = format!("{}{}", new.letters, before + 1);
            named.push(Named { code: rung.code.clone(), ..new });
        }
    }
}

/// A setting that has a short name, and what tells it from others.
#[derive(Clone, PartialEq)]
struct Named {
    code: String,
    letters: &'static str,
    settings: Settings,
    /// Label of a setting that is rendered smaller than it is shown.
    reduced: Option<String>,
}

/// A setting of the key.
pub struct Entry<'r> {
    /// The first setting of that short name.
    pub rung: &'r Rung,
    /// Its options on the command line, where they differ from the defaults.
    pub options: String,
}

/// The settings by family, in the order in which they first appear.
pub fn entries<'r>(rungs: impl IntoIterator<Item = &'r Rung>) -> Vec<Entry<'r>> {
    let mut families: Vec<Family> = Vec::new();
    let mut entries: Vec<Entry<'_>> = Vec::new();
    for rung in rungs {
        if !families.contains(&rung.family) {
            families.push(rung.family);
        }
        if entries.iter().all(|known| known.rung.code != rung.code) {
            entries.push(Entry { rung, options: options(rung) });
        }
    }
    entries.sort_by_key(|entry| families.iter().position(|family| *family == entry.rung.family));
    entries
}

fn options(rung: &Rung) -> String {
    let settings = &rung.settings;
    let differing = settings.differences().into_iter().filter(|(option, _)| option.applies(settings));
    let told = differing.map(|(option, value)| (option.name, value.to_string()));
    let method = ("method", settings.method.name().to_owned());
    let all = std::iter::once(method).chain(told.filter(|(name, _)| *name != "method"));
    // Flags take their values after an equals sign.
    let written = |(name, value): (&str, String)| match value.as_str() {
        "true" => format!("--{name}"),
        "false" => format!("--{name}=false"),
        _ => format!("--{name} {value}"),
    };
    all.map(written).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ladder;

    #[test]
    fn short_names_tell_settings_apart_and_nothing_else() {
        let base = Settings::default();
        let mut jobs = [ladder::job(&base, [960, 540]), ladder::job(&base, [64, 64])];
        // The same settings by another name.
        jobs[1].rungs.truncate(6);
        for rung in &mut jobs[1].rungs[4..] {
            rung.name = format!("again {}", rung.name);
        }
        assign(&mut jobs);
        let codes = |job: &Job| job.rungs.iter().map(|rung| rung.code.clone()).collect::<Vec<_>>();
        let all = codes(&jobs[0]);
        assert_eq!(all[..6], ["R1", "R2", "R3", "K1", "F1", "F2"]);
        assert_eq!(codes(&jobs[1]), all[..6]);
        let mut distinct = all.clone();
        distinct.sort();
        distinct.dedup();
        assert_eq!(distinct.len(), jobs[0].rungs.len());
        let key = entries(jobs.iter().flat_map(|job| &job.rungs));
        assert_eq!(key.len(), all.len(), "each stands in the key once");
    }

    #[test]
    fn the_key_has_the_options_that_differ() {
        let mut jobs = [ladder::job(&Settings::default(), [960, 540])];
        assign(&mut jobs);
        let key = entries(&jobs[0].rungs);
        let of = |name: &str| {
            key.iter().find(|entry| entry.rung.name == name).map(|entry| entry.options.as_str()).unwrap()
        };
        assert_eq!(of("fixed 1"), "--method full");
        assert_eq!(of("fixed 9"), "--method full --sampling 3");
        assert_eq!(of("combined balanced"), "--method adaptive --postcorrect on --supersample");
        assert!(of("block 4").starts_with("--method adaptive") && of("block 4").contains("--block 4"));
    }
}
