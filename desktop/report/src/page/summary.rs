//! The head of the page: the first sentence, the scenes at equal error, and where and how they were measured.

use glimpse_measure::output::counted;
use maud::{Markup, html};

use super::Header;
use crate::headline::{self, Finding};
use crate::rows;
use crate::scene::SceneReport;

/// Headings of the table of scenes.
pub const HEAD: [&str; 6] =
    ["scene", "time / full tracing's", "95 % interval", "PSNR compared, dB", "finding", "noise of times"];

/// The first sentence of the page.
pub fn sentence(scenes: &[SceneReport]) -> String {
    let compared = scenes.iter().map(|scene| (scene.stem.as_str(), &scene.compared));
    headline::sentence(&compared.collect::<Vec<_>>())
}

/// Renders the head of the page.
pub fn section(header: &Header, scenes: &[SceneReport]) -> Markup {
    html! {
        p class="headline" { (sentence(scenes)) }
        div class="wide" { table {
            thead { tr { @for head in HEAD { th { (head) } } } }
            tbody { @for scene in scenes { (row(scene)) } }
        } }
        (method(header))
        ul class="contents" {
            @for scene in scenes {
                li { a href={ "#" (scene.stem) } { (scene.stem) } ": " (rows::verdict(&scene.rows)) "." }
            }
        }
        (facts(header, scenes))
    }
}

fn row(scene: &SceneReport) -> Markup {
    let percent =
        |share: f64| if share.is_nan() { "-".to_owned() } else { format!("{:.1} %", 100.0 * share) };
    html! {
        tr {
            th { a href={ "#" (scene.stem) } { (scene.stem) } }
            @match &scene.compared {
                Ok(compared) => {
                    td { (format!("{:.3}", compared.ratio().mean)) }
                    td { (compared.ratio().range(3)) }
                    td { (format!("{:.1} to {:.1}", compared.psnr_db[0], compared.psnr_db[1])) }
                    td { (Finding::of(&compared.ratio()).word()) }
                }
                Err(reason) => {
                    td {} td {} td {}
                    td class="source" { "not compared: " (reason) }
                }
            }
            td {
                @if let Some(noise) = scene.noise {
                    (percent(noise.between)) " of " (counted(noise.groups, "group")) ", " (percent(noise.within)) " of frames"
                }
            }
        }
    }
}

fn method(header: &Header) -> Markup {
    let interval = match header.frames {
        0 | 1 => "There are no intervals, as each setting was timed once (--frames)".to_owned(),
        frames => format!(
            "Intervals are those of Student's t of the logarithms over {frames} rounds: they are of the noise of this machine's \
             times on these scenes, and do not speak of other scenes"
        ),
    };
    html! {
        p {
            "At equal error: of full tracing (one or more samples a pixel, reduced resolutions) and of adaptive sampling (all \
             settings that are no baseline) the Pareto fronts of PSNR and time, the logarithm of time interpolated linearly in \
             PSNR, and its difference averaged over the PSNR that both reach (Bjøntegaard, VCEG-M33, 2001, with lines for \
             cubics). Two or three settings take turns frame by frame with a control, full tracing with one sample a pixel; times \
             are compared as ratios to the control's of the same round. " (interval) ". Noise: the relative standard deviation of \
             the control's mean times between the groups of settings that it was timed with, all through the measurement, and \
             of its single frames within a group."
        }
    }
}

fn facts(header: &Header, scenes: &[SceneReport]) -> Markup {
    let rows = || scenes.iter().flat_map(|scene| &scene.rows);
    let ends = [rows().map(|row| &row.day).min(), rows().map(|row| &row.day).max()];
    let days = match ends {
        [Some(first), Some(last)] if first == last => first.clone(),
        [Some(first), Some(last)] => format!("{first} to {last}"),
        _ => "no day".to_owned(),
    };
    let Header { adapter, cpu, clock, version, commit, command, .. } = header;
    html! {
        dl {
            dt { "Graphics" } dd { (adapter) }
            dt { "Processor" } dd { (cpu) }
            dt { "Measured" } dd { (days) " (UTC)" }
            dt { "Times" } dd { (clock) ", medians of warm frames, settings interleaved frame by frame" }
            dt { "Glimpse" } dd { (version) ", commit " (commit) }
            dt { "Command" } dd { code { (command) } }
            dt { "Cite as" } dd {
                "Glimpse " (version) ", commit " (commit) ": error against run time of " (counted(scenes.len(), "scene")) " ("
                @for (index, scene) in scenes.iter().enumerate() {
                    @if index > 0 { ", " }
                    (scene.stem) " " (short(scene))
                }
                "), " (adapter) ", " (cpu) ", " (days) "."
            }
        }
    }
}

/// The first digits of the scene's fingerprint.
fn short(scene: &SceneReport) -> String {
    scene.prepared.content.to_string().chars().take(8).collect()
}
