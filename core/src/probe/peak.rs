//! How fast a device does arithmetic at its best: what a kernel reaches is a share of it.

use crate::{
    Gpu, Result,
    device::{Kernel, Timer, shader::Source},
    passes::{TRACE_GROUP, Tracing, wgsl},
};

/// Turns of the kernel's loop, and operations of a turn: eight multiply-adds of four numbers each.
const TURNS: u32 = 512;
const TURN_OPERATIONS: u32 = 8 * 4 * 2;
/// More threads than any device runs at once.
const THREADS: u32 = 1 << 16;
/// The median of so many runs counts: others may use the device too, as they do while frames are timed.
const RUNS: usize = 9;

/// Billions of 32-bit floating-point operations that the device does in a second, a multiply-add as two, measured in a
/// second or less; `None` where the device has no timestamps.
///
/// # Errors
/// A device that failed or has no memory for it.
pub fn peak_gflops(gpu: &Gpu) -> Result<Option<f64>> {
    let sources = sources();
    let results = gpu.buffer("results", 4 * u64::from(THREADS), wgpu::BufferUsages::STORAGE)?;
    let kernel = Kernel::new(gpu, "probe_arithmetic", &sources)?;
    let bound = kernel.bind(&gpu.device, &[("results", results.as_entire_binding())])?;
    let timer = Timer::new(gpu, vec![("probe_arithmetic", Tracing::No)])?;
    let mut times = Vec::with_capacity(1 + RUNS);
    for _ in 0..=RUNS {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        bound.dispatch(&mut timer.pass(&mut encoder, 0), [THREADS / TRACE_GROUP, 1]);
        timer.resolve(&mut encoder);
        gpu.submit_and_wait(encoder)?;
        times.push(timer.read(gpu)?.ms);
    }
    // Drivers finish compiling in the first run.
    let timed = &mut times[1..];
    timed.sort_by(f64::total_cmp);
    let median = timed[RUNS / 2];
    let operations = f64::from(THREADS) * f64::from(TURNS) * f64::from(TURN_OPERATIONS);
    Ok((median > 0.0).then(|| operations / median * 1e-6))
}

/// The sources of the kernel.
pub(crate) fn sources() -> Vec<Source> {
    let constants = format!("const TRACE_GROUP: u32 = {TRACE_GROUP};\nconst TURNS: u32 = {TURNS};\n");
    vec![
        Source { file: "(constants of the probe)", text: constants.into() },
        wgsl!("wgsl/probe/probe_arithmetic.wgsl"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{device::shader::link, passes::count_operations};

    /// What the kernel is said to do in a turn is what its code does.
    #[test]
    fn a_turn_has_as_many_operations_as_are_counted() {
        let [_, turn, _] =
            count_operations(&link(&sources()).expect("links"), None, &[]).expect("an entry point");
        // And the loop's own comparison and step.
        assert_eq!(turn.operations, f64::from(TURN_OPERATIONS) + 2.0);
    }
}
