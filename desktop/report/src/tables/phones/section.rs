//! "Will it be real time?": the section of the page with the predictions for phones and their assumptions.

use glimpse::Tracing;
use maud::{Markup, html};

use super::{BANDWIDTH, Cell, MISSED, PUBLISHED, Prediction, Predictions, SIZE};
use crate::tables::kim2016;
use crate::work::class_name;

/// Renders the section; without a calibration it states what is missing.
pub fn section(predictions: &Result<Predictions, String>) -> Markup {
    let [width, height] = SIZE;
    html! {
        section id="phones" {
            h2 { "Will it be real time? A prediction for phones, " (width) "x" (height) }
            @match predictions {
                Err(lack) => p { strong { "Not calibrated: " (lack) ". Nothing is predicted." } },
                Ok(predictions) => {
                    p { strong {
                        "This is a prediction, not a measurement: no phone was at hand. It may be wrong by more than its range."
                    } }
                    (times(predictions))
                    h3 { "What is assumed" }
                    (assumptions(predictions))
                    h3 { "Calibration" }
                    (calibration(predictions))
                    h3 { "Each scene from the others" }
                    (checks(predictions))
                    h3 { "Counted work" }
                    (work(predictions))
                    h3 { "The phones" }
                    (phones(predictions))
                }
            }
        }
    }
}

fn times(predictions: &Predictions) -> Markup {
    let of = |cell: &Cell| {
        let rows = predictions.rows.iter();
        rows.filter(|row| row.scene == cell.scene && row.method == cell.method).collect::<Vec<_>>()
    };
    html! {
        p {
            "Predicted milliseconds: in between, and from low to high; frames a second of the time in between. PREDICTION in \
             every cell."
        }
        div class="wide" { table {
            thead { tr {
                th { "scene, method" }
                @for phone in &predictions.phones { th { (phone.gpu) } }
            } }
            tbody {
                @for cell in &predictions.cells {
                    tr {
                        th { (cell.scene) ", " (cell.method) }
                        @for row in of(cell) { td { (time(row)) } }
                    }
                }
            }
        } }
    }
}

/// Formats a prediction: `118 ms (51 to 310), 8.5 fps`.
fn time(row: &Prediction) -> String {
    let short = |value: f64| if value < 9.95 { format!("{value:.1}") } else { format!("{value:.0}") };
    let [low, mid, high, fps] =
        [row.predicted_low_ms, row.predicted_mid_ms, row.predicted_high_ms, row.predicted_mid_fps].map(short);
    format!("{mid} ms ({low} to {high}), {fps} fps")
}

fn assumptions(predictions: &Predictions) -> Markup {
    let percent = |shares: [f64; 3]| shares.map(|share| format!("{:.0} %", 100.0 * share)).join(", ");
    html! {
        ul {
            li {
                "A pass takes the longer of two times: its arithmetic at a share of the peak operations, its bytes at a share \
                 of the peak bandwidth; a frame is the sum of its passes. Rays, node visits, primitive tests and samples are \
                 counted in a frame of this very size; the arithmetic and the bytes of each are counted from the kernels' code \
                 (quotients and transcendental functions as four operations, of two branches the longer)."
            }
            li {
                "Traced neighbours reach " (percent(predictions.arithmetic)) " of a phone's peak operations (low, in between, \
                 high): the largest, the median and the smallest of the shares under Calibration. Lists and passes that trace \
                 nothing are to them as on this device. How wide the groups of threads of a phone are is not considered."
            }
            li {
                "Of the peak bandwidth " (percent(BANDWIDTH)) " are reached, and " (percent(MISSED)) " of the bytes read of \
                 the scene come from memory, the others from caches. No published figures were found: these are estimates."
            }
            li {
                "Low and high are widened by " (format!("{:.2}", predictions.factor)) ", by which the worst scene is off when \
                 predicted from the others."
                @if predictions.checks.is_empty() { " With one scene there is no such check." }
            }
            li {
                "Not considered: phones that get warm and clock lower (3DMark's stability is 54 to 99 % on nanoreview.net), that \
                 published peaks are never reached, what else uses the memory, the time of a dispatch and of the gaps between \
                 submissions, the display."
            }
        }
    }
}

fn calibration(predictions: &Predictions) -> Markup {
    let calibration = &predictions.calibration;
    html! {
        p {
            "This device does " (format!("{:.0}", calibration.peak_gflops)) " billion operations a second at its best (a \
             kernel of nothing but multiply-adds, the median of what was measured right after each frame). Of it the passes reach, in \
             the median frame:"
        }
        div class="wide" { table {
            thead { tr { th { "of the peak operations" } th { "share" } th { "source" } } }
            tbody {
                @for class in Tracing::ALL {
                    tr {
                        th { "this device, " (class_name(class)) }
                        td { (format!("{:.1} %", 100.0 * calibration.shares[class as usize])) }
                        td { "measured" }
                    }
                }
                @for (published, share) in PUBLISHED.iter().zip(&predictions.known[1..]) {
                    tr {
                        th { (published.what) }
                        td { (format!("{:.1} %", 100.0 * share)) }
                        td { (published.source) }
                    }
                }
            }
        } }
        p {
            "The published rates are of other programs and scenes: they are shares of the peak if a ray, or a pixel, took them as \
             many operations as here. Kim 2016: " (kim2016::CITATION) "."
        }
    }
}

