//! `glimpse bench --pan`: errors of the frames of a panning camera.

use glimpse::{Camera, Renderer, metrics};
use serde::Serialize;

use crate::output;
use crate::statistics::Statistics;

/// Pan of the camera during the measurement.
pub struct Pan {
    /// Angle to the right in degrees per frame.
    pub degrees: f64,
    /// For each method, the index of the method that its frames are compared with.
    pub against: Vec<Option<usize>>,
}

/// Measurements of each frame of one method.
#[derive(Clone, Debug)]
pub struct Panned {
    degrees: f64,
    /// RMSE of each frame in levels of 0 to 255; empty if there is no method to compare with.
    rmse: Vec<f64>,
    rt_ratio: Vec<f64>,
}

impl Panned {
    /// Starts without frames.
    pub fn new(pan: &Pan) -> Self {
        Self { degrees: pan.degrees, rmse: Vec::new(), rt_ratio: Vec::new() }
    }
}

impl Pan {
    /// Compares the current frames of all methods, and counts their rays.
    ///
    /// # Errors
    /// Fails if the device fails.
    pub fn compare(
        &self,
        renderers: &mut [(Renderer, f64)],
        camera: &Camera,
        panned: &mut [Option<Panned>],
    ) -> glimpse::Result<()> {
        let pictures = renderers.iter().map(|(renderer, _)| renderer.display_image());
        let pictures = pictures.collect::<glimpse::Result<Vec<_>>>()?;
        for (index, panned) in panned.iter_mut().enumerate() {
            let Some(panned) = panned else { continue };
            if let Some(against) = self.against[index] {
                panned.rmse.push(metrics::rmse(&pictures[index], &pictures[against])?);
            }
            panned.rt_ratio.push(renderers[index].0.inspect(camera)?.counts.rt_ratio());
        }
        Ok(())
    }
}

/// Summary of the frames of a panning camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PanStatistics {
    /// Angle to the right in degrees per frame.
    pub degrees: f64,
    /// PSNR of the mean squared error of all frames against `full`; null if there is nothing to compare with
    /// or no error.
    pub psnr_db: Option<f64>,
    /// PSNR of the worst frame in decibels.
    pub worst_psnr_db: Option<f64>,
    /// Number of the worst frame, from 1.
    pub worst_frame: Option<usize>,
    /// Mean RT ratio of the frames.
    pub rt_ratio: f64,
}

impl PanStatistics {
    /// Summarises the frames of one method.
    pub fn of(panned: &Panned) -> Self {
        let mean = |values: &mut dyn Iterator<Item = f64>, count: usize| values.sum::<f64>() / count as f64;
        let Panned { degrees, rmse, rt_ratio } = panned;
        let squared = mean(&mut rmse.iter().map(|e| e * e), rmse.len());
        let worst = rmse.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
        Self {
            degrees: *degrees,
            psnr_db: (!rmse.is_empty()).then(|| metrics::psnr_db(squared.sqrt())).flatten(),
            worst_psnr_db: worst.and_then(|(_, rmse)| metrics::psnr_db(*rmse)),
            worst_frame: worst.map(|(index, _)| index + 1),
            rt_ratio: mean(&mut rt_ratio.iter().copied(), rt_ratio.len()),
        }
    }
}

/// Table with a line for each method with a panning camera.
pub fn table(column: usize, rows: &[(String, Statistics)]) -> String {
    let Some(first) = rows.iter().find_map(|(_, s)| s.pan.map(|pan| (pan, s.frames))) else {
        return String::new();
    };
    let (pan, frames) = first;
    let mut text = format!(
        "camera turned by {} degrees a frame, {}\n{:<column$}{:>10}{:>10}{:>10}{:>10}\n",
        pan.degrees,
        output::counted(frames, "frame"),
        "method",
        "ms",
        "RT ratio",
        "PSNR/dB",
        "worst/dB"
    );
    for (name, statistics) in rows {
        let Some(pan) = statistics.pan else { continue };
        let db = |db: Option<f64>| db.map_or_else(|| "-".to_owned(), |db| format!("{db:.2}"));
        text += &format!(
            "{name:<column$}{:>10.2}{:>10.3}{:>10}{:>10}\n",
            statistics.time_ms.frame.median,
            pan.rt_ratio,
            db(pan.psnr_db),
            db(pan.worst_psnr_db)
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::tests::example;

    fn panned(rmse: &[f64]) -> Panned {
        Panned { degrees: 0.5, rmse: rmse.to_vec(), rt_ratio: vec![0.1, 0.3] }
    }

    #[test]
    fn frames_are_judged_by_their_mean_square_and_the_worst() {
        let statistics = PanStatistics::of(&panned(&[0.0, 25.5, 0.0, 0.0]));
        let near = |db: Option<f64>, expected: f64| (db.unwrap() - expected).abs() < 1e-9;
        assert!(near(statistics.worst_psnr_db, 20.0), "{statistics:?}");
        assert!(near(statistics.psnr_db, 20.0 + 10.0 * 4_f64.log10()), "{statistics:?}");
        assert_eq!((statistics.worst_frame, statistics.rt_ratio), (Some(2), 0.2));
    }

    #[test]
    fn without_another_method_there_is_no_error() {
        let statistics = PanStatistics::of(&panned(&[]));
        assert_eq!((statistics.psnr_db, statistics.worst_psnr_db), (None, None));
    }

    #[test]
    fn the_table_has_a_line_for_each_method() {
        assert_eq!(table(10, &[("full".to_owned(), example())]), "");
        let turned = Statistics { pan: Some(PanStatistics::of(&panned(&[25.5, 25.5]))), ..example() };
        let text = table(12, &[("reproject".to_owned(), turned)]);
        assert!(text.starts_with("camera turned by 0.5 degrees a frame, "), "{text}");
        assert!(text.contains("reproject        10.00     0.200     20.00     20.00\n"), "{text}");
    }
}
