//! Tests of the names in the statistics JSON, and of medians and shares.

use glimpse::{PassTime, Scene, Specialize};
use serde_json::{Value, json};

use super::*;

/// Made-up statistics of an adaptive frame, with all optional fields.
pub fn example() -> Statistics {
    Statistics {
        glimpse: "0",
        adapter: AdapterStatistics { name: "Card".into(), backend: "vulkan".into(), driver: "D 1".into() },
        scene: SceneStatistics::of("a.glb", &Scene::default(), Specialize::Auto),
        warnings: vec!["mesh 7: lines are left out".into()],
        not_shown: vec![NotShown { feature: "node.skin".into(), count: 1, places: vec!["node 3".into()] }],
        settings: SettingsUsed { settings: Settings::default(), camera: "0 (front)".into() },
        size: [8, 4],
        frames: 1,
        time_ms: Times {
            frame: Spread { median: 10.0, p95: 12.0 },
            clock: "gpu",
            passes: vec![
                PassMedian { name: "base", tracing: Tracing::Neighbours, median: 8.0 },
                PassMedian { name: "resolve", tracing: Tracing::No, median: 2.0 },
            ],
            load: 1.0,
            build: 2.0,
            compile: 3.0,
        },
        rays: Rays::default(),
        samples: Samples {
            total: 32,
            base: 8,
            traced_a1: 1,
            traced_a2: 2,
            interpolated: 21,
            ..Samples::default()
        },
        rt_ratio: 0.34,
        cost: Cost { traced_share: Some(0.5), ..work(5, 6) },
        failed_checks: FailedChecks { oid: 3, ..FailedChecks::default() },
        memory_bytes: Memory::default(),
        mrays_per_s: 7.0,
        non_tracing_share: Some(0.2),
        gain: Some(Gain { speedup: 2.0, efficiency: 0.68, cost_efficiency: 1.0 }),
        error: Some(ErrorAgainst {
            against: "full",
            report: ErrorReport {
                rmse: 1.0,
                psnr_db: Some(48.13),
                ssim: 0.99,
                flip_mean: Some(0.01),
                flip_p99: Some(0.1),
                worst_tile_rmse: 9.0,
                worst_tile: [0, 0],
                linear_rmse: None,
            },
        }),
        pan: None,
        sides: None,
        missing: Some(Missing {
            objects_shown: 2000,
            objects_lost: 1,
            pixels_shown: 30,
            pixels_lost: 3,
            mean_share_lost: 0.1,
        }),
    }
}

/// The JSON of section 3 of the command line's contract.
fn contract() -> Value {
    json!({
        "glimpse": "", "adapter": {"name": "", "backend": "", "driver": ""},
        "scene": {"file": "", "triangles": 0, "spheres": 0, "objects": 0, "lights": 0, "textures": 0,
                  "features": [], "left_out": []},
        "settings": {"method": ""},
        "size": [], "frames": 1,
        "time_ms": {"frame": {"median": 0.0, "p95": 0.0}, "clock": "", "passes": [{"name": "", "median": 0.0}]},
        "rays": {"primary": 0, "shadow": 0, "reflection": 0, "refraction": 0, "total": 0},
        "samples": {"total": 0, "base": 0, "traced_a1": 0, "traced_a2": 0, "postcorrected": 0, "interpolated": 0},
        "rt_ratio": 0.0,
        "cost": {"node_visits": 0, "primitive_tests": 0, "traced_share": 0.0},
        "failed_checks": {"oid": 0, "pos": 0, "norm": 0, "convex": 0, "tex": 0, "shadow": 0, "gcol": 0},
        "memory_bytes": {"scene": 0, "bvh": 0, "targets": 0, "total": 0},
        "error": {"against": "", "rmse": 0.0, "psnr_db": 0.0, "ssim": 0.0, "flip_mean": 0.0, "flip_p99": 0.0,
                  "worst_tile_rmse": 0.0},
        "speedup": 0.0, "efficiency": 0.0, "cost_efficiency": 0.0
    })
}

