//! The tables: rows of text, measured here and printed in Kim 2016.

use super::SceneReport;
use super::bench::Measured;
use super::record::Record;
use super::{eyes, jin, missing, pan, paper};
use crate::args::TableName;
use crate::output::grouped;

/// A table as it is read.
pub struct Table {
    /// What it shows.
    pub title: String,
    /// How it came about.
    pub note: String,
    /// Column heads.
    pub head: Vec<&'static str>,
    /// Measured here.
    pub ours: Vec<Vec<String>>,
    /// Printed in the paper; empty where it has no such figures.
    pub paper: Vec<Vec<String>>,
    /// How the paper is cited.
    pub citation: &'static str,
}

/// Every table that something was measured for.
pub fn all(scenes: &[SceneReport]) -> Vec<Table> {
    let of_kim: [fn(&_) -> _; 6] = [resolutions, kernels, reflective, views, hairball, missing::table];
    let others: [fn(&_) -> _; 4] = [jin::table2::table, jin::figure7::table, eyes::table, pan::table];
    let tables = of_kim.into_iter().chain(others).map(|table| table(scenes));
    tables.filter(|table| !table.ours.is_empty()).collect()
}

fn resolutions(scenes: &[SceneReport]) -> Table {
    let ours = of(scenes, TableName::Resolutions).map(|(scene, measured)| {
        let [width, height] = measured.job.shown;
        let name =
            format!("{} ({})", scene.prepared.name, grouped(scene.prepared.statistics.triangles as u64));
        let cells = [name, format!("{width}x{height}"), sampling(measured)];
        cells.into_iter().chain(Pair::of(measured).cells()).collect()
    });
    let paper = paper::TABLE_5.iter().flat_map(|(scene, triangles, sizes)| {
        sizes.iter().flat_map(move |(side, pairs)| {
            pairs.iter().map(move |pair| {
                let name = format!("{scene} ({})", grouped(u64::from(*triangles)));
                let cells = [name, format!("{side}x{side}"), format!("{0}x{0}", pair.sampling)];
                cells.into_iter().chain(Pair::from(pair).cells()).collect()
            })
        })
    });
    Table {
        title: "Table 5: resolution and sampling".to_owned(),
        note: "Full ray tracing and the adaptive method (2x2 blocks, default tolerances, postcorrection by what the \
               scene holds) with the same samples; PSNR against full tracing of the same sampling. Efficiency is \
               speedup x RT ratio: 1 where every saved sample is saved time."
            .to_owned(),
        head: ["scene (triangles)", "size", "sampling"].into_iter().chain(PAIR_HEAD).collect(),
        ours: ours.collect(),
        paper: paper.collect(),
        citation: paper::CITATION,
    }
}

fn hairball(scenes: &[SceneReport]) -> Table {
    let ours = of(scenes, TableName::Hairball).map(|(scene, measured)| {
        let [width, height] = measured.job.shown;
        let cells = [format!("{}, {width}x{height}", scene.prepared.name), sampling(measured)];
        cells.into_iter().chain(Pair::of(measured).cells()).collect()
    });
    let paper = paper::TABLE_4.iter().map(|pair| {
        let cells = ["Hairball, 3840x2160".to_owned(), format!("{0}x{0}", pair.sampling)];
        cells.into_iter().chain(Pair::from(pair).cells()).collect()
    });
    Table {
        title: "Table 4: the hairball".to_owned(),
        note: "As table 5. The paper's is Laine and Karras's of 2,880,000 triangles, reflective, with three lights, on a \
               desktop GPU."
            .to_owned(),
        head: ["scene", "sampling"].into_iter().chain(PAIR_HEAD).collect(),
        ours: ours.collect(),
        paper: paper.collect(),
        citation: paper::CITATION,
    }
}

fn kernels(scenes: &[SceneReport]) -> Table {
    let ours = of(scenes, TableName::Kernels).map(|(scene, measured)| {
        let steps = by_step(&measured.records[1]);
        std::iter::once(scene.prepared.name.clone()).chain(milliseconds(&steps)).collect()
    });
    let paper = paper::TABLE_3A
        .iter()
        .map(|(scene, steps)| std::iter::once((*scene).to_owned()).chain(milliseconds(steps)).collect());
    let steps = paper::STEPS.map(|(step, _)| step);
    Table {
        title: "Table 3(a): milliseconds by kernel".to_owned(),
        note: "1024x1024, one sample a pixel. I, II-c and III-c trace rays; IV is postcorrection; ETC is all else of the \
               frame."
            .to_owned(),
        head: ["scene"].into_iter().chain(steps).chain(["ETC", "frame"]).collect(),
        ours: ours.collect(),
        paper: paper.collect(),
        citation: paper::CITATION,
    }
}

fn reflective(scenes: &[SceneReport]) -> Table {
    let ours = of(scenes, TableName::Reflective).map(|(scene, measured)| {
        let [full, ours] = Pair::of(measured).ms;
        varied(&scene.prepared.name, measured.records[0].reflective_share, full, ours)
    });
    Table {
        title: "Table 3(b): share of reflective pixels varied".to_owned(),
        note: "1024x1024, one sample a pixel. The paper moves the camera; here the view stays and surfaces change: all are \
               opaque with a diffuse share of 0.7, and a growing set of objects (the largest that fit under 20, 40, 60 and \
               80 % of the pixels, then all) mirrors a share of 0.3. The share is that of the pixels whose first hit is \
               such a mirror."
            .to_owned(),
        head: vec!["scene", "reflective pixels", "full ms", "adaptive ms", "speedup"],
        ours: ours.collect(),
        paper: paper::TABLE_3B.iter().map(|&(share, full, ours)| varied("Bathroom", share, full, ours)).collect(),
        citation: paper::CITATION,
    }
}

