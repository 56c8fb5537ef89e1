//! Numbers of the file: finite, inside their range, and large enough that shaders do not take them for zero.

use std::ops::RangeInclusive;

use glam::{Vec2, Vec3};

use crate::{Error, Result};

/// WGSL lets a device take a subnormal number for zero, and many do; what stands in a scene must not depend on it.
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
    /// The element, for errors and warnings.
    pub what: &'a str,
    pub warnings: &'a mut Vec<String>,
}

impl Numbers<'_> {
    /// The number; one outside its range is read as the nearest end, with a warning.
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

    /// Accepts a finite number from 0 to 1.
    pub fn share(&mut self, name: &str, value: f32) -> Result<f32> {
        self.within(name, value, 0.0..=1.0)
    }

    /// Returns the error that names the property, what was expected and what was found.
    pub fn refused<T>(&self, name: &str, expected: &str, found: f32) -> Result<T> {
        Err(Error::scene(self.what, format!("{name}: expected {expected}, found {found}")))
    }
}
