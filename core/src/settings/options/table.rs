//! The rows.

use super::applicability::{
    ADAPTIVE, AFTER_ADAPTIVE, EVEN_GRID, EXTRA_SAMPLES, JITTERED, KEPT_PIXELS, PATHS, QUINCUNX, RANDOM,
    TWO_EYES,
};
use super::{Control, Group, Integers, Kind, Numbers, OptionSpec};
use crate::scene::MAX_COORDINATE;
use crate::{
    Crossing, Denoise, Direct, Filter, Inactive, Jitter, Linking, MAX_CPU_THREADS, MAX_DEPTH, MAX_GAZE,
    MAX_LIGHT_SAMPLES, MAX_SAMPLING, Method, Mip, Postcorrect, Preset, Refine, Roulette, Sampler, Shining,
    Stopping,
};

/// A [`Kind::Choice`] between the variants of an enum, kept in a field.
macro_rules! choice {
    ($kind:ident in $($field:ident).+) => {
        Kind::Choice {
            choices: $kind::CHOICES,
            get: |settings| $kind::ALL.iter().position(|value| *value == settings.$($field).+),
            set: |settings, index| settings.$($field).+ = $kind::ALL[index],
        }
    };
}

macro_rules! integer {
    ($($field:ident).+, $allowed:expr, $control:expr) => {
        Kind::Integer { field: |settings| &mut settings.$($field).+, allowed: $allowed, control: $control }
    };
}

macro_rules! number {
    ($($field:ident).+, $allowed:expr, $control:expr) => {
        Kind::Number { field: |settings| &mut settings.$($field).+, allowed: $allowed, control: $control }
    };
}

/// A threshold of Jin 2009.
macro_rules! threshold {
    ($field:ident, $published:literal, $summary:literal) => {
        OptionSpec::new(
            Group::Supersampling,
            concat!("tau-", stringify!($field)),
            concat!("tau ", stringify!($field)),
            number!(thresholds.$field, Numbers::between(0.0, 1.0), slider(0.0, 1.0, 0.01)),
            concat!($summary, ", 0 (always) to 1 (never); the preset has all nine."),
        )
        .published($published, JIN)
        .with(&EXTRA_SAMPLES)
    };
}

const KIM: &str = "Kim 2016";
const JIN: &str = "Jin 2009";
const VR: &str = "Kim & Sung 2021";

const fn slider(low: f32, high: f32, step: f32) -> Control {
    Control::Slider { low, high, step }
}