fn views(scenes: &[SceneReport]) -> Table {
    let mut ours = Vec::new();
    for scene in scenes {
        let mut views: Vec<_> = of(std::slice::from_ref(scene), TableName::Views)
            .map(|(_, measured)| (measured.records[1].rt_ratio, measured.job.turn, Pair::of(measured).ms))
            .collect();
        views.sort_by(|a, b| a.0.total_cmp(&b.0));
        ours.extend(views.into_iter().map(|(ratio, turn, [full, ours])| {
            varied(&format!("{}, turned by {turn}°", scene.prepared.name), ratio, full, ours)
        }));
    }
    Table {
        title: "Table 3(c): RT ratio varied".to_owned(),
        note: "1024x1024, one sample a pixel, five views: the camera turned about the vertical where it stands. Sorted by \
               RT ratio."
            .to_owned(),
        head: vec!["scene", "RT ratio", "full ms", "adaptive ms", "speedup"],
        ours,
        paper: paper::TABLE_3C.iter().map(|&(ratio, full, ours)| varied("Conference", ratio, full, ours)).collect(),
        citation: paper::CITATION,
    }
}

/// What was measured for a table.
pub fn of(scenes: &[SceneReport], table: TableName) -> impl Iterator<Item = (&SceneReport, &Measured)> {
    let measured = scenes.iter().flat_map(|scene| scene.measured.iter().map(move |m| (scene, m)));
    measured.filter(move |(_, measured)| measured.job.tables.contains(&table))
}

fn varied(name: &str, share: f64, full_ms: f64, ours_ms: f64) -> Vec<String> {
    let speedup = full_ms / ours_ms;
    vec![
        name.to_owned(),
        format!("{:.1} %", 100.0 * share),
        format!("{full_ms:.1}"),
        format!("{ours_ms:.1}"),
        format!("{speedup:.2}"),
    ]
}

fn sampling(measured: &Measured) -> String {
    format!("{0}x{0}", measured.job.rungs[0].settings.sampling)
}

/// Milliseconds of the paper's steps, and of what belongs to none.
fn by_step(record: &Record) -> [f64; 9] {
    let mut steps = [0.0; 9];
    for (pass, ms) in record.passes() {
        let step = paper::STEPS.iter().position(|(_, name)| pass.contains(name));
        steps[step.unwrap_or(8)] += ms;
    }
    let timed: f64 = steps.iter().sum();
    steps[8] += (record.time().median - timed).max(0.0);
    steps
}

fn milliseconds(steps: &[f64; 9]) -> impl Iterator<Item = String> {
    let sum: f64 = steps.iter().sum();
    steps.iter().copied().chain([sum]).map(|ms| format!("{ms:.2}")).collect::<Vec<_>>().into_iter()
}

const PAIR_HEAD: [&str; 6] = ["full ms", "adaptive ms", "speedup", "RT ratio", "efficiency", "PSNR dB"];

/// Full tracing and the adaptive method.
struct Pair {
    ms: [f64; 2],
    rt_ratio: f64,
    psnr_db: f64,
}

impl Pair {
    fn of(measured: &Measured) -> Self {
        let [full, ours] = [0, 1].map(|i| &measured.records[i]);
        Self {
            ms: [full.time().median, ours.time().median],
            rt_ratio: ours.rt_ratio,
            psnr_db: ours.psnr_db().unwrap_or(f64::NAN),
        }
    }

    fn cells(&self) -> Vec<String> {
        let speedup = self.ms[0] / self.ms[1];
        vec![
            format!("{:.1}", self.ms[0]),
            format!("{:.1}", self.ms[1]),
            format!("{speedup:.2}"),
            format!("{:.3}", self.rt_ratio),
            format!("{:.2}", speedup * self.rt_ratio),
            format!("{:.2}", self.psnr_db),
        ]
    }
}

impl From<&paper::Pair> for Pair {
    fn from(pair: &paper::Pair) -> Self {
        Self { ms: [pair.full_ms, pair.ours_ms], rt_ratio: pair.rt_ratio, psnr_db: pair.psnr_db }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::record::tests::example;

    #[test]
    fn passes_belong_to_the_papers_steps() {
        let mut record = example("r", 20.0, None);
        record.frames[0].passes = [
            ("base", 8.0),
            ("similarity_a1", 1.0),
            ("compact_a1", 0.5),
            ("trace_a1", 2.0),
            ("similarity_a2", 1.5),
            ("compact_a2", 0.25),
            ("trace_a2", 3.0),
            ("postcorrect_seed", 0.5),
            ("compact_postcorrect", 0.25),
            ("postcorrect", 1.0),
            ("resolve", 0.75),
        ]
        .map(|(name, ms)| (name.to_owned(), ms))
        .to_vec();
        // What is left of the frame's 20 ms is not in any pass.
        assert_eq!(by_step(&record), [8.0, 1.0, 0.5, 2.0, 1.5, 0.25, 3.0, 1.75, 2.0]);
    }

    #[test]
    fn a_pair_says_what_the_paper_says() {
        let cells = Pair::from(&paper::TABLE_5[0].2[1].1[0]).cells();
        assert_eq!(cells, ["1211.7", "591.2", "2.05", "0.294", "0.60", "43.99"]);
        assert_eq!(varied("s", 0.199, 813.3, 454.0)[1..], ["19.9 %", "813.3", "454.0", "1.79"]);
    }
}
