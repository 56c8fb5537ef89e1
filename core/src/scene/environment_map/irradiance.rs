//! Irradiance of all surfaces that an environment map lights.

use glam::{DVec2, DVec3};

use super::{EnvironmentMap, FilteredLevel, direction};

/// Width of the irradiance map in texels, whose bilinear interpolation is within 2 % of the brightest irradiance.
const SIDE: u32 = 64;

/// Blocks along a side of the map whose light arrives from one direction each.
const BLOCKS: u32 = 32;

/// The light of a block of texels: solid angle, radiance times solid angle, and the direction that it comes from, weighted
/// by radiance.
#[derive(Clone, Copy, Default)]
struct Block {
    weight: f64,
    light: DVec3,
    direction: DVec3,
}

impl EnvironmentMap {
    /// Irradiance over pi by unit normal, that is, the mean radiance that a matte surface receives, in the projection of
    /// the map: the integral of radiance times the clamped cosine.
    #[must_use]
    pub fn irradiance_over_pi(&self) -> FilteredLevel {
        let mean = self.mean().as_dvec3();
        let blocks = self.blocks(mean);
        let texels = (0..SIDE * SIDE).map(|i| {
            let place = DVec2::new(f64::from(i % SIDE) + 0.5, f64::from(i / SIDE) + 0.5) / f64::from(SIDE);
            let normal = direction(place);
            let (mut light, mut weight) = (DVec3::ZERO, 0.0);
            for block in &blocks {
                let cosine = normal.dot(block.direction).max(0.0);
                light += cosine * block.light;
                weight += cosine * block.weight;
            }
            (mean + light / weight).max(DVec3::ZERO).as_vec3()
        });
        FilteredLevel { side: SIDE, texels: texels.collect() }
    }

    /// The map in blocks, with radiance as its deviation from the mean, so that a constant map has exactly the mean.
    fn blocks(&self, mean: DVec3) -> Vec<Block> {
        let side = self.side();
        let count = BLOCKS.min(side);
        let mut blocks = vec![Block::default(); (count * count) as usize];
        for (i, (direction, weight, radiance)) in (0..).zip(self.weighted()) {
            let (x, y) = (i % side * count / side, i / side * count / side);
            let block = &mut blocks[(y * count + x) as usize];
            block.weight += weight;
            block.light += weight * (radiance - mean);
            block.direction += weight * (radiance.element_sum() + mean.element_sum()) * direction;
        }
        for (i, block) in (0..).zip(&mut blocks) {
            let place = DVec2::new(f64::from(i % count) + 0.5, f64::from(i / count) + 0.5) / f64::from(count);
            block.direction = block.direction.normalize_or(direction(place));
        }
        blocks
    }
}
