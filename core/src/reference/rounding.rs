//! Effects of rounding: an f32 tracer decides differently where a decision depends on its last digits. The reference can
//! be asked the same question with numbers displaced at random by as much as f32 may be off. Where that never leads to
//! the tracer's answer, rounding does not explain it.

use glam::{DVec2, DVec3};

use crate::random::Random;

/// A unit in the last place of an f32 number between 1 and 2.
const ULP: f64 = 1.0 / 8_388_608.0;
/// So far may numbers be off: [`ULPS`] units in the last place of the largest number that they are computed from.
pub const ULPS: f64 = 16.0;
/// So far from their surface rays may start, in units in the last place of the coordinates there.
pub const SPAWN_ULPS: f64 = 64.0;
/// A contrast is off as if it came from numbers so large: by 2^-13, as radiances are.
const CONTRAST_SCALE: f64 = 64.0;
/// A decision that hangs on the last digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// Which surface a ray meets, and where: silhouettes, edges, grazing rays.
    Silhouette,
    /// The visibility of a light from a point.
    ShadowEdge,
    /// Which texels a texture coordinate lies between: texel edges and seams.
    TexelEdge,
    /// Whether a ray is followed, and whether reflection is total.
    Branch,
    /// How bright the image of a light is: a high power of a cosine.
    Highlight,
    /// Which step of its scale an attribute is stored as.
    Storage,
    /// More than one of them in one answer.
    Several,
}

impl Cause {
    /// Every cause, the one of several last.
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

/// Displacements of one cause, drawn at random; or none.
#[derive(Clone)]
pub struct Rounding {
    random: Random,
    cause: Option<Cause>,
}

impl Rounding {
    /// No displacement: the reference itself.
    #[must_use]
    pub fn none() -> Self {
        Self { random: Random(0), cause: None }
    }

    /// Displacements of one cause ([`Cause::Several`]: of all of them).
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

    /// A number that was computed from numbers as large as `scale`.
    pub(super) fn number(&mut self, cause: Cause, x: f64, scale: f64) -> f64 {
        if self.is(cause) { x + ULPS * ULP * scale * self.sign() } else { x }
    }

    /// A contrast of two colours, which may be off as the radiances may that it is computed from; none where they are equal.
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

    /// How far from a surface of this extent a ray starts: not at all, or up to [`SPAWN_ULPS`].
    pub(super) fn spawn(&mut self, cause: Cause, extent: f64) -> f64 {
        if self.is(cause) { SPAWN_ULPS * ULP * extent * self.random.unit() } else { 0.0 }
    }
}