fn assert_same_shape(expected: &Value, found: &Value, at: &str) {
    match expected {
        Value::Object(fields) => {
            for (name, value) in fields {
                let inner = found.get(name).unwrap_or_else(|| panic!("{at}/{name} is missing"));
                assert_same_shape(value, inner, &format!("{at}/{name}"));
            }
        }
        Value::Array(items) => {
            assert!(found.is_array(), "{at} is no list");
            if let Some(item) = items.first() {
                assert_same_shape(item, &found[0], &format!("{at}/0"));
            }
        }
        Value::Number(_) => assert!(found.is_number(), "{at} is no number: {found}"),
        _ => assert!(found.is_string(), "{at} is no text: {found}"),
    }
}

#[test]
fn the_json_has_every_field_of_the_contract() {
    assert_same_shape(&contract(), &serde_json::to_value(example()).unwrap(), "");
}

#[test]
fn settings_name_every_option() {
    let json = serde_json::to_value(example()).unwrap();
    let settings = &json["settings"];
    assert_eq!((&settings["method"], &settings["specialize"]), (&json!("adaptive"), &json!("auto")));
    for name in ["t_pos", "depth", "min_weight", "camera"] {
        assert!(!settings[name].is_null(), "{name}");
    }
    for option in glimpse::options::OPTIONS {
        assert!(settings.get(option.name.replace('-', "_")).is_some(), "{}", option.name);
    }
}

#[test]
fn without_a_reference_nothing_speaks_of_one() {
    let mut statistics = example();
    (statistics.gain, statistics.error) = (None, None);
    let json = serde_json::to_value(statistics).unwrap();
    for name in ["speedup", "efficiency", "cost_efficiency", "error", "gain"] {
        assert!(json.get(name).is_none(), "{name}");
    }
}

#[test]
fn medians_are_per_pass_and_keep_the_order() {
    let frame = |base, resolve| FrameTime {
        ms: base + resolve,
        passes: vec![
            PassTime { name: "base", tracing: Tracing::Neighbours, ms: base },
            PassTime { name: "resolve", tracing: Tracing::No, ms: resolve },
        ],
    };
    let passes = pass_medians(&[frame(6.0, 1.0), frame(8.0, 2.0), frame(30.0, 0.5)]);
    assert_eq!(
        passes,
        [
            PassMedian { name: "base", tracing: Tracing::Neighbours, median: 8.0 },
            PassMedian { name: "resolve", tracing: Tracing::No, median: 1.0 }
        ]
    );
    assert_eq!(non_tracing_share(&passes, 10.0), Some(0.1));
    assert_eq!(non_tracing_share(&[], 10.0), None);
    assert!(pass_medians(&[]).is_empty());
}

/// The passes of every method: those that trace rays do not count as overhead, whatever their names.
#[test]
fn overhead_is_the_time_of_passes_that_trace_nothing() {
    let median = |name| PassMedian { name, tracing: Tracing::of_pass(name).expect(name), median: 1.0 };
    for (passes, share) in [
        (["presample", "subpixel_test", "compact_active", "extra_samples"], 0.5),
        (["quincunx_base", "quincunx_split_a", "quincunx_trace_a", "quincunx_trace_b"], 0.25),
        (["refine_test", "refine", "stratum_test", "strata"], 0.5),
        (["base", "similarity_a1", "compact_a1", "trace_a1"], 0.5),
        (["path", "stereo_reproject", "stereo_gather", "median"], 0.5),
    ] {
        assert_eq!(non_tracing_share(&passes.map(median), 4.0), Some(share), "{passes:?}");
    }
    assert_eq!(serde_json::to_value(median("refine")).unwrap()["tracing"], "listed");
}

fn work(node_visits: u64, primitive_tests: u64) -> Cost {
    Cost { node_visits, primitive_tests, ..Cost::default() }
}

#[test]
fn the_traced_share_is_of_the_full_frames_work() {
    assert_eq!(traced_share(&work(30, 20), &work(60, 40)), Some(0.5));
    assert_eq!(traced_share(&work(60, 40), &work(60, 40)), Some(1.0));
    assert_eq!(traced_share(&work(0, 0), &work(0, 0)), None);
}
