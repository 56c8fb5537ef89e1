//! Formats statistics as text.

use std::fmt::Write;

use glimpse::metrics::ErrorReport;
use glimpse::{Method, Missing};
use glimpse_measure::statistics::SceneStatistics;

use crate::cpu_tracer::{Side, Sides};
use crate::output::{Verbosity, bytes, counted, grouped, listed, one_line};
use crate::statistics::Statistics;

/// Number of warnings printed in full; the others are only counted.
const WARNINGS: usize = 3;

/// A line of the summary with its label.
pub fn row(name: &str, text: &str) -> String {
    format!("{name:<10}{}\n", one_line(text))
}

/// Summary of a frame that was written to `picture`: the picture, its time, its rays and its error; the scene, the
/// device and every counter to the verbose.
pub fn frame(
    s: &Statistics,
    picture: &str,
    legend: &str,
    warnings: &[String],
    verbosity: Verbosity,
) -> String {
    let [width, height] = s.size;
    let shown = format!("{picture}, {width}x{height}, method {}, camera {}", method(s), s.settings.camera);
    let mut text = row("picture", &shown) + legend;
    text += &row("time", &time(s));
    text += &row("rays", &rays(s));
    if let Some(gain) = &s.gain {
        text += &row(
            "speedup",
            &format!(
                "{:.2} over full's {:.2} ms; efficiency {:.2} (x RT ratio), {:.2} (x traced share of the work)",
                gain.speedup,
                gain.speedup * s.time_ms.frame.median,
                gain.efficiency,
                gain.cost_efficiency
            ),
        );
    }
    if let Some(against) = &s.error {
        text += &row("error", &error(&against.report));
    }
    if let Some(lost) = s.missing.as_ref().filter(|lost| lost.pixels_lost > 0) {
        text += &row("lost", &missing(lost));
    }
    if let Some(sides) = &s.sides {
        text += &row("sides", &self::sides(sides));
    }
    for warning in warnings.iter().take(WARNINGS) {
        text += &row("warning", warning);
    }
    if warnings.len() > WARNINGS {
        let more = warnings.len() - WARNINGS;
        text += &row("warning", &format!("and {more} more: glimpse info {}", s.scene.file));
    }
    if verbosity == Verbosity::Verbose { text + &details(s) } else { text }
}

/// Where a frame's time went, every counter and the memory.
fn details(s: &Statistics) -> String {
    let t = &s.time_ms;
    let mut text = scene(&s.scene) + &row("adapter", &adapter(s));
    text += &row(
        "prepared",
        &format!("load {:.0} ms, build {:.0} ms, compile {:.0} ms", t.load, t.build, t.compile),
    );
    for pass in &t.passes {
        let share = 100.0 * pass.median / t.frame.median;
        text += &row("", &format!("{:<16}{:>10.3} ms {share:>5.1} %", pass.name, pass.median));
    }
    text += &row("samples", &counted_by(s.samples.total, s.samples.labelled()));
    text += &row("RT ratio", &format!("{:.4}", s.rt_ratio));
    let failed = counts(s.failed_checks.labelled());
    if !failed.is_empty() {
        text += &row("traced", &format!("samples whose neighbours differ in {failed}"));
    }
    text += &row("work", &work(s));
    let m = &s.memory_bytes;
    text + &row(
        "memory",
        &format!(
            "{} (scene {}, acceleration structure {}, targets {})",
            bytes(m.total),
            bytes(m.scene),
            bytes(m.bvh),
            bytes(m.targets)
        ),
    )
}

fn time(s: &Statistics) -> String {
    let t = &s.time_ms;
    format!(
        "{:.2} ms (median of {}, 95 % within {:.2} ms), {} clock, after {:.1} s of preparation",
        t.frame.median,
        counted(s.frames, "frame"),
        t.frame.p95,
        t.clock,
        (t.load + t.build + t.compile) / 1000.0
    )
}

