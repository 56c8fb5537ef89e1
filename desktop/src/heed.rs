//! Which options a frame has a use for.

use glimpse::{Jitter, Method, Settings};

use crate::args::PathOptions;

/// Does an option concern a frame?
pub fn heeds(settings: &Settings, option: &str) -> bool {
    match option {
        "block" | "postcorrect" | "t-pos" | "t-norm" | "t-tex" | "t-gcol" | "supersample" => {
            settings.method == Method::Adaptive
        }
        "preset" | "focus" | "refine" | "inactive" => settings.supersamples(),
        "seed" if settings.method.follows_paths() => true,
        "seed" => match settings.jitter {
            Jitter::Auto => settings.supersamples(),
            Jitter::On => true,
            Jitter::Off => false,
        },
        "similar" => settings.method == Method::Quincunx,
        "share" => settings.method.keeps_frames() && !settings.method.follows_paths(),
        "crossing" | "eye-distance" | "convergence" => settings.method == Method::Vr,
        _ if PathOptions::contain(option) => settings.method.follows_paths(),
        "filter" => settings.method == Method::Full,
        _ => !option.starts_with("tau-") || settings.supersamples(),
    }
}

/// A warning for each of the typed options that changes nothing.
pub fn idle(typed: &[String], settings: &Settings) -> Vec<String> {
    let method = settings.method.name();
    let extra = Settings { supersample: true, ..*settings };
    let told = |option: &String| {
        let helps = settings.method == Method::Adaptive && heeds(&extra, option);
        let without = if helps { " without --supersample" } else { "" };
        format!("--{option} changes nothing with --method {method}{without}")
    };
    typed.iter().filter(|option| !heeds(settings, option)).map(told).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_changes_nothing_is_warned_of() {
        let typed = ["preset", "tau-col", "block", "depth", "share"].map(str::to_owned);
        let adaptive = Settings::default();
        let told = idle(&typed, &adaptive);
        assert_eq!(told.len(), 3, "{told:?}");
        assert_eq!(told[1], "--tau-col changes nothing with --method adaptive without --supersample");
        let share = "--share changes nothing with --method adaptive";
        assert_eq!(told[2], share);
        assert_eq!(idle(&typed, &Settings { supersample: true, ..adaptive }), [share]);
        let told = idle(&typed, &Settings { method: Method::Supersample, ..adaptive });
        assert_eq!(
            told,
            [
                "--block changes nothing with --method supersample",
                "--share changes nothing with --method supersample",
            ]
        );
    }
}
