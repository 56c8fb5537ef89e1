//! One setting that is measured, and the family that plots colour it by.

use glimpse::{Method, Settings};

/// One setting to measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Rung {
    /// Its label.
    pub name: String,
    /// What it belongs to.
    pub family: Family,
    /// How it is rendered.
    pub settings: Settings,
    /// The size at which it is rendered; what is smaller than the frame is upscaled before it is judged.
    pub rendered: [u32; 2],
    /// Its picture is kept: the page shows it, or others are measured against it.
    pub keeps_picture: bool,
}

/// Settings that share a colour and a line of the legend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Family {
    /// Its name in the legend.
    pub name: &'static str,
    /// An SVG colour: one of Okabe and Ito's, which colour-blind readers tell apart.
    pub color: &'static str,
    /// Something to beat. Plots draw it as a square.
    pub is_baseline: bool,
}

impl Family {
    /// Full ray tracing with fixed samples a pixel.
    pub const FIXED: Self = Self::baseline("full, fixed samples", "#333333");
    /// A ray through every second pixel.
    pub const CHECKERBOARD: Self = Self::baseline("checkerboard", "#a6761d");
    /// The adaptive method with other tolerances.
    pub const TOLERANCES: Self = Self::contender("adaptive, tolerances", "#0072b2");
    /// The adaptive method with larger base blocks.
    pub const BLOCKS: Self = Self::contender("adaptive, larger blocks", "#009e73");
    /// The adaptive method with other base blocks and no postcorrection.
    pub const UNCORRECTED: Self = Self::contender("adaptive, no postcorrection", "#e69f00");
    /// Extra samples where neighbours differ, by their thresholds.
    pub const SUPERSAMPLE: Self = Self::contender("supersample, thresholds", "#56b4e9");
    /// Extra samples after the adaptive method.
    pub const COMBINED: Self = Self::contender("adaptive, extra samples", "#d55e00");
    /// Quincunx sampling, by how much the ends of a quincunx may differ.
    pub const QUINCUNX: Self = Self::contender("quincunx", "#882255");

    /// A family that others are to beat.
    pub const fn baseline(name: &'static str, color: &'static str) -> Self {
        Self { name, color, is_baseline: true }
    }

    /// A family that is to beat the baselines.
    pub const fn contender(name: &'static str, color: &'static str) -> Self {
        Self { name, color, is_baseline: false }
    }
}

impl Rung {
    /// A setting of the whole frame in a job whose first rung is full ray tracing: that one's picture is kept, and the
    /// others are compared with it.
    pub fn beside_full(name: impl Into<String>, family: Family, settings: Settings, size: [u32; 2]) -> Self {
        let keeps_picture = family == Family::FIXED;
        Self { keeps_picture, ..Self::beside_converged(name, family, settings, size) }
    }

    /// A setting of the whole frame in a job that is compared with a converged frame: its own picture is not kept.
    pub fn beside_converged(
        name: impl Into<String>,
        family: Family,
        settings: Settings,
        size: [u32; 2],
    ) -> Self {
        Self { name: name.into(), family, settings, rendered: size, keeps_picture: false }
    }

    /// Frames that a picture takes: until it has its samples, or nothing of what was before them.
    pub fn frames(&self) -> u64 {
        match self.settings.method {
            Method::Path | Method::Vr => self.settings.paths.samples.into(),
            Method::Frameless | Method::Reproject => (1.0 / self.settings.refresh_fraction).ceil() as u64,
            _ => 1,
        }
    }

    /// Frames whose time is that of a picture.
    pub fn timed_frames(&self) -> u64 {
        if self.settings.method.is_path_traced() { self.frames() } else { 1 }
    }

    /// Samples that take the time of one frame: those that add some trace twice as many as there are, others half of them,
    /// or what costs as much.
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
