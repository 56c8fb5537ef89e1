//! Path tracing for two eyes, plain and with the techniques of Kim & Sung 2021, alone and combined: error
//! against time.

use glimpse::{
    Denoise, DirectLight, Foveation, LightSelection, Method, Paths, Roulette, Settings, StereoReuse,
};

use crate::job::{Job, Reference};
use crate::record::Record;
use crate::rung::{Family, Rung};
use crate::scene::SceneReport;
use crate::subject::Prepared;
use crate::table::{Content, Plot, Request, Rows, Table, measured, settings};

/// Citation of the paper.
const CITATION: &str = "Kim, Sung, \"Efficient Path Tracer for the Presence of Mobile Virtual Reality\", Human-centric \
                        Computing and Information Sciences 11, 2021 (Galaxy S10+)";

/// Size of one eye's picture in pixels, as in the paper.
const EYE: [u32; 2] = [640, 480];

/// Size of both eyes' pictures side by side, in pixels.
const SIZE: [u32; 2] = [2 * EYE[0], EYE[1]];

/// Samples per pixel that are measured.
const SAMPLES: [u32; 3] = [1, 4, 16];

/// Samples per pixel of the reference picture.
const CONVERGED: u32 = 256;

/// Samples per pixel of the paper's own reference.
const REFERENCE_SAMPLES: u32 = 100;

/// Path tracing for two eyes, plain and with the paper's techniques.
pub struct TwoEyes;

impl Table for TwoEyes {
    fn name(&self) -> &'static str {
        "vr"
    }

    fn summary(&self) -> &'static str {
        "Paths for two eyes, 640x480 each (Kim & Sung 2021, Tables 2 and 3)"
    }

    fn jobs(&self, request: &Request<'_>) -> Vec<Job> {
        let settings = converged(request.base, request.scene);
        vec![Job {
            reference: Reference::Converged { settings, beside_first: true },
            against: "converged paths",
            ..Job::new(self.name(), SIZE, rungs(request.base, request.scene))
        }]
    }

    fn content(&self, scenes: &[SceneReport]) -> Content {
        let rows = measured(scenes, self.name()).flat_map(|(scene, measured)| {
            let plain = measured.records.get(1);
            settings(measured).map(move |(rung, record)| {
                let cells = [Some(record), plain].map(|record| record.map_or([f64::NAN; 5], numbers));
                row(&scene.prepared.name, &rung.label(), cells)
            })
        });
        Content::Rows(Rows {
            title: "Kim & Sung 2021, Tables 2 and 3: paths for two eyes",
            note: format!(
                "640x480 an eye. Errors against {CONVERGED} samples of other random numbers and of less noise (multiple importance \
                 sampling), and against {REFERENCE_SAMPLES} as in the \
                 paper (the first setting, whose own noise is in them). Plain: next-event estimation with \
                 two points on emitters at every diffuse surface, up to six vertices, no roulette. Stopped: away from the gaze, \
                 which is in the middle, survivors count for more. Crossing: samples of one eye count for the other, weighted. \
                 Filtered: edge-avoiding a-trous wavelets. All three together, and without one. These have no error in the limit of many samples. As in the paper: \
                 stopped paths are missing, samples are copied to the other eye, 3x3 medians. The number is that of samples a \
                 pixel; times are of pictures with all of them, and what follows them is over plain 1."
            ),
            head: [&["scene", "setting"][..], NUMBERS.as_flattened()].concat(),
            measured: rows.collect(),
            published: published(),
            citation: CITATION,
        })
    }

    fn plot(&self) -> Option<Plot> {
        Some(Plot { file: "paths" })
    }
}

fn published() -> Vec<Vec<String>> {
    let rows = PUBLISHED.iter().flat_map(|line| {
        let [plain, paper] = [0, 1].map(|i| [line.ms[i], f64::NAN, f64::NAN, line.mse[i], line.ssim[i]]);
        [row(line.scene, "plain 1", [plain, plain]), row(line.scene, "as in the paper 1", [paper, plain])]
    });
    rows.collect()
}

