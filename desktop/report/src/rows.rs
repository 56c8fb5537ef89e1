//! The rows of report.csv, one for each measurement.

use anyhow::Context;
use glimpse::Method;
use serde::{Deserialize, Serialize};

use crate::bench::Measured;
use crate::interval::Estimate;
use crate::pareto::{self, Point};
use crate::subject::Variant;

/// A measured setting of one view of one scene.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Row {
    /// Name of the scene on the command line.
    pub scene: String,
    /// Part of the report: `ladder` or `tables`.
    pub part: String,
    /// Change made to the scene or the view; empty for none.
    pub changed: String,
    /// Label of the setting.
    pub setting: String,
    /// Whether the setting belongs to a baseline family.
    pub baseline: bool,
    /// Width of the shown frame in pixels.
    pub width: u32,
    /// Height of the shown frame in pixels.
    pub height: u32,
    /// Width of the rendered frame in pixels.
    pub rendered_width: u32,
    /// Height of the rendered frame in pixels.
    pub rendered_height: u32,
    /// Samples along the side of a pixel.
    pub sampling: u32,
    /// Side of the base block in pixels; 1 for methods without blocks.
    pub block: u32,
    /// Value of the postcorrection option; empty for methods without it.
    pub postcorrect: String,
    /// Number of timed frames.
    pub frames: usize,
    /// Median frame time in milliseconds.
    pub median_ms: f64,
    /// 95th percentile of the frame time in milliseconds.
    pub p95_ms: f64,
    /// Rays of all kinds per shown pixel.
    pub rays_per_pixel: f64,
    /// RT ratio of Kim 2016: traced samples over all samples.
    pub rt_ratio: f64,
    /// Reference: the converged frame or full ray tracing with the same samples; empty for the latter's own
    /// row.
    pub against: String,
    /// RMSE in levels of 0 to 255.
    pub rmse: Option<f64>,
    /// PSNR in decibels; `inf` for equal pictures.
    pub psnr_db: Option<f64>,
    /// SSIM; 1 for equal pictures.
    pub ssim: Option<f64>,
    /// Mean of the FLIP error map.
    pub flip_mean: Option<f64>,
    /// 99th percentile of the FLIP error map.
    pub flip_p99: Option<f64>,
    /// RMSE of the worst tile, in levels of 0 to 255.
    pub worst_tile_rmse: Option<f64>,
    /// Number of objects that full ray tracing shows. This and the next four columns are empty unless missing
    /// objects are counted.
    pub objects_shown: Option<u64>,
    /// Number of these objects that no pixel shows.
    pub objects_lost: Option<u64>,
    /// Number of pixels in which full ray tracing shows an object.
    pub pixels_shown: Option<u64>,
    /// Number of these pixels that show another object or none.
    pub pixels_lost: Option<u64>,
    /// Lost share of an object's pixels, averaged over the objects.
    pub mean_share_lost: Option<f64>,
    /// Efficiency 1 / (MSE x seconds), MSE of values in [0, 1].
    pub efficiency: Option<f64>,
    /// Whether the row is on the ladder's Pareto front of PSNR against time.
    pub front_time: bool,
    /// Whether the row is on the ladder's Pareto front of PSNR against rays per pixel.
    pub front_rays: bool,
    /// Short name of the setting on the page.
    pub code: String,
    /// Geometric mean of the ratio of the frame's time to that of the job's control in the same round; empty, as the next
    /// two columns, for jobs without a control.
    pub time_ratio: Option<f64>,
    /// Lower end of the ratio's 95 % confidence interval; empty, as the upper end, for a single frame.
    pub time_ratio_low: Option<f64>,
    /// Upper end of the interval.
    pub time_ratio_high: Option<f64>,
    /// Day of the measurement in UTC.
    pub day: String,
}

impl Row {
    /// Point for the Pareto front of PSNR against time.
    pub fn time_point(&self) -> Point {
        Point { cost: self.median_ms, psnr_db: self.psnr_db.unwrap_or(f64::NAN) }
    }

    /// Point for the Pareto front of PSNR against rays per pixel.
    pub fn rays_point(&self) -> Point {
        Point { cost: self.rays_per_pixel, ..self.time_point() }
    }
}

