//! The settings whose error is plotted against their time.

use glimpse::{MAX_SAMPLING, Method, Postcorrect, Preset, Settings, Tolerances};

/// One setting to measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Rung {
    /// Its label.
    pub name: String,
    /// What it belongs to.
    pub family: Family,
    /// How it is rendered.
    pub settings: Settings,
    /// At this size; what is smaller than the frame is upscaled before it is judged.
    pub rendered: [u32; 2],
    /// Its picture is kept: the page shows it, or others are measured against it.
    pub keeps_picture: bool,
}

impl Rung {
    /// Of the whole frame, where others are compared with full ray tracing: its picture is kept for that.
    pub fn beside_full(name: String, family: Family, settings: Settings, size: [u32; 2]) -> Self {
        let keeps_picture = family == Family::Fixed;
        Self { name, family, settings, rendered: size, keeps_picture }
    }
}

/// What is varied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Full ray tracing of a smaller frame.
    Reduced,
    /// A ray through every second pixel.
    Checkerboard,
    /// Full ray tracing with several samples a pixel.
    Fixed,
    /// The tolerances of the adaptive method.
    Tolerances,
    /// Its base block.
    Blocks,
    /// Its base block, without postcorrection.
    Uncorrected,
    /// Its samples a pixel.
    Grids,
    /// The thresholds of extra samples.
    Supersample,
    /// Those of extra samples after the adaptive method.
    Combined,
    /// How much the ends of a quincunx may differ.
    Quincunx,
    /// Paths for two eyes and nothing else.
    Plain,
    /// Which stop away from the gaze.
    Stopped,
    /// Whose samples count for the other eye.
    Crossed,
    /// Whose picture is filtered.
    Filtered,
    /// The last two of these three.
    Unstopped,
    /// The first and the last.
    Uncrossed,
    /// The first two.
    Unfiltered,
    /// All of that.
    Together,
    /// All of that in the way of Kim & Sung 2021.
    Published,
    /// Pixels are traced anew in turn.
    Frameless,
    /// The frame before is moved.
    Reprojected,
}

impl Family {
    /// In the order of the legend.
    pub const ALL: [Self; 21] = [
        Self::Reduced,
        Self::Checkerboard,
        Self::Fixed,
        Self::Tolerances,
        Self::Blocks,
        Self::Uncorrected,
        Self::Grids,
        Self::Supersample,
        Self::Combined,
        Self::Quincunx,
        Self::Plain,
        Self::Stopped,
        Self::Crossed,
        Self::Filtered,
        Self::Unstopped,
        Self::Uncrossed,
        Self::Unfiltered,
        Self::Together,
        Self::Published,
        Self::Frameless,
        Self::Reprojected,
    ];

    /// Its name in the legend.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reduced => "full, reduced resolution",
            Self::Checkerboard => "checkerboard",
            Self::Fixed => "full, fixed samples",
            Self::Tolerances => "adaptive, tolerances",
            Self::Blocks => "adaptive, larger blocks",
            Self::Uncorrected => "adaptive, no postcorrection",
            Self::Grids => "adaptive, sampling grids",
            Self::Supersample => "supersample, thresholds",
            Self::Combined => "adaptive, extra samples",
            Self::Quincunx => "quincunx",
            Self::Plain => "plain",
            Self::Stopped => "stopped",
            Self::Crossed => "crossing",
            Self::Filtered => "filtered",
            Self::Unstopped => "without stopping",
            Self::Uncrossed => "without crossing",
            Self::Unfiltered => "without filter",
            Self::Together => "together",
            Self::Published => "as in the paper",
            Self::Frameless => "frameless",
            Self::Reprojected => "reproject",
        }
    }

    /// Something to beat.
    pub fn is_baseline(self) -> bool {
        matches!(self, Self::Reduced | Self::Checkerboard | Self::Fixed | Self::Plain)
    }
}

/// The shares of the frame's side that are rendered: 1/8, 1/4 and 1/2 of the pixels.
const REDUCED: [f64; 3] = [0.35, 0.5, 0.71];

/// The tolerances, over Kim 2016's.
const FACTORS: [f32; 5] = [4.0, 2.0, 1.0, 0.5, 0.25];

/// Where extra samples go, few to many.
const PRESETS: [Preset; 3] = [Preset::Edges, Preset::Balanced, Preset::Textures];

/// How much the ends of a quincunx may differ, few samples to many.
const SIMILAR: [f32; 3] = [0.2, 0.1, 0.05];

/// The frame that errors are measured against: 256 samples a pixel.
pub fn converged(base: &Settings) -> Settings {
    Settings { method: Method::Full, sampling: MAX_SAMPLING, ..*base }
}

/// Full ray tracing with 1, 4, 9 and 16 samples a pixel.
pub fn fixed(base: &Settings) -> [(String, Family, Settings); 4] {
    [1, 2, 3, 4].map(|sampling| {
        let settings = Settings { method: Method::Full, sampling, ..*base };
        (format!("fixed {}", sampling * sampling), Family::Fixed, settings)
    })
}

/// Extra samples by preset: alone, and after that adaptive frame.
pub fn extra_samples(adaptive: &Settings) -> Vec<(String, Family, Settings)> {
    let of = |preset: Preset| {
        let settings = Settings { thresholds: preset.thresholds(), ..*adaptive };
        let alone = Settings { method: Method::Supersample, ..settings };
        let combined = Settings { supersample: true, ..settings };
        [
            (format!("supersample {}", preset.name()), Family::Supersample, alone),
            (format!("combined {}", preset.name()), Family::Combined, combined),
        ]
    };
    PRESETS.into_iter().flat_map(of).collect()
}