/// Plain path tracing as in the authors' program: up to six vertices, both triangles of the light sampled at
/// each.
fn plain(base: &Settings, scene: &Prepared) -> Settings {
    let emits = !scene.statistics.left_out.contains(&"emission");
    let paths = Paths {
        direct_light: DirectLight::Nee,
        light_samples: 2,
        // The lights of their scenes are emitters; the files repeat them as point lights.
        lights: if emits { LightSelection::Emitters } else { LightSelection::All },
        roulette: Roulette::Off,
        stereo_reuse: StereoReuse::Off,
        ..Paths::default()
    };
    Settings { method: Method::Vr, depth: 6, paths, ..*base }
}

/// Settings of the reference, with independent random numbers. It uses multiple importance sampling: sampling
/// emitters alone has infinite variance where a surface is as near to an emitter as the ceiling is to its
/// lamp.
fn converged(base: &Settings, scene: &Prepared) -> Settings {
    let plain = plain(base, scene);
    let paths = Paths {
        samples: CONVERGED,
        stereo_reuse: StereoReuse::Weighted,
        direct_light: DirectLight::Mis,
        ..plain.paths
    };
    Settings { seed: base.seed.wrapping_add(1), paths, ..plain }
}

/// The three techniques added to plain path tracing.
type Parts = (Foveation, StereoReuse, Denoise);

/// Unbiased variants of the techniques; [`PAPERS`] has those of the paper, and [`NONE`] none.
const OURS: Parts = (Foveation::Compensated, StereoReuse::Weighted, Denoise::Atrous);
const PAPERS: Parts = (Foveation::Paper, StereoReuse::Paper, Denoise::Median);
const NONE: Parts = (Foveation::Off, StereoReuse::Off, Denoise::Off);

const PLAIN: Family = Family::baseline("VN", "plain", "#333333");
const STOPPED: Family = Family::contender("VS", "stopped", "#e69f00");
const CROSSED: Family = Family::contender("VC", "crossing", "#0072b2");
const FILTERED: Family = Family::contender("VF", "filtered", "#009e73");
const UNSTOPPED: Family = Family::contender("VCF", "without stopping", "#a6761d");
const UNCROSSED: Family = Family::contender("VSF", "without crossing", "#56b4e9");
const UNFILTERED: Family = Family::contender("VSC", "without filter", "#882255");
const TOGETHER: Family = Family::contender("VA", "together", "#d55e00");
const AS_PUBLISHED: Family = Family::contender("VP", "as in the paper", "#cc79a7");

/// No technique, each alone, all but each, all together, and as in the paper.
const PARTS: [(Family, Parts); 9] = [
    (PLAIN, NONE),
    (STOPPED, (OURS.0, NONE.1, NONE.2)),
    (CROSSED, (NONE.0, OURS.1, NONE.2)),
    (FILTERED, (NONE.0, NONE.1, OURS.2)),
    (UNSTOPPED, (NONE.0, OURS.1, OURS.2)),
    (UNCROSSED, (OURS.0, NONE.1, OURS.2)),
    (UNFILTERED, (OURS.0, OURS.1, NONE.2)),
    (TOGETHER, OURS),
    (AS_PUBLISHED, PAPERS),
];

/// The paper's reference, then all of [`PARTS`] with increasing numbers of samples.
fn rungs(base: &Settings, scene: &Prepared) -> Vec<Rung> {
    let plain = plain(base, scene);
    let parts = PARTS.map(|(family, (foveation, stereo_reuse, denoise))| {
        (family, Settings { paths: Paths { foveation, stereo_reuse, denoise, ..plain.paths }, ..plain })
    });
    let rung = |(family, settings): (Family, Settings), samples, keeps_picture| {
        let settings = Settings { paths: Paths { samples, ..settings.paths }, ..settings };
        let name = format!("{} {samples}", family.name);
        Rung { keeps_picture, ..Rung::beside_converged(name, family, settings, SIZE) }
    };
    let measured = SAMPLES.into_iter().flat_map(|samples| parts.map(|part| rung(part, samples, false)));
    // Independent random numbers, as all other pictures are compared with it.
    let published = (PLAIN, Settings { seed: base.seed.wrapping_add(2), ..plain });
    std::iter::once(rung(published, REFERENCE_SAMPLES, true)).chain(measured).collect()
}

