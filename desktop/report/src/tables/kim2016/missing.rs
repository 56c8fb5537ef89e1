//! Missing objects (Kim 2016, section 4): objects that full ray tracing shows and the adaptive method loses,
//! by base block.

use glimpse::{Method, Missing, Postcorrect, Settings};
use glimpse_measure::output::grouped;

use crate::job::Job;
use crate::record::Record;
use crate::rung::{Family, Rung};
use crate::scene::SceneReport;
use crate::table::{Content, Request, Rows, Table, measured, settings};

/// Each base block without and with postcorrection.
pub struct MissingObjects;

impl Table for MissingObjects {
    fn name(&self) -> &'static str {
        "missing"
    }

    fn summary(&self) -> &'static str {
        "Objects that are lost, by block, without and with postcorrection"
    }

    fn jobs(&self, request: &Request<'_>) -> Vec<Job> {
        vec![Job {
            counts_missing: true,
            against: "full and its objects",
            ..Job::new(self.name(), request.size, rungs(request.base, request.size))
        }]
    }

    fn content(&self, scenes: &[SceneReport]) -> Content {
        let rows = measured(scenes, self.name()).flat_map(|(scene, measured)| {
            settings(measured).skip(1).filter_map(|(rung, record)| {
                let setting = [
                    scene.sized(measured.job.shown),
                    format!("{0}x{0}", rung.settings.block),
                    format!("{:?}", rung.settings.postcorrect).to_lowercase(),
                ];
                Some(setting.into_iter().chain(cells(record, record.missing.as_ref()?)).collect())
            })
        });
        Content::Rows(Rows {
            title: "Missing objects",
            note: "What full ray tracing of the same frame shows and the adaptive method (default tolerances) does not. An \
                   object is lost where no pixel of the frame shows it, a pixel where it shows another object or none. An \
                   object's share counts a wire as much as a wall. PSNR against full tracing. The paper prints no figures \
                   for this."
                .to_owned(),
            head: vec![
                "scene",
                "block",
                "postcorrection",
                "objects",
                "objects lost",
                "pixels lost",
                "lost of the average object",
                "RT ratio",
                "PSNR dB",
            ],
            measured: rows.collect(),
            published: Vec::new(),
            citation: "",
        })
    }
}

/// Full ray tracing, then every base block without and with postcorrection.
fn rungs(base: &Settings, size: [u32; 2]) -> Vec<Rung> {
    let rung = |name, family, settings| Rung::beside_full(name, family, settings, size);
    let mut rungs = vec![rung("full".to_owned(), Family::FIXED, Settings { method: Method::Full, ..*base })];
    for block in [2, 4, 8] {
        let adaptive = |postcorrect| Settings { method: Method::Adaptive, block, postcorrect, ..*base };
        rungs.push(rung(format!("block {block}, off"), Family::UNCORRECTED, adaptive(Postcorrect::Off)));
        rungs.push(rung(format!("block {block}"), Family::BLOCKS, adaptive(Postcorrect::On)));
    }
    rungs
}

fn cells(record: &Record, missing: &Missing) -> [String; 6] {
    let objects = 100.0 * missing.objects_lost as f64 / missing.objects_shown.max(1) as f64;
    let pixels = 100.0 * missing.pixels_lost as f64 / missing.pixels_shown.max(1) as f64;
    [
        grouped(missing.objects_shown),
        format!("{} ({objects:.2} %)", grouped(missing.objects_lost)),
        format!("{pixels:.2} %"),
        format!("{:.2} %", 100.0 * missing.mean_share_lost),
        format!("{:.3}", record.rt_ratio),
        format!("{:.2}", record.psnr_db().unwrap_or(f64::NAN)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::tests::example;

    #[test]
    fn every_block_is_there_without_and_with_postcorrection() {
        let base = Settings { depth: 7, ..Settings::default() };
        let rungs = rungs(&base, [32, 24]);
        for rung in &rungs {
            rung.settings.validate().unwrap();
            assert_eq!((rung.settings.depth, rung.rendered), (7, [32, 24]));
        }
        assert_eq!(rungs[0].settings.method, Method::Full);
        assert!(rungs.iter().all(|rung| rung.keeps_picture == (rung.settings.method == Method::Full)));
        let adaptive: Vec<_> =
            rungs[1..].iter().map(|rung| (rung.settings.block, rung.settings.postcorrect)).collect();
        let expected = [2, 4, 8].map(|block| [(block, Postcorrect::Off), (block, Postcorrect::On)]);
        assert_eq!(adaptive, expected.concat());
    }

    #[test]
    fn losses_are_shares_of_what_full_tracing_shows() {
        let missing = Missing {
            objects_shown: 2000,
            objects_lost: 25,
            pixels_shown: 8000,
            pixels_lost: 3000,
            mean_share_lost: 0.125,
        };
        let record = example("r", 10.0, Some(41.5));
        assert_eq!(
            cells(&record, &missing),
            ["2,000", "25 (1.25 %)", "37.50 %", "12.50 %", "0.340", "41.50"]
        );
        let nothing = cells(&record, &Missing::default());
        assert_eq!(nothing[..4], ["0", "0 (0.00 %)", "0.00 %", "0.00 %"], "an empty view loses nothing");
    }
}