/// Contents of a scene and what its kernels do without, in one or two lines.
pub fn scene(scene: &SceneStatistics) -> String {
    let counts = [
        counted(scene.triangles, "triangle"),
        counted(scene.spheres, "sphere"),
        counted(scene.objects, "object"),
        counted(scene.lights, "light"),
        counted(scene.textures, "texture"),
    ];
    let text = row("scene", &format!("{}: {}", scene.file, listed(&counts)));
    if scene.left_out.is_empty() {
        return text;
    }
    text + &row("kernels", &format!("without {}: this scene needs none of it", listed(&scene.left_out)))
}

/// Samples by GPU and CPU thread after the timed frames, in one line.
pub fn sides(sides: &Sides) -> String {
    let side = |who: String, side: &Side| {
        format!("{who} {} ({:.0} % busy)", counted(side.samples as usize, "sample"), 100.0 * side.utilisation)
    };
    let cpu_threads = sides
        .cpu_threads
        .iter()
        .enumerate()
        .map(|(index, thread)| side(format!("CPU thread {index}"), thread));
    let all: Vec<_> = std::iter::once(side("GPU".to_owned(), &sides.gpu)).chain(cpu_threads).collect();
    format!("{} in {:.0} ms, {:.3} samples/s", all.join(", "), sides.wall_ms, sides.samples_per_s)
}

/// Error metrics, in one line.
pub fn error(report: &ErrorReport) -> String {
    let mut text =
        format!("RMSE {:.3}, PSNR {}, SSIM {:.5}", report.rmse, decibels(report.psnr_db), report.ssim);
    // Writing to a String cannot fail.
    if let (Some(mean), Some(p99)) = (report.flip_mean, report.flip_p99) {
        let _ = write!(text, ", FLIP {mean:.5} (99 % within {p99:.4})");
    }
    let [x, y] = report.worst_tile;
    let _ = write!(text, ", worst tile {:.2} at ({x}, {y})", report.worst_tile_rmse);
    if let Some(linear) = report.linear_rmse {
        let _ = write!(text, ", linear RMSE {linear:.5}");
    }
    text
}

/// PSNR in decibels; `infinite` for equal images.
pub fn decibels(psnr_db: Option<f64>) -> String {
    psnr_db.map_or_else(|| "infinite".to_owned(), |db| format!("{db:.2} dB"))
}

/// Name of the frame's method, as on the command line.
pub fn method(statistics: &Statistics) -> String {
    method_name(statistics.settings.settings.method)
}

/// Name of a method, as on the command line.
pub fn method_name(method: Method) -> String {
    method.name().to_owned()
}

/// Objects and pixels that `full` shows and the frame loses, in one line.
pub fn missing(m: &Missing) -> String {
    format!(
        "{} of {}, {} of {} pixels, {:.2} % of the average object",
        grouped(m.objects_lost),
        counted(m.objects_shown as usize, "object"),
        grouped(m.pixels_lost),
        grouped(m.pixels_shown),
        100.0 * m.mean_share_lost
    )
}

/// Adapter with backend and driver, in one line.
pub fn adapter(statistics: &Statistics) -> String {
    let a = &statistics.adapter;
    let known: Vec<_> =
        [&a.backend, &a.driver].into_iter().filter(|s| !s.is_empty()).map(String::as_str).collect();
    format!("{} ({})", a.name, known.join(", "))
}

fn rays(s: &Statistics) -> String {
    let traced = format!("{:.1} % of the samples traced", 100.0 * s.rt_ratio);
    format!("{}, {:.2} million/s, {traced}", counted_by(s.rays.total, s.rays.labelled()), s.mrays_per_s)
}

/// A sum with its parts.
fn counted_by<const N: usize>(total: u64, labelled: [(&str, u64); N]) -> String {
    let parts = counts(labelled);
    if parts.is_empty() { grouped(total) } else { format!("{} ({parts})", grouped(total)) }
}