/// Headings of each number and of its ratio to that of plain path tracing with 1 sample.
const NUMBERS: [[&str; 2]; 5] = [
    ["ms", "ms / plain 1"],
    ["MSE", "MSE / plain 1"],
    ["SSIM", "SSIM / plain 1"],
    ["MSE of 100", "MSE of 100 / plain 1"],
    ["SSIM of 100", "SSIM of 100 / plain 1"],
];

/// Median milliseconds; then MSE (levels of 0 to 255) and SSIM against each of the two references.
fn numbers(record: &Record) -> [f64; 5] {
    let [[mse, ssim], [mse_of_first, ssim_of_first]] = [record.error, record.error_of_first]
        .map(|error| error.map_or([f64::NAN; 2], |error| [error.rmse * error.rmse, error.ssim]));
    [record.time().median, mse, ssim, mse_of_first, ssim_of_first]
}

/// Makes a row; unknown numbers (NaN) give empty cells.
fn row(scene: &str, setting: &str, [own, plain]: [[f64; 5]; 2]) -> Vec<String> {
    let text = |number: f64, digits| {
        if number.is_nan() { String::new() } else { format!("{number:.digits$}") }
    };
    let numbers = own.into_iter().zip(plain).zip([1, 1, 3, 1, 3]);
    let cells = numbers.flat_map(|((own, plain), digits)| [text(own, digits), text(own / plain, 2)]);
    [scene.to_owned(), setting.to_owned()].into_iter().chain(cells).collect()
}

/// Figures of a scene in [`PUBLISHED`]: plain path tracing, then the paper's method.
#[derive(Clone, Copy, Debug)]
struct Line {
    /// Name of the scene.
    scene: &'static str,
    /// MSE of one sample against 100, in levels of 0 to 255.
    mse: [f64; 2],
    /// SSIM of one sample against 100.
    ssim: [f64; 2],
    /// Frame time in milliseconds.
    ms: [f64; 2],
}

const fn line(scene: &'static str, mse: [f64; 2], ssim: [f64; 2], ms: [f64; 2]) -> Line {
    Line { scene, mse, ssim, ms }
}

/// As printed for 640x480 per eye.
#[rustfmt::skip]
const PUBLISHED: [Line; 5] = [
    line("Teapot", [2157.72, 1994.47], [0.13, 0.18], [236.0, 210.39]),
    line("Ant", [2141.26, 1971.1], [0.13, 0.18], [328.96, 293.73]),
    line("Bunny", [2139.19, 1999.16], [0.13, 0.18], [330.55, 274.12]),
    line("Monkey", [2269.04, 2124.44], [0.12, 0.17], [379.73, 329.07]),
    line("Knot", [2181.45, 2031.54], [0.13, 0.18], [609.95, 478.82]),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Printed for the teapot: "7.57 % decrease of MSE, 38.46 % increase of SSIM, 10.85 % less time".
    #[test]
    fn the_papers_rows_say_what_it_prints() {
        let line = PUBLISHED[0];
        assert!((1.0 - line.mse[1] / line.mse[0] - 0.0757).abs() < 1e-4);
        assert!((line.ssim[1] / line.ssim[0] - 1.3846).abs() < 1e-4);
        assert!((1.0 - line.ms[1] / line.ms[0] - 0.1085).abs() < 1e-4);
        assert_eq!(
            published()[1],
            [
                "Teapot",
                "as in the paper 1",
                "210.4",
                "0.89",
                "",
                "",
                "",
                "",
                "1994.5",
                "0.92",
                "0.180",
                "1.38"
            ]
        );
    }
}
