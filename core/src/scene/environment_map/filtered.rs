//! Levels of an environment map that are filtered by microfacet lobes, for rough reflection.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};

use super::{EnvironmentMap, bilinear, direction};
use glam::DVec2;

/// Width of the finest filtered level in texels; each further level has half of it, down to 8.
pub const FIRST_FILTERED: u32 = 128;

/// Width of the coarsest filtered level in texels, which is that of roughness 1.
const LAST_FILTERED: u32 = 8;

/// A level `side` texels wide is filtered for `alpha = WIDEST_LOBE / side`.
pub const WIDEST_LOBE: f32 = LAST_FILTERED as f32;

/// Directions that are averaged for a texel of the finest filtered level; each further level takes twice as many.
const DIRECTIONS: u32 = 64;

/// Radiance averaged over lobes, in the projection of the map. Of [`EnvironmentMap::filtered`] a level is for the lobe of
/// a GGX distribution with `alpha = 8 / side`, seen along the normal: weighted by the probability of microfacets that
/// reflect the radiance, times the cosine.
#[derive(Clone, Debug, PartialEq)]
pub struct FilteredLevel {
    /// Width and height in texels.
    pub side: u32,
    /// Radiance of each texel, row by row, in the same projection as the map.
    pub texels: Vec<Vec3>,
}

impl EnvironmentMap {
    /// The filtered levels, from the narrowest lobe to the widest.
    #[must_use]
    pub fn filtered(&self) -> Vec<FilteredLevel> {
        let averages = averages(self);
        let mean = self.mean().as_dvec3();
        let sides = std::iter::successors(Some(FIRST_FILTERED), |side| Some(side / 2));
        sides.take_while(|side| *side >= LAST_FILTERED).map(|side| filtered(&averages, mean, side)).collect()
    }
}

/// A square map and its averages over 2x2, 4x4, ... texels.
fn averages(map: &EnvironmentMap) -> Vec<(u32, Vec<Vec3>)> {
    let mut levels = vec![(map.side, map.texels.clone())];
    while let Some((side, texels)) = levels.last()
        && *side > 1
    {
        let half = side / 2;
        let at = |x: u32, y: u32| texels[(y * side + x) as usize];
        let averaged = (0..half * half).map(|i| {
            let (x, y) = (2 * (i % half), 2 * (i / half));
            0.25 * (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1))
        });
        let averaged = averaged.collect();
        levels.push((half, averaged));
    }
    levels
}

/// Importance sampling of the lobe, each sample from the averages that have its share of the solid angle (Colbert &
/// Krivanek 2007, "GPU-Based Importance Sampling").
fn filtered(averages: &[(u32, Vec<Vec3>)], mean: DVec3, side: u32) -> FilteredLevel {
    let alpha = f64::from(LAST_FILTERED) / f64::from(side);
    let directions = DIRECTIONS * (FIRST_FILTERED / side);
    let texel = 4.0 * PI / f64::from(averages[0].0).powi(2);
    // Cosine to the normal, direction in the plane, weight and level of each sample, the same for every texel.
    let samples: Vec<_> = (0..directions)
        .map(|i| {
            let (u, v) =
                ((f64::from(i) + 0.5) / f64::from(directions), f64::from(i.reverse_bits()) / 2_f64.powi(32));
            let half2 = (1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u);
            let density = (alpha / ((alpha * alpha - 1.0) * half2 + 1.0)).powi(2) / PI;
            let cosine = 2.0 * half2 - 1.0;
            let around = (1.0 - cosine * cosine).max(0.0).sqrt() * DVec2::from_angle(TAU * v);
            let share = 4.0 / (f64::from(directions) * density);
            let level = 0.5 * (share / texel).log2() + 0.5;
            (around.extend(cosine), cosine.max(0.0), level.clamp(0.0, (averages.len() - 1) as f64))
        })
        .collect();
    let texels = (0..side * side).map(|i| {
        let place = DVec2::new(f64::from(i % side) + 0.5, f64::from(i / side) + 0.5) / f64::from(side);
        let normal = direction(place);
        let (x, y) = normal.any_orthonormal_pair();
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        for (sample, weight, level) in &samples {
            let towards = sample.x * x + sample.y * y + sample.z * normal;
            let (low, share) = (level.floor() as usize, level.fract());
            let of = |level: usize| {
                let (side, texels) = &averages[level.min(averages.len() - 1)];
                bilinear(texels, *side, towards)
            };
            // Of the deviation from the mean, so that a constant map stays as it is.
            sum += *weight * (of(low).lerp(of(low + 1), share) - mean);
            weights += weight;
        }
        (mean + sum / weights).max(DVec3::ZERO).as_vec3()
    });
    FilteredLevel { side, texels: texels.collect() }
}
