//! Boundaries between media around the critical angle.

use super::{Bench, Case, Outcome, Random};
use crate::{
    Result,
    probe::{ProbeBoundary, fresnel},
};

pub const CASE: Case = Case {
    name: "critical",
    construction: "relative indices {1, 1 +- 1 ulp, 1.0003, 1.33, 1.5, 2.42, 2.6} and their inverses; cosines 0, 1, random, and \
                   that of the critical angle +- 0, 1, 2, 4 ... 2^20 ulp",
    rule: "finite; reflectance within 1e-6 of f64 away from the critical angle; R + T = 1 +- 1e-6 with T by its own formula; \
           the refracted direction of unit length +- 1e-6; total reflection as in f64 outside of 4 ulp",
    run,
};

const INDICES: [f32; 8] = [1.0, 1.0 + f32::EPSILON, 1.0 - f32::EPSILON / 2.0, 1.0003, 1.33, 1.5, 2.42, 2.6];

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let mut random = Random(bench.seed);
    let ratios: Vec<f32> = INDICES.iter().flat_map(|n| [*n, 1.0 / n]).collect();
    let inputs: Vec<ProbeBoundary> = (0..bench.rays)
        .map(|i| {
            let ratio = ratios[i as usize % ratios.len()];
            ProbeBoundary { cosine: cosine(ratio, i / ratios.len() as u64, &mut random), ratio }
        })
        .collect();
    let answers = fresnel(bench.gpu, &inputs)?;
    for (ProbeBoundary { cosine, ratio }, answer) in inputs.iter().zip(&answers) {
        let (c, r) = (f64::from(*cosine), f64::from(*ratio));
        let is_total = |c: f64| (1.0 - r) * (1.0 + r) + (r * c) * (r * c) <= 0.0;
        let total = is_total(c);
        // Where four units in the last place of the cosine decide.
        let ulp = f64::from(cosine.next_up() - cosine).max(f64::from(f32::MIN_POSITIVE));
        let tie = is_total((c - 4.0 * ulp).max(0.0)) != is_total(c + 4.0 * ulp);
        let replay =
            |what: &str| format!("seed {}: cosine {cosine:e}, ratio {ratio}: {what}: {answer:?}", bench.seed);
        if (answer.total != 0) != total {
            if tie {
                outcome.explain("the critical angle is within 4 ulp of the cosine");
            } else {
                outcome.fail(|| replay("total reflection"));
            }
            continue;
        }
        let direction = answer.refracted.map(f64::from);
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        let reflectance = f64::from(answer.reflectance);
        let finite = answer.reflectance.is_finite() && length.is_finite();
        let sound = finite && (0.0..=1.0).contains(&reflectance);
        let unit = total || (length - 1.0).abs() <= 1.0e-6;
        let whole =
            total || (reflectance + transmittance(c, r, f64::from(answer.transmitted)) - 1.0).abs() <= 1.0e-6;
        outcome
            .check(sound && unit && whole, || replay(&format!("sound {sound}, unit {unit}, whole {whole}")));
    }
    Ok(outcome)
}

/// The part of the light that passes, from both cosines: the other half of Fresnel's equations.
fn transmittance(cosine: f64, ratio: f64, other: f64) -> f64 {
    if cosine == 0.0 {
        return if other > 0.0 { 0.0 } else { 1.0 };
    }
    let s = 2.0 * ratio * cosine / (ratio * cosine + other);
    let p = 2.0 * ratio * cosine / (cosine + ratio * other);
    0.5 * other / (ratio * cosine) * (s * s + p * p)
}

fn cosine(ratio: f32, index: u64, random: &mut Random) -> f32 {
    let r = f64::from(ratio);
    let critical = (1.0 - 1.0 / (r * r)).max(0.0).sqrt() as f32;
    match index % 8 {
        0 => [0.0, 1.0, f32::MIN_POSITIVE, 1.0 - f32::EPSILON][random.below(4)],
        1 | 2 => random.unit() as f32,
        _ => {
            let step = [0, 1 << random.below(21)][usize::from(random.below(8) != 0)];
            let sign = if random.below(2) == 0 { 1 } else { -1 };
            f32::from_bits((critical.to_bits() as i32 + sign * step).max(0) as u32).clamp(0.0, 1.0)
        }
    }
}
