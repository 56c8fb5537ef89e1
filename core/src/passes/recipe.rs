//! How each method makes a frame.

use super::{Stage, adaptive, checkerboard, frameless, full, path, quincunx, reproject, supersample};
use crate::{
    Method,
    plan::{Band, Plan, Shape},
};

/// What a method is made of.
pub struct Recipe {
    /// Adds the dispatches of one band of rows to the plan.
    pub plan: fn(&mut Plan, &Shape, &Band),
    /// The stage whose kernel stands for its traced samples where the demand of a frame is estimated.
    pub traced: &'static Stage,
    /// The stages that make a sample which is not traced, and what the loops in them are over.
    pub interpolated: &'static [(&'static Stage, Loops)],
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
