//! The rows of the table of options.

use super::Control::Sides;
use super::Integers::{OneOf, Range};
use super::applicability::{
    ADAPTIVE, AFTER_ADAPTIVE, EVEN_GRID, EXTRA_SAMPLES, JITTERED, KEPT_PIXELS, PATHS, QUINCUNX, RANDOM,
    TWO_EYES,
};
use super::{Control, Group, Kind, Numbers, OptionSpec, conflicts};
use crate::scene::MAX_COORDINATE;
use crate::{
    Denoise, DirectLight, Filter, Foveation, Jitter, LightSelection, MAX_CPU_THREADS, MAX_DEPTH,
    MAX_EXPOSURE, MAX_GAZE, MAX_LIGHT_SAMPLES, MAX_SAMPLING, Method, Mip, Postcorrect, Preset, Refine,
    Roulette, Sampler, Specialize, StereoReuse, Tonemap, Unsampled,
};

/// A [`Kind::Choice`] between the variants of an enum in a field of the settings.
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

/// An option for a threshold of Jin 2009.
macro_rules! threshold {
    ($field:ident, $published:literal, $summary:literal) => {
        extra(
            concat!("tau-", stringify!($field)),
            concat!("tau ", stringify!($field)),
            number!(thresholds.$field, between(0.0, 1.0), slider(0.0, 1.0, 0.01)),
            concat!($summary, ", 0 (always) to 1 (never); the preset has all nine."),
        )
        .published($published, JIN)
    };
}

const KIM: &str = "Kim 2016";
const JIN: &str = "Jin 2009";
const VR: &str = "Kim & Sung 2021";

/// An option in the group of all methods.
const fn frame(name: &'static str, label: &'static str, kind: Kind, summary: &'static str) -> OptionSpec {
    OptionSpec::new(Group::Frame, name, label, kind, summary)
}

/// An option that needs the adaptive method.
const fn adaptive(name: &'static str, label: &'static str, kind: Kind, summary: &'static str) -> OptionSpec {
    OptionSpec::new(Group::Adaptive, name, label, kind, summary).with(&ADAPTIVE)
}

/// An option that needs extra samples.
const fn extra(name: &'static str, label: &'static str, kind: Kind, summary: &'static str) -> OptionSpec {
    OptionSpec::new(Group::Supersampling, name, label, kind, summary).with(&EXTRA_SAMPLES)
}

/// An option that needs path tracing.
const fn path(name: &'static str, label: &'static str, kind: Kind, summary: &'static str) -> OptionSpec {
    OptionSpec::new(Group::Paths, name, label, kind, summary).with(&PATHS)
}

/// An option that needs stereo rendering.
const fn stereo(name: &'static str, label: &'static str, kind: Kind, summary: &'static str) -> OptionSpec {
    OptionSpec::new(Group::Stereo, name, label, kind, summary).with(&TWO_EYES)
}

const fn between(low: f32, high: f32) -> Numbers {
    Numbers { low, high, with_low: true, with_high: true }
}

/// The range without its lower bound.
const fn above(low: f32, high: f32) -> Numbers {
    Numbers { with_low: false, ..between(low, high) }
}

/// The range without its upper bound.
const fn below(low: f32, high: f32) -> Numbers {
    Numbers { with_high: false, ..between(low, high) }
}

const fn slider(low: f32, high: f32, step: f32) -> Control {
    Control::Slider { low, high, step }
}

