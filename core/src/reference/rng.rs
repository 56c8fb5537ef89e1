//! Random numbers of paths, in the shaders' integer arithmetic; 24 bits make a number in [0, 1).

use crate::{Sampler, Settings};

/// 2^32 over the golden ratio, which spreads consecutive seeds far apart.
const SEED_STEP: u32 = 0x9e37_79b9;

/// The random numbers of one sample of one pixel.
#[derive(Clone, Copy, Debug)]
pub struct Rng {
    /// Kind of the generator.
    pub sampler: Sampler,
    /// Seed of the frame.
    pub seed: u32,
    /// Column and row of the pixel.
    pub pixel: [u32; 2],
    /// Index of the sample, from 0.
    pub sample: u32,
}

impl Rng {
    /// The random numbers of a sample, with the sampler and the seed of the settings.
    #[must_use]
    pub fn of(settings: &Settings, pixel: [u32; 2], sample: u32) -> Self {
        Self { sampler: settings.paths.sampler, seed: settings.seed, pixel, sample }
    }

    /// A pair in [0, 1). Pairs of different dimensions are independent.
    #[must_use]
    pub fn pair(&self, dimension: u32) -> [f64; 2] {
        let [x, y] = self.pixel;
        let dimension = dimension ^ self.seed.wrapping_mul(SEED_STEP);
        let words = match self.sampler {
            Sampler::Random => {
                let [a, b, ..] = pcg4d([x, y, self.sample, dimension]);
                [a, b]
            }
            Sampler::Sobol => {
                let [order, first, second, _] = pcg4d([x, y, 0, dimension]);
                let index = owen(self.sample, order);
                [owen(index.reverse_bits(), first), owen(sobol(index), second)]
            }
        };
        words.map(|word| f64::from(word >> 8) / 16_777_216.0)
    }
}

/// The hash pcg4d (Jarzynski & Olano 2020, "Hash Functions for GPU Rendering").
fn pcg4d(v: [u32; 4]) -> [u32; 4] {
    let mixed = mix(v.map(|word| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223)));
    mix(mixed.map(|word| word ^ word >> 16))
}

fn mix([mut x, mut y, mut z, mut w]: [u32; 4]) -> [u32; 4] {
    x = x.wrapping_add(y.wrapping_mul(w));
    y = y.wrapping_add(z.wrapping_mul(x));
    z = z.wrapping_add(x.wrapping_mul(y));
    w = w.wrapping_add(y.wrapping_mul(z));
    [x, y, z, w]
}

/// Owen scrambling (Burley 2020, "Practical Hash-based Owen Scrambling", section 4): flips each bit depending on
/// the bits above it.
fn owen(v: u32, key: u32) -> u32 {
    laine_karras(v.reverse_bits(), key).reverse_bits()
}

/// The hash of Laine & Karras 2011 ("Stratified Sampling for Stochastic Transparency"): a bit depends only on
/// bits below it.
fn laine_karras(x: u32, key: u32) -> u32 {
    let factors = [0x6c50_b47c, 0xb82f_1e52, 0xc7af_e638, 0x8d22_f6e6];
    factors.into_iter().fold(x.wrapping_add(key), |x, factor| x ^ x.wrapping_mul(factor))
}

/// The second Sobol' dimension; the first is the bit-reversed index.
fn sobol(mut index: u32) -> u32 {
    let (mut direction, mut result) = (1_u32 << 31, 0);
    while index != 0 {
        if index & 1 == 1 {
            result ^= direction;
        }
        index >>= 1;
        direction ^= direction >> 1;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rng(sampler: Sampler, pixel: [u32; 2], sample: u32) -> Rng {
        Rng { sampler, seed: 7, pixel, sample }
    }

    #[test]
    fn numbers_are_uniform_over_pixels_samples_and_dimensions() {
        for sampler in [Sampler::Random, Sampler::Sobol] {
            let places: [&dyn Fn(u32) -> [f64; 2]; 3] = [
                &|i| rng(sampler, [i % 64, i / 64], 3).pair(5),
                &|i| rng(sampler, [17, 4], i).pair(5),
                &|i| rng(sampler, [17, 4], 3).pair(i),
            ];
            for pair in places {
                let mut strata = [0_u32; 64];
                for [a, b] in (0..4096).map(pair) {
                    assert!((0.0..1.0).contains(&a) && (0.0..1.0).contains(&b));
                    strata[8 * (8.0 * b) as usize + (8.0 * a) as usize] += 1;
                }
                let expected = 4096.0 / 64.0;
                let chi2: f64 = strata.iter().map(|n| (f64::from(*n) - expected).powi(2) / expected).sum();
                // Chi-squared with 63 degrees of freedom: mean 63, standard deviation sqrt(126); allows five of
                // them.
                assert!(chi2 < 63.0 + 5.0 * 126_f64.sqrt(), "{sampler:?}: {chi2}");
            }
        }
    }

    #[test]
    fn sixteen_sobol_pairs_lie_in_one_cell_each() {
        for first in [0, 16, 1 << 20] {
            for dimension in [0, 5, 1029] {
                for [columns, rows] in [[4, 4], [16, 1], [2, 8]] {
                    let mut strata = [0; 16];
                    for sample in first..first + 16 {
                        let [a, b] = rng(Sampler::Sobol, [9, 30], sample).pair(dimension);
                        let [column, row] = [a * f64::from(columns), b * f64::from(rows)].map(|x| x as u32);
                        strata[(columns * row + column) as usize] += 1;
                    }
                    assert_eq!(strata, [1; 16], "{columns}x{rows} cells, dimension {dimension}");
                }
            }
        }
    }

    #[test]
    fn numbers_follow_everything_that_they_are_drawn_for() {
        for sampler in [Sampler::Random, Sampler::Sobol] {
            let one = rng(sampler, [1, 2], 3);
            let others = [
                Rng { seed: 8, ..one }.pair(4),
                Rng { pixel: [2, 1], ..one }.pair(4),
                Rng { sample: 4, ..one }.pair(4),
                one.pair(5),
            ];
            assert!(others.iter().all(|other| *other != one.pair(4)), "{sampler:?}");
            let [a, b] = one.pair(4);
            assert_ne!(a, b);
        }
    }
}
