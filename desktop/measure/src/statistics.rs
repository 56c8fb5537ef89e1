//! Medians of measurements, and the descriptions of scenes and adapters that accompany them.

use std::time::Instant;

use glimpse::{Features, Scene, Specialize};
use serde::Serialize;

/// The adapter that was measured.
#[derive(Clone, Debug, Serialize)]
pub struct AdapterStatistics {
    /// Name of the adapter as the driver reports it.
    pub name: String,
    /// Graphics API, such as `vulkan`.
    pub backend: String,
    /// Driver name and version.
    pub driver: String,
}

/// Contents of a scene and the features linked into its kernels.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneStatistics {
    /// Name of the scene on the command line.
    pub file: String,
    /// Number of triangles.
    pub triangles: usize,
    /// Number of analytic spheres.
    pub spheres: usize,
    /// Number of objects (OIDs).
    pub objects: usize,
    /// Number of lights.
    pub lights: usize,
    /// Number of textures.
    pub textures: usize,
    /// Features linked into the kernels.
    pub features: Vec<&'static str>,
    /// Features left out of the kernels.
    pub left_out: Vec<&'static str>,
}

/// Median and 95th percentile of several measurements.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Median; the mean of the middle two for an even number.
    pub median: f64,
    /// 95th percentile (nearest rank).
    pub p95: f64,
}

impl AdapterStatistics {
    /// Describes an adapter from wgpu's information.
    pub fn of(info: &wgpu::AdapterInfo) -> Self {
        let driver = [info.driver.trim(), info.driver_info.trim()];
        Self {
            name: info.name.clone(),
            backend: info.backend.to_string(),
            driver: driver.into_iter().filter(|s| !s.is_empty()).collect::<Vec<_>>().join(" "),
        }
    }
}

impl SceneStatistics {
    /// Describes a scene before it is uploaded.
    pub fn of(name: &str, scene: &Scene, specialize: Specialize) -> Self {
        let unlinked = Self {
            file: name.to_owned(),
            triangles: scene.positions.len(),
            spheres: scene.spheres.len(),
            objects: scene.objects.len(),
            lights: scene.lights.len(),
            textures: scene.textures.len(),
            features: Vec::new(),
            left_out: Vec::new(),
        };
        unlinked.linked(Features::of(scene), specialize)
    }

    /// Fills in the features linked and left out, for a scene that needs `needed`.
    pub fn linked(self, needed: Features, specialize: Specialize) -> Self {
        let linked = match specialize {
            Specialize::Auto => needed,
            Specialize::All => Features::all(),
        };
        let names = |there: bool| {
            linked.list().into_iter().filter(|(_, l)| *l == there).map(|(name, _)| name).collect()
        };
        Self { features: names(true), left_out: names(false), ..self }
    }
}

impl Spread {
    /// Computes the spread of any number of measurements; NaN for none.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let mut sorted: Vec<f64> = values.into_iter().collect();
        sorted.sort_by(f64::total_cmp);
        let n = sorted.len();
        if n == 0 {
            return Self { median: f64::NAN, p95: f64::NAN };
        }
        Self { median: 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]), p95: sorted[(n * 95).div_ceil(100) - 1] }
    }
}

/// Runs the work and returns its result with the elapsed wall-clock time in milliseconds.
pub fn timed<T, E>(work: impl FnOnce() -> Result<T, E>) -> Result<(T, f64), E> {
    let start = Instant::now();
    let result = work()?;
    Ok((result, 1000.0 * start.elapsed().as_secs_f64()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_empty_scene_leaves_everything_out_unless_all_is_linked() {
        let auto = SceneStatistics::of("a", &Scene::default(), Specialize::Auto);
        assert_eq!((auto.features.len(), auto.left_out.len()), (0, Features::COUNT));
        let all = SceneStatistics::of("a", &Scene::default(), Specialize::All);
        // The data of some exist only where a scene needs them.
        let all_features = Features::all().list();
        let of_need: Vec<_> =
            all_features.iter().filter(|(_, linked)| !linked).map(|(name, _)| *name).collect();
        assert!(of_need.contains(&"environment_map"));
        assert_eq!((all.features.len(), all.left_out), (Features::COUNT - of_need.len(), of_need));
    }

    #[test]
    fn medians_and_percentiles() {
        assert_eq!(Spread::of([7.0]), Spread { median: 7.0, p95: 7.0 });
        assert_eq!(Spread::of([9.0, 1.0, 2.0]), Spread { median: 2.0, p95: 9.0 });
        assert_eq!(Spread::of([4.0, 1.0, 2.0, 100.0]).median, 3.0);
        assert_eq!(Spread::of((1..=100).map(f64::from)), Spread { median: 50.5, p95: 95.0 });
        assert!(Spread::of([]).median.is_nan());
    }
}