/// Every option, in the order in which values are set: those that change others before these.
pub static OPTIONS: &[OptionSpec] = &[
    OptionSpec::new(
        Group::Frame,
        "method",
        "method",
        Kind::Choice {
            choices: Method::CHOICES,
            get: |settings| Method::ALL.iter().position(|method| *method == settings.method),
            set: |settings, index| *settings = settings.with_method(Method::ALL[index]),
        },
        "How the frame is made.",
    ),
    OptionSpec::new(
        Group::Frame,
        "sampling",
        "samples a pixel",
        integer!(sampling, Integers::Range(1, MAX_SAMPLING), Control::Sides(&[1, 2, 4])),
        "Samples along a side of a pixel, averaged in linear radiance.",
    )
    .conflicting(|settings| {
        let method = settings.method;
        match settings.sampling {
            0 | 1 => None,
            _ if method.takes_one_sample() => Some(format!("1 with method {}", method.name())),
            _ => settings.supersample.then(|| "1 with supersample".to_owned()),
        }
    }),
    OptionSpec::new(
        Group::Frame,
        "depth",
        "depth",
        integer!(depth, Integers::Range(1, MAX_DEPTH), slider(1.0, MAX_DEPTH as f32, 1.0)),
        "Levels of rays; 1 is primary rays alone.",
    ),
    OptionSpec::new(
        Group::Frame,
        "min-weight",
        "least weight",
        number!(min_weight, Numbers::between(0.0, 1.0), slider(0.0, 0.5, 0.01)),
        "Rays that would contribute less than this share of a pixel are not traced.",
    ),
    OptionSpec::new(
        Group::Frame,
        "mip",
        "averaged textures",
        choice!(Mip in mip),
        "What a texture shows where it is seen small.",
    ),
    OptionSpec::new(
        Group::Frame,
        "filter",
        "filter",
        choice!(Filter in filter),
        "How a pixel follows from a grid of samples.",
    )
    .with(&EVEN_GRID)
    .conflicting(|settings| {
        let fits = settings.filter == Filter::Box || settings.method == Method::Full;
        let method = settings.method.name();
        (!fits).then(|| format!("box with method {method}, which has no even grid of samples"))
    }),
    OptionSpec::new(
        Group::Frame,
        "refresh-fraction",
        "refresh fraction",
        number!(share, Numbers::above(0.0, 1.0), slider(0.01, 1.0, 0.01)),
        "Share of the pixels that methods which keep frames trace anew in each; no pixel is older than 1 / this many frames.",
    )
    .formerly("share")
    .with(&KEPT_PIXELS),
    OptionSpec::new(
        Group::Frame,
        "specialize",
        "specialised kernels",
        choice!(Linking in features),
        "Which pieces of the shaders are linked.",
    )
    .formerly("features"),
    OptionSpec::new(
        Group::Adaptive,
        "block",
        "block",
        integer!(block, Integers::OneOf(&[2, 4, 8]), Control::Sides(&[2, 4, 8])),
        "Side of the square of samples of which one is always traced.",
    )
    .published("2", KIM)
    .with(&ADAPTIVE),
    OptionSpec::new(
        Group::Adaptive,
        "t-pos",
        "position",
        number!(tolerances.pos, Numbers::between(0.0, f32::MAX), slider(0.0, 0.1, 0.001)),
        "Positions may differ by less than this, in units of the scene's longest box side; lower traces more.",
    )
    .published("0.03", KIM)
    .with(&ADAPTIVE),
    OptionSpec::new(
        Group::Adaptive,
        "t-norm",
        "normal",
        number!(tolerances.norm, Numbers::between(-1.0, 2.0), slider(0.5, 1.0, 0.005)),
        "Normals must have a cosine above this; higher traces more.",
    )
    .published("0.9", KIM)
    .with(&ADAPTIVE),
    OptionSpec::new(
        Group::Adaptive,
        "t-tex",
        "texture border",
        number!(tolerances.tex, Numbers::between(0.0, 0.5), slider(0.0, 0.5, 0.005)),
        "Width of the border zone of a texture that is not interpolated across; higher traces more.",
    )
    .published("0.3", KIM)
    .with(&ADAPTIVE),
    OptionSpec::new(
        Group::Adaptive,
        "t-gcol",
        "mirrored colour",
        number!(tolerances.gcol, Numbers::between(0.0, f32::MAX), slider(0.0, 0.5, 0.005)),
        "Reflected and refracted colours may differ by less than this; lower traces more.",
    )
    .published("0.15", KIM)
    .with(&ADAPTIVE),
    OptionSpec::new(
        Group::Adaptive,
        "postcorrect",
        "postcorrection",
        choice!(Postcorrect in postcorrect),
        "What is traced again around traced pixels that differ from their neighbours (Kim 2016, section 4).",
    )
    .with(&ADAPTIVE),
    OptionSpec::new(
        Group::Supersampling,
        "supersample",
        "extra samples",
        Kind::Flag(|settings| &mut settings.supersample),
        "Extra samples after the adaptive frame, where its pixels differ from their neighbours.",
    )
    .with(&AFTER_ADAPTIVE)
    .conflicting(|settings| {
        let fits = !settings.supersample || settings.method == Method::Adaptive;
        (!fits).then(|| format!("false with method {}: only adaptive takes it", settings.method.name()))
    }),
    OptionSpec::new(
        Group::Supersampling,
        "preset",
        "thresholds",
        Kind::Choice {
            choices: Preset::CHOICES,
            get: |settings| {
                Preset::ALL.iter().position(|preset| preset.thresholds() == settings.thresholds)
            },
            set: |settings, index| settings.thresholds = Preset::ALL[index].thresholds(),
        },
        "All nine thresholds of the contrast that extra samples need (Jin 2009, Table 1).",
    )
    .published("balanced", JIN)
    .with(&EXTRA_SAMPLES),
    threshold!(col, "0.6", "Threshold where nothing but colours differ"),
    threshold!(poid, "0.05", "Threshold where objects differ"),
    threshold!(psn, "0.06", "Threshold where surface normals differ"),
    threshold!(psc, "0.06", "Threshold where shadows differ"),
    threshold!(pte, "0.6", "Threshold on textured surfaces"),
    threshold!(soid, "0.05", "Threshold where objects differ that are seen in mirrors or through glass"),
    threshold!(ssn, "0.06", "Threshold where normals differ that are seen in mirrors or through glass"),
    threshold!(ssc, "0.06", "Threshold where shadows differ that are seen in mirrors or through glass"),
    threshold!(ste, "0.6", "Threshold on textured surfaces that are seen in mirrors or through glass"),
    OptionSpec::new(
        Group::Supersampling,
        "focus",
        "focus",
        Kind::Objects(|settings| &mut settings.focus),
        "The objects whose differences get extra samples; elsewhere the colour decides alone.",
    )
    .with(&EXTRA_SAMPLES),
    OptionSpec::new(
        Group::Supersampling,
        "refine",
        "refine",
        choice!(Refine in refine),
        "Whether extra samples go to whole pixels, 4 to 16 of them as they differ, and along what they find.",
    )
    .with(&EXTRA_SAMPLES),
    OptionSpec::new(
        Group::Supersampling,
        "unsampled",
        "unsampled subpixels",
        choice!(Inactive in inactive),
        "What stands for the subpixels that get no extra samples.",
    )
    .formerly("inactive")
    .with(&EXTRA_SAMPLES),
    OptionSpec::new(
        Group::Supersampling,
        "quincunx-threshold",
        "quincunx threshold",
        number!(similar, Numbers::between(0.0, 1.0), slider(0.0, 1.0, 0.01)),
        "How much the ends of a quincunx may differ before there are samples between them, 0 to 1.",
    )
    .formerly("similar")
    .with(&QUINCUNX),
    OptionSpec::new(
        Group::Supersampling,
        "jitter",
        "jitter",
        choice!(Jitter in jitter),
        "Whether samples lie anywhere in their cells.",
    )
    .with(&JITTERED)
    .conflicting(|settings| {
        let fits =
            settings.jitter != Jitter::On || matches!(settings.method, Method::Full | Method::Supersample);
        let method = settings.method.name();
        (!fits).then(|| format!("auto or off with method {method}, whose samples have fixed places"))
    }),
    OptionSpec::new(
        Group::Frame,
        "seed",
        "seed",
        integer!(seed, Integers::Range(0, u32::MAX), slider(0.0, 100.0, 1.0)),
        "Seed of whatever is random; the same seed gives the same samples.",
    )
    .with(&RANDOM),
    OptionSpec::new(
        Group::Paths,
        "samples",
        "samples of paths",
        integer!(paths.samples, Integers::Range(1, u32::MAX), slider(1.0, 1024.0, 1.0)),
        "Samples of a pixel of a path-traced picture; a frame adds one.",
    )
    .with(&PATHS),
    OptionSpec::new(
        Group::Paths,
        "direct",
        "direct light",
        choice!(Direct in paths.direct),
        "How paths find the light of emitters.",
    )
    .published("bsdf", VR)
    .with(&PATHS),
    OptionSpec::new(
        Group::Paths,
        "light-samples",
        "light samples",
        integer!(
            paths.light_samples,
            Integers::Range(1, MAX_LIGHT_SAMPLES),
            slider(1.0, MAX_LIGHT_SAMPLES as f32, 1.0)
        ),
        "Points on emitters for each diffuse surface that a path meets.",
    )
    .with(&PATHS),
    OptionSpec::new(
        Group::Paths,
        "lights",
        "lights",
        choice!(Shining in paths.shining),
        "What lights path-traced scenes.",
    )
    .formerly("shining")
    .with(&PATHS),
    OptionSpec::new(
        Group::Paths,
        "sampler",
        "sampler",
        choice!(Sampler in paths.sampler),
        "Where the random numbers of paths come from.",
    )
    .with(&PATHS),
    OptionSpec::new(
        Group::Paths,
        "roulette",
        "Russian roulette",
        choice!(Roulette in paths.roulette),
        "Whether long paths end at random, those that go on counting for more.",
    )
    .with(&PATHS),
    OptionSpec::new(
        Group::Paths,
        "foveation",
        "foveation",
        choice!(Stopping in paths.stopping),
        "What happens to paths away from the gaze (Kim & Sung 2021, equation 7).",
    )
    .formerly("stopping")
    .published("paper", VR)
    .with(&PATHS),
    OptionSpec::new(
        Group::Paths,
        "gaze",
        "gaze",
        Kind::Point { field: |settings| &mut settings.paths.gaze, most: MAX_GAZE },
        "Where the eyes look, in widths and heights of what an eye sees, from its upper left corner.",
    )
    .with(&PATHS),
    OptionSpec::new(
        Group::Paths,
        "foveation-max",
        "largest probability",
        number!(paths.p_max, Numbers::below(0.0, 1.0), slider(0.0, 0.99, 0.01)),
        "The probability of stopping where the picture is farthest from the gaze, at each bounce.",
    )
    .formerly("p-max")
    .with(&PATHS),
    OptionSpec::new(
        Group::Paths,
        "foveation-start",
        "bounces before",
        integer!(paths.stop_after, Integers::Range(0, u32::MAX), slider(0.0, MAX_DEPTH as f32, 1.0)),
        "Bounces before paths may stop away from the gaze; with foveation paper one more.",
    )
    .formerly("stop-after")
    .with(&PATHS),
    OptionSpec::new(
        Group::Paths,
        "denoise",
        "denoiser",
        choice!(Denoise in paths.denoise),
        "What is done about noise in the picture that is shown.",
    )
    .published("median", VR)
    .with(&PATHS),
    OptionSpec::new(
        Group::Paths,
        "cpu-threads",
        "CPU threads",
        integer!(paths.cpu_threads, Integers::Range(0, MAX_CPU_THREADS), slider(0.0, 16.0, 1.0)),
        "Threads of the CPU that trace samples beside the GPU after the timed frames of render and bench.",
    )
    .formerly("cores")
    .with(&PATHS)
    .conflicting(|settings| {
        (settings.paths.cpu_threads > 0 && !settings.takes_planes()).then(|| {
            if settings.crosses() {
                "0 with stereo-reuse paper, whose pixels count samples one by one".to_owned()
            } else {
                format!("0 with method {}: only path and vr add samples up", settings.method.name())
            }
        })
    }),
    OptionSpec::new(
        Group::Stereo,
        "stereo-reuse",
        "stereo reuse",
        choice!(Crossing in paths.crossing),
        "Whether what one eye finds out counts for the other too (Kim & Sung 2021, equations 1 to 6).",
    )
    .formerly("crossing")
    .published("paper", VR)
    .with(&TWO_EYES),
    OptionSpec::new(
        Group::Stereo,
        "eye-distance",
        "eye distance",
        number!(
            paths.eye_distance,
            Numbers::between(0.0, MAX_COORDINATE),
            slider(0.0, 0.2, 0.001)
        ),
        "From one eye to the other, in the scene's units.",
    )
    .with(&TWO_EYES),
    OptionSpec::new(
        Group::Stereo,
        "convergence",
        "convergence",
        Kind::OptionalNumber {
            field: |settings| &mut settings.paths.convergence,
            allowed: Numbers::above(0.0, MAX_COORDINATE),
        },
        "From the eyes to where both see the same in the middle, in the scene's units; none for eyes that look in parallel.",
    )
    .with(&TWO_EYES),
];
