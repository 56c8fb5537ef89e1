//! Effects of rounding. An f32 tracer decides differently where a decision depends on the last digits. The
//! reference can be evaluated with numbers displaced at random by up to the error of f32; if that never gives the
//! tracer's result, rounding does not explain it.

use glam::{DVec2, DVec3};

use crate::random::Random;

/// A unit in the last place of an f32 number between 1 and 2.
const ULP: f64 = 1.0 / 8_388_608.0;
/// Largest displacement of a number, in units in the last place of the largest number that it is computed from.
pub const ULPS: f64 = 16.0;
/// Largest offset of a spawned ray from its surface, in units in the last place of the coordinates there.
pub const SPAWN_ULPS: f64 = 64.0;
/// Scale of contrasts' errors: they are displaced by up to 2^-13, like radiances.
const CONTRAST_SCALE: f64 = 64.0;
/// The kinds of decisions that depend on the last digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// The surface that a ray hits, and where: silhouettes, edges, grazing rays.
    Silhouette,
    /// The visibility of a light from a point.
    ShadowEdge,
    /// The texels around a texture coordinate: texel edges and seams.
    TexelEdge,
    /// Whether a ray is traced, and whether reflection is total.
    Branch,
    /// The brightness of a light's image, a high power of a cosine.
    Highlight,
    /// The quantisation step of a stored attribute.
    Storage,
    /// Several of these causes in one result.
    Several,
}

impl Cause {
    /// All causes; [`Cause::Several`] is last.
    pub const ALL: [Self; 7] = [
        Self::Silhouette,
        Self::ShadowEdge,
        Self::TexelEdge,
        Self::Branch,
        Self::Highlight,
        Self::Storage,
        Self::Several,
    ];
}

/// Random displacements for one cause, or none.
#[derive(Clone)]
pub struct Rounding {
    random: Random,
    cause: Option<Cause>,
}

impl Rounding {
    /// No displacements: the exact reference.
    #[must_use]
    pub fn none() -> Self {
        Self { random: Random(0), cause: None }
    }

    /// Displacements for one cause, or for all with [`Cause::Several`].
    #[must_use]
    pub fn of(cause: Cause, seed: u64) -> Self {
        Self { random: Random(seed), cause: Some(cause) }
    }

    fn is(&self, cause: Cause) -> bool {
        self.cause == Some(cause) || self.cause == Some(Cause::Several)
    }

    fn sign(&mut self) -> f64 {
        2.0 * self.random.unit() - 1.0
    }

    /// Displaces a number that was computed from numbers as large as `scale`.
    pub(super) fn number(&mut self, cause: Cause, x: f64, scale: f64) -> f64 {
        if self.is(cause) { x + ULPS * ULP * scale * self.sign() } else { x }
    }

    /// Displaces the contrast of two colours by the errors of the radiances; equal colours keep theirs.
    pub(super) fn contrast(&mut self, contrast: f64) -> f64 {
        if contrast > 0.0 { self.number(Cause::Branch, contrast, CONTRAST_SCALE) } else { contrast }
    }

    /// Perturbs a 2D vector by at most a rounding error at this scale.
    pub(super) fn pair(&mut self, cause: Cause, p: DVec2, scale: f64) -> DVec2 {
        DVec2::new(self.number(cause, p.x, scale), self.number(cause, p.y, scale))
    }

    /// Perturbs a point or a vector by at most a rounding error at this scale.
    pub(super) fn vector(&mut self, cause: Cause, p: DVec3, scale: f64) -> DVec3 {
        DVec3::new(
            self.number(cause, p.x, scale),
            self.number(cause, p.y, scale),
            self.number(cause, p.z, scale),
        )
    }

    /// Perturbs a unit vector and normalises it again.
    pub(super) fn direction(&mut self, cause: Cause, d: DVec3) -> DVec3 {
        if self.is(cause) { self.vector(cause, d, 1.0).normalize_or_zero() } else { d }
    }

    /// Offset of a ray's origin from a surface of this extent: zero, or up to [`SPAWN_ULPS`].
    pub(super) fn spawn(&mut self, cause: Cause, extent: f64) -> f64 {
        if self.is(cause) { SPAWN_ULPS * ULP * extent * self.random.unit() } else { 0.0 }
    }
}