fn checks(predictions: &Predictions) -> Markup {
    html! {
        @if predictions.checks.is_empty() {
            p { "Not checked: that takes two scenes." }
        } @else {
            p { "The passes of each frame on this device, predicted from the shares that the other scenes' frames reach." }
            div class="wide" { table {
                thead { tr {
                    @for head in ["scene, method", "predicted ms", "measured ms", "error"] { th { (head) } }
                } }
                tbody {
                    @for check in &predictions.checks {
                        tr {
                            th { (check.scene) ", " (check.method) }
                            td { (format!("{:.1}", check.predicted_ms)) }
                            td { (format!("{:.1}", check.measured_ms)) }
                            td { (format!("{:+.0} %", 100.0 * (check.predicted_ms / check.measured_ms - 1.0))) }
                        }
                    }
                }
            } }
        }
    }
}

fn work(predictions: &Predictions) -> Markup {
    let billions = |value: f64| format!("{:.2}", 1e-9 * value);
    html! {
        p { "Operations and bytes of one frame, in billions." }
        div class="wide" { table {
            thead { tr {
                th { "scene, method" }
                @for head in ["rays a pixel", "node visits a ray", "primitive tests a ray"] { th { (head) } }
                @for class in Tracing::ALL { th { (class_name(class)) ", operations" } }
                @for head in ["bytes of the scene", "bytes of the frame"] { th { (head) } }
            } }
            tbody {
                @for cell in &predictions.cells {
                    tr {
                        th { (cell.scene) ", " (cell.method) }
                        td { (format!("{:.2}", cell.rays as f64 / cell.pixels as f64)) }
                        td { (format!("{:.1}", cell.node_visits as f64 / cell.rays as f64)) }
                        td { (format!("{:.1}", cell.primitive_tests as f64 / cell.rays as f64)) }
                        @for load in &cell.loads { td { (billions(load.operations)) } }
                        td { (billions(cell.loads.iter().map(|load| load.scene_bytes).sum())) }
                        td { (billions(cell.loads.iter().map(|load| load.frame_bytes).sum())) }
                    }
                }
            }
        } }
    }
}

fn phones(predictions: &Predictions) -> Markup {
    html! {
        div class="wide" { table {
            thead { tr {
                @for head in ["graphics device", "phone", "billion operations/s", "GB/s", "sources"] { th { (head) } }
            } }
            tbody {
                @for phone in &predictions.phones {
                    tr {
                        th { (phone.gpu) }
                        td { (phone.model) }
                        td { (format!("{:.0}", phone.gflops.value)) }
                        td { (format!("{:.1}", phone.gigabytes.value)) }
                        td class="source" { (phone.gflops.source) "; " (phone.gigabytes.source) }
                    }
                }
            }
        } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::phones::tests::predictions;

    #[test]
    fn the_section_says_that_it_predicts_and_what_it_rests_on() {
        let page = section(&Ok(predictions())).into_string();
        let predictions = predictions();
        assert!(page.contains("This is a prediction, not a measurement"), "{page}");
        for row in &predictions.rows {
            assert!(page.contains(&format!("<td>{}</td>", time(row))), "{row:?}");
        }
        for phone in &predictions.phones {
            assert!(
                page.contains(&phone.gflops.source) && page.contains(&phone.gigabytes.source),
                "{}",
                phone.gpu
            );
        }
        for published in PUBLISHED {
            assert!(page.contains(published.source), "{}", published.what);
        }
        assert_eq!(page.matches(" %</td></tr>").count(), predictions.checks.len(), "an error for each check");
        assert!(page.contains("widened by 2.00"), "by the worst of them");
    }

    #[test]
    fn without_a_calibration_there_is_no_number() {
        let page = section(&Err("no frame has times of traced lists".to_owned())).into_string();
        assert!(page.contains("Not calibrated: no frame has times of traced lists"), "{page}");
        assert!(!page.contains("<td>") && !page.contains(" ms"), "{page}");
    }

    #[test]
    fn times_have_their_range_and_unit() {
        let mut row = predictions().rows.remove(0);
        (row.predicted_low_ms, row.predicted_mid_ms, row.predicted_high_ms, row.predicted_mid_fps) =
            (51.4, 117.6, 310.2, 8.503);
        assert_eq!(time(&row), "118 ms (51 to 310), 8.5 fps");
    }
}
