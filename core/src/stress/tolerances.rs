//! The tolerances of the similarity checks at their extremes and beyond.

use super::{Bench, Case, Outcome, unexposed};
use crate::options::{Group, Kind, Numbers, OPTIONS, OptionSpec};
use crate::{Error, Method, Renderer, Result, Settings, scene::builtin};

pub const CASE: Case = Case {
    name: "tolerances",
    construction: "each tolerance, the depth and the weight cut at 0, at both ends of their ranges, just beyond, negative, \
                   infinite, not a number; frames of builtin:room",
    rule: "an error that names the option, or a finite frame; a tolerance of 0 for G2 is full tracing bit for bit",
    run,
};

/// An option that takes a number, with values that it accepts and others that it refuses.
struct Requests {
    option: &'static str,
    field: fn(&mut Settings) -> &mut f32,
    accepted: Vec<f32>,
    refused: Vec<f32>,
}

/// What is tried of each, on whichever side of its ends it lies.
const NUMBERS: [f32; 8] = [0.0, -0.0, f32::MIN_POSITIVE, 1.0e-45, -f32::MIN_POSITIVE, -1.0e-3, 1.0, -1.0];

const NOT_NUMBERS: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

/// The adaptive method's numbers and the least weight.
fn requests() -> Vec<Requests> {
    let of = |option: &'static OptionSpec| {
        let Kind::Number { field, allowed, .. } = option.kind else { return None };
        let Numbers { low, high, .. } = allowed;
        let ends = [low, high, low.next_down(), high.next_up(), low - 0.1, 1.1 * high];
        let finite = NUMBERS.into_iter().chain(ends).filter(|number| number.is_finite());
        let (accepted, refused) = finite.partition(|number| (low..=high).contains(number));
        Some(Requests { option: option.name, field, accepted, refused })
    };
    OPTIONS.iter().filter(|o| o.group == Group::Adaptive || o.name == "min-weight").filter_map(of).collect()
}

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let scene = builtin("room").ok_or_else(|| Error::scene("builtin:room", "expected to be there"))?;
    let camera = *scene.camera(None)?;
    let scene = bench.upload(scene)?;
    let requests = requests();
    let frames: usize = requests.iter().map(|w| w.accepted.len()).sum();
    let width = ((bench.rays as f64 / frames as f64 * 4.0 / 3.0).sqrt() as u32 + 4).clamp(16, 2_048);
    let size = [width, width * 3 / 4];
    let frame = |settings: &Settings| Renderer::new(bench.gpu, &scene, size, settings)?.linear_image(&camera);
    let full = frame(&Settings { method: Method::Full, ..unexposed() })?;
    for Requests { option, field, accepted, refused } in &requests {
        let wish = |value: f32| {
            let mut settings = unexposed();
            *field(&mut settings) = value;
            settings
        };
        for value in refused.iter().chain(&NOT_NUMBERS) {
            let error = wish(*value).validate().err().map(|e| e.to_string());
            let named = error.as_ref().is_some_and(|e| e.contains(option));
            outcome.check(named, || format!("{option} {value} gives {error:?}"));
        }
        for value in accepted {
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
