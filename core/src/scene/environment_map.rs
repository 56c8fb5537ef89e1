//! Light from infinitely far away in all directions: an octahedral map of radiance, one of irradiance, and levels that are
//! filtered for rough reflection.

mod distribution;
mod filtered;
mod irradiance;
mod studio;

use glam::{DVec2, DVec3, Vec3};

pub use distribution::EnvironmentDistribution;
pub use filtered::{FIRST_FILTERED, FilteredLevel, WIDEST_LOBE};

use super::MAX_RADIANCE;
use crate::{Error, LinearImage, Result};

/// The widest map that is kept, in texels; images of more are averaged.
pub const MAX_ENVIRONMENT_SIDE: u32 = 2048;

/// Radiance by direction: a square image in octahedral projection (Cigolle et al. 2014), whose centre is +Y.
///
/// Between texels radiance is interpolated bilinearly, across the folded border as well.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentMap {
    side: u32,
    texels: Vec<Vec3>,
    rotation: f32,
}

impl EnvironmentMap {
    /// The map of an equirectangular image of linear radiance: rows from the zenith (+Y) to the nadir, columns by the
    /// angle `atan2(z, x)`, which is 0 in the middle (the convention of three.js).
    ///
    /// # Errors
    /// [`Error::Scene`] if the image is not twice as wide as high, or a channel is negative, not finite or above
    /// [`MAX_RADIANCE`].
    pub fn from_equirectangular(image: &LinearImage) -> Result<Self> {
        let (width, height) = image.dimensions();
        if width != 2 * height || height == 0 {
            return Err(Error::scene(
                "environment",
                format!("expected an image twice as wide as high, found {width}x{height}"),
            ));
        }
        for (x, y, pixel) in image.enumerate_pixels() {
            if !pixel.0.iter().all(|channel| (0.0..=MAX_RADIANCE).contains(channel)) {
                let expected = format!("expected radiances from 0 to {MAX_RADIANCE:e}");
                return Err(Error::scene(
                    "environment",
                    format!("pixel {x}, {y}: {expected}, found {:?}", pixel.0),
                ));
            }
        }
        let side = (width / 2 + 1).next_power_of_two().clamp(16, MAX_ENVIRONMENT_SIDE);
        // As many places along a texel's side as the image has pixels there, at the horizon.
        let places = (1.2 * f64::from(width) / f64::from(side)).ceil().max(1.0) as u32;
        Ok(Self::of(side, places, |direction| equirectangular(image, direction)))
    }

    /// A neutral studio with soft lights from above, from both sides and from behind; white matte surfaces are bright
    /// in it and not burnt out.
    #[must_use]
    pub fn studio() -> Self {
        Self::of(512, 1, studio::radiance)
    }

    /// The same radiance from all directions.
    #[must_use]
    pub fn constant(radiance: Vec3) -> Self {
        Self { side: 16, texels: vec![radiance; 16 * 16], rotation: 0.0 }
    }

    /// Averages a function of the unit direction over `places` x `places` points of each texel.
    pub(crate) fn of(side: u32, places: u32, radiance: impl Fn(DVec3) -> DVec3) -> Self {
        let step = 1.0 / f64::from(places);
        let texels = (0..side * side).map(|i| {
            let corner = DVec2::new(f64::from(i % side), f64::from(i / side));
            let sum: DVec3 = (0..places * places)
                .map(|j| {
                    let within = DVec2::new(f64::from(j % places) + 0.5, f64::from(j / places) + 0.5) * step;
                    radiance(direction((corner + within) / f64::from(side)))
                })
                .sum();
            (sum / f64::from(places * places)).as_vec3()
        });
        Self { side, texels: texels.collect(), rotation: 0.0 }
    }

    /// This map turned about the +Y axis, counter-clockwise seen from above, by an angle in radians.
    #[must_use]
    pub fn rotated(self, rotation: f32) -> Self {
        Self { rotation, ..self }
    }

    /// This map with its radiance multiplied.
    pub(crate) fn scaled(mut self, factor: f32) -> Self {
        self.texels.iter_mut().for_each(|radiance| *radiance *= factor);
        self
    }

    /// Angle in radians by which the map is turned about the +Y axis.
    #[must_use]
    pub fn rotation(&self) -> f32 {
        self.rotation
    }

