//! The distribution by which paths draw directions of an environment map: hierarchical sample warping (Clarberg et al.
//! 2005, "Wavelet Importance Sampling").

use glam::{DVec2, DVec3, Vec2};

use super::{EnvironmentMap, on_octahedron};

/// The most texels along a side of the distribution, of which a sun half a degree wide covers four.
const MOST: u32 = 1024;

/// Share of the probability that all directions have, so that none that interpolation lights is left out.
const EVENLY: f64 = 0.01;

/// The largest number below 1 in f32.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

/// Probabilities of the texels of the octahedral map, in proportion to their power, and of their squares of 2x2, 4x4, ...
/// texels; within a texel, places are uniform.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentDistribution {
    /// Width and height of each level, from the texels to 2x2 squares, and its probabilities row by row.
    pub levels: Vec<(u32, Vec<f32>)>,
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
        let texels = powers.iter().zip(evenly).map(|(power, solid_angle)| lit * power + rest * solid_angle);
        let finest = (side, texels.collect::<Vec<_>>());
        let levels = std::iter::successors(Some(finest), |level| (level.0 > 2).then(|| halved(level)));
        let rounded = |level: Vec<f64>| level.into_iter().map(|probability| probability as f32).collect();
        Self { levels: levels.map(|(side, level)| (side, rounded(level))).collect() }
    }

    /// The direction that two uniform numbers in [0, 1) select in the map's frame. In f32, as in the kernels: the
    /// decisions must be the same.
    #[must_use]
    pub fn draw(&self, number: Vec2) -> DVec3 {
        let mut number = number;
        let (mut x, mut y) = (0, 0);
        for (side, level) in self.levels.iter().rev() {
            (x, y) = (2 * x, 2 * y);
            let at = |x: usize, y: usize| level[y * *side as usize + x];
            let (top, bottom) = ([at(x, y), at(x + 1, y)], [at(x, y + 1), at(x + 1, y + 1)]);
            let [above, below] = [top, bottom].map(|[a, b]| a + b);
            let lower = split(&mut number.y, above, below);
            let [left, right] = if lower { bottom } else { top };
            let further = split(&mut number.x, left, right);
            (x, y) = (x + usize::from(further), y + usize::from(lower));
        }
        let corner = DVec2::new(x as f64, y as f64);
        on_octahedron((corner + number.as_dvec2()) / f64::from(self.side())).normalize()
    }

    /// Density of [`EnvironmentDistribution::draw`] at a unit direction, per unit of solid angle.
    #[must_use]
    pub fn density(&self, direction: DVec3) -> f64 {
        let side = f64::from(self.side());
        let place = (super::place(direction) * side).floor().clamp(DVec2::ZERO, DVec2::splat(side - 1.0));
        let probability = self.levels[0].1[(place.y * side + place.x) as usize];
        let norm = direction.x.abs() + direction.y.abs() + direction.z.abs();
        f64::from(probability) * 0.25 * side * side / norm.powi(3)
    }

    /// Width and height in texels.
    fn side(&self) -> u32 {
        self.levels[0].0
    }
}

/// Sums of 2x2 squares.
fn halved((side, level): &(u32, Vec<f64>)) -> (u32, Vec<f64>) {
    let (side, half) = (*side as usize, side / 2);
    let sums = (0..half * half).map(|i| {
        let corner = 2 * (i / half) as usize * side + 2 * (i % half) as usize;
        [0, 1, side, side + 1].into_iter().map(|offset| level[corner + offset]).sum()
    });
    (half, sums.collect())
}

/// Whether a uniform number selects the second of two probabilities; it becomes its uniform remainder.
fn split(number: &mut f32, first: f32, second: f32) -> bool {
    let share = first / (first + second);
    let is_second = *number >= share;
    let remainder = if is_second { (*number - share) / (1.0 - share) } else { *number / share };
    *number = remainder.min(BELOW_ONE);
    is_second
}
