//! report.html: one self-contained page.

mod pictures;
mod settings;
mod summary;

pub use summary::sentence;

use glimpse_measure::output::{counted, listed};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::ladder::{self, Axis};
use crate::rows::{self, Row};
use crate::scene::SceneReport;
use crate::store::Store;
use crate::table::plot_of;
use crate::tables::TABLES;

const STYLE: &str = include_str!("page/style.css");

/// The head of the page: where and with what the report was made.
pub struct Header {
    /// Adapter name with backend and driver.
    pub adapter: String,
    /// Model of the processor and its threads.
    pub cpu: String,
    /// Clock that measured the times.
    pub clock: &'static str,
    /// Number of timed frames of each setting.
    pub frames: usize,
    /// Version of the program.
    pub version: String,
    /// Git commit of the program.
    pub commit: String,
    /// Command line of the report.
    pub command: String,
}

/// Renders the page: a section for each scene, then one for each table with measurements.
pub fn html(header: &Header, store: &Store, scenes: &[SceneReport]) -> anyhow::Result<String> {
    let sections = scenes.iter().map(|scene| section(store, scene)).collect::<anyhow::Result<Vec<_>>>()?;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { "Glimpse: error against run time" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "Error against run time" }
                (summary::section(header, scenes))
                (settings::section(scenes))
                @for section in sections { (section) }
                @for section in TABLES.iter().filter_map(|table| table.content(scenes).section()) { (section) }
            }
        }
    };
    Ok(page.into_string())
}

fn section(store: &Store, scene: &SceneReport) -> anyhow::Result<Markup> {
    let holds = &scene.prepared.statistics;
    let ladder: Vec<_> = scene.rows.iter().filter(|row| row.part == "ladder").collect();
    let figures = pictures::of(store, scene)?;
    Ok(html! {
        section id=(scene.stem) {
            h2 { (scene.prepared.name) }
            p {
                (counted(holds.triangles, "triangle")) ", " (counted(holds.spheres, "sphere")) ", "
                (counted(holds.objects, "object")) ", " (counted(holds.lights, "light")) ", "
                (counted(holds.textures, "texture")) "; left out: " (listed(&holds.left_out)) ". "
                @if let Some(row) = ladder.first() { (row.width) "x" (row.height) " pixels." }
                " Content " code { (scene.prepared.content) } " (128-bit FNV-1a of the files)."
            }
            p { strong { (rows::verdict(&scene.rows)) "." } }
            div class="plots" {
                @for axis in Axis::ALL { figure { (PreEscaped(ladder::svg(scene, axis))) } }
                @for svg in TABLES.iter().filter_map(|table| plot_of(*table, scene)) {
                    figure { (PreEscaped(svg)) }
                }
            }
            (ladder_table(&ladder))
            div class="pictures" {
                @for figure in figures {
                    figure {
                        img src=(figure.source) alt=(figure.caption) loading="lazy";
                        figcaption { (figure.caption) }
                    }
                }
            }
        }
    })
}

/// Headings of the ladder's table.
const HEAD: [&str; 17] = [
    "setting",
    "median ms",
    "p95 ms",
    "time / control",
    "95 % interval",
    "front of time",
    "rays / pixel",
    "front of rays",
    "RT ratio",
    "PSNR dB",
    "RMSE levels",
    "SSIM",
    "FLIP mean",
    "FLIP p99",
    "worst tile RMSE levels",
    "efficiency 1/s",
    "frames",
];

fn ladder_table(rows: &[&Row]) -> Markup {
    let number =
        |value: Option<f64>, digits: usize| value.map_or_else(String::new, |v| format!("{v:.digits$}"));
    let mark = |front: bool| if front { "●" } else { "" };
    let interval = |row: &Row| match (row.time_ratio_low, row.time_ratio_high) {
        (Some(low), Some(high)) => format!("{low:.3} to {high:.3}"),
        _ => String::new(),
    };
    html! {
        div class="wide" { table {
            thead { tr { @for head in HEAD { th { (head) } } } }
            tbody {
                @for row in rows {
                    tr class=[row.baseline.then_some("baseline")] {
                        th title=(row.setting) { (row.code) }
                        td { (format!("{:.2}", row.median_ms)) }
                        td { (format!("{:.2}", row.p95_ms)) }
                        td { (number(row.time_ratio, 3)) }
                        td { (interval(row)) }
                        td class="mark" { (mark(row.front_time)) }
                        td { (format!("{:.2}", row.rays_per_pixel)) }
                        td class="mark" { (mark(row.front_rays)) }
                        td { (format!("{:.3}", row.rt_ratio)) }
                        td { (number(row.psnr_db, 2)) }
                        td { (number(row.rmse, 3)) }
                        td { (number(row.ssim, 4)) }
                        td { (number(row.flip_mean, 4)) }
                        td { (number(row.flip_p99, 3)) }
                        td { (number(row.worst_tile_rmse, 1)) }
                        td { (number(row.efficiency, 0)) }
                        td { (row.frames) }
                    }
                }
            }
        } }
    }
}

