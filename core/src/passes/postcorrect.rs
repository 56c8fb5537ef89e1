//! Postcorrection (Kim 2016, section 4): traces interpolated samples next to traced ones of another object.

use super::{FrameSpec, stage::*, wgsl};
use crate::{
    Postcorrect,
    device::shader::Source,
    passes::TRACE_GROUP,
    frame::plan::{Band, Part, Plan, SAMPLES_PER_SUBMISSION, chunks, lines, once, one},
};

stages! {
    /// Compacts all samples listed by the adaptive steps for indirect dispatch.
    COMPACT_SEED = {
        name: "compact_seed", wgsl: "passes/compact.wgsl", paper: "Kim 2016, 4; Step-IV",
        work: Work::Fixed, tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.compact_sources(wgsl!("wgsl/adaptive/list_range_all.wgsl"), entry),
    }
    /// Claims interpolated neighbours that differ from a listed sample.
    POSTCORRECT_SEED = {
        name: "postcorrect_seed", wgsl: "passes/postcorrect/postcorrect_seed.wgsl", paper: "Kim 2016, 4; Step-IV",
        work: Work::List, tracing: Tracing::No, clears: [],
        sources: |spec, entry| {
            let mut sources = spec.pixel_sources(wgsl!("wgsl/adaptive/attributes_atomic.wgsl"));
            sources.extend(step_sources(entry));
            sources
        },
    }
    /// Claims pixels onto which points of thin features project and that no traced sample has covered.
    POSTCORRECT_PROBE_POINTS = {
        name: "postcorrect_probe_points", wgsl: "passes/postcorrect/postcorrect_probe_points.wgsl", paper: "ours",
        work: Work::Fixed, tracing: Tracing::No, clears: [],
        sources: |spec, entry| {
            let mut sources = spec.pixel_sources(wgsl!("wgsl/adaptive/attributes_atomic.wgsl"));
            sources.extend(step_sources(entry));
            sources
        },
    }
    /// Compacts the samples claimed in the last round for indirect dispatch.
    COMPACT_POSTCORRECT = {
        name: "compact_postcorrect", wgsl: "passes/compact.wgsl", paper: "Kim 2016, 4; Step-IV",
        work: Work::Fixed, tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.compact_sources(wgsl!("wgsl/adaptive/list_range_round.wgsl"), entry),
    }
    /// Traces the claimed samples and claims their differing neighbours.
    POSTCORRECT = {
        name: "postcorrect", wgsl: "passes/postcorrect/postcorrect.wgsl", paper: "Kim 2016, 4; Step-IV",
        work: Work::List, tracing: Tracing::Listed, clears: [],
        sources: |spec, entry| {
            let claims = wgsl!("wgsl/adaptive/attributes_atomic.wgsl");
            spec.tracing_sources_from(claims, spec.hit(), step_sources(entry))
        },
    }
    /// Scans rows or columns in one direction and traces differing neighbours, as in the paper.
    POSTCORRECT_SCAN = {
        name: "postcorrect_scan", wgsl: "passes/postcorrect/postcorrect_scan.wgsl", paper: "Kim 2016, 5; Step-IV",
        work: Work::Lines, tracing: Tracing::Listed, clears: [],
        sources: |spec, entry| {
            spec.tracing_sources_from(wgsl!("wgsl/adaptive/attributes_atomic.wgsl"), spec.hit(), [entry])
        },
    }
}

/// Number of rounds in which each thread traces one sample, and of rounds in which it walks on. Most samples are
/// found in the short rounds, which keep threads converged; the walks together reach twice the longest straight
/// run in a band.
const SHORT_ROUNDS: u32 = 6;
const LONG_ROUNDS: u32 = 10;

/// The most samples that one round traces.
pub const ROUND_SAMPLES: u32 = SAMPLES_PER_SUBMISSION / 4;

/// Adds the passes of postcorrection (Kim 2016, section 4) within a band.
pub fn plan(plan: &mut Plan, spec: &FrameSpec, band: &Band) {
    let rows = band.rows(1, [band.first, band.end]);
    let samples = plan.grid[0] * rows.count();
    match spec.settings.postcorrect {
        Postcorrect::Auto | Postcorrect::Off => {}
        Postcorrect::Scans => {
            for step in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
                plan.push(lines(&POSTCORRECT_SCAN, plan.grid[0], band.rows(1, band.own), step));
            }
        }
        Postcorrect::Objects | Postcorrect::On => {
            plan.lists(samples);
            plan.push(once(&COMPACT_SEED, rows));
            plan.push(chunks(&POSTCORRECT_SEED, samples, rows));
            if spec.scene.probe_points > 0 {
                let groups = [spec.scene.probe_points.div_ceil(TRACE_GROUP), 1];
                plan.push(one(&POSTCORRECT_PROBE_POINTS, rows, groups));
            }
            let far = 2 * (plan.grid[0] + rows.count()) / LONG_ROUNDS + 1;
            for round in 0..SHORT_ROUNDS + LONG_ROUNDS {
                let walk = if round < SHORT_ROUNDS { 1 } else { far };
                plan.push(once(&COMPACT_POSTCORRECT, rows));
                let parts = chunks(&POSTCORRECT, samples.min(ROUND_SAMPLES), rows);
                plan.push(parts.into_iter().map(|part| Part { walk, ..part }).collect());
            }
        }
    }
}

fn step_sources(entry: Source) -> [Source; 4] {
    [
        wgsl!("wgsl/adaptive/list.wgsl"),
        wgsl!("wgsl/adaptive/list_append.wgsl"),
        wgsl!("passes/postcorrect/postcorrect_step.wgsl"),
        entry,
    ]
}
