//! The tolerances of the similarity checks at their extremes and beyond.

use super::{Bench, Case, Outcome};
use crate::{Error, Method, Renderer, Result, Settings, scene::builtin};

pub const CASE: Case = Case {
    name: "tolerances",
    construction: "each tolerance, the depth and the weight cut at 0, at both ends of their ranges, just beyond, negative, \
                   infinite, not a number; frames of builtin:room",
    rule: "an error that names the option, or a finite frame; a tolerance of 0 for G2 is full tracing bit for bit",
    run,
};

/// Valid and invalid values of one option.
struct Requests {
    option: &'static str,
    set: fn(&mut Settings, f32),
    accepted: &'static [f32],
    refused: &'static [f32],
}

const NOT_NUMBERS: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

const REQUESTS: [Requests; 5] = [
    Requests {
        option: "t-pos",
        set: |s, x| s.tolerances.pos = x,
        accepted: &[0.0, -0.0, f32::MIN_POSITIVE, 1.0e-45, 1.0, f32::MAX],
        refused: &[-f32::MIN_POSITIVE, -1.0],
    },
    Requests {
        option: "t-norm",
        set: |s, x| s.tolerances.norm = x,
        accepted: &[-1.0, 0.0, 1.0, 2.0],
        refused: &[-1.1, 2.1],
    },
    Requests {
        option: "t-tex",
        set: |s, x| s.tolerances.tex = x,
        accepted: &[0.0, 1.0e-45, 0.5],
        refused: &[-0.1, 0.51],
    },
    Requests {
        option: "t-gcol",
        set: |s, x| s.tolerances.gcol = x,
        accepted: &[0.0, 1.0e-45, 1.0, f32::MAX],
        refused: &[-1.0e-3],
    },
    Requests {
        option: "min-weight",
        set: |s, x| s.min_weight = x,
        accepted: &[0.0, 1.0e-45, 1.0],
        refused: &[-1.0e-3, 1.1],
    },
];

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let scene = builtin("room").ok_or_else(|| Error::scene("builtin:room", "expected to be there"))?;
    let camera = *scene.camera(None)?;
    let scene = bench.upload(scene)?;
    let frames: usize = REQUESTS.iter().map(|w| w.accepted.len()).sum();
    let width = ((bench.rays as f64 / frames as f64 * 4.0 / 3.0).sqrt() as u32 + 4).clamp(16, 2_048);
    let size = [width, width * 3 / 4];
    let frame = |settings: &Settings| Renderer::new(bench.gpu, &scene, size, settings)?.linear_image(&camera);
    let full = frame(&Settings { method: Method::Full, ..Settings::default() })?;
    for Requests { option, set, accepted, refused } in &REQUESTS {
        let wish = |value: f32| {
            let mut settings = Settings::default();
            set(&mut settings, value);
            settings
        };
        for value in refused.iter().chain(&NOT_NUMBERS) {
            let error = wish(*value).validate().err().map(|e| e.to_string());
            let named = error.as_ref().is_some_and(|e| e.contains(option));
            outcome.check(named, || format!("{option} {value} gives {error:?}"));
        }
        for value in *accepted {
            let settings = wish(*value);
            let image = frame(&settings)?;
            for (x, y, pixel) in image.enumerate_pixels() {
                let same = settings.tolerances.pos != 0.0 || pixel == full.get_pixel(x, y);
                outcome.check(same && pixel.0.iter().all(|c| c.is_finite()), || {
                    format!("{option} {value}, {size:?}: ({x}, {y}) is {:?}", pixel.0)
                });
            }
        }
    }
    Ok(outcome)
}