#[cfg(test)]
mod tests {
    use glimpse::{DisplayImage, Missing};

    use super::*;
    use crate::bench::Measured;
    use crate::job::Job;
    use crate::record::{Record, tests::example};
    use crate::rows::tests::ladder;
    use crate::subject::Prepared;
    use crate::table::Content;
    use crate::work::Work;

    /// A scene with a ladder and measurements for every table; stores the pictures that its page embeds.
    fn report(store: &Store) -> SceneReport {
        let mut measured = vec![ladder()];
        for table in TABLES {
            let Measured { job, .. } = ladder();
            let job = Job { tables: vec![table.name()], rungs: job.rungs[..2].to_vec(), ..job };
            let work = Work { node_visits: 0, primitive_tests: 0, loads: Default::default() };
            let (missing, work) = (Some(Missing::default()), Some(work));
            let adaptive = Record { missing, work, ..example("adaptive", 8.0, Some(41.5)) };
            let records = vec![example("full", 20.0, None), adaptive];
            measured.push(Measured { job, identities: vec![], converged: None, records });
        }
        let picture = DisplayImage::from_pixel(10, 10, [9, 9, 9, 255].into());
        store.keep_picture("converged", &picture).unwrap();
        for identity in &measured[0].identities {
            store.keep_picture(identity, &picture).unwrap();
        }
        let mut prepared = Prepared::new("builtin:minray", None).unwrap();
        prepared.name = "<b>&scene".to_owned();
        SceneReport::new(prepared, "scene".to_owned(), measured)
    }

    #[test]
    fn the_page_holds_every_row_and_needs_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let scene = report(&store);
        let header = Header {
            adapter: "Card (vulkan, D 1)".into(),
            cpu: "Processor, 2 threads".into(),
            frames: 1,
            clock: "GPU timestamps",
            version: "0".into(),
            commit: "abc".into(),
            command: "glimpse report <b>".into(),
        };
        let scenes = [scene];
        let page = html(&header, &store, &scenes).unwrap();
        for row in scenes[0].rows.iter().filter(|row| row.part == "ladder") {
            assert!(
                page.contains(&format!(
                    "<th title=\"{}\">{}</th><td>{:.2}</td>",
                    row.setting, row.code, row.median_ms
                )),
                "{}",
                row.setting
            );
        }
        assert!(page.contains(&sentence(&scenes)));
        assert_eq!(page.matches("id=\"setting-A1\"").count(), 1, "the key names each setting once");
        for table in TABLES {
            match table.content(&scenes) {
                Content::Nothing => panic!("{} was measured", table.name()),
                Content::Section(section) => assert!(page.contains(&section.into_string())),
                Content::Rows(rows) => {
                    assert!(page.contains(&rows.title.replace('&', "&amp;")));
                    for row in rows.measured.iter().chain(&rows.published) {
                        let cells: String = row[1..].iter().map(|cell| format!("<td>{cell}</td>")).collect();
                        assert!(page.contains(&cells), "{row:?}");
                    }
                }
            }
        }
        let cited = |authors: &str| page.matches(authors).count();
        assert_eq!(
            [cited("Kim, Seo, Kim"), cited("Jin, Ihm, Chang")],
            [5, 2],
            "no paper has figures of missing objects"
        );
        for text in [
            "Card (vulkan, D 1)",
            "Processor, 2 threads",
            "2026-01-31",
            "commit abc",
            "glimpse report &lt;b&gt;",
            "&lt;b&gt;&amp;scene",
        ] {
            assert!(page.contains(text), "{text}");
        }
        assert_eq!(page.matches("<svg").count(), 4);
        assert!(page.matches("src=\"data:image/png;base64,").count() >= 2);
        let without_namespace = page.replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
        for outside in ["http:", "https:", "src=\"/", "url(", "@import", "<script", "<link", "<b>"] {
            assert!(!without_namespace.contains(outside), "{outside}");
        }
    }

    #[test]
    fn no_two_columns_of_a_table_are_called_the_same() {
        let folder = tempfile::tempdir().unwrap();
        let scenes = [report(&Store::open(folder.path()).unwrap())];
        let of_tables = TABLES.iter().filter_map(|table| match table.content(&scenes) {
            Content::Rows(rows) => Some(rows.head),
            _ => None,
        });
        for head in of_tables.chain([HEAD.to_vec(), summary::HEAD.to_vec(), settings::HEAD.to_vec()]) {
            let mut names = head.clone();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), head.len(), "{head:?}");
        }
    }
}
