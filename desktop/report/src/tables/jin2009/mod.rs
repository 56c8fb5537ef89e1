//! Tables of Jin 2009: the quality and cost of adaptive supersampling, for other scenes.

pub mod figure7;
pub mod table2;

use crate::record::Record;
use crate::rung::Rung;

/// Citation of the paper.
const CITATION: &str = "Jin, Ihm, Chang, Park, Lee, Jung, \"Selective and Adaptive Supersampling for Real-Time Ray \
                        Tracing\", High Performance Graphics 2009 (GeForce GTX 280)";

/// Traced samples per pixel of the frame.
fn samples_a_pixel(rung: &Rung, record: &Record) -> f64 {
    record.rt_ratio * f64::from(rung.settings.sampling).powi(2)
}
