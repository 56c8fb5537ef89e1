//! What is right: the steps of the shaders in f64 on the CPU, slow and obvious. It shares no arithmetic with them.

mod traversal;

pub use traversal::{Hit, Ray, Tracer, Verdict};
