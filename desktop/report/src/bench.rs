//! The measuring itself: what is not kept yet is rendered.

use std::cell::OnceCell;

use anyhow::Context;
use glimpse::{Demands, DisplayImage, Gpu, Missing, Renderer, metrics, probe};
use glimpse_measure::progress::Progress;
use glimpse_measure::statistics::timed;

use crate::complete::complete;
use crate::job::Job;
use crate::record::{Frame, Record};
use crate::rung::Rung;
use crate::store::Store;
use crate::subject::{Prepared, Subject, Subjects};
use crate::upscale::bilinear;
use crate::work::Work;

/// What counting the rays costs, in warm frames.
const LOOK: u64 = 2;

/// Everything that measurements need besides a scene.
pub struct Bench<'b> {
    /// The device.
    pub gpu: &'b Gpu,
    /// Its name with the driver.
    pub adapter: String,
    /// Fingerprint of the program.
    pub program: String,
    /// Where results are kept.
    pub store: &'b Store,
    /// Warm frames of each setting.
    pub frames: usize,
}

/// A job with what is kept of it.
pub struct Known {
    /// What is to be measured.
    pub job: Job,
    /// Of each setting.
    pub identities: Vec<String>,
    /// The converged frame, where errors are measured against one.
    pub converged: Option<(Rung, String)>,
    recalled: Vec<Option<Record>>,
    has_converged: bool,
}

/// A job with its results.
pub struct Measured {
    /// What was measured.
    pub job: Job,
    /// Of each setting.
    pub identities: Vec<String>,
    /// The name under which the converged frame is kept.
    pub converged: Option<String>,
    /// Of each setting.
    pub records: Vec<Record>,
}

impl Bench<'_> {
    /// What is kept of a job.
    pub fn recall(&self, scene: &Prepared, job: Job) -> anyhow::Result<Known> {
        let identities = job.identities(&self.program, &self.adapter, scene)?;
        let converged = job.converged(&self.program, scene)?;
        let picture = |identity: &str| self.store.picture(identity, job.shown).is_some();
        let recalled = identities.iter().zip(&job.rungs).enumerate().map(|(index, (identity, rung))| {
            let complete = |r: &Record| job.accepts(index, r) && (!rung.keeps_picture || picture(identity));
            self.store.record(identity).filter(complete)
        });
        let recalled = recalled.collect();
        let has_converged = converged.as_ref().is_none_or(|(_, identity)| picture(identity));
        Ok(Known { job, identities, converged, recalled, has_converged })
    }

    /// Renders what is missing.
    pub fn measure(
        &self,
        subjects: &mut Subjects<'_>,
        scene: &Prepared,
        known: Known,
        progress: &Progress,
    ) -> anyhow::Result<Measured> {
        let lacks_objects = known.lacks_objects();
        let Known { job, identities, converged, recalled, has_converged } = known;
        let done = has_converged && recalled.iter().all(|r| lacking(r.as_ref(), self.frames) == 0);
        let converged_identity = converged.as_ref().map(|(_, identity)| identity.clone());
        if done {
            let records = recalled.into_iter().flatten().collect();
            return Ok(Measured { job, identities, converged: converged_identity, records });
        }
        progress.doing(&format!("{}: loading", scene.name));
        let subject = subjects.get(job.variant)?;
        if let Some((rung, identity)) = converged.filter(|_| !has_converged) {
            // Another job of this frame may have made it meanwhile.
            if self.store.picture(&identity, job.shown).is_none() {
                progress.doing(&format!("{}: converged", scene.name));
                let picture = self.warm(subject, scene, &job, &rung)?.display_image()?;
                self.store.keep_picture(&identity, &picture)?;
            }
            progress.steps(rung.samples());
        }
        let against = |index: usize| match &converged_identity {
            Some(identity) => Some(identity),
            None => (index > 0).then(|| &identities[0]),
        };
        let camera = job.view(scene, 0);
        // What full tracing shows, which every other setting is searched for.
        let objects = if lacks_objects {
            progress.doing(&format!("{}: objects of {}", scene.name, job.rungs[0].name));
            let inspection = self.warm(subject, scene, &job, &job.rungs[0])?.inspect(&camera)?;
            progress.steps((1 + LOOK) * job.rungs[0].samples());
            OnceCell::from(inspection.pixels)
        } else {
            OnceCell::new()
        };
        let records = complete(
            self.store,
            recalled,
            self.frames,
            |index| {
                let rung = &job.rungs[index];
                progress.doing(&format!("{}: {}", scene.name, rung.name));
                let renderer = self.warm(subject, scene, &job, rung)?;
                progress.steps(rung.samples());
                Ok((renderer, 0))
            },
            |index, (renderer, _)| {
                let rung = &job.rungs[index];
                let picture = shown(renderer.display_image()?, job.shown);
                let error_of = |identity: &String| {
                    anyhow::Ok(metrics::compare(&picture, &self.reference(identity, &job)?)?)
                };
                let error = against(index).map(error_of).transpose()?;
                let first = (index > 0 && job.is_against_first_too()).then(|| &identities[0]);
                let error_of_first = first.map(error_of).transpose()?;
                if rung.keeps_picture {
                    self.store.keep_picture(&identities[index], &picture)?;
                }
                let inspection = renderer.inspect(&camera)?;
                progress.steps(LOOK * rung.samples());
                let identity = identities[index].clone();
                let record = Record::new(identity, job.shown, &inspection, &subject.reflects, error);
                let missing = objects.get().and_then(|full| Missing::of(full, &inspection.pixels));
                let lights = scene.statistics.lights;
                let work = job.counts_work.then(|| {
                    let demands = Demands::of(&subject.scene, renderer.settings())?;
                    anyhow::Ok(Work::of(&inspection, &demands, lights))
                });
                let work = work.transpose()?;
                if job.counts_missing {
                    objects.get_or_init(|| inspection.pixels);
                }
                Ok(Record { error_of_first, missing, work, ..record })
            },
            |index, (renderer, timed_frames)| {
                *timed_frames += 1;
                let view = job.view(scene, *timed_frames);
                let (frame, ms) = timed(|| renderer.render(&view))?;
                progress.steps(job.rungs[index].samples());
                // Adapters without timestamps measure nothing.
                let frame = if frame.passes.is_empty() {
                    Frame { ms, passes: vec![], peak_gflops: None }
                } else {
                    frame.into()
                };
                let frame = frame.times(job.rungs[index].timed_frames() as f64);
                let peak = job.counts_work.then(|| probe::peak_gflops(self.gpu)).transpose()?;
                Ok(Frame { peak_gflops: peak.flatten(), ..frame })
            },
        )?;
        Ok(Measured { job, identities, converged: converged_identity, records })
    }

    /// The kept picture that errors are measured against.
    fn reference(&self, identity: &str, job: &Job) -> anyhow::Result<DisplayImage> {
        let picture = self.store.picture(identity, job.shown);
        picture.context("the reference picture is gone: it was removed while Glimpse was measuring")
    }

    /// Compiled, and past its first frame, in which drivers finish compiling.
    fn warm(&self, subject: &Subject, scene: &Prepared, job: &Job, rung: &Rung) -> anyhow::Result<Renderer> {
        let name = || format!("{}: {}", scene.name, rung.name);
        let mut renderer =
            Renderer::new(self.gpu, &subject.scene, rung.rendered, &rung.settings).with_context(name)?;
        for frame in 1 - i32::try_from(rung.frames()).unwrap_or(i32::MAX)..=0 {
            renderer.render(&job.view(scene, frame)).with_context(name)?;
        }
        Ok(renderer)
    }
}

