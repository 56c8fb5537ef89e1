//! A measured setting (a rung of the ladder) and the family that gives its colour in plots.

use glimpse::{Method, Settings};

/// One setting to measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Rung {
    /// Label of the setting.
    pub name: String,
    /// Short name, unique in the report; empty until [`crate::key::assign`].
    pub code: String,
    /// Family of the setting in the plots.
    pub family: Family,
    /// Settings of the renderer.
    pub settings: Settings,
    /// Size in pixels at which it is rendered; a smaller picture is upscaled before it is compared.
    pub rendered: [u32; 2],
    /// Whether the picture is stored, for the page or as a reference for other settings.
    pub keeps_picture: bool,
}

/// Settings that share a colour and an entry of the legend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Family {
    /// Letters that the short names of its settings start with.
    pub letters: &'static str,
    /// Name in the legend.
    pub name: &'static str,
    /// SVG colour, mostly from the palette of Okabe and Ito for colour-blind readers.
    pub color: &'static str,
    /// Whether it is a baseline for the adaptive methods, drawn as a square.
    pub is_baseline: bool,
}

impl Family {
    /// Full ray tracing with a fixed number of samples per pixel.
    pub const FIXED: Self = Self::baseline("F", "full, fixed samples", "#333333");
    /// Checkerboard rendering: every second pixel is traced.
    pub const CHECKERBOARD: Self = Self::baseline("K", "checkerboard", "#a6761d");
    /// The adaptive method with scaled tolerances.
    pub const TOLERANCES: Self = Self::contender("A", "adaptive, tolerances", "#0072b2");
    /// The adaptive method with larger base blocks.
    pub const BLOCKS: Self = Self::contender("B", "adaptive, larger blocks", "#009e73");
    /// The adaptive method with other base blocks and no postcorrection.
    pub const UNCORRECTED: Self = Self::contender("U", "adaptive, no postcorrection", "#e69f00");
    /// Supersampling where neighbours differ, by preset of thresholds.
    pub const SUPERSAMPLE: Self = Self::contender("S", "supersample, thresholds", "#56b4e9");
    /// Supersampling after the adaptive method.
    pub const COMBINED: Self = Self::contender("C", "adaptive, extra samples", "#d55e00");
    /// Quincunx sampling, by threshold.
    pub const QUINCUNX: Self = Self::contender("Q", "quincunx", "#882255");

    /// A family of baselines.
    pub const fn baseline(letters: &'static str, name: &'static str, color: &'static str) -> Self {
        Self { letters, name, color, is_baseline: true }
    }

    /// A family of methods that are compared with the baselines.
    pub const fn contender(letters: &'static str, name: &'static str, color: &'static str) -> Self {
        Self { letters, name, color, is_baseline: false }
    }
}

impl Rung {
    /// A full-size setting in a job whose first rung is full ray tracing and serves as the reference: only
    /// the pictures of [`Family::FIXED`] are stored.
    pub fn beside_full(name: impl Into<String>, family: Family, settings: Settings, size: [u32; 2]) -> Self {
        let keeps_picture = family == Family::FIXED;
        Self { keeps_picture, ..Self::beside_converged(name, family, settings, size) }
    }

    /// A full-size setting in a job with a converged reference: its picture is not stored.
    pub fn beside_converged(
        name: impl Into<String>,
        family: Family,
        settings: Settings,
        size: [u32; 2],
    ) -> Self {
        let (name, code) = (name.into(), String::new());
        Self { name, code, family, settings, rendered: size, keeps_picture: false }
    }

    /// Short name and label: `A1 adaptive`.
    pub fn label(&self) -> String {
        format!("{} {}", self.code, self.name)
    }

    /// Number of frames until the picture has all its samples, or shows nothing older than the current view.
    pub fn frames(&self) -> u64 {
        match self.settings.method {
            Method::Path | Method::Vr => self.settings.paths.samples.into(),
            Method::Frameless | Method::Reproject => (1.0 / self.settings.refresh_fraction).ceil() as u64,
            _ => 1,
        }
    }

    /// Number of frames that count towards the time of a picture: all for path tracing, else 1.
    pub fn timed_frames(&self) -> u64 {
        if self.settings.method.is_path_traced() { self.frames() } else { 1 }
    }

    /// Estimated cost of one picture in samples, for the progress bar: supersampling, quincunx and path
    /// tracing count twice the nominal samples, the adaptive and reprojecting methods half.
    pub fn samples(&self) -> u64 {
        let [width, height] = self.rendered.map(u64::from);
        let samples = width * height * u64::from(self.settings.sampling).pow(2) * self.frames();
        match self.settings.method {
            Method::Full => samples,
            Method::Supersample | Method::Quincunx | Method::Path | Method::Vr => 2 * samples,
            Method::Adaptive if self.settings.supersample => 2 * samples,
            Method::Adaptive | Method::Checkerboard | Method::Frameless | Method::Reproject => {
                samples.div_ceil(2)
            }
        }
    }
}