/// Counters with their labels, separated by commas, without those that are zero.
fn counts<const N: usize>(labelled: [(&str, u64); N]) -> String {
    let there = labelled.into_iter().filter(|(_, count)| *count > 0);
    there.map(|(label, count)| format!("{label} {}", grouped(count))).collect::<Vec<_>>().join(", ")
}

fn work(s: &Statistics) -> String {
    let share = s.cost.traced_share.map_or_else(String::new, |share| {
        format!("; {:.1} % of the full frame's work lies in traced samples", 100.0 * share)
    });
    let work = s.cost.labelled().map(|(label, count)| format!("{} {label}", grouped(count)));
    format!("{}{share}", work.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::tests::example;

    #[test]
    fn a_frame_is_told_in_full() {
        let text = frame(&example(), "out.png", "", &[], Verbosity::Verbose);
        for expected in [
            "scene     a.glb: 0 triangles",
            "kernels   without textures, glossy, emission, metallic_roughness_textures",
            "Card (vulkan, D 1)",
            "picture   out.png, 8x4, method adaptive, camera 0 (front)",
            "10.00 ms (median of 1 frame, 95 % within 12.00 ms), gpu clock",
            "base                 8.000 ms  80.0 %",
            "RT ratio  0.3400",
            "rays      0, 7.00 million/s, 34.0 % of the samples traced",
            "samples   32 (base 8, traced A1 1, traced A2 2, interpolated 21)",
            "neighbours differ in oid 3",
            "50.0 % of the full frame's work",
            "speedup   2.00 over full's 20.00 ms",
            "PSNR 48.13 dB",
            "worst tile 9.00 at (0, 0)",
            "lost      1 of 2,000 objects, 3 of 30 pixels, 10.00 % of the average object",
        ] {
            assert!(text.contains(expected), "no `{expected}` in\n{text}");
        }
        assert!(!text.contains("warning"));
    }

    #[test]
    fn a_person_is_told_the_picture_its_time_and_its_error_and_nothing_that_reads_as_a_failure() {
        let text = frame(&example(), "out.png", "", &[], Verbosity::Normal);
        let names: Vec<_> = text.lines().map(|line| line[..10].trim_end()).collect();
        assert_eq!(names, ["picture", "time", "rays", "speedup", "error", "lost"]);
        let mut statistics = example();
        statistics.missing.as_mut().unwrap().pixels_lost = 0;
        for verbosity in [Verbosity::Normal, Verbosity::Verbose] {
            let text = frame(&statistics, "out.png", "", &[], verbosity);
            assert!(
                !text.contains("lost") && !text.contains("left out") && !text.contains("failed"),
                "{text}"
            );
        }
    }

    #[test]
    fn a_name_stays_on_its_line() {
        assert_eq!(row("camera", "a\nb"), "camera    a\\u{a}b\n");
    }

    /// Every counter is printed, so that the printed counts add up to their sum.
    #[test]
    fn every_counter_of_the_json_is_told() {
        let mut statistics = example();
        statistics.samples.extra = 1_234_567;
        statistics.rays.diffuse = 7_654_321;
        let text = frame(&statistics, "out.png", "", &[], Verbosity::Verbose);
        assert!(text.contains("extra 1,234,567") && text.contains("diffuse 7,654,321"), "{text}");
        let json = serde_json::to_value(&statistics).unwrap();
        for (section, labels) in
            [("rays", statistics.rays.labelled().len()), ("samples", statistics.samples.labelled().len())]
        {
            assert_eq!(json[section].as_object().unwrap().len(), labels + 1, "{section}: all and `total`");
        }
    }

    #[test]
    fn many_warnings_are_counted() {
        let warnings: Vec<String> = (0..5).map(|i| format!("mesh {i}")).collect();
        let text = frame(&example(), "out.png", "", &warnings, Verbosity::Normal);
        assert!(text.contains("mesh 2") && !text.contains("mesh 3"), "{text}");
        assert!(text.contains("and 2 more"), "{text}");
    }

    #[test]
    fn equal_images_have_infinite_psnr() {
        assert_eq!(decibels(None), "infinite");
    }
}