    /// Radiance that arrives from a direction of the world.
    #[must_use]
    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        bilinear(&self.texels, self.side, self.turned(direction))
    }

    /// A direction of the world in the frame of the map.
    pub(crate) fn turned(&self, d: DVec3) -> DVec3 {
        let (sine, cosine) = f64::from(self.rotation).sin_cos();
        DVec3::new(cosine * d.x - sine * d.z, d.y, sine * d.x + cosine * d.z)
    }

    /// A direction of the map's frame in the world.
    pub(crate) fn turned_back(&self, d: DVec3) -> DVec3 {
        let (sine, cosine) = f64::from(self.rotation).sin_cos();
        DVec3::new(cosine * d.x + sine * d.z, d.y, cosine * d.z - sine * d.x)
    }

    /// Width and height in texels.
    #[must_use]
    pub fn side(&self) -> u32 {
        self.side
    }

    /// Radiance of each texel, row by row.
    #[must_use]
    pub fn texels(&self) -> &[Vec3] {
        &self.texels
    }

    /// The mean radiance of all directions.
    #[must_use]
    pub fn mean(&self) -> Vec3 {
        let weighted = self.weighted();
        let (sum, weights) =
            weighted.fold((DVec3::ZERO, 0.0), |(sum, all), (_, weight, l)| (sum + weight * l, all + weight));
        // The deviation of a constant map is nothing, whatever the sums round to.
        if self.texels.iter().all(|l| *l == self.texels[0]) {
            self.texels[0]
        } else {
            (sum / weights).as_vec3()
        }
    }

    /// Unit direction, solid angle (up to a factor) and radiance of each texel.
    fn weighted(&self) -> impl Iterator<Item = (DVec3, f64, DVec3)> {
        let side = f64::from(self.side);
        self.texels.iter().enumerate().map(move |(i, radiance)| {
            let place = DVec2::new((i as u32 % self.side) as f64 + 0.5, (i as u32 / self.side) as f64 + 0.5);
            let point = on_octahedron(place / side);
            (point.normalize(), point.length().powi(-3), radiance.as_dvec3())
        })
    }
}

/// The point of the octahedron |x| + |y| + |z| = 1 at a place in [0, 1]^2 of the map.
pub(crate) fn on_octahedron(place: DVec2) -> DVec3 {
    let p = 2.0 * place - 1.0;
    let y = 1.0 - p.x.abs() - p.y.abs();
    let fold = (-y).max(0.0);
    DVec3::new(p.x - fold.copysign(p.x), y, p.y - fold.copysign(p.y))
}

/// Unit direction of a place in [0, 1]^2 of the map.
pub(crate) fn direction(place: DVec2) -> DVec3 {
    on_octahedron(place).normalize()
}

/// The place in [0, 1]^2 of the map of a direction.
pub(crate) fn place(direction: DVec3) -> DVec2 {
    let p = direction / (direction.x.abs() + direction.y.abs() + direction.z.abs());
    let upper = DVec2::new(p.x, p.z);
    let folded = DVec2::new((1.0 - p.z.abs()).copysign(p.x), (1.0 - p.x.abs()).copysign(p.z));
    0.5 * if p.y < 0.0 { folded } else { upper } + 0.5
}

/// Index of a texel that is at most one texel outside of a square map, which is folded along its border.
pub(crate) fn folded(x: i64, y: i64, side: i64) -> usize {
    let (mut x, mut y) = (x, y);
    if !(0..side).contains(&x) {
        (x, y) = (x.clamp(0, side - 1), side - 1 - y);
    }
    if !(0..side).contains(&y) {
        (x, y) = (side - 1 - x, y.clamp(0, side - 1));
    }
    (y * side + x) as usize
}

/// Bilinear interpolation in a square octahedral map.
pub(crate) fn bilinear(texels: &[Vec3], side: u32, direction: DVec3) -> DVec3 {
    let at = place(direction) * f64::from(side) - 0.5;
    let low = at.floor();
    let [x, y] = [low.x as i64, low.y as i64];
    let weight = at - low;
    let texel = |x, y| texels[folded(x, y, i64::from(side))].as_dvec3();
    let top = texel(x, y).lerp(texel(x + 1, y), weight.x);
    let bottom = texel(x, y + 1).lerp(texel(x + 1, y + 1), weight.x);
    top.lerp(bottom, weight.y)
}

fn equirectangular(image: &LinearImage, direction: DVec3) -> DVec3 {
    let (width, height) = image.dimensions();
    let x = (direction.z.atan2(direction.x) / std::f64::consts::TAU + 0.5) * f64::from(width) - 0.5;
    let y = direction.y.clamp(-1.0, 1.0).acos() / std::f64::consts::PI * f64::from(height) - 0.5;
    let pixel = |x: f64, y: f64| {
        let column = (x as i64).rem_euclid(i64::from(width)) as u32;
        let row = y.clamp(0.0, f64::from(height - 1)) as u32;
        Vec3::from(image.get_pixel(column, row).0).as_dvec3()
    };
    let (left, above) = (x.floor(), y.floor());
    let top = pixel(left, above).lerp(pixel(left + 1.0, above), x - left);
    let bottom = pixel(left, above + 1.0).lerp(pixel(left + 1.0, above + 1.0), x - left);
    top.lerp(bottom, y - above)
}

#[cfg(test)]
mod tests;
