//! Published ray tracing rates of graphics devices without ray tracing units, as shares of their peaks.

use glimpse_measure::statistics::Spread;

use super::calibration::Cell;
use crate::tables::kim2016::table5;

/// A published ray tracing rate.
#[derive(Clone, Copy, Debug)]
pub struct Published {
    /// Program and device.
    pub what: &'static str,
    /// Source of the rate and of the peak.
    pub source: &'static str,
    /// Peak of the device in billions of operations per second.
    pub gflops: f64,
    rate: Rate,
}

#[derive(Clone, Copy, Debug)]
enum Rate {
    /// Rays per second.
    Rays(f64),
    /// Median frame of Kim 2016's table 5: full ray tracing at 1024x1024 with one sample per pixel.
    Paper,
}

/// All published rates.
pub const PUBLISHED: [Published; 2] = [
    Published {
        what: "RTX 4070 Ti, the same kind of tree in a shader: 2.75 ms for 1920x1080 primary rays and as many of ambient \
               occlusion",
        source: "github.com/DGriffin91/tray_racing, results/gpu_traversal_bench.PNG; peak: purespecs.click/nvidia-geforce-rtx-4070-ti-gpu-specs",
        gflops: 40_090.0,
        rate: Rate::Rays(2.0 * 1920.0 * 1080.0 / 2.75e-3),
    },
    Published {
        what: "Adreno 420, the frames of Kim 2016 (a kd-tree in OpenCL; scenes of that kind, not these)",
        source: "Kim 2016, table 5; peak: hmc-tech.com/gpu/qualcomm-adreno-420-vs-qualcomm-adreno-330, 128 units at 600 MHz",
        gflops: 153.6,
        rate: Rate::Paper,
    },
];

impl Published {
    /// Share of the peak operations that the rate amounts to, if a ray or a pixel takes as many operations as
    /// in the given frames of full ray tracing.
    pub fn share(&self, full: &[&Cell]) -> f64 {
        let median = |per: fn(&Cell) -> f64| Spread::of(full.iter().map(|cell| per(cell))).median;
        let operations_a_second = match self.rate {
            Rate::Rays(rays_a_second) => rays_a_second * median(|cell| cell.operations() / cell.rays as f64),
            Rate::Paper => {
                let pixels = 1024.0 * 1024.0;
                pixels * median(|cell| cell.operations() / cell.pixels as f64) / (1e-3 * paper_ms())
            }
        };
        operations_a_second * 1e-9 / self.gflops
    }
}

/// Milliseconds of the paper's median frame.
fn paper_ms() -> f64 {
    let sizes = table5::PUBLISHED.iter().flat_map(|(_, _, sizes)| sizes);
    Spread::of(sizes.filter(|(side, _)| *side == 1024).map(|(_, [once, ..])| once.full_ms)).median
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::phones::calibration::tests::cell;

    #[test]
    fn shares_follow_from_what_a_ray_and_a_pixel_take() {
        // 40 billion operations in 10 million rays of 4 million pixels.
        let full = cell("a", "full", [40e9, 0.0, 0.0], [1000.0, 0.0, 0.0]);
        let shares = PUBLISHED.map(|published| published.share(&[&full]));
        // 1.508 billion rays of 4,000 operations of 40.09 trillion.
        assert!((shares[0] - 1.508_07e9 * 4000.0 / 40.09e12).abs() < 1e-5, "{shares:?}");
        // 1,048,576 pixels of 10,000 operations in 1190.6 to 1243.8 ms of 153.6 billion a second.
        assert!((0.054..0.058).contains(&shares[1]), "{shares:?}");
    }

    #[test]
    fn every_figure_has_a_source() {
        for published in PUBLISHED {
            assert!(
                published.source.contains("peak: ") && published.source.contains(".com/"),
                "{published:?}"
            );
            assert!(published.gflops > 0.0);
        }
    }
}
