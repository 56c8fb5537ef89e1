//! Where in its cell a sample lies: the hash of `jitter_stratified.wgsl`, whose integers are the same everywhere.

/// Fractions of a cell from its upper left corner.
pub(super) fn jitter([x, y]: [u32; 2], seed: u32) -> [f64; 2] {
    let mut v = [x, y, seed].map(|word| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    for i in 0..3 {
        v[i] = v[i].wrapping_add(v[(i + 1) % 3].wrapping_mul(v[(i + 2) % 3]));
    }
    v = v.map(|word| word ^ word >> 16);
    for i in 0..2 {
        v[i] = v[i].wrapping_add(v[(i + 1) % 3].wrapping_mul(v[(i + 2) % 3]));
    }
    [v[0], v[1]].map(|word| f64::from(word >> 8) / 16_777_216.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_spread_evenly_and_follow_the_seed() {
        let places: Vec<_> = (0..64).flat_map(|y| (0..64).map(move |x| jitter([x, y], 5))).collect();
        for axis in 0..2 {
            let mean = places.iter().map(|place| place[axis]).sum::<f64>() / 4096.0;
            // Of 4096 uniform numbers, three standard deviations.
            assert!((mean - 0.5).abs() < 3.0 * (1.0 / 12.0_f64 / 4096.0).sqrt(), "{mean}");
            assert!(places.iter().all(|place| (0.0..1.0).contains(&place[axis])));
        }
        assert_ne!(jitter([1, 2], 0), jitter([1, 2], 1));
        assert_ne!(jitter([1, 2], 0), jitter([2, 1], 0));
    }
}
