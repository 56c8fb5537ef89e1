//! The interface of a table: what is measured for it and what the page shows.

use glimpse::Settings;
use maud::{Markup, html};

use crate::bench::Measured;
use crate::job::Job;
use crate::pareto::{self, Point};
use crate::plot::{Mark, draw};
use crate::record::Record;
use crate::rung::Rung;
use crate::scene::SceneReport;
use crate::subject::Prepared;

/// A table or figure of a paper, or one like it, for any scene.
pub trait Table: Sync {
    /// Name on the command line.
    fn name(&self) -> &'static str;

    /// What the table measures, as one line of help.
    fn summary(&self) -> &'static str;

    /// Jobs to measure for a scene; none if the table does not apply to it.
    fn jobs(&self, request: &Request<'_>) -> Vec<Job>;

    /// Content of the table's section of the page.
    fn content(&self, scenes: &[SceneReport]) -> Content;

    /// Plot of PSNR against the time of a picture, drawn for each scene.
    fn plot(&self) -> Option<Plot> {
        None
    }

    /// CSV file with data of all scenes, written beside the page.
    fn csv(&self) -> Option<Csv> {
        None
    }
}

/// Settings and scene that a table makes jobs for.
pub struct Request<'r> {
    /// Recursion and features that all settings share.
    pub base: &'r Settings,
    /// Frame size in pixels for tables without a size of their own.
    pub size: [u32; 2],
    /// Sides in pixels of the square frames of Kim 2016's table 5.
    pub table5_sizes: &'r [u32],
    /// Side in pixels of the square frames of Kim 2016's tables 3.
    pub table3_side: u32,
    /// Scene to measure.
    pub scene: &'r Prepared,
}

/// Sides in pixels of the square frames of Kim 2016's tables 5 and, the second one, 3, for reports of this size: those of
/// the paper, 512 and 1024, at 960x540; otherwise the nearest power of two below the shorter side, and twice that.
pub fn square_sides(size: [u32; 2]) -> [u32; 2] {
    let side = 1 << size[0].min(size[1]).max(1).ilog2();
    [side, 2 * side]
}

/// Content of a table's section of the page.
pub enum Content {
    /// No section, as nothing was measured.
    Nothing,
    /// Measured rows above the rows printed in the paper.
    Rows(Rows),
    /// A section with its own markup.
    Section(Markup),
}

/// Rows of a table, measured and published.
pub struct Rows {
    /// Title of the section.
    pub title: &'static str,
    /// Conditions of the measurement.
    pub note: String,
    /// Column headings.
    pub head: Vec<&'static str>,
    /// Measured rows, by scene.
    pub measured: Vec<Vec<String>>,
    /// Rows as printed in the paper; empty if it has none.
    pub published: Vec<Vec<String>>,
    /// Citation of the paper.
    pub citation: &'static str,
}

/// A plot of a table's job: PSNR against milliseconds, for each setting with an error.
pub struct Plot {
    /// End of the file name, before `.svg`.
    pub file: &'static str,
}

/// A CSV file.
pub struct Csv {
    /// File name.
    pub file: &'static str,
    /// Makes the file's content from all scenes.
    pub bytes: fn(&[SceneReport]) -> anyhow::Result<Vec<u8>>,
}

impl Content {
    /// Section of the page, if anything was measured.
    pub fn section(self) -> Option<Markup> {
        match self {
            Self::Nothing => None,
            Self::Rows(rows) => (!rows.measured.is_empty()).then(|| rows.section()),
            Self::Section(markup) => Some(markup),
        }
    }
}

impl Rows {
    fn section(&self) -> Markup {
        html! {
            section {
                h2 { (self.title) }
                p { (self.note) }
                div class="wide" { table {
                    thead { tr { @for head in &self.head { th { (head) } } } }
                    tbody { @for row in &self.measured { (cells(row)) } }
                    @if !self.published.is_empty() {
                        tbody class="paper" {
                            tr { td colspan=(self.head.len()) { "The paper's own figures: " (self.citation) } }
                            @for row in &self.published { (cells(row)) }
                        }
                    }
                } }
            }
        }
    }
}

fn cells(row: &[String]) -> Markup {
    html! {
        tr { @for (i, cell) in row.iter().enumerate() {
            @if i == 0 { th { (cell) } } @else { td { (cell) } }
        } }
    }
}

impl Plot {
    /// File name of the plot for a scene's file stem.
    pub fn name(&self, stem: &str) -> String {
        format!("{stem}-{}.svg", self.file)
    }
}

/// Draws the plot of a scene, if the table has one and was measured.
pub fn plot_of(table: &dyn Table, scene: &SceneReport) -> Option<String> {
    table.plot()?;
    let measured = scene.of_table(table.name()).next()?;
    Some(draw(&scene.stem, "time of a picture in ms", &marks(measured)))
}

fn marks(measured: &Measured) -> Vec<Mark> {
    let point =
        |record: &Record| Point { cost: record.time().median, psnr_db: record.psnr_db().unwrap_or(f64::NAN) };
    // A reference has no error and therefore no point.
    let judged: Vec<_> = settings(measured).filter(|(_, record)| record.error.is_some()).collect();
    let points: Vec<_> = judged.iter().map(|(_, record)| point(record)).collect();
    let front = pareto::front(&points);
    let marks = judged.into_iter().zip(points).zip(front);
    marks
        .map(|(((rung, record), point), front)| {
            let interval = record.interval_ms();
            Mark { label: rung.code.clone(), family: rung.family, point, interval, front }
        })
        .collect()
}

/// Measurements of all scenes for the table of that name.
pub fn measured<'s>(
    scenes: &'s [SceneReport],
    table: &'s str,
) -> impl Iterator<Item = (&'s SceneReport, &'s Measured)> {
    scenes.iter().flat_map(move |scene| scene.of_table(table).map(move |measured| (scene, measured)))
}

/// Settings of a job with their records.
pub fn settings(measured: &Measured) -> impl Iterator<Item = (&Rung, &Record)> {
    measured.job.rungs.iter().zip(&measured.records)
}
