//! The distribution by which paths draw directions of an environment map.

use super::{EnvironmentMap, on_octahedron};
use glam::{DVec2, DVec3};

/// The most texels along a side of the distribution.
const MOST: u32 = 64;

/// Share of the probability that all directions have, so that none that interpolation lights is left out.
const EVENLY: f64 = 0.01;

/// Square texels of the octahedral map, each with a probability in proportion to its power; within a texel, places are
/// uniform.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentDistribution {
    /// Width and height in texels.
    pub side: u32,
    /// Cumulative probability up to and including each texel, row by row, and its own probability.
    pub shares: Vec<[f32; 2]>,
}

impl EnvironmentDistribution {
    /// The distribution of a map.
    #[must_use]
    pub fn of(map: &EnvironmentMap) -> Self {
        let side = map.side().min(MOST);
        let texel = |i: u32| i * side / map.side();
        let mut powers = vec![0.0; (side * side) as usize];
        let mut evenly = powers.clone();
        for (i, (_, solid_angle, radiance)) in (0..).zip(map.weighted()) {
            let index = (texel(i / map.side()) * side + texel(i % map.side())) as usize;
            powers[index] += solid_angle * radiance.element_sum();
            evenly[index] += solid_angle;
        }
        let [total, all] = [powers.iter().sum::<f64>(), evenly.iter().sum()];
        // A black map is sampled evenly.
        let lit = if total > 0.0 { (1.0 - EVENLY) / total } else { 0.0 };
        let rest = if total > 0.0 { EVENLY / all } else { 1.0 / all };
        let mut so_far = 0.0;
        let mut shares: Vec<[f32; 2]> = powers
            .iter()
            .zip(evenly)
            .map(|(power, solid_angle)| {
                let probability = lit * power + rest * solid_angle;
                so_far += probability;
                [so_far as f32, probability as f32]
            })
            .collect();
        if let Some([last, _]) = shares.last_mut() {
            *last = 1.0;
        }
        Self { side, shares }
    }

    /// The direction that uniform numbers in [0, 1) select in the map's frame: one the texel, two the place in it.
    #[must_use]
    pub fn draw(&self, number: f32, place: DVec2) -> DVec3 {
        let index =
            self.shares.partition_point(|[share, _]| *share <= number).min(self.shares.len() - 1) as u32;
        let corner = DVec2::new(f64::from(index % self.side), f64::from(index / self.side));
        on_octahedron((corner + place) / f64::from(self.side)).normalize()
    }

    /// Density of [`EnvironmentDistribution::draw`] at a unit direction, per unit of solid angle.
    #[must_use]
    pub fn density(&self, direction: DVec3) -> f64 {
        let side = f64::from(self.side);
        let place = (super::place(direction) * side).floor().clamp(DVec2::ZERO, DVec2::splat(side - 1.0));
        let [_, probability] = self.shares[(place.y * side + place.x) as usize];
        let norm = direction.x.abs() + direction.y.abs() + direction.z.abs();
        f64::from(probability) * 0.25 * side * side / norm.powi(3)
    }
}