/// Rows of a scene, with the Pareto fronts of the ladder marked.
pub fn of(scene: &str, measured: &[Measured]) -> Vec<Row> {
    let mut rows = Vec::new();
    for measured in measured {
        let mut of_job: Vec<Row> = (0..measured.records.len()).map(|i| row(scene, measured, i)).collect();
        if measured.job.is_ladder() {
            mark_fronts(&mut of_job);
        }
        rows.extend(of_job);
    }
    rows
}

fn mark_fronts(rows: &mut [Row]) {
    let time = pareto::front(&rows.iter().map(Row::time_point).collect::<Vec<_>>());
    let rays = pareto::front(&rows.iter().map(Row::rays_point).collect::<Vec<_>>());
    for (row, (time, rays)) in rows.iter_mut().zip(time.into_iter().zip(rays)) {
        (row.front_time, row.front_rays) = (time, rays);
    }
}

fn row(scene: &str, measured: &Measured, index: usize) -> Row {
    let (job, rung, record) = (&measured.job, &measured.job.rungs[index], &measured.records[index]);
    let (baseline, adaptive) = (rung.family.is_baseline, rung.settings.method == Method::Adaptive);
    let changed = match job.variant {
        Variant::Reflective(percent) => format!("up to {percent} % reflective pixels"),
        Variant::AsIs if job.turn != 0.0 => format!("turned by {} degrees", job.turn),
        Variant::AsIs => String::new(),
    };
    let against = match record.error {
        None => "",
        Some(_) if job.is_against_converged() => "256 samples a pixel",
        Some(_) => "full",
    };
    let (error, missing) = (record.error.as_ref(), record.missing.as_ref());
    let time = record.time();
    let ratio = job.control.map(|_| Estimate::of_logarithms(&record.log_times()));
    let interval = ratio.and_then(|ratio| ratio.interval);
    Row {
        scene: scene.to_owned(),
        part: if job.is_ladder() { "ladder" } else { "tables" }.to_owned(),
        changed,
        setting: rung.name.clone(),
        baseline,
        width: job.shown[0],
        height: job.shown[1],
        rendered_width: rung.rendered[0],
        rendered_height: rung.rendered[1],
        sampling: rung.settings.sampling,
        block: if adaptive { rung.settings.block } else { 1 },
        postcorrect: if adaptive {
            format!("{:?}", rung.settings.postcorrect).to_lowercase()
        } else {
            String::new()
        },
        frames: record.frames.len(),
        median_ms: time.median,
        p95_ms: time.p95,
        rays_per_pixel: record.rays_per_pixel(),
        rt_ratio: record.rt_ratio,
        against: against.to_owned(),
        rmse: error.map(|e| e.rmse),
        psnr_db: record.psnr_db(),
        ssim: error.map(|e| e.ssim),
        flip_mean: error.and_then(|e| e.flip_mean),
        flip_p99: error.and_then(|e| e.flip_p99),
        worst_tile_rmse: error.map(|e| e.worst_tile_rmse),
        objects_shown: missing.map(|m| m.objects_shown),
        objects_lost: missing.map(|m| m.objects_lost),
        pixels_shown: missing.map(|m| m.pixels_shown),
        pixels_lost: missing.map(|m| m.pixels_lost),
        mean_share_lost: missing.map(|m| m.mean_share_lost),
        efficiency: record.efficiency(),
        front_time: false,
        front_rays: false,
        code: rung.code.clone(),
        time_ratio: ratio.map(|ratio| ratio.mean),
        time_ratio_low: interval.map(|[low, _]| low),
        time_ratio_high: interval.map(|[_, high]| high),
        day: record.day.clone(),
    }
}

/// Writes the rows as comma-separated values.
pub fn csv(rows: &[&Row]) -> anyhow::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).context("CSV")?;
    }
    writer.into_inner().context("CSV")
}

