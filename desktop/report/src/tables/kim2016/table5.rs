//! Table 5: resolutions and sampling rates.

use glimpse_measure::output::grouped;

use super::{CITATION, Pair, SAMPLINGS, pair, pair_job};
use crate::job::Job;
use crate::scene::SceneReport;
use crate::table::{Content, Request, Rows, Table, measured};

/// Square frames of several sizes, each at several sampling rates.
pub struct Resolutions;

impl Table for Resolutions {
    fn name(&self) -> &'static str {
        "5"
    }

    fn summary(&self) -> &'static str {
        "Resolution and sampling"
    }

    fn jobs(&self, request: &Request<'_>) -> Vec<Job> {
        let job = |side, sampling| pair_job(self.name(), request.base, [side; 2], sampling);
        request.table5_sizes.iter().flat_map(|side| SAMPLINGS.map(|sampling| job(*side, sampling))).collect()
    }

    fn content(&self, scenes: &[SceneReport]) -> Content {
        let row = |scene: &str, triangles: u64, [width, height]: [u32; 2], pair: &Pair| {
            pair.row([format!("{scene} ({})", grouped(triangles)), format!("{width}x{height}")])
        };
        let rows = measured(scenes, self.name()).map(|(scene, measured)| {
            let triangles = scene.prepared.statistics.triangles as u64;
            row(&scene.prepared.name, triangles, measured.job.shown, &Pair::of(measured))
        });
        let published = PUBLISHED.iter().flat_map(|(scene, triangles, sizes)| {
            let pairs = sizes.iter().flat_map(|(side, pairs)| pairs.iter().map(|pair| (*side, pair)));
            pairs.map(move |(side, pair)| row(scene, u64::from(*triangles), [side; 2], pair))
        });
        Content::Rows(Rows {
            title: "Table 5: resolution and sampling",
            note: "Full ray tracing and the adaptive method (2x2 blocks, default tolerances, postcorrection by what the \
                   scene holds) with the same samples; PSNR against full tracing of the same sampling. Efficiency is \
                   speedup x RT ratio: 1 where every saved sample is saved time."
                .to_owned(),
            head: ["scene (triangles)", "size"].into_iter().chain(Pair::HEAD).collect(),
            measured: rows.collect(),
            published: published.collect(),
            citation: CITATION,
        })
    }
}

/// Side of a square frame in pixels, and its pairs for three sampling rates.
pub type Size = (u32, [Pair; 3]);

/// As printed: scene, number of triangles, and three sizes.
#[rustfmt::skip]
#[allow(clippy::approx_constant, reason = "0.318 is a ratio of rays")]
pub const PUBLISHED: [(&str, u32, [Size; 3]); 6] = [
    ("Café", 29_359, [
        (512, [pair(1, 314.0, 199.3, 0.327, 43.44), pair(2, 1203.1, 637.3, 0.294, 41.72), pair(4, 4620.6, 2130.1, 0.274, 41.68)]),
        (1024, [pair(1, 1211.7, 591.2, 0.294, 43.99), pair(2, 4396.7, 2079.5, 0.274, 44.03), pair(4, 16663.8, 7382.3, 0.263, 44.26)]),
        (2048, [pair(1, 4332.0, 1928.5, 0.274, 44.58), pair(2, 16593.7, 6991.6, 0.263, 46.23), pair(4, 83840.8, 25808.9, 0.257, 46.58)]),
    ]),
    ("Ben", 78_039, [
        (512, [pair(1, 345.2, 191.7, 0.288, 44.25), pair(2, 1314.3, 619.3, 0.270, 47.81), pair(4, 4802.3, 2086.2, 0.260, 50.92)]),
        (1024, [pair(1, 1275.8, 575.2, 0.270, 45.46), pair(2, 4586.9, 1946.6, 0.260, 49.55), pair(4, 18007.2, 7230.0, 0.255, 51.66)]),
        (2048, [pair(1, 4654.1, 1927.7, 0.260, 47.23), pair(2, 17789.7, 6868.0, 0.255, 51.00), pair(4, 78791.9, 26620.5, 0.253, 52.14)]),
    ]),
    ("Kitchen", 101_015, [
        (512, [pair(1, 356.0, 278.8, 0.394, 37.89), pair(2, 1319.8, 834.0, 0.345, 43.99), pair(4, 4870.8, 2866.7, 0.312, 48.40)]),
        (1024, [pair(1, 1296.9, 828.0, 0.345, 39.14), pair(2, 4796.9, 2656.5, 0.312, 45.22), pair(4, 18244.1, 8978.5, 0.291, 48.83)]),
        (2048, [pair(1, 4777.8, 2634.1, 0.312, 39.79), pair(2, 17738.9, 8620.8, 0.291, 46.04), pair(4, 68734.2, 29885.4, 0.276, 49.14)]),
    ]),
    ("Conference", 190_947, [
        (512, [pair(1, 230.6, 173.1, 0.336, 47.44), pair(2, 842.5, 549.0, 0.300, 50.56), pair(4, 3414.4, 1958.2, 0.277, 51.11)]),
        (1024, [pair(1, 841.6, 508.1, 0.300, 48.92), pair(2, 3284.0, 1803.9, 0.277, 50.35), pair(4, 12700.4, 6729.4, 0.265, 51.58)]),
        (2048, [pair(1, 3216.5, 1666.2, 0.277, 50.89), pair(2, 12640.0, 6157.8, 0.265, 51.41), pair(4, 49223.0, 23200.3, 0.258, 51.61)]),
    ]),
    ("Bathroom", 268_725, [
        (512, [pair(1, 319.4, 240.6, 0.355, 36.63), pair(2, 1223.8, 857.0, 0.318, 44.31), pair(4, 4384.2, 2805.8, 0.294, 48.60)]),
        (1024, [pair(1, 1169.5, 733.6, 0.318, 40.54), pair(2, 4331.8, 2561.0, 0.294, 46.41), pair(4, 16759.8, 8480.6, 0.280, 49.12)]),
        (2048, [pair(1, 4293.7, 2456.2, 0.294, 41.85), pair(2, 16555.3, 8183.9, 0.280, 47.25), pair(4, 64030.8, 28831.4, 0.270, 49.85)]),
    ]),
    ("San Miguel", 588_402, [
        (512, [pair(1, 382.5, 324.2, 0.395, 36.87), pair(2, 1357.0, 978.4, 0.340, 43.10), pair(4, 4910.6, 3375.9, 0.300, 46.47)]),
        (1024, [pair(1, 1344.3, 905.4, 0.340, 39.16), pair(2, 4833.8, 2923.6, 0.300, 43.18), pair(4, 17917.2, 9987.0, 0.278, 48.08)]),
        (2048, [pair(1, 4814.2, 2838.4, 0.300, 38.06), pair(2, 17845.4, 8774.0, 0.278, 45.89), pair(4, 67949.8, 31442.0, 0.265, 49.51)]),
    ]),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Halving the sample spacing gives the samples of a frame of twice the side.
    #[test]
    fn ratios_of_equal_grids_agree() {
        for (name, _, [(_, small), (_, middle), (_, large)]) in &PUBLISHED {
            assert_eq!(
                (small[1].rt_ratio, small[2].rt_ratio),
                (middle[0].rt_ratio, middle[1].rt_ratio),
                "{name}"
            );
            assert_eq!(
                (middle[1].rt_ratio, middle[2].rt_ratio),
                (large[0].rt_ratio, large[1].rt_ratio),
                "{name}"
            );
        }
    }
}
