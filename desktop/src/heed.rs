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
    let extra = if settings.method == Method::Adaptive && !settings.supersample {
        " without --supersample"
    } else {
        ""
    };
    let idle = typed.iter().filter(|option| !heeds(settings, option));
    idle.map(|option| format!("--{option} changes nothing with --method {method}{extra}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_changes_nothing_is_warned_of() {
        let typed = ["preset", "tau-col", "block", "depth"].map(str::to_owned);
        let adaptive = Settings::default();
        let told = idle(&typed, &adaptive);
        assert_eq!(told.len(), 2, "{told:?}");
        assert_eq!(told[1], "--tau-col changes nothing with --method adaptive without --supersample");
        assert!(idle(&typed, &Settings { supersample: true, ..adaptive }).is_empty());
        let told = idle(&typed, &Settings { method: Method::Supersample, ..adaptive });
        assert_eq!(told, ["--block changes nothing with --method supersample"]);
    }
}
