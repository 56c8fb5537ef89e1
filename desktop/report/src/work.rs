//! The work of a frame: its counters times the demand of each counted item.

use glimpse::{Demand, Demands, Inspection, Origin, Tracing};
use serde::{Deserialize, Serialize};

/// Name of a class of passes on the page.
pub fn class_name(class: Tracing) -> &'static str {
    match class {
        Tracing::Neighbours => "traced neighbours",
        Tracing::Listed => "traced lists",
        Tracing::No => "passes that trace nothing",
    }
}

/// Counted work of a frame.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Work {
    /// Number of visited nodes of the acceleration structure.
    pub node_visits: u64,
    /// Number of intersection tests with triangles and spheres.
    pub primitive_tests: u64,
    /// Operations and bytes by class of passes, in the order of [`Tracing::ALL`].
    pub loads: [Demand; 3],
}

impl Work {
    /// Computes the work of an inspected frame with one sample per pixel, of a scene with `lights` lights.
    ///
    /// The counters cover the whole frame. The cost of each pixel divides rays and visits between the base
    /// samples and the traced lists.
    pub fn of(inspection: &Inspection, demands: &Demands, lights: usize) -> Self {
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
        }
    }
}

fn is_listed(origin: Origin) -> bool {
    matches!(origin, Origin::TracedA1 | Origin::TracedA2 | Origin::Postcorrected)
}

#[cfg(test)]
mod tests {
    use glimpse::{Cost, Counts, PixelRecord, Rays, Samples};

    use super::*;

    fn operations(operations: f64) -> Demand {
        Demand { operations, ..Demand::default() }
    }

    fn pixel(origin: Origin, cost: u32) -> PixelRecord {
        PixelRecord {
            origin,
            failed: 0,
            cost,
            active: 0,
            differing: 0,
            strata: 0,
            object: None,
            depth: 1.0,
            normal: [0.0; 3],
        }
    }

    #[test]
    fn work_is_counters_times_demands() {
        let demands = Demands {
            sample: operations(1.0),
            followed_ray: operations(10.0),
            light: operations(100.0),
            ray: operations(1e3),
            node_visit: operations(1e4),
            primitive_test: operations(1e5),
            interpolated: operations(1e6),
            interpolated_light: operations(1e7),
        };
        let counts = Counts {
            rays: Rays { primary: 3, shadow: 4, reflection: 1, total: 8, ..Rays::default() },
            samples: Samples {
                total: 9,
                base: 2,
                traced_a1: 1,
                postcorrected: 1,
                interpolated: 5,
                ..Samples::default()
            },
            cost: Cost { node_visits: 16, primitive_tests: 8, ..Cost::default() },
            ..Counts::default()
        };
        let pixels = vec![
            pixel(Origin::Base, 10),
            pixel(Origin::Base, 8),
            pixel(Origin::TracedA1, 4),
            pixel(Origin::Postcorrected, 2),
            pixel(Origin::Interpolated, 0),
        ];
        let work = Work::of(&Inspection { counts, pixels, uncorrected: 0 }, &demands, 2);
        // Four rays are followed, with two lights each; the lists have 6 of 24 visits and tests.
        let traced = 8.0 * 1e3 + 16.0 * 1e4 + 8.0 * 1e5 + 4.0 * (10.0 + 2.0 * 100.0);
        let expected = [0.75 * traced + 2.0, 0.25 * traced + 2.0, 7.0 * (1e6 + 2.0 * 1e7)];
        assert_eq!(work.loads.map(|load| load.operations), expected);
        assert_eq!((work.node_visits, work.primitive_tests), (16, 8));
    }
}
