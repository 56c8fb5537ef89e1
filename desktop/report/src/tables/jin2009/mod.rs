//! Where extra samples go, and what they give for what they cost: Jin 2009's comparisons for other scenes.

pub mod figure7;
pub mod table2;

use crate::record::Record;
use crate::rung::Rung;

/// How the tables are cited.
const CITATION: &str = "Jin, Ihm, Chang, Park, Lee, Jung, \"Selective and Adaptive Supersampling for Real-Time Ray \
                        Tracing\", High Performance Graphics 2009 (GeForce GTX 280)";

/// Traced samples over the pixels of the frame.
fn samples_a_pixel(rung: &Rung, record: &Record) -> f64 {
    record.rt_ratio * f64::from(rung.settings.sampling).powi(2)
}