/// States in one sentence which baselines are on the Pareto front and which adaptive settings a baseline
/// beats.
pub fn verdict(rows: &[Row]) -> String {
    let ladder = || rows.iter().filter(|row| row.part == "ladder");
    let named = |rows: Vec<&Row>| -> String {
        rows.iter().map(|row| row.code.as_str()).collect::<Vec<_>>().join(", ")
    };
    let baselines: Vec<_> = ladder().filter(|row| row.front_time && row.baseline).collect();
    let beaten =
        |row: &Row| ladder().any(|other| other.baseline && other.time_point().beats(row.time_point()));
    let beaten: Vec<_> = ladder().filter(|row| !row.baseline && beaten(row)).collect();
    let front = if baselines.is_empty() {
        "no baseline lies on the Pareto front of PSNR against time".to_owned()
    } else {
        format!("baselines on the Pareto front of PSNR against time: {}", named(baselines))
    };
    let beaten = if beaten.is_empty() {
        "no adaptive setting is beaten by a baseline".to_owned()
    } else {
        format!("adaptive settings that a baseline beats: {}", named(beaten))
    };
    format!("{front}; {beaten}")
}

#[cfg(test)]
pub mod tests {
    use glimpse::{Missing, Settings};

    use super::*;
    use crate::record::tests::example;
    use crate::{key, ladder};

    /// A ladder whose settings take 10, 20, ... ms at 30, 31, ... dB; the last has infinite PSNR.
    pub fn ladder() -> Measured {
        let mut job = ladder::job(&Settings::default(), [10, 10]);
        key::assign([&mut job]);
        let rungs = &job.rungs;
        let psnr = |i: usize| if i + 1 == rungs.len() { f64::INFINITY } else { 30.0 + i as f64 };
        let records = (0..rungs.len())
            .map(|i| example(&format!("ladder {i}"), 10.0 * (i + 1) as f64, Some(psnr(i))))
            .collect();
        let identities = (0..rungs.len()).map(|i| format!("ladder {i}")).collect();
        Measured { job, identities, converged: Some("converged".to_owned()), records }
    }

    #[test]
    fn csv_parses_back() {
        let mut measured = ladder();
        measured.records[2].missing = Some(Missing {
            objects_shown: 5,
            objects_lost: 4,
            pixels_shown: 3,
            pixels_lost: 2,
            mean_share_lost: 0.5,
        });
        let mut rows = of("a, \"b\".glb", &[measured]);
        rows[1].psnr_db = None;
        let bytes = csv(&rows.iter().collect::<Vec<_>>()).unwrap();
        let parsed: Vec<Row> =
            csv::Reader::from_reader(bytes.as_slice()).deserialize().map(Result::unwrap).collect();
        assert_eq!(parsed, rows);
        let lost = |row: &Row| [row.objects_shown, row.objects_lost, row.pixels_shown, row.pixels_lost];
        assert_eq!((lost(&parsed[2]), parsed[2].mean_share_lost), ([5, 4, 3, 2].map(Some), Some(0.5)));
        let head = String::from_utf8(bytes).unwrap();
        assert!(head.starts_with("scene,part,changed,setting,baseline,width,height,"), "{head}");
        assert_eq!(parsed.last().unwrap().psnr_db, Some(f64::INFINITY));
    }

    #[test]
    fn fronts_are_marked_on_the_ladder() {
        let mut measured = ladder();
        let all = of("s", std::slice::from_ref(&measured));
        assert!(all.iter().all(|row| row.front_time), "each takes more and gives more");
        assert_eq!(all.iter().filter(|row| row.front_rays).count(), 1, "all cost the same rays");
        measured.records[3].error = example("worse", 1.0, Some(31.5)).error;
        let rows = of("s", &[measured]);
        assert!(!rows[3].front_time && rows[2].front_time);
    }

    #[test]
    fn the_verdict_names_who_is_beaten_by_whom() {
        let rows = of("s", &[ladder()]);
        assert!(verdict(&rows).contains("F4; no adaptive setting is beaten"), "{}", verdict(&rows));
        let mut rows = rows;
        for row in rows.iter_mut().filter(|row| row.baseline) {
            row.psnr_db = Some(1.0);
        }
        mark_fronts(&mut rows);
        // The cheapest of all is on the front, however bad.
        assert!(verdict(&rows).starts_with("baselines on the Pareto front of PSNR against time: R1; no"));
        rows[0].psnr_db = Some(99.0);
        mark_fronts(&mut rows);
        assert!(verdict(&rows).contains("beats: A1, "), "{}", verdict(&rows));
    }
}
