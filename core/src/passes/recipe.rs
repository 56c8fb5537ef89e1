//! How each method makes a frame.

use super::{
    FrameSpec, Stage, adaptive, checkerboard, frameless, full, path, quincunx, reproject, supersample,
};
use crate::{
    Method,
    frame::plan::{Band, Plan},
};

/// What a method is made of.
pub struct Recipe {
    /// Adds the dispatches of one band of rows to the plan.
    pub plan: fn(&mut Plan, &FrameSpec, &Band),
    /// The stage whose kernel stands for its traced samples where the demand of a frame is estimated.
    pub traced: &'static Stage,
    /// The stages that make a sample which is not traced, and what the loops in them are over.
    pub interpolated: &'static [(&'static Stage, Loops)],
    /// What it stores of each sample besides attributes.
    pub storage: Storage,
}

/// What a method stores of each sample besides attributes, and of how many rows at once.
#[derive(Clone, Copy, Debug)]
pub struct Storage {
    /// Radiances, where a pixel has one sample.
    pub radiances: u64,
    /// Words in the list, without extra samples.
    pub listed: u64,
    /// The most rows of a band; `None` where later passes, or frames, look across the borders of bands.
    pub band_rows: Option<u32>,
}

impl Storage {
    /// Nothing, in bands of any height.
    pub const NONE: Self = Self { radiances: 0, listed: 0, band_rows: Some(u32::MAX) };
    /// Nothing, in one band.
    pub const WHOLE: Self = Self { band_rows: None, ..Self::NONE };
}

/// What the outermost loops of a kernel are over.
#[derive(Clone, Copy, Debug)]
pub enum Loops {
    /// The lights of the scene.
    OverLights,
    /// So many turns.
    Repeated(f64),
}

impl Recipe {
    /// That of a method.
    #[must_use]
    pub fn of(method: Method) -> &'static Self {
        match method {
            Method::Full => &full::RECIPE,
            Method::Adaptive => &adaptive::RECIPE,
            Method::Checkerboard => &checkerboard::RECIPE,
            Method::Supersample => &supersample::RECIPE,
            Method::Quincunx => &quincunx::RECIPE,
            Method::Frameless => &frameless::RECIPE,
            Method::Reproject => &reproject::RECIPE,
            Method::Path | Method::Vr => &path::RECIPE,
        }
    }
}
