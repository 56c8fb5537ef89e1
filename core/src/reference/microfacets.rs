//! Reflection by microfacets along paths: the distribution of Trowbridge and Reitz (GGX) with height-correlated
//! shadowing (Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs").

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec2, DVec3};

use crate::scene::LobeAlbedos;

/// Least cosine of the view angle.
const LEAST_COSINE: f64 = 1.0e-3;

/// Reflectance of microfacets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reflectance {
    /// At normal and at grazing incidence.
    pub f0: DVec3,
    pub f90: DVec3,
    /// The viewer's index of refraction over that of the other side, of a surface that transmits light.
    pub ratio: Option<f64>,
}

impl Reflectance {
    /// Schlick's approximation; from the denser side, at the angle of refraction.
    pub fn at(&self, cosine: f64) -> DVec3 {
        let cosine = cosine.clamp(0.0, 1.0);
        let across = match self.ratio {
            Some(ratio) if ratio > 1.0 => (1.0 - ratio * ratio * (1.0 - cosine * cosine)).max(0.0).sqrt(),
            _ => cosine,
        };
        self.f0 + (self.f90 - self.f0) * (1.0 - across).powi(5)
    }
}

/// A lobe around a normal, seen from a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Microfacets {
    /// Tangent, bitangent and normal.
    frame: DMat3,
    /// Unit vector to the viewer, in the frame.
    view: DVec3,
    /// Widths along tangent and bitangent.
    alpha: DVec2,
    reflectance: Reflectance,
    scale: DVec3,
    /// Directional albedo.
    pub albedo: DVec3,
}

impl Microfacets {
    /// The lobe of a surface; what microfacets scatter more than once has the lobe's shape (Turquin 2019, "Practical
    /// multiple scattering compensation for microfacet models", equation 16), unless the surface transmits light.
    pub fn new(
        frame: DMat3,
        view: DVec3,
        alpha: DVec2,
        reflectance: Reflectance,
        albedos: &LobeAlbedos,
    ) -> Self {
        let local = frame.transpose() * view;
        let view = DVec3::new(local.x, local.y, local.z.max(LEAST_COSINE)).normalize();
        let mut shares = albedos.at(view.z, (alpha.x * alpha.y).powf(0.25));
        if alpha.x != alpha.y {
            // More than the albedo of an anisotropic lobe, so that compensation never adds light.
            let more = 1.0 + 0.3 * (1.0 - (alpha.min_element() / alpha.max_element()).sqrt());
            shares.x = (more * shares.x).min(1.0);
        }
        let Reflectance { f0, f90, ratio } = reflectance;
        let (scale, albedo) = match ratio {
            Some(_) => (DVec3::ONE, shares.x * reflectance.at(view.z)),
            None => {
                let scale = 1.0 + f0 * (1.0 / shares.x - 1.0);
                (scale, scale * (f0 * shares.x + (f90 - f0) * shares.y))
            }
        };
        Self { frame, view, alpha, reflectance, scale, albedo }
    }

    /// The lobe under a layer that lets these shares through.
    pub fn under(self, shares: DVec3) -> Self {
        Self { scale: shares * self.scale, albedo: shares * self.albedo, ..self }
    }

    /// Smith's function of shadowed over unshadowed slopes for a direction in the frame.
    fn lambda(&self, v: DVec3) -> f64 {
        let slope2 = (self.alpha * v.truncate()).length_squared() / (v.z * v.z);
        0.5 * ((1.0 + slope2).sqrt() - 1.0)
    }

    fn distribution(&self, h: DVec3) -> f64 {
        let [x, y] = [h.x / self.alpha.x, h.y / self.alpha.y];
        1.0 / (PI * self.alpha.x * self.alpha.y * (x * x + y * y + h.z * h.z).powi(2))
    }

    /// The lobe times the cosine for light from a direction of the world, and the density with which it is drawn.
    pub fn response(&self, direction: DVec3) -> (DVec3, f64) {
        let light = self.frame.transpose() * direction;
        if light.z <= 0.0 {
            return (DVec3::ZERO, 0.0);
        }
        let h = (self.view + light).normalize_or_zero();
        let d = self.distribution(h);
        let both = 1.0 / (1.0 + self.lambda(self.view) + self.lambda(light));
        let visible = 1.0 / (1.0 + self.lambda(self.view));
        let value = self.reflectance.at(self.view.dot(h)) * self.scale * (d * both / (4.0 * self.view.z));
        (value, d * visible / (4.0 * self.view.z))
    }

    /// A visible normal in the frame (Dupuy, Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps").
    fn normal(&self, [u, v]: [f64; 2]) -> DVec3 {
        let stretch = |v: DVec3| DVec3::new(self.alpha.x * v.x, self.alpha.y * v.y, v.z);
        let view = stretch(self.view).normalize();
        let z = (1.0 - v) * (1.0 + view.z) - view.z;
        let r = (1.0 - z * z).clamp(0.0, 1.0).sqrt();
        stretch(DVec3::new(r * (TAU * u).cos(), r * (TAU * u).sin(), z) + view).normalize()
    }

    /// A direction of the world that the lobe reflects to the viewer.
    pub fn draw(&self, random: [f64; 2]) -> DVec3 {
        let h = self.normal(random);
        self.frame * (2.0 * self.view.dot(h) * h - self.view)
    }

    /// Direction of the world in which a microfacet refracts (Walter et al. 2007), and its weight; `thin` turns what is
    /// reflected to the other side. `None` for total reflection.
    pub fn refract(&self, thin: bool, ratio: f64, random: [f64; 2]) -> Option<(DVec3, DVec3)> {
        let h = self.normal(random);
        let cosine = self.view.dot(h);
        let beyond = if thin {
            let reflected = 2.0 * cosine * h - self.view;
            DVec3::new(reflected.x, reflected.y, -reflected.z)
        } else {
            let other2 = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
            if other2 <= 0.0 {
                return None;
            }
            (ratio * cosine - other2.sqrt()) * h - ratio * self.view
        };
        if beyond.z >= 0.0 {
            return None;
        }
        let lambdas = [self.view, beyond].map(|v| self.lambda(v));
        let unshadowed = (1.0 + lambdas[0]) / (1.0 + lambdas[0] + lambdas[1]);
        Some((self.frame * beyond, (1.0 - self.reflectance.at(cosine)) * unshadowed))
    }

    /// Reflectance of the surface as a plane.
    pub fn reflectance(&self, cosine: f64) -> DVec3 {
        self.reflectance.at(cosine)
    }
}
