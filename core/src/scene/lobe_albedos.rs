//! Directional albedos of microfacet lobes, tabulated by quadrature.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, DVec4, Vec4Swizzles as _};

/// Entries along each axis of the table.
pub const ALBEDO_SIDE: usize = 32;
/// Samples of the quadrature: of the slope of normals, and of the turn around the stretched view.
const QUADRATURE: [usize; 2] = [48, 24];
/// Least width of a lobe in the table.
const LEAST_ALPHA: f64 = 1.0e-3;
/// Least roughness of a sheen.
pub const LEAST_SHEEN_ROUGHNESS: f32 = 0.07;

/// The share of white light from all directions that a lobe reflects to a viewer, by the cosine of the view angle and
/// roughness.
#[derive(Clone, Debug)]
pub struct LobeAlbedos {
    /// Row by row: roughness grows with the row from 0 to 1, and the square root of the cosine with the column. Each
    /// has the albedo of a GGX lobe of reflectance 1, and the part of it that Schlick's approximation weights by the
    /// reflectance at grazing incidence; then the albedo of a white sheen, and the
    /// factor on the sheen that keeps it at most 1.
    pub entries: Vec<[f32; 4]>,
}

impl LobeAlbedos {
    /// Integrates the lobes.
    #[must_use]
    pub fn new() -> Self {
        let last = (ALBEDO_SIDE - 1) as f64;
        let entry = |row: usize, column: usize| {
            let cosine = (column as f64 / last).powi(2).max(1.0e-4);
            let roughness = row as f64 / last;
            let [all, grazing] = ggx(cosine, roughness.powi(2).max(LEAST_ALPHA));
            let fibres = sheen(cosine, roughness);
            [all as f32, grazing as f32, fibres.min(1.0) as f32, fibres.max(1.0).recip() as f32]
        };
        let entries = (0..ALBEDO_SIDE).flat_map(|row| (0..ALBEDO_SIDE).map(move |column| entry(row, column)));
        Self { entries: entries.collect() }
    }

    /// The first two numbers of the entries, interpolated bilinearly.
    #[must_use]
    pub fn at(&self, cosine: f64, roughness: f64) -> DVec2 {
        self.interpolated(cosine, roughness).xy()
    }

    /// Albedo of a white sheen, and the factor that keeps it at most 1.
    #[must_use]
    pub fn sheen(&self, cosine: f64, roughness: f64) -> [f64; 2] {
        let entry = self.interpolated(cosine, roughness);
        [entry.z, entry.w]
    }

    fn interpolated(&self, cosine: f64, roughness: f64) -> DVec4 {
        let place = DVec2::new(cosine.clamp(0.0, 1.0).sqrt(), roughness.clamp(0.0, 1.0));
        let place = place * (ALBEDO_SIDE - 1) as f64;
        let low = place.floor().min(DVec2::splat((ALBEDO_SIDE - 2) as f64));
        let weight = place - low;
        let entry = |x: usize, y: usize| {
            let entry = self.entries[(low.y as usize + y) * ALBEDO_SIDE + low.x as usize + x];
            DVec4::from_array(entry.map(f64::from))
        };
        entry(0, 0).lerp(entry(1, 0), weight.x).lerp(entry(0, 1).lerp(entry(1, 1), weight.x), weight.y)
    }
}

impl Default for LobeAlbedos {
    fn default() -> Self {
        Self::new()
    }
}

