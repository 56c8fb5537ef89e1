//! The key of the page: the short name of each setting and its options.

use maud::{Markup, html};

use crate::key;
use crate::scene::SceneReport;

/// Headings of the key.
pub const HEAD: [&str; 4] = ["short name", "family", "setting", "options of glimpse render"];

/// Renders the key of all measured settings.
pub fn section(scenes: &[SceneReport]) -> Markup {
    let rungs = scenes.iter().flat_map(|scene| &scene.measured).flat_map(|measured| &measured.job.rungs);
    html! {
        details open id="settings" {
            summary { h2 { "Settings" } }
            (explanation())
            div class="wide" { table class="key" {
                thead { tr { @for head in HEAD { th { (head) } } } }
                tbody {
                    @for key::Entry { rung, options } in key::entries(rungs) {
                        tr id={ "setting-" (rung.code) } class=[rung.family.is_baseline.then_some("baseline")] {
                            th { (rung.code) }
                            td { (rung.family.name) }
                            td { (rung.name) }
                            td { code { (options) } }
                        }
                    }
                }
            } }
        }
    }
}

fn explanation() -> Markup {
    html! {
        p {
            "Errors are those of display-encoded 8-bit pictures against a frame of 256 samples a pixel. Frames of reduced \
             resolution are upscaled bilinearly on the CPU, which is not in their time: that favours them. Fixed N traces N \
             samples a pixel. The adaptive method has 2x2 blocks, Kim 2016's tolerances and postcorrection where a setting \
             does not say otherwise; \"off\" leaves postcorrection out, tolerance x2 passes pairs of pixels that differ by \
             twice as much. Supersample adds four samples to each quarter of a pixel where neighbours differ (Jin 2009), by \
             preset: edges, balanced or textures; combined does so after the adaptive method. Quincunx X puts samples between \
             those that differ by more than X. Efficiency is 1 / (MSE x seconds), MSE of values in [0, 1]; RMSE is in levels of \
             0 to 255. A ● marks the Pareto front of all settings: none is both faster (or traces fewer rays) and better. \
             Settings with a grey background are the baselines."
        }
    }
}
