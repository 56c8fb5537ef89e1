//! Positions of samples in their cells: the net of `jitter_stratified.wgsl` in the same integer arithmetic.

/// Position in the cell as fractions from its upper left corner.
pub(super) fn jitter(stratum: [u32; 2], seed: u32) -> [f64; 2] {
    let scramble = hash(stratum.map(|i| i / 4), seed).map(|word| word >> 30);
    let low = net(stratum.map(|i| i & 3));
    let rest = hash(stratum, seed);
    [0, 1].map(|i| f64::from((low[i] ^ scramble[i]) << 22 | rest[i] >> 10) / 16_777_216.0)
}

/// The third and fourth binary digits of the (0,2)-net's only point with these first two digits.
fn net([x, y]: [u32; 2]) -> [u32; 2] {
    let fourth = (x ^ y) & 1;
    let third = ((x >> 1) ^ (y >> 1) ^ y) & 1;
    [2 * third + fourth, 2 * (third ^ fourth) + fourth]
}

fn hash([x, y]: [u32; 2], seed: u32) -> [u32; 2] {
    let mut v = [x, y, seed].map(|word| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    for i in 0..3 {
        v[i] = v[i].wrapping_add(v[(i + 1) % 3].wrapping_mul(v[(i + 2) % 3]));
    }
    v = v.map(|word| word ^ word >> 16);
    for i in 0..2 {
        v[i] = v[i].wrapping_add(v[(i + 1) % 3].wrapping_mul(v[(i + 2) % 3]));
    }
    [v[0], v[1]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_spread_evenly_and_follow_the_seed() {
        let places: Vec<_> = (0..64).flat_map(|y| (0..64).map(move |x| jitter([x, y], 5))).collect();
        for axis in 0..2 {
            let mean = places.iter().map(|place| place[axis]).sum::<f64>() / 4096.0;
            // Three standard deviations of the mean of 4096 uniform numbers.
            assert!((mean - 0.5).abs() < 3.0 * (1.0 / 12.0_f64 / 4096.0).sqrt(), "{mean}");
            assert!(places.iter().all(|place| (0.0..1.0).contains(&place[axis])));
        }
        assert_ne!(jitter([1, 2], 0), jitter([1, 2], 1));
        assert_ne!(jitter([1, 2], 0), jitter([2, 1], 0));
    }

    /// One of a square's sixteen samples must lie in each cell of 4x4, 16x1, 1x16, 8x2 and 2x8 grids.
    #[test]
    fn each_square_of_cells_is_a_net() {
        for square in [[0, 0], [3, 7], [100, 41]] {
            let places: Vec<_> = (0..16)
                .map(|i| [4 * square[0] + i % 4, 4 * square[1] + i / 4])
                .map(|stratum| {
                    let inside = jitter(stratum, 9);
                    [0, 1].map(|i| (f64::from(stratum[i] % 4) + inside[i]) / 4.0)
                })
                .collect();
            for columns in [1, 2, 4, 8, 16] {
                let counts = [f64::from(columns), 16.0 / f64::from(columns)];
                let strata: std::collections::HashSet<_> =
                    places.iter().map(|p| [0, 1].map(|i| (p[i] * counts[i]) as u32)).collect();
                assert_eq!(strata.len(), 16, "{square:?}, {columns} columns");
            }
        }
    }
}