/// All options, in the order in which values are applied: an option precedes those that it changes.
#[rustfmt::skip]
pub static OPTIONS: &[OptionSpec] = &[
    frame("method", "method",
        Kind::Choice {
            choices: Method::CHOICES,
            get: |settings| Method::ALL.iter().position(|method| *method == settings.method),
            set: |settings, index| *settings = settings.with_method(Method::ALL[index]),
        },
        "How the frame is made.").essential(),
    frame("sampling", "samples a pixel", integer!(sampling, Range(1, MAX_SAMPLING), Sides(&[1, 2, 4])),
        "Samples along a side of a pixel; they are averaged in linear radiance.").essential().conflicting(conflicts::sampling),
    frame("depth", "depth", integer!(depth, Range(1, MAX_DEPTH), slider(1.0, MAX_DEPTH as f32, 1.0)),
        "Levels of rays; 1 is primary rays alone.").essential(),
    frame("min-weight", "least weight", number!(min_weight, between(0.0, 1.0), slider(0.0, 0.5, 0.01)),
        "Rays that would contribute less than this share of a pixel are not traced."),
    frame("mip", "averaged textures", choice!(Mip in mip),
        "What a texture shows where it is seen small."),
    frame("filter", "filter", choice!(Filter in filter),
        "How a pixel follows from a grid of samples.").with(&EVEN_GRID).conflicting(conflicts::filter),
    frame("refresh-fraction", "refresh fraction", number!(refresh_fraction, above(0.0, 1.0), slider(0.01, 1.0, 0.01)),
        "Share of the pixels that methods which keep frames trace anew in each; no pixel is older than 1 / this many frames.")
        .formerly("share").with(&KEPT_PIXELS),
    frame("exposure", "exposure",
        Kind::OptionalNumber { field: |settings| &mut settings.exposure, allowed: between(-MAX_EXPOSURE, MAX_EXPOSURE), absent: "auto" },
        "Factor on all light, as a power of two (EV); auto exposes scenes whose lights have photometric strengths, and leaves others as they are.").essential(),
    frame("tonemap", "tone curve", choice!(Tonemap in tonemap),
        "How radiance above what a display can show is compressed."),
    frame("specialize", "specialised kernels", choice!(Specialize in specialize),
        "Which pieces of the shaders are linked.").formerly("features"),
    adaptive("block", "block", integer!(block, OneOf(&[2, 4, 8]), Sides(&[2, 4, 8])),
        "Side of a block, a square of samples; one of each is always traced.").essential().published("2", KIM),
    adaptive("t-pos", "position", number!(tolerances.pos, between(0.0, f32::MAX), slider(0.0, 0.1, 0.001)),
        "Positions may differ by less than this, in units of the scene's longest box side; lower traces more.")
        .published("0.03", KIM),
    adaptive("t-norm", "normal", number!(tolerances.norm, between(-1.0, 2.0), slider(0.5, 1.0, 0.005)),
        "Normals must have a cosine above this; higher traces more.").published("0.9", KIM),
    adaptive("t-tex", "texture border", number!(tolerances.tex, between(0.0, 0.5), slider(0.0, 0.5, 0.005)),
        "Width of the border zone of a texture that is not interpolated across; higher traces more.")
        .published("0.3", KIM),
    adaptive("t-gcol", "mirrored colour", number!(tolerances.gcol, between(0.0, f32::MAX), slider(0.0, 0.5, 0.005)),
        "Reflected and refracted colours may differ by less than this; lower traces more.").published("0.15", KIM),
    adaptive("postcorrect", "postcorrection", choice!(Postcorrect in postcorrect),
        "What is traced again around traced pixels that differ from their neighbours (Kim 2016, section 4)."),
    extra("supersample", "extra samples", Kind::Flag(|settings| &mut settings.supersample),
        "Extra samples after the adaptive frame, where its pixels differ from their neighbours.").essential()
        .with(&AFTER_ADAPTIVE).conflicting(conflicts::supersample),
    extra("preset", "thresholds",
        Kind::Choice {
            choices: Preset::CHOICES,
            get: |settings| Preset::ALL.iter().position(|preset| preset.thresholds() == settings.thresholds),
            set: |settings, index| settings.thresholds = Preset::ALL[index].thresholds(),
        },
        "All nine thresholds of the contrast that extra samples need (Jin 2009, Table 1).")
        .published("balanced", JIN),
    threshold!(col, "0.6", "Threshold where nothing but colours differ"),
    threshold!(poid, "0.05", "Threshold where objects differ"),
    threshold!(psn, "0.06", "Threshold where surface normals differ"),
    threshold!(psc, "0.06", "Threshold where shadows differ"),
    threshold!(pte, "0.6", "Threshold on textured surfaces"),
    threshold!(soid, "0.05", "Threshold where objects differ that are seen in mirrors or through glass"),
    threshold!(ssn, "0.06", "Threshold where normals differ that are seen in mirrors or through glass"),
    threshold!(ssc, "0.06", "Threshold where shadows differ that are seen in mirrors or through glass"),
    threshold!(ste, "0.6", "Threshold on textured surfaces that are seen in mirrors or through glass"),
    extra("focus", "focus", Kind::Objects(|settings| &mut settings.focus),
        "The objects whose differences get extra samples; elsewhere the colour decides alone."),
    extra("refine", "refine", choice!(Refine in refine),
        "Whether extra samples go to whole pixels, 4 to 16 of them as they differ, and along what they find."),
    extra("unsampled", "unsampled subpixels", choice!(Unsampled in unsampled),
        "What stands for the subpixels that get no extra samples.").formerly("inactive"),
    extra("quincunx-threshold", "quincunx threshold", number!(quincunx_threshold, between(0.0, 1.0), slider(0.0, 1.0, 0.01)),
        "How much the ends of a quincunx may differ before there are samples between them, 0 to 1.")
        .formerly("similar").with(&QUINCUNX),
    extra("jitter", "jitter", choice!(Jitter in jitter),
        "Whether samples lie anywhere in their cells.").with(&JITTERED).conflicting(conflicts::jitter),
    frame("seed", "seed", integer!(seed, Range(0, u32::MAX), slider(0.0, 100.0, 1.0)),
        "Seed of whatever is random; the same seed gives the same samples.").with(&RANDOM),
    path("samples", "samples of paths", integer!(paths.samples, Range(1, u32::MAX), slider(1.0, 1024.0, 1.0)),
        "Samples of a pixel of a path-traced picture; a frame adds one.").essential(),
    path("direct", "direct light", choice!(DirectLight in paths.direct_light),
        "How paths find the light of emitters.").published("bsdf", VR),
    path("light-samples", "light samples",
        integer!(paths.light_samples, Range(1, MAX_LIGHT_SAMPLES), slider(1.0, MAX_LIGHT_SAMPLES as f32, 1.0)),
        "Points on emitters for each diffuse surface that a path meets."),
    path("lights", "lights", choice!(LightSelection in paths.lights),
        "What lights path-traced scenes.").formerly("shining"),
    path("sampler", "sampler", choice!(Sampler in paths.sampler),
        "Where the random numbers of paths come from."),
    path("roulette", "Russian roulette", choice!(Roulette in paths.roulette),
        "Whether long paths end at random, those that go on counting for more."),
    path("foveation", "foveation", choice!(Foveation in paths.foveation),
        "What happens to paths away from the gaze (Kim & Sung 2021, equation 7).")
        .formerly("stopping").published("paper", VR),
    path("gaze", "gaze", Kind::Point { field: |settings| &mut settings.paths.gaze, most: MAX_GAZE },
        "Where the eyes look, in widths and heights of what an eye sees, from its upper left corner."),
    path("foveation-max", "largest probability", number!(paths.foveation_max, below(0.0, 1.0), slider(0.0, 0.99, 0.01)),
        "The probability of stopping where the picture is farthest from the gaze, at each bounce.").formerly("p-max"),
    path("foveation-start", "bounces before",
        integer!(paths.foveation_start, Range(0, u32::MAX), slider(0.0, MAX_DEPTH as f32, 1.0)),
        "Bounces before paths may stop away from the gaze; with foveation paper one more.").formerly("stop-after"),
    path("denoise", "denoiser", choice!(Denoise in paths.denoise),
        "What is done about noise in the picture that is shown.").essential().published("median", VR),
    path("cpu-threads", "CPU threads", integer!(paths.cpu_threads, Range(0, MAX_CPU_THREADS), slider(0.0, 16.0, 1.0)),
        "Threads of the CPU that trace samples beside the GPU after the timed frames of render and bench.")
        .formerly("cores").conflicting(conflicts::cpu_threads),
    stereo("stereo-reuse", "stereo reuse", choice!(StereoReuse in paths.stereo_reuse),
        "Whether what one eye finds out counts for the other too (Kim & Sung 2021, equations 1 to 6).")
        .formerly("crossing").published("paper", VR),
    stereo("eye-distance", "eye distance",
        number!(paths.eye_distance, between(0.0, MAX_COORDINATE), slider(0.0, 0.2, 0.001)),
        "From one eye to the other, in the scene's units."),
    stereo("convergence", "convergence",
        Kind::OptionalNumber { field: |settings| &mut settings.paths.convergence, allowed: above(0.0, MAX_COORDINATE), absent: "none" },
        "From the eyes to where both see the same in the middle, in the scene's units; none for eyes that look in parallel."),
];
