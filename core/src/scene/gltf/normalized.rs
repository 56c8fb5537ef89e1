//! Checks numbers of the file: they must be finite and in range; subnormal ones become zero.

use std::ops::RangeInclusive;

use glam::{Vec2, Vec3};

use crate::{Error, Result};

/// Replaces subnormal numbers by zero. WGSL allows devices to do the same, and the scene must not depend on it.
pub(super) fn flushed(x: f32) -> f32 {
    if x.is_subnormal() { 0.0 } else { x }
}

pub(super) fn flushed2(v: Vec2) -> Vec2 {
    Vec2::from(v.to_array().map(flushed))
}

pub(super) fn flushed3(v: Vec3) -> Vec3 {
    Vec3::from(v.to_array().map(flushed))
}

/// Validates the numbers of one element of the file; errors name the element.
pub(super) struct Numbers<'a> {
    /// Name of the element in errors and warnings.
    pub what: &'a str,
    pub warnings: &'a mut Vec<String>,
}

impl Numbers<'_> {
    /// A finite number; one outside `range` is clamped, with a warning.
    pub fn within(&mut self, name: &str, value: f32, range: RangeInclusive<f32>) -> Result<f32> {
        if !value.is_finite() {
            return self.refused(name, "a finite number", value);
        }
        let nearest = value.clamp(*range.start(), *range.end());
        if nearest != value {
            self.warnings.push(format!("{}: its {name} of {value} is read as {nearest}", self.what));
        }
        Ok(flushed(nearest))
    }

    /// A finite number, clamped to 0 to 1 with a warning.
    pub fn share(&mut self, name: &str, value: f32) -> Result<f32> {
        self.within(name, value, 0.0..=1.0)
    }

    /// Returns the error that names the property, what was expected and what was found.
    pub fn refused<T>(&self, name: &str, expected: &str, found: f32) -> Result<T> {
        Err(Error::scene(self.what, format!("{name}: expected {expected}, found {found}")))
    }
}