/// The ladder of a frame of that size. Of `base`, recursion and features count.
pub fn rungs(base: &Settings, size: [u32; 2]) -> Vec<Rung> {
    let full = Settings { method: Method::Full, ..*base };
    let adaptive = Settings { method: Method::Adaptive, postcorrect: Postcorrect::On, ..*base };
    let rung = |name: String, family, settings| Rung {
        keeps_picture: false,
        name,
        family,
        settings,
        rendered: size,
    };
    let mut rungs = Vec::new();
    for share in REDUCED {
        let rendered = size.map(|side| ((f64::from(side) * share).round() as u32).max(1));
        rungs.push(Rung { rendered, ..rung(format!("full {share}x"), Family::Reduced, full) });
    }
    let checkerboard = Settings { method: Method::Checkerboard, ..*base };
    rungs.push(rung("checkerboard".to_owned(), Family::Checkerboard, checkerboard));
    rungs.extend(fixed(base).map(|(name, family, settings)| rung(name, family, settings)));
    for factor in FACTORS {
        let name = if factor == 1.0 { "adaptive".to_owned() } else { format!("tolerance x{factor}") };
        let tolerances = scaled(base.tolerances, factor);
        rungs.push(rung(name, Family::Tolerances, Settings { tolerances, ..adaptive }));
    }
    for block in [4, 8] {
        rungs.push(rung(format!("block {block}"), Family::Blocks, Settings { block, ..adaptive }));
    }
    for block in [2, 4, 8] {
        let settings = Settings { block, postcorrect: Postcorrect::Off, ..adaptive };
        rungs.push(rung(format!("block {block}, off"), Family::Uncorrected, settings));
    }
    for (sampling, block) in [(2, 2), (2, 4), (4, 2), (4, 4)] {
        let blocks = if block == 2 { String::new() } else { format!(", block {block}") };
        let name = format!("grid {sampling}x{sampling}{blocks}");
        rungs.push(rung(name, Family::Grids, Settings { sampling, block, ..adaptive }));
    }
    rungs.extend(
        extra_samples(&adaptive).into_iter().map(|(name, family, settings)| rung(name, family, settings)),
    );
    let sparse = Settings { supersample: true, block: 4, ..adaptive };
    rungs.push(rung("combined, block 4".to_owned(), Family::Combined, sparse));
    for similar in SIMILAR {
        let settings = Settings { method: Method::Quincunx, similar, ..*base };
        rungs.push(rung(format!("quincunx {similar}"), Family::Quincunx, settings));
    }
    for rung in &mut rungs {
        rung.keeps_picture = ["full 0.5x", "fixed 1", "adaptive", "block 4"].contains(&rung.name.as_str());
    }
    rungs
}

/// A factor above 1 passes more pairs of pixels: distances may be greater, the cosine smaller, the texture's border zone
/// narrower.
fn scaled(t: Tolerances, factor: f32) -> Tolerances {
    Tolerances {
        pos: t.pos * factor,
        norm: (1.0 - (1.0 - t.norm) * factor).max(-1.0),
        tex: (t.tex / factor).min(0.5),
        gcol: t.gcol * factor,
    }
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
        let reduced: Vec<_> = rungs.iter().map(|r| r.rendered).filter(|r| *r != [960, 540]).collect();
        assert_eq!(reduced, [[336, 189], [480, 270], [682, 383]]);
        assert_eq!(rungs.iter().filter(|r| r.keeps_picture).count(), 4);
        for family in Family::ALL.into_iter().take_while(|family| *family != Family::Plain) {
            let of = || rungs.iter().filter(|r| r.family == family);
            assert!(of().count() > usize::from(family != Family::Checkerboard));
            let fixed = |r: &Rung| matches!(r.settings.method, Method::Full | Method::Checkerboard);
            assert!(of().all(|r| fixed(r) == family.is_baseline()));
            assert!(of().all(|r| r.settings.supersample == (family == Family::Combined)));
        }
    }

    #[test]
    fn the_smallest_frame_has_a_pixel_at_every_scale() {
        assert!(rungs(&Settings::default(), [1, 1]).iter().all(|r| r.rendered == [1, 1]));
    }

    #[test]
    fn a_looser_tolerance_passes_more() {
        let t = Tolerances { pos: 0.03, norm: 0.9, tex: 0.3, gcol: 0.15 };
        let (loose, strict) = (scaled(t, 2.0), scaled(t, 0.5));
        assert_eq!((loose.pos, loose.tex, loose.gcol), (0.06, 0.15, 0.3));
        assert!((loose.norm - 0.8).abs() < 1e-6 && (strict.norm - 0.95).abs() < 1e-6);
        assert_eq!((strict.pos, strict.tex, strict.gcol), (0.015, 0.5, 0.075));
        assert_eq!(scaled(t, 1e9).norm, -1.0);
    }

    #[test]
    fn the_reference_has_256_samples() {
        let settings = converged(&Settings { depth: 7, ..Settings::default() });
        assert_eq!((settings.method, settings.sampling.pow(2), settings.depth), (Method::Full, 256, 7));
    }
}
