//! Where extra samples go, and what they give for what they cost: Jin 2009's comparisons for other scenes.

pub mod figure7;
mod published;
pub mod table2;

use super::ladder::Rung;
use super::record::Record;

/// How the tables are cited.
const CITATION: &str = "Jin, Ihm, Chang, Park, Lee, Jung, \"Selective and Adaptive Supersampling for Real-Time Ray \
                        Tracing\", High Performance Graphics 2009 (GeForce GTX 280)";

/// Traced samples over the pixels of the frame.
fn samples_a_pixel(rung: &Rung, record: &Record) -> f64 {
    record.rt_ratio * f64::from(rung.settings.sampling).powi(2)
}
