//! Recipes: how each method plans a frame and what it stores.

use super::{
    FrameSpec, Stage, adaptive, checkerboard, frameless, full, path, quincunx, reproject, supersample,
};
use crate::{
    Method,
    frame::plan::{Band, Plan},
};

/// The plan, storage and cost model of a method.
pub struct Recipe {
    /// Adds the dispatches of one band of rows to a plan.
    pub plan: fn(&mut Plan, &FrameSpec, &Band),
    /// The stage whose kernel represents traced samples in the cost model.
    pub traced: &'static Stage,
    /// The stages that process samples which are not traced, and the loops in their kernels, for the cost model.
    pub interpolated: &'static [(&'static Stage, Loops)],
    /// Storage per sample, without attributes.
    pub storage: Storage,
}

/// Storage of a method per sample, without attributes, and the rows that it needs at the same time.
#[derive(Clone, Copy, Debug)]
pub struct Storage {
    /// Number of stored RGB radiances, if a pixel has one sample.
    pub radiances: u64,
    /// Number of words in the list, without extra samples.
    pub listed: u64,
    /// The most rows of a band; `None` if later passes or frames read across the borders of bands.
    pub band_rows: Option<u32>,
}

impl Storage {
    /// No storage; bands may have any height.
    pub const NONE: Self = Self { radiances: 0, listed: 0, band_rows: Some(u32::MAX) };
    /// No storage, but the frame must be a single band.
    pub const WHOLE: Self = Self { band_rows: None, ..Self::NONE };
}

/// How often the outermost loops of a kernel iterate.
#[derive(Clone, Copy, Debug)]
pub enum Loops {
    /// Once for each light of the scene.
    OverLights,
    /// This many times.
    Repeated(f64),
}

impl Recipe {
    /// The recipe of a method.
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