impl Known {
    /// The settings that are complete, and how many there are.
    pub fn complete(&self, frames: usize) -> [usize; 2] {
        let complete = self.recalled.iter().filter(|r| lacking(r.as_ref(), frames) == 0);
        [complete.count(), self.recalled.len()]
    }

    /// Settings are still to be searched for objects, but full tracing, which shows these, is not to be looked at for
    /// its own sake.
    fn lacks_objects(&self) -> bool {
        let [full, others @ ..] = self.recalled.as_slice() else { return false };
        self.job.counts_missing && full.is_some() && others.iter().any(Option::is_none)
    }

    /// Samples that are still to be rendered.
    pub fn work(&self, frames: usize) -> u64 {
        let converged = self.converged.as_ref().filter(|_| !self.has_converged);
        let rungs = self.job.rungs.iter().zip(&self.recalled);
        let objects = self.job.rungs.first().filter(|_| self.lacks_objects());
        rungs.map(|(rung, recalled)| rung.samples() * lacking(recalled.as_ref(), frames)).sum::<u64>()
            + converged.map_or(0, |(rung, _)| rung.samples())
            + objects.map_or(0, |rung| (1 + LOOK) * rung.samples())
    }
}

/// Frames that are still to be rendered, warm-up and counting included.
fn lacking(record: Option<&Record>, frames: usize) -> u64 {
    match record {
        None => 1 + LOOK + frames as u64,
        Some(record) => match frames.saturating_sub(record.frames.len()) {
            0 => 0,
            more => 1 + more as u64,
        },
    }
}

/// As it is shown: at the frame's size.
fn shown(picture: DisplayImage, size: [u32; 2]) -> DisplayImage {
    if <[u32; 2]>::from(picture.dimensions()) == size { picture } else { bilinear(&picture, size) }
}
