//! How fast a device is at its best: what the share of it that a kernel reaches is measured by.

use serde::{Deserialize, Serialize};

use crate::{
    Gpu, Result,
    gpu::{Kernel, Timer, shader::Source},
    passes::{TRACE_GROUP, wgsl},
};

/// Turns of the arithmetic kernel's loop, and operations of a turn: eight multiply-adds of four numbers each.
const TURNS: u32 = 512;
const TURN_OPERATIONS: u32 = 8 * 4 * 2;
/// Threads of the arithmetic kernel: more than any device runs at once.
const THREADS: u32 = 1 << 16;
/// Numbers of 16 bytes that a thread of the streaming kernel reads and writes, and its workgroups: 64 MiB together.
const STEPS: u32 = 16;
const STREAM_GROUPS: u32 = (64 << 20) / (16 * STEPS * TRACE_GROUP);
/// The best of so many runs counts: others may use the device too.
const RUNS: u32 = 8;

/// Measured peak rates.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Peak {
    /// Billions of 32-bit floating-point operations a second, a multiply-add as two.
    pub gflops: f64,
    /// Billions of bytes a second, read and written.
    pub gigabytes: f64,
}

/// Measures them, in a second or less; `None` where the device has no timestamps.
///
/// # Errors
/// A device that failed or has no memory for it.
pub fn peak(gpu: &Gpu) -> Result<Option<Peak>> {
    if !gpu.facts().timestamps {
        return Ok(None);
    }
    let storage = wgpu::BufferUsages::STORAGE;
    let results = gpu.buffer("results", 4 * u64::from(THREADS), storage)?;
    let groups = THREADS / TRACE_GROUP;
    let arithmetic = best_ms(gpu, wgsl!("wgsl/probe_arithmetic.wgsl"), ("results", &results), groups)?;
    let operations = f64::from(THREADS) * f64::from(TURNS) * f64::from(TURN_OPERATIONS);
    let bytes = 16 * STEPS * TRACE_GROUP * STREAM_GROUPS;
    let stream = gpu.buffer("stream", u64::from(bytes), storage)?;
    let streaming = best_ms(gpu, wgsl!("wgsl/probe_stream.wgsl"), ("stream", &stream), STREAM_GROUPS)?;
    let rate = |amount: f64, ms: f64| (ms > 0.0).then(|| amount / ms * 1e-6);
    let rates = rate(operations, arithmetic).zip(rate(2.0 * f64::from(bytes), streaming));
    Ok(rates.map(|(gflops, gigabytes)| Peak { gflops, gigabytes }))
}

fn best_ms(gpu: &Gpu, entry: Source, (name, buffer): (&str, &wgpu::Buffer), groups: u32) -> Result<f64> {
    let constants = format!(
        "const TRACE_GROUP: u32 = {TRACE_GROUP};\nconst PEAK_TURNS: u32 = {TURNS};\nconst PEAK_STEPS: u32 = {STEPS};\n"
    );
    let sources = [Source { file: "(peak constants)", text: constants.into() }, entry];
    let bound =
        Kernel::new(gpu, "peak", &sources)?.bind(&gpu.device, &[(name, buffer.as_entire_binding())])?;
    let timer = Timer::new(gpu, &["peak"])?;
    let mut best = f64::INFINITY;
    // Drivers finish compiling in the first run.
    for _ in 0..=RUNS {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        bound.dispatch(&mut timer.pass(&mut encoder, 0), [groups, 1]);
        timer.resolve(&mut encoder);
        gpu.submit_and_wait(encoder)?;
        best = best.min(timer.read(gpu)?.ms);
    }
    Ok(best)
}
