//! The settings under which options have an effect.

use crate::{Jitter, Method, Settings};

/// The frames that an option has an effect on.
#[derive(Debug)]
pub struct Applicability {
    /// Whether the option has an effect under these settings.
    pub to: fn(&Settings) -> bool,
    /// Why it has no effect under other settings, as a sentence.
    pub reason: &'static str,
}

pub(super) const ALWAYS: Applicability = Applicability { to: |_| true, reason: "" };

pub(super) const ADAPTIVE: Applicability = Applicability {
    to: |settings| settings.method == Method::Adaptive,
    reason: "The adaptive method alone interpolates.",
};

pub(super) const AFTER_ADAPTIVE: Applicability =
    Applicability { to: ADAPTIVE.to, reason: "Extra samples are added to the adaptive method." };

pub(super) const EXTRA_SAMPLES: Applicability = Applicability {
    to: Settings::supersamples,
    reason: "There are extra samples with method supersample, and with supersample after the adaptive method.",
};

pub(super) const QUINCUNX: Applicability = Applicability {
    to: |settings| settings.method == Method::Quincunx,
    reason: "Method quincunx alone divides quincunxes.",
};

pub(super) const EVEN_GRID: Applicability = Applicability {
    to: |settings| settings.method == Method::Full,
    reason: "Method full alone has an even grid of samples.",
};

pub(super) const JITTERED: Applicability = Applicability {
    to: |settings| settings.method == Method::Full || settings.supersamples(),
    reason: "Samples have fixed places unless the method is full or there are extra ones.",
};

pub(super) const RANDOM: Applicability = Applicability {
    to: |settings| {
        settings.method.is_path_traced()
            || match settings.jitter {
                Jitter::Auto => settings.supersamples(),
                Jitter::On => true,
                Jitter::Off => false,
            }
    },
    reason: "Nothing in this frame is random.",
};

pub(super) const KEPT_PIXELS: Applicability = Applicability {
    to: |settings| settings.method.has_history() && !settings.method.is_path_traced(),
    reason: "Only frameless and reproject keep pixels.",
};

pub(super) const PATHS: Applicability = Applicability {
    to: |settings| settings.method.is_path_traced(),
    reason: "The methods path and vr follow paths.",
};

pub(super) const TWO_EYES: Applicability =
    Applicability { to: |settings| settings.method == Method::Vr, reason: "Method vr alone has two eyes." };
