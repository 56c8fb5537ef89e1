//! Measurements of the last frame, as rows with bars.

use egui::{Color32, ProgressBar, RichText, Ui};
use glimpse::Method;

use super::{amounts, style};
use crate::{Choices, HudState};

/// Shows the time of each pass of the last frame.
pub fn passes(ui: &mut Ui, hud_state: &HudState) {
    let longest = hud_state.passes.iter().map(|pass| pass.ms).fold(0.0, f64::max);
    for pass in &hud_state.passes {
        style::reading(ui, pass.name, &format!("{:.2} ms", pass.ms));
        bar(ui, pass.ms, longest);
    }
    nothing(ui, hud_state.passes.is_empty(), "The adapter measures no passes, or no frame was made yet.");
}

/// Shows rays, samples and traversal work of the last counted frame.
pub fn rays(ui: &mut Ui, hud_state: &HudState, choices: &Choices) {
    let Some(counts) = hud_state.counts else {
        return nothing(ui, true, "Frames are counted when the camera rests.");
    };
    nothing(ui, choices.refined().is_some(), "Counted before the frame was refined.");
    style::reading(ui, "RT ratio", &amounts::percent(counts.rt_ratio()));
    bar(ui, counts.rt_ratio(), 1.0);
    for (kind, count) in counts.rays.labelled() {
        style::reading(ui, &format!("{kind} rays"), &amounts::count(count));
        bar(ui, count as f64, counts.rays.total as f64);
    }
    style::reading(ui, "all rays", &amounts::count(counts.rays.total));
    for (origin, count) in counts.samples.labelled() {
        style::reading(ui, &format!("{origin} samples"), &amounts::count(count));
    }
    for (work, count) in counts.cost.labelled() {
        style::reading(ui, work, &amounts::count(count));
    }
}

/// Shows how often each similarity check failed and required a ray.
pub fn failed_checks(ui: &mut Ui, hud_state: &HudState) {
    let Some(counts) = hud_state.counts else { return };
    for (name, count) in counts.failed_checks.labelled() {
        style::reading(ui, name, &amounts::count(count));
        bar(ui, count as f64, counts.samples.total as f64);
    }
}

/// Shows device memory in use and the adapter.
pub fn device(ui: &mut Ui, hud_state: &HudState) {
    let memory = hud_state.memory;
    let rows = [
        ("scene", memory.scene),
        ("hierarchy", memory.bvh),
        ("targets", memory.targets),
        ("all", memory.total),
    ];
    for (name, bytes) in rows {
        style::reading(ui, name, &amounts::mebibytes(bytes));
    }
    ui.label(RichText::new(hud_state.adapter.as_str()).small().weak());
}

/// Shows the scene's contents and the features left out of its kernels.
pub fn scene(ui: &mut Ui, hud_state: &HudState, method: Method) {
    style::reading(ui, "primitives", &amounts::count(hud_state.primitives));
    for (caption, names) in [("needs", &hud_state.features), ("left out of the kernels", &hud_state.left_out)]
    {
        style::caption(ui, caption);
        let text = if names.is_empty() { "nothing".to_owned() } else { names.join(", ") };
        ui.label(RichText::new(text).small());
    }
    let warn = |ui: &mut Ui, line: &str| ui.label(RichText::new(line).small().color(style::WARNING));
    for warning in &hud_state.warnings {
        warn(ui, warning);
    }
    let of_method =
        hud_state.not_shown_by.iter().filter(|(by, _)| *by == method).flat_map(|(_, lines)| lines);
    for not_shown in hud_state.not_shown.iter().chain(of_method) {
        warn(ui, &format!("not shown: {not_shown}"));
    }
}

/// A bar whose filled share is `part` of `whole`.
fn bar(ui: &mut Ui, part: f64, whole: f64) {
    let share = if whole > 0.0 { (part / whole) as f32 } else { 0.0 };
    let fill = if share > 0.0 { style::ACCENT.gamma_multiply(0.7) } else { Color32::TRANSPARENT };
    ui.add(ProgressBar::new(share).desired_height(4.0).corner_radius(2).fill(fill));
}

fn nothing(ui: &mut Ui, so: bool, why: &str) {
    if so {
        ui.label(RichText::new(why).small().weak());
    }
}
