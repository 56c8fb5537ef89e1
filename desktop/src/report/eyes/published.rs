//! Tables 2 and 3, as printed.

/// A scene of [`TABLES_2_AND_3`]: plain path tracing, then the paper's.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// What was rendered.
    pub scene: &'static str,
    /// Against the mean of 100 samples, after one.
    pub mse: [f64; 2],
    /// As MSE.
    pub ssim: [f64; 2],
    /// Milliseconds of a frame.
    pub ms: [f64; 2],
}

const fn line(scene: &'static str, mse: [f64; 2], ssim: [f64; 2], ms: [f64; 2]) -> Line {
    Line { scene, mse, ssim, ms }
}

/// 640x480 an eye.
#[rustfmt::skip]
pub const TABLES_2_AND_3: [Line; 5] = [
    line("Teapot", [2157.72, 1994.47], [0.13, 0.18], [236.0, 210.39]),
    line("Ant", [2141.26, 1971.1], [0.13, 0.18], [328.96, 293.73]),
    line("Bunny", [2139.19, 1999.16], [0.13, 0.18], [330.55, 274.12]),
    line("Monkey", [2269.04, 2124.44], [0.12, 0.17], [379.73, 329.07]),
    line("Knot", [2181.45, 2031.54], [0.13, 0.18], [609.95, 478.82]),
];
