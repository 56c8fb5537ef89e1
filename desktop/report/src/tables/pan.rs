//! A panning camera: methods that reuse the previous frame against those that do not.

use glimpse::{Method, Settings};

use crate::job::Job;
use crate::rung::{Family, Rung};
use crate::scene::SceneReport;
use crate::table::{Content, Plot, Request, Rows, Table, measured, settings};

/// Angle in degrees by which the camera pans to the right per frame.
const DEGREES: f64 = 0.25;

/// Shares of pixels traced anew in each frame.
const SHARES: [f32; 4] = [0.05, 0.1, 0.25, 0.5];

const FRAMELESS: Family = Family::contender("L", "frameless", "#e69f00");
const REPROJECTED: Family = Family::contender("P", "reproject", "#d55e00");

/// Methods that reuse the previous frame against those that do not, while the camera pans.
pub struct Pan;

impl Table for Pan {
    fn name(&self) -> &'static str {
        "pan"
    }

    fn summary(&self) -> &'static str {
        "A camera that turns: frameless rendering and reprojection"
    }

    fn jobs(&self, request: &Request<'_>) -> Vec<Job> {
        vec![Job {
            turn_per_frame: DEGREES,
            against: "full, after a turn",
            ..Job::new(self.name(), request.size, rungs(request.base, request.size))
        }]
    }

    fn content(&self, scenes: &[SceneReport]) -> Content {
        let rows = measured(scenes, self.name()).flat_map(|(scene, measured)| {
            let full = measured.records[0].time().median;
            settings(measured).skip(1).map(move |(rung, record)| {
                let ssim = record.error.as_ref().map_or(f64::NAN, |error| error.ssim);
                vec![
                    scene.sized(measured.job.shown),
                    rung.label(),
                    format!("{:.1}", record.time().median),
                    format!("{:.2}", record.time().median / full),
                    format!("{:.3}", record.rt_ratio),
                    format!("{:.2}", record.psnr_db().unwrap_or(f64::NAN)),
                    format!("{ssim:.3}"),
                ]
            })
        });
        Content::Rows(Rows {
            title: "Frames that keep something",
            note: format!(
                "The camera turns by {DEGREES} degrees a frame, until no pixel is left of what was there before it turned. \
                 Then the frame is compared with full ray tracing of the same view; times are those of the frames that \
                 follow on the turn. The number is the share of the pixels that are traced anew whatever they show; the RT \
                 ratio is that of all that are. The lecture prints no figures for this."
            ),
            head: vec!["scene", "setting", "ms", "ms / full", "RT ratio", "PSNR dB", "SSIM"],
            measured: rows.collect(),
            published: Vec::new(),
            citation: "",
        })
    }

    fn plot(&self) -> Option<Plot> {
        Some(Plot { file: "pan" })
    }
}

/// Full ray tracing and the adaptive method; then the methods that reuse the previous frame, by refresh
/// fraction.
fn rungs(base: &Settings, size: [u32; 2]) -> Vec<Rung> {
    let rung = |name, family, settings| Rung::beside_full(name, family, settings, size);
    let of = |method| Settings { method, ..*base };
    let mut rungs = vec![
        rung("full".to_owned(), Family::FIXED, of(Method::Full)),
        rung("adaptive".to_owned(), Family::TOLERANCES, of(Method::Adaptive)),
    ];
    for (method, family) in [(Method::Frameless, FRAMELESS), (Method::Reproject, REPROJECTED)] {
        let settings = SHARES.map(|share| Settings { refresh_fraction: share, ..of(method) });
        rungs.extend(settings.map(|settings| {
            rung(format!("{} {}", family.name, settings.refresh_fraction), family, settings)
        }));
    }
    rungs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rung_is_valid_and_the_first_is_what_others_are_compared_with() {
        let base = Settings { depth: 7, ..Settings::default() };
        let rungs = rungs(&base, [32, 24]);
        assert_eq!(rungs.len(), 2 + 2 * SHARES.len());
        assert!(rungs.iter().all(|rung| rung.settings.validate().is_ok() && rung.settings.depth == 7));
        assert!(rungs.iter().all(|rung| rung.keeps_picture == (rung.settings.method == Method::Full)));
        // Number of frames in which every pixel is traced anew.
        let frames: Vec<_> = rungs.iter().map(Rung::frames).collect();
        assert_eq!(frames, [1, 1, 20, 10, 4, 2, 20, 10, 4, 2]);
    }
}
