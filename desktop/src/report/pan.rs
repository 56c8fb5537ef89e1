//! A camera that turns: methods that keep something of the frame before, beside those that do not.

use glimpse::{Camera, Method, Settings};

use super::SceneReport;
use super::ladder::{Family, Rung};
use super::tables::{self, Table};
use crate::args::TableName;

/// To the right, from one frame to the next.
const DEGREES: f64 = 0.25;

/// Of the pixels that are traced anew.
const SHARES: [f32; 4] = [0.05, 0.1, 0.25, 0.5];

/// Full ray tracing, and the adaptive method; then those that keep something, by their share.
pub fn rungs(base: &Settings, size: [u32; 2]) -> Vec<Rung> {
    let rung = |name, family, settings| Rung::beside_full(name, family, settings, size);
    let of = |method| Settings { method, ..*base };
    let mut rungs = vec![
        rung("full".to_owned(), Family::Fixed, of(Method::Full)),
        rung("adaptive".to_owned(), Family::Tolerances, of(Method::Adaptive)),
    ];
    for (method, family) in [(Method::Frameless, Family::Frameless), (Method::Reproject, Family::Reprojected)]
    {
        let settings = SHARES.map(|share| Settings { share, ..of(method) });
        rungs.extend(
            settings.map(|settings| rung(format!("{} {}", family.name(), settings.share), family, settings)),
        );
    }
    rungs
}

/// The view of a frame; frame 0 has the camera as it is.
pub fn view(camera: &Camera, frame: i32) -> Camera {
    if frame == 0 { *camera } else { camera.panned(f64::from(frame) * DEGREES) }
}

/// A row for every setting but full ray tracing.
pub fn table(scenes: &[SceneReport]) -> Table {
    let ours = tables::of(scenes, TableName::Pan).flat_map(|(scene, measured)| {
        let [width, height] = measured.job.shown;
        let full = measured.records[0].time().median;
        let others = measured.job.rungs.iter().zip(&measured.records).skip(1);
        others.map(move |(rung, record)| {
            let ssim = record.error.as_ref().map_or(f64::NAN, |error| error.ssim);
            vec![
                format!("{}, {width}x{height}", scene.prepared.name),
                rung.name.clone(),
                format!("{:.1}", record.time().median),
                format!("{:.2}", record.time().median / full),
                format!("{:.3}", record.rt_ratio),
                format!("{:.2}", record.psnr_db().unwrap_or(f64::NAN)),
                format!("{ssim:.3}"),
            ]
        })
    });
    Table {
        title: "Frames that keep something".to_owned(),
        note: format!(
            "The camera turns by {DEGREES} degrees a frame, until no pixel is left of what was there before it turned. Then \
             the frame is compared with full ray tracing of the same view; times are those of the frames that follow on the \
             turn. The number is the share of the pixels that are traced anew whatever they show; the RT ratio is that of \
             all that are. The lecture prints no figures for this."
        ),
        head: vec!["scene", "setting", "ms", "ms / full", "RT ratio", "PSNR dB", "SSIM"],
        ours: ours.collect(),
        paper: Vec::new(),
        citation: "",
    }
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
        // In so many frames every pixel is traced anew.
        let frames: Vec<_> = rungs.iter().map(Rung::frames).collect();
        assert_eq!(frames, [1, 1, 20, 10, 4, 2, 20, 10, 4, 2]);
    }

    #[test]
    fn the_turn_ends_at_the_camera() {
        let camera = *glimpse::scene::builtin("room").unwrap().camera(None).unwrap();
        assert_eq!(view(&camera, 0), camera);
        let [before, after] = [-1, 1].map(|frame| view(&camera, frame).forward.normalize());
        let angle = before.angle_between(after).to_degrees();
        assert!((f64::from(angle) - 2.0 * DEGREES).abs() < 1e-2, "{angle}");
    }
}
