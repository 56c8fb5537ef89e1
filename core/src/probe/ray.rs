//! Rays as callers give them, and as the shaders expect them.

use glam::Vec3;

use crate::{device::mirror::gpu_struct, reference, scene::MAX_COORDINATE};

gpu_struct! {
    /// A ray; `direction` may have any length. A ray that is none meets nothing: a direction of zero or with a component
    /// that is not finite, an origin beyond 16 [`MAX_COORDINATE`] or not a number, an end that is not a number.
    pub struct ProbeRay {
        /// Origin in world space.
        origin: [f32; 3],
        /// Hits at this parameter or beyond do not count.
        t_max: f32,
        /// Direction in world space, of any length.
        direction: [f32; 3],
        /// Not 0: any hit will do (a shadow ray).
        any: u32,
        /// 1 + the primitive (in the order of the leaves) that the ray leaves and does not meet again; 0 for none.
        left: u32,
        /// Width of what the ray stands for where it starts, in units of the scene.
        width: f32,
        /// Growth of the cone's width per unit of distance.
        growth: f32,
        /// Padding to the struct's alignment.
        padding: u32,
    }
}

impl ProbeRay {
    /// The same ray for the reference, and the factor from its parameter to a distance.
    #[must_use]
    pub fn exact(&self) -> (reference::Ray, f64) {
        let direction = Vec3::from(self.direction).as_dvec3();
        let origin = Vec3::from(self.origin).as_dvec3();
        let length = direction.length();
        let t_max = f64::from(self.t_max) * length;
        let [width, growth] = [self.width, self.growth].map(f64::from);
        (reference::Ray { origin, direction: direction / length, t_max, width, growth }, length)
    }
}

/// The same ray with a direction whose largest component is in [1, 2), and what its parameters are multiplied by to
/// be the caller's. Rays of cameras and surfaces are like that already, within a factor that the size of a
/// frame bounds.
pub(super) fn sane(ray: &ProbeRay) -> (ProbeRay, f64) {
    let largest = ray.direction.iter().fold(0.0_f32, |a, b| a.max(b.abs()));
    let finite = ray.direction.iter().all(|x| x.is_finite());
    let near = ray.origin.iter().all(|x| x.abs() <= 16.0 * MAX_COORDINATE);
    if !finite || !near || largest == 0.0 || ray.t_max.is_nan() {
        let nowhere = ProbeRay { origin: [0.0; 3], t_max: 0.0, direction: [0.0, 0.0, 1.0], ..*ray };
        return (nowhere, 1.0);
    }
    // Powers of two, in f64: no product but one that a thousandth of the rounding hides is rounded.
    let unit = f64::from(largest).log2().floor().exp2();
    let direction = ray.direction.map(|x| (f64::from(x) / unit) as f32);
    // Infinity is beyond the range that shaders must know.
    let t_max = (f64::from(ray.t_max) * unit).min(FAR) as f32;
    (ProbeRay { t_max, direction, ..*ray }, 1.0 / unit)
}

const FAR: f64 = 3.0e38;

#[cfg(test)]
mod tests {
    use super::*;

    fn ray(direction: [f32; 3]) -> ProbeRay {
        ProbeRay { origin: [1.0, 2.0, 3.0], t_max: 4.0, direction, ..ProbeRay::default() }
    }

    #[test]
    fn directions_of_any_length() {
        for length in [1e-44_f32, 1.2e-38, 1e-20, 0.3, 1.0, 7.0, 1e20, 3e38] {
            let (found, scale) = sane(&ray([0.5 * length, -length, 0.0]));
            let [x, y, z] = found.direction.map(f64::from);
            assert!((1.0..2.0).contains(&-y) && z == 0.0, "{length}: {found:?}");
            assert!(
                (x / y - f64::from(0.5 * length) / f64::from(-length)).abs() < 1e-12,
                "{length}: {found:?}"
            );
            assert!((f64::from(length) * scale / -y - 1.0).abs() < 1e-12, "{length}");
        }
        assert_eq!(sane(&ray([0.0, 0.0, 4.0])).0.t_max, 16.0);
    }

    #[test]
    fn what_is_no_ray_goes_nowhere() {
        let far = ProbeRay { origin: [f32::INFINITY, 0.0, 0.0], ..ray([1.0, 0.0, 0.0]) };
        let unknown = ProbeRay { origin: [0.0, f32::NAN, 0.0], ..ray([1.0, 0.0, 0.0]) };
        let endless = ProbeRay { t_max: f32::NAN, ..ray([1.0, 0.0, 0.0]) };
        let others = [[0.0, -0.0, 0.0], [f32::NAN, 1.0, 0.0], [f32::INFINITY, 1.0, 0.0]].map(ray);
        for none in others.into_iter().chain([far, unknown, endless]) {
            assert_eq!(sane(&none).0.t_max, 0.0, "{none:?}");
        }
        assert!(sane(&ProbeRay { t_max: f32::INFINITY, ..ray([1.0, 0.0, 0.0]) }).0.t_max.is_finite());
    }
}
