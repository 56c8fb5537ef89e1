//! The tables and figures of papers, measured for other scenes. Each file has the jobs, rows, published
//! figures and plot of one table; [`TABLES`] lists them for the command line and the page.

mod jin2009;
mod kim2016;
mod kim_sung2021;
mod pan;
mod phones;
#[cfg(test)]
mod tests;

use crate::job::Job;
use crate::ladder;
use crate::subject::Variant;
use crate::table::{Request, Table};

/// All tables, in the order of the page.
pub static TABLES: [&dyn Table; 11] = [
    &kim2016::table5::Resolutions,
    &kim2016::table3a::Kernels,
    &kim2016::table3b::Reflective,
    &kim2016::table3c::Views,
    &kim2016::table4::Hairball,
    &kim2016::missing::MissingObjects,
    &jin2009::table2::Supersampling,
    &jin2009::figure7::SingleAndMultiple,
    &kim_sung2021::TwoEyes,
    &pan::Pan,
    &phones::Phones,
];

/// Finds a table by its name, ignoring case.
pub fn named(name: &str) -> Option<&'static dyn Table> {
    TABLES.into_iter().find(|table| table.name().eq_ignore_ascii_case(name))
}

/// Jobs of a scene: the ladder, then those of the tables, without duplicates. Jobs with the unchanged scene
/// come first, as each variant needs an upload.
pub fn jobs(tables: &[&dyn Table], request: &Request<'_>) -> Vec<Job> {
    let mut jobs = vec![ladder::job(request.base, request.size)];
    for job in tables.iter().flat_map(|table| table.jobs(request)) {
        match jobs.iter_mut().find(|known| known.measures_the_same_as(&job)) {
            Some(known) => known.tables.extend(job.tables),
            None => jobs.push(job),
        }
    }
    jobs.sort_by_key(|job| job.variant != Variant::AsIs);
    jobs
}