/// Albedo of a GGX lobe of reflectance 1 with height-correlated shadowing, and the part that (1 - v.h)^5 weights; over
/// visible normals (Dupuy, Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps").
fn ggx(cosine: f64, alpha: f64) -> [f64; 2] {
    let view = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
    let stretched = DVec3::new(alpha * view.x, 0.0, view.z);
    let toward_view = stretched.length();
    let stretched = stretched / toward_view;
    let mut sums = [0.0; 2];
    let [slopes, turns] = QUADRATURE;
    for i in 0..slopes * turns {
        let (u, v) = ((i % slopes) as f64 + 0.5, (i / slopes) as f64 + 0.5);
        let (u, v) = (u / slopes as f64, v / turns as f64);
        // More samples where normals are steep: GGX has a long tail.
        let weight = 3.0 * u * u;
        let z = u.powi(3) * (1.0 + stretched.z) - stretched.z;
        let r = (1.0 - z * z).max(0.0).sqrt();
        // The lobe is symmetric: half of the turn suffices.
        let cap = DVec3::new(r * (PI * v).cos(), r * (PI * v).sin(), z) + stretched;
        let half_way = DVec3::new(alpha * cap.x, alpha * cap.y, cap.z).normalize();
        let along = view.dot(half_way);
        let light = 2.0 * along * half_way - view;
        if light.z > 0.0 {
            let toward_light = light.z.hypot(alpha * light.x.hypot(light.y));
            let share =
                weight * light.z * (cosine + toward_view) / (cosine * toward_light + light.z * toward_view);
            sums[0] += share;
            sums[1] += share * (1.0 - along.clamp(0.0, 1.0)).powi(5);
        }
    }
    sums.map(|sum| (sum / (slopes * turns) as f64).min(1.0))
}

/// Albedo of a sheen of reflectance 1, over directions of light, denser near the horizon; the formulas are in
/// `core/MATERIALS.md`.
fn sheen(cosine: f64, roughness: f64) -> f64 {
    let inverse = roughness.max(f64::from(LEAST_SHEEN_ROUGHNESS)).powi(-2);
    let view = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
    let [heights, turns] = QUADRATURE;
    let mut sum = 0.0;
    for i in 0..heights * turns {
        let t = ((i % heights) as f64 + 0.5) / heights as f64;
        let phi = PI * ((i / heights) as f64 + 0.5) / turns as f64;
        let (z, r) = (t * t, (1.0 - t.powi(4)).sqrt());
        let half_way = (view + DVec3::new(r * phi.cos(), r * phi.sin(), z)).normalize();
        let sine2 = (1.0 - half_way.z * half_way.z).max(0.0);
        let distribution = (2.0 + inverse) * sine2.powf(0.5 * inverse) / TAU;
        sum += 2.0 * t * distribution * z / (4.0 * (z + cosine - z * cosine));
    }
    sum * TAU / (heights * turns) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same integral over directions of light instead of normals, by another formula of the lobe.
    fn over_directions(cosine: f64, alpha: f64) -> f64 {
        const STEPS: usize = 400;
        let view = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
        let lambda = |z: f64| 0.5 * ((1.0 + alpha * alpha * (1.0 - z * z) / (z * z)).sqrt() - 1.0);
        let mut sum = 0.0;
        for i in 0..STEPS * STEPS {
            let [u, v] = [i % STEPS, i / STEPS].map(|k| (k as f64 + 0.5) / STEPS as f64);
            let (z, phi) = (u, TAU * v);
            let r = (1.0 - z * z).sqrt();
            let light = DVec3::new(r * phi.cos(), r * phi.sin(), z);
            let h = (light + view).normalize();
            let d = alpha * alpha / (PI * (h.z * h.z * (alpha * alpha - 1.0) + 1.0).powi(2));
            sum += d / (1.0 + lambda(z) + lambda(cosine)) / (4.0 * cosine);
        }
        sum * TAU / (STEPS * STEPS) as f64
    }

    #[test]
    fn entries_are_the_integral_of_the_lobe() {
        let albedos = LobeAlbedos::new();
        for (cosine, roughness) in [(0.9, 1.0), (0.3, 0.8), (0.6, 0.6), (0.15, 0.7), (0.95, 0.3)] {
            let (found, exact) =
                (albedos.at(cosine, roughness).x, over_directions(cosine, roughness * roughness));
            assert!((found - exact).abs() < 3.0e-3, "{cosine} {roughness}: {found}, not {exact}");
        }
        assert!(
            albedos
                .entries
                .iter()
                .all(|[all, grazing, sheen, _]| 0.0 <= *grazing && grazing <= all && all.max(*sheen) <= 1.0)
        );
    }
}
