//! The ladder: the settings whose error is plotted against their cost, and the plot.

use glimpse::{MAX_SAMPLING, Method, Postcorrect, Preset, Settings};

use crate::job::{Job, Reference};
use crate::plot::{Mark, draw};
use crate::rung::{Family, Rung};
use crate::scene::SceneReport;

const REDUCED: Family = Family::baseline("R", "full, reduced resolution", "#999999");
const GRIDS: Family = Family::contender("G", "adaptive, sampling grids", "#cc79a7");

/// Scale factors of width and height: about 1/8, 1/4 and 1/2 of the pixels.
const REDUCED_SIDES: [f64; 3] = [0.35, 0.5, 0.71];

/// Factors on the tolerances of Kim 2016.
const FACTORS: [f32; 5] = [4.0, 2.0, 1.0, 0.5, 0.25];

/// Name of the setting that is timed in every round: full ray tracing with one sample per pixel.
const CONTROL: &str = "fixed 1";

/// Presets of supersampling thresholds, from few extra samples to many.
const PRESETS: [Preset; 3] = [Preset::Edges, Preset::Balanced, Preset::Textures];

/// Quincunx thresholds, from few extra samples to many.
const SIMILAR: [f32; 3] = [0.2, 0.1, 0.05];

/// Settings of the reference frame: full ray tracing with 256 samples per pixel.
pub fn converged(base: &Settings) -> Settings {
    Settings { method: Method::Full, sampling: MAX_SAMPLING, ..*base }
}

/// Full ray tracing with 1, 4, 9 and 16 samples per pixel.
pub fn fixed(base: &Settings) -> [(String, Family, Settings); 4] {
    [1, 2, 3, 4].map(|sampling| {
        let settings = Settings { method: Method::Full, sampling, ..*base };
        (format!("fixed {}", sampling * sampling), Family::FIXED, settings)
    })
}

/// Supersampling (Jin 2009) with each preset, alone and combined with the adaptive method.
pub fn extra_samples(adaptive: &Settings) -> Vec<(String, Family, Settings)> {
    let of = |preset: Preset| {
        let settings = Settings { thresholds: preset.thresholds(), ..*adaptive };
        let alone = Settings { method: Method::Supersample, ..settings };
        let combined = Settings { supersample: true, ..settings };
        [
            (format!("supersample {}", preset.name()), Family::SUPERSAMPLE, alone),
            (format!("combined {}", preset.name()), Family::COMBINED, combined),
        ]
    };
    PRESETS.into_iter().flat_map(of).collect()
}

/// The ladder of a frame of `size` pixels, compared with the converged frame. `base` gives recursion and
/// features.
pub fn job(base: &Settings, size: [u32; 2]) -> Job {
    let rungs = rungs(base, size);
    Job {
        tables: Vec::new(),
        control: rungs.iter().position(|rung| rung.name == CONTROL),
        reference: Reference::Converged { settings: converged(base), beside_first: false },
        against: "converged",
        ..Job::new("", size, rungs)
    }
}

/// Settings of the ladder, in the order of the page's table.
pub fn rungs(base: &Settings, size: [u32; 2]) -> Vec<Rung> {
    let full = Settings { method: Method::Full, ..*base };
    let adaptive = Settings { method: Method::Adaptive, postcorrect: Postcorrect::On, ..*base };
    let rung = |name: String, family, settings| Rung::beside_converged(name, family, settings, size);
    let mut rungs = Vec::new();
    for share in REDUCED_SIDES {
        let rendered = size.map(|side| ((f64::from(side) * share).round() as u32).max(1));
        rungs.push(Rung { rendered, ..rung(format!("full {share}x"), REDUCED, full) });
    }
    let checkerboard = Settings { method: Method::Checkerboard, ..*base };
    rungs.push(rung("checkerboard".to_owned(), Family::CHECKERBOARD, checkerboard));
    rungs.extend(fixed(base).map(|(name, family, settings)| rung(name, family, settings)));
    for factor in FACTORS {
        let name = if factor == 1.0 { "adaptive".to_owned() } else { format!("tolerance x{factor}") };
        let tolerances = base.tolerances.relaxed(factor);
        rungs.push(rung(name, Family::TOLERANCES, Settings { tolerances, ..adaptive }));
    }
    for block in [4, 8] {
        rungs.push(rung(format!("block {block}"), Family::BLOCKS, Settings { block, ..adaptive }));
    }
    for block in [2, 4, 8] {
        let settings = Settings { block, postcorrect: Postcorrect::Off, ..adaptive };
        rungs.push(rung(format!("block {block}, off"), Family::UNCORRECTED, settings));
    }
    for (sampling, block) in [(2, 2), (2, 4), (4, 2), (4, 4)] {
        let blocks = if block == 2 { String::new() } else { format!(", block {block}") };
        let name = format!("grid {sampling}x{sampling}{blocks}");
        rungs.push(rung(name, GRIDS, Settings { sampling, block, ..adaptive }));
    }
    rungs.extend(
        extra_samples(&adaptive).into_iter().map(|(name, family, settings)| rung(name, family, settings)),
    );
    let sparse = Settings { supersample: true, block: 4, ..adaptive };
    rungs.push(rung("combined, block 4".to_owned(), Family::COMBINED, sparse));
    for quincunx_threshold in SIMILAR {
        let settings = Settings { method: Method::Quincunx, quincunx_threshold, ..*base };
        rungs.push(rung(format!("quincunx {quincunx_threshold}"), Family::QUINCUNX, settings));
    }
    for rung in &mut rungs {
        rung.keeps_picture = ["full 0.5x", CONTROL, "adaptive", "block 4"].contains(&rung.name.as_str());
    }
    rungs
}

