//! Conflicts between options: each function returns the accepted values if a value conflicts with other options.

use crate::{Filter, Jitter, Method, Settings};

pub(super) fn sampling(settings: &Settings) -> Option<String> {
    let method = settings.method;
    match settings.sampling {
        0 | 1 => None,
        _ if method.is_path_traced() => {
            Some(format!("1 with method {}, whose samples option `samples` counts", method.name()))
        }
        _ if method.takes_one_sample() => Some(format!("1 with method {}", method.name())),
        _ => settings.supersample.then(|| "1 with supersample".to_owned()),
    }
}

pub(super) fn supersample(settings: &Settings) -> Option<String> {
    let fits = !settings.supersample || settings.method == Method::Adaptive;
    (!fits).then(|| format!("false with method {}: only adaptive takes it", settings.method.name()))
}

pub(super) fn filter(settings: &Settings) -> Option<String> {
    let fits = settings.filter == Filter::Box || settings.method == Method::Full;
    let method = settings.method.name();
    (!fits).then(|| format!("box with method {method}, which has no even grid of samples"))
}

pub(super) fn jitter(settings: &Settings) -> Option<String> {
    let fits = settings.jitter != Jitter::On || matches!(settings.method, Method::Full | Method::Supersample);
    let method = settings.method.name();
    (!fits).then(|| format!("auto or off with method {method}, whose samples have fixed places"))
}

pub(super) fn cpu_threads(settings: &Settings) -> Option<String> {
    let fits = settings.paths.cpu_threads == 0 || settings.accepts_cpu_samples();
    (!fits).then(|| {
        if settings.reuses_stereo() {
            "0 with stereo-reuse paper, whose pixels count samples one by one".to_owned()
        } else {
            format!("0 with method {}: only path and vr add samples up", settings.method.name())
        }
    })
}
