//! Thin films (KHR_materials_iridescence), by the model of Belcour and Barla 2017 ("A Practical Extension to Microfacet
//! Theory for the Modeling of Varying Iridescence").

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};

use super::Material;

/// A film over a point of a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Film {
    /// Share of the surface that it covers.
    pub strength: f64,
    pub ior: f64,
    /// In nanometres.
    pub thickness: f64,
}

impl Film {
    /// Reflectance over a base of this reflectance at normal incidence.
    fn over(&self, f0: DVec3, cosine: f64) -> DVec3 {
        let t = (self.thickness / 0.03).clamp(0.0, 1.0);
        let ior = 1.0 + (self.ior - 1.0) * t * t * (3.0 - 2.0 * t);
        let sine2 = (1.0 - cosine * cosine) / (ior * ior);
        if sine2 >= 1.0 {
            return DVec3::ONE;
        }
        let inner = (1.0 - sine2).sqrt();
        let schlick = |f0: f64, cosine: f64| f0 + (1.0 - f0) * (1.0 - cosine).powi(5);
        let top = schlick(((ior - 1.0) / (ior + 1.0)).powi(2), cosine);
        // By channel: the base, the half waves lost at both boundaries, and the Airy sum up to its second order.
        let base_iors =
            f0.clamp(DVec3::ZERO, DVec3::splat(0.9999)).map(|f| (1.0 + f.sqrt()) / (1.0 - f.sqrt()));
        let base = base_iors.map(|base| schlick(((base - ior) / (base + ior)).powi(2), inner));
        let shift = base_iors.map(|base| PI + if base < ior { PI } else { 0.0 });
        let path = 2.0 * ior * self.thickness * inner;
        let both = (top * base).min(DVec3::splat(0.9999));
        let through = (1.0 - top).powi(2) * base / (1.0 - both);
        let mut sum = top + through;
        for order in 1..=2 {
            let weight = both.powf(0.5 * f64::from(order)) * (through - (1.0 - top));
            sum += 2.0 * weight * sensitivity(f64::from(order) * path, f64::from(order) * shift);
        }
        sum.clamp(DVec3::ZERO, DVec3::ONE)
    }
}

/// Fourier transform of the eye's sensitivity, in linear RGB, at an optical path difference in nanometres.
fn sensitivity(path: f64, shift: DVec3) -> DVec3 {
    let phase = TAU * 1.0e-9 * path;
    let gaussian = |height: f64, place: f64, width: f64, shift: f64| {
        height * (TAU * width).sqrt() * (place * phase + shift).cos() * (-width * phase * phase).exp()
    };
    let x =
        gaussian(5.4856e-13, 1.6810e6, 4.3278e9, shift.x) + gaussian(9.7470e-14, 2.2399e6, 4.5282e9, shift.x);
    let y = gaussian(4.4201e-13, 1.7953e6, 9.3046e9, shift.y);
    let z = gaussian(5.2481e-13, 2.2084e6, 6.6121e9, shift.z);
    let xyz_to_rgb = DMat3::from_cols_array(&[
        3.240_454_2,
        -0.969_266,
        0.055_643_4,
        -1.537_138_5,
        1.876_010_8,
        -0.204_025_9,
        -0.498_531_4,
        0.041_556,
        1.057_225_2,
    ]);
    xyz_to_rgb * DVec3::new(x, y, z) / 1.0685e-7
}

impl Material {
    /// A reflectance of the surface, as if it had this metalness, under its film. `ratio` is the viewer's index over
    /// that of the other side.
    pub(super) fn filmed(&self, metallic: f64, reflectance: DVec3, cosine: f64, ratio: f64) -> DVec3 {
        let Some(film) = self.film else { return reflectance };
        // From the denser side, the angle of refraction counts.
        let outside2 =
            if ratio > 1.0 { 1.0 - ratio * ratio * (1.0 - cosine * cosine) } else { cosine * cosine };
        if outside2 <= 0.0 {
            return reflectance;
        }
        let [dielectric, metal] = [self.at_normal(), self.base].map(|f0| film.over(f0, outside2.sqrt()));
        reflectance.lerp(dielectric.lerp(metal, metallic), film.strength)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A film of no thickness is none along the normal, one of its base's index neither, and one of a quarter of a wave over
    /// denser glass takes away most of the glass' reflection, as the coating of a lens does.
    #[test]
    fn films_are_those_of_optics() {
        let film = |ior: f64, thickness: f64| Film { strength: 1.0, ior, thickness };
        for bare in [film(1.8, 0.0), film(1.5, 300.0)] {
            let found = bare.over(DVec3::splat(0.04), 1.0);
            assert!((found - 0.04).abs().max_element() < 1.0e-9, "{found}");
        }
        let glass = DVec3::splat((0.8_f64 / 2.8).powi(2));
        let coated = film(1.38, 550.0 / (4.0 * 1.38)).over(glass, 1.0);
        // By exact amplitudes ((n^2 - n_b) / (n^2 + n_b))^2 = 0.0008 at 550 nm, of the glass' 0.0816.
        assert!(coated.y < 0.005 && coated.max_element() < 0.2 * glass.x, "{coated}");
    }
}