/// Horizontal axis of the plots of PSNR.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Median frame time in milliseconds.
    Time,
    /// Rays of all kinds per pixel.
    Rays,
}

impl Axis {
    /// Both axes, in the order of the page.
    pub const ALL: [Self; 2] = [Self::Time, Self::Rays];

    /// File name of the plot for a scene's file stem.
    pub fn file(self, stem: &str) -> String {
        let what = match self {
            Self::Time => "time",
            Self::Rays => "rays",
        };
        format!("{stem}-{what}.svg")
    }

    /// Title of the axis.
    pub fn title(self) -> &'static str {
        match self {
            Self::Time => "median frame time in ms",
            Self::Rays => "rays a pixel (all kinds)",
        }
    }
}

/// Draws the plot of a scene's ladder as SVG.
pub fn svg(scene: &SceneReport, axis: Axis) -> String {
    let measured = scene.measured.iter().flat_map(|m| m.job.rungs.iter().zip(&m.records));
    let marks: Vec<Mark> = scene
        .rows
        .iter()
        .zip(measured)
        .filter(|(row, _)| row.part == "ladder")
        .map(|(row, (rung, record))| {
            let (point, interval, front) = match axis {
                Axis::Time => (row.time_point(), record.interval_ms(), row.front_time),
                // Counts of rays are exact.
                Axis::Rays => (row.rays_point(), None, row.front_rays),
            };
            Mark { label: row.code.clone(), family: rung.family, point, interval, front }
        })
        .collect();
    draw(&scene.stem, axis.title(), &marks)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rung_is_valid_and_has_its_own_name_and_settings() {
        let rungs = rungs(&Settings::default(), [960, 540]);
        assert_eq!(rungs.len(), 32);
        for (i, a) in rungs.iter().enumerate() {
            a.settings.validate().unwrap();
            for b in &rungs[..i] {
                assert_ne!(a.name, b.name);
                assert!((a.settings, a.rendered) != (b.settings, b.rendered), "{} and {}", a.name, b.name);
            }
        }
        let control = job(&Settings::default(), [960, 540]).control.unwrap();
        assert_eq!(rungs[control].settings, Settings { method: Method::Full, ..Settings::default() });
        let reduced: Vec<_> = rungs.iter().map(|r| r.rendered).filter(|r| *r != [960, 540]).collect();
        assert_eq!(reduced, [[336, 189], [480, 270], [682, 383]]);
        assert_eq!(rungs.iter().filter(|r| r.keeps_picture).count(), 4);
        for family in [
            REDUCED,
            Family::CHECKERBOARD,
            Family::FIXED,
            Family::TOLERANCES,
            Family::BLOCKS,
            Family::UNCORRECTED,
            GRIDS,
            Family::SUPERSAMPLE,
            Family::COMBINED,
            Family::QUINCUNX,
        ] {
            let of = || rungs.iter().filter(|r| r.family == family);
            assert!(of().count() > usize::from(family != Family::CHECKERBOARD));
            let fixed = |r: &Rung| matches!(r.settings.method, Method::Full | Method::Checkerboard);
            assert!(of().all(|r| fixed(r) == family.is_baseline));
            assert!(of().all(|r| r.settings.supersample == (family == Family::COMBINED)));
        }
    }

    #[test]
    fn the_smallest_frame_has_a_pixel_at_every_scale() {
        assert!(rungs(&Settings::default(), [1, 1]).iter().all(|r| r.rendered == [1, 1]));
    }

    #[test]
    fn the_reference_has_256_samples() {
        let settings = converged(&Settings { depth: 7, ..Settings::default() });
        assert_eq!((settings.method, settings.sampling.pow(2), settings.depth), (Method::Full, 256, 7));
    }
}
