//! What a frame asks of a device: its counters, times what each counted thing takes.

use glimpse::{Demand, Demands, Inspection, Origin};
use serde::{Deserialize, Serialize};

/// Passes whose threads run differently well together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Neighbouring samples are traced.
    Neighbours,
    /// Samples from all over a tile are traced, as a list has them.
    Listed,
    /// Nothing is traced.
    Untraced,
}

impl Kind {
    /// In the order of [`Work::loads`].
    pub const ALL: [Self; 3] = [Self::Neighbours, Self::Listed, Self::Untraced];

    /// That of a pass by its name.
    pub fn of(pass: &str) -> Self {
        match pass {
            "full" | "base" | "checkerboard" => Self::Neighbours,
            "trace_a1" | "trace_a2" | "postcorrect" | "postcorrect_scan" => Self::Listed,
            _ => Self::Untraced,
        }
    }

    /// As the page has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Neighbours => "traced neighbours",
            Self::Listed => "traced lists",
            Self::Untraced => "passes that trace nothing",
        }
    }
}

/// The work of a frame, with the peak of the device that it was timed on.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Work {
    /// Visited nodes of the acceleration structure.
    pub node_visits: u64,
    /// Tested triangles and spheres.
    pub primitive_tests: u64,
    /// By [`Kind`].
    pub loads: [Demand; 3],
    /// Billions of operations a second that the device does at its best, measured when the frame was; none without
    /// timestamps.
    pub peak_gflops: Option<f64>,
}

impl Work {
    /// Of an inspected frame with one sample a pixel, of a scene with so many lights.
    ///
    /// The counters are of the whole frame. Nodes and primitives are known of each pixel too: by them rays and visits are
    /// divided between the base and the lists.
    pub fn of(inspection: &Inspection, demands: &Demands, lights: usize, peak_gflops: Option<f64>) -> Self {
        let counts = &inspection.counts;
        let lights = lights as f64;
        let costs = |listed: Option<bool>| -> u64 {
            let pixels = inspection.pixels.iter();
            let chosen = pixels.filter(|pixel| listed.is_none_or(|listed| is_listed(pixel.origin) == listed));
            chosen.map(|pixel| u64::from(pixel.cost)).sum()
        };
        let share = costs(Some(true)) as f64 / costs(None).max(1) as f64;
        let followed = counts.rays.total - counts.rays.shadow;
        let traced = demands.ray.times(counts.rays.total as f64)
            + demands.node_visit.times(counts.cost.node_visits as f64)
            + demands.primitive_test.times(counts.cost.primitive_tests as f64)
            + (demands.followed_ray + demands.light.times(lights)).times(followed as f64);
        let samples = &counts.samples;
        let listed = samples.traced_a1 + samples.traced_a2 + samples.postcorrected;
        let checked = samples.total.saturating_sub(samples.base);
        let interpolated = demands.interpolated + demands.interpolated_light.times(lights);
        Self {
            node_visits: counts.cost.node_visits,
            primitive_tests: counts.cost.primitive_tests,
            loads: [
                traced.times(1.0 - share) + demands.sample.times(samples.base as f64),
                traced.times(share) + demands.sample.times(listed as f64),
                interpolated.times(checked as f64),
            ],
            peak_gflops,
        }
    }
}

fn is_listed(origin: Origin) -> bool {
    matches!(origin, Origin::TracedA1 | Origin::TracedA2 | Origin::Postcorrected)
}
