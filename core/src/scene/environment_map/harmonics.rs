//! Irradiance by the first nine spherical harmonics.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};

use super::EnvironmentMap;

/// Irradiance over pi, that is, the mean radiance that a matte surface receives, as a polynomial of the unit normal
/// (Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps"). Its error is at most
/// 9 %, and 3 % on average, for radiance that is nowhere negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonics(
    /// Coefficients of 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2.
    pub [Vec3; 9],
);

/// The polynomials of a unit vector, without their constant factors.
fn basis(n: DVec3) -> [f64; 9] {
    [1.0, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0 * n.z * n.z - 1.0, n.x * n.z, n.x * n.x - n.y * n.y]
}

/// Squares of the constant factors of the harmonics, times the factors pi, 2 pi / 3 and pi / 4 of the clamped cosine for
/// each degree, over pi.
fn factors() -> [f64; 9] {
    let [first, second] = [3.0 / (4.0 * PI) * (2.0 / 3.0), 15.0 / (4.0 * PI) * 0.25];
    let [middle, last] = [5.0 / (16.0 * PI) * 0.25, 15.0 / (16.0 * PI) * 0.25];
    [1.0 / (4.0 * PI), first, first, first, second, second, middle, second, last]
}

impl Harmonics {
    /// Projects the radiance of a map onto the nine harmonics and convolves it with the clamped cosine.
    #[must_use]
    pub fn of(map: &EnvironmentMap) -> Self {
        let mean = map.mean().as_dvec3();
        let mut sums = [DVec3::ZERO; 9];
        let mut solid_angle = 0.0;
        for (direction, weight, radiance) in map.weighted() {
            solid_angle += weight;
            // Of the deviation from the mean, so that a constant map has exactly one coefficient.
            let deviation = weight * (radiance - mean);
            for (sum, value) in sums.iter_mut().zip(basis(direction)) {
                *sum += value * deviation;
            }
        }
        let scale = 4.0 * PI / solid_angle;
        let mut coefficients = [Vec3::ZERO; 9];
        for ((coefficient, sum), factor) in coefficients.iter_mut().zip(sums).zip(factors()) {
            *coefficient = (scale * factor * sum).as_vec3();
        }
        coefficients[0] = (mean + coefficients[0].as_dvec3()).as_vec3();
        Self(coefficients)
    }

    /// The mean radiance that a matte surface with this unit normal receives.
    #[must_use]
    pub fn irradiance_over_pi(&self, normal: DVec3) -> DVec3 {
        let terms = self.0.iter().zip(basis(normal));
        terms.map(|(coefficient, value)| coefficient.as_dvec3() * value).sum::<DVec3>().max(DVec3::ZERO)
    }
}
