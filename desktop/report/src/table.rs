//! What a table of a paper is: what is measured for it, and what the page shows of that.

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
    /// The name by which it is asked for.
    fn name(&self) -> &'static str;

    /// What it measures, in one line of help.
    fn summary(&self) -> &'static str;

    /// What is measured for it in a scene; nothing where the table does not concern the scene.
    fn jobs(&self, request: &Request<'_>) -> Vec<Job>;

    /// What the page shows of it.
    fn content(&self, scenes: &[SceneReport]) -> Content;

    /// A plot of PSNR against the time of a picture, for each scene.
    fn plot(&self) -> Option<Plot> {
        None
    }

    /// A file beside the page, of all scenes.
    fn csv(&self) -> Option<Csv> {
        None
    }
}

/// What a report is to measure of a scene.
pub struct Request<'r> {
    /// Recursion and features.
    pub base: &'r Settings,
    /// The size of the frame where a table has none of its own.
    pub size: [u32; 2],
    /// The sides of the square frames of Kim 2016's table 5.
    pub table5_sizes: &'r [u32],
    /// The scene.
    pub scene: &'r Prepared,
}

/// What the page shows of a table.
pub enum Content {
    /// Nothing was measured for it.
    Nothing,
    /// Rows measured here above those printed in the paper.
    Rows(Rows),
    /// A section of its own kind.
    Section(Markup),
}

/// A table as it is read.
pub struct Rows {
    /// What it shows.
    pub title: &'static str,
    /// How it came about.
    pub note: String,
    /// Column heads.
    pub head: Vec<&'static str>,
    /// Measured here, by scene.
    pub measured: Vec<Vec<String>>,
    /// Printed in the paper; empty where it has no such figures.
    pub published: Vec<Vec<String>>,
    /// How the paper is cited.
    pub citation: &'static str,
}

/// What is plotted of a table's job: PSNR against milliseconds, for each setting that has an error.
pub struct Plot {
    /// What the name of the file ends in, before `.svg`.
    pub file: &'static str,
    /// What stands beside the point of a setting.
    pub label: fn(&Rung) -> String,
}

/// A file of comma-separated values.
pub struct Csv {
    /// Its name.
    pub file: &'static str,
    /// What it holds of all scenes.
    pub bytes: fn(&[SceneReport]) -> anyhow::Result<Vec<u8>>,
}

impl Content {
    /// Its section of the page, where something was measured.
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
    /// The name of its file of a scene.
    pub fn name(&self, stem: &str) -> String {
        format!("{stem}-{}.svg", self.file)
    }
}

/// The plot of a scene, where the table has one and was measured.
pub fn plot_of(table: &dyn Table, scene: &SceneReport) -> Option<String> {
    let plot = table.plot()?;
    let measured = scene.of_table(table.name()).next()?;
    Some(draw(&scene.stem, "milliseconds of a picture", &marks(measured, plot.label)))
}

fn marks(measured: &Measured, label: fn(&Rung) -> String) -> Vec<Mark> {
    let point =
        |record: &Record| Point { cost: record.time().median, psnr_db: record.psnr_db().unwrap_or(f64::NAN) };
    // What others are compared with has no error of its own.
    let judged = settings(measured).filter(|(_, record)| record.error.is_some());
    let (rungs, points): (Vec<_>, Vec<_>) = judged.map(|(rung, record)| (rung, point(record))).unzip();
    let front = pareto::front(&points);
    let marks = rungs.into_iter().zip(points).zip(front);
    marks
        .map(|((rung, point), front)| Mark { label: label(rung), family: rung.family, point, front })
        .collect()
}

/// The scenes' measurements for the table of that name.
pub fn measured<'s>(
    scenes: &'s [SceneReport],
    table: &'s str,
) -> impl Iterator<Item = (&'s SceneReport, &'s Measured)> {
    scenes.iter().flat_map(move |scene| scene.of_table(table).map(move |measured| (scene, measured)))
}

/// The settings of a job with their records.
pub fn settings(measured: &Measured) -> impl Iterator<Item = (&Rung, &Record)> {
    measured.job.rungs.iter().zip(&measured.records)
}
