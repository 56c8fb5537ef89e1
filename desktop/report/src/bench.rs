//! Renders and times the settings that have no stored result yet.

use std::cell::OnceCell;

use anyhow::Context;
use glimpse::{Demands, DisplayImage, Gpu, Missing, PixelRecord, Renderer, metrics, probe};
use glimpse_measure::progress::Progress;
use glimpse_measure::statistics::timed;

use crate::complete::{Measure, complete, groups};
use crate::job::Job;
use crate::record::{Frame, Record};
use crate::rung::Rung;
use crate::store::Store;
use crate::subject::{Prepared, Subject, Subjects};
use crate::upscale::bilinear;
use crate::work::Work;

/// Cost of inspecting a setting (counting its rays), in warm frames; used to estimate progress.
const LOOK: u64 = 2;

/// The device and the store shared by all measurements.
pub struct Bench<'b> {
    /// Device that renders.
    pub gpu: &'b Gpu,
    /// Adapter name with backend and driver, and the model of the processor.
    pub adapter: String,
    /// Fingerprint of the program's executable.
    pub program: String,
    /// Store of the results.
    pub store: &'b Store,
    /// Number of timed frames of each setting.
    pub frames: usize,
}

/// A job with the results already in the store.
pub struct Known {
    /// Job to be measured.
    pub job: Job,
    /// Identity of each setting, by the index of its rung.
    pub identities: Vec<String>,
    /// Setting and identity of the converged frame, if the job measures errors against one.
    pub converged: Option<(Rung, String)>,
    recalled: Vec<Option<Record>>,
    has_converged: bool,
}

/// A job with its complete results.
pub struct Measured {
    /// Job that was measured.
    pub job: Job,
    /// Identity of each setting, by the index of its rung.
    pub identities: Vec<String>,
    /// Identity under which the converged frame is stored.
    pub converged: Option<String>,
    /// Record of each setting, by the index of its rung.
    pub records: Vec<Record>,
}

impl Bench<'_> {
    /// Looks up which results of a job are in the store.
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

    /// Renders and times what a job lacks, and stores each result.
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
            // Another job with the same reference may have rendered it since `recall`.
            if self.store.picture(&identity, job.shown).is_none() {
                progress.doing(&format!("{}: converged", scene.name));
                let picture = self.warm(subject, scene, &job, &rung)?.display_image()?;
                self.store.keep_picture(&identity, &picture)?;
            }
            progress.steps(rung.samples());
        }
        let camera = job.view(scene, 0);
        // Objects that full ray tracing shows, for which the pixels of every other setting are searched.
        let objects = if lacks_objects {
            progress.doing(&format!("{}: objects of {}", scene.name, job.rungs[0].name));
            let inspection = self.warm(subject, scene, &job, &job.rungs[0])?.inspect(&camera)?;
            progress.steps((1 + LOOK) * job.rungs[0].samples());
            OnceCell::from(inspection.pixels)
        } else {
            OnceCell::new()
        };
        let converged = converged_identity.as_ref();
        let settings = OfJob {
            bench: self,
            progress,
            subject,
            scene,
            job: &job,
            identities: &identities,
            converged,
            objects,
        };
        let records = complete(self.store, recalled, self.frames, job.control, &settings)?;
        Ok(Measured { job, identities, converged: converged_identity, records })
    }

    /// Loads the stored picture that errors are measured against.
    fn reference(&self, identity: &str, job: &Job) -> anyhow::Result<DisplayImage> {
        let picture = self.store.picture(identity, job.shown);
        picture.context("the reference picture is gone: it was removed while Glimpse was measuring")
    }

    /// Creates a renderer and renders until the picture has all its samples. This also warms it up: drivers
    /// finish compiling in the first frame.
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

/// Measures the settings of a job.
struct OfJob<'j> {
    bench: &'j Bench<'j>,
    progress: &'j Progress,
    subject: &'j Subject,
    scene: &'j Prepared,
    job: &'j Job,
    identities: &'j [String],
    /// Identity of the converged frame.
    converged: Option<&'j String>,
    /// Pixels of full ray tracing, once they are inspected.
    objects: OnceCell<Vec<PixelRecord>>,
}

impl OfJob<'_> {
    /// Identity of the picture that the error of a setting is measured against.
    fn against(&self, index: usize) -> Option<&String> {
        self.converged.or_else(|| (index > 0).then(|| &self.identities[0]))
    }
}

impl Measure for OfJob<'_> {
    /// The renderer and the number of frames that were timed.
    type Open = (Renderer, i32);

    fn open(&self, index: usize) -> anyhow::Result<Self::Open> {
        let rung = &self.job.rungs[index];
        self.progress.doing(&format!("{}: {}", self.scene.name, rung.name));
        let renderer = self.bench.warm(self.subject, self.scene, self.job, rung)?;
        self.progress.steps(rung.samples());
        Ok((renderer, 0))
    }

    fn look(&self, index: usize, (renderer, _): &mut Self::Open) -> anyhow::Result<Record> {
        let (job, rung) = (self.job, &self.job.rungs[index]);
        let picture = shown(renderer.display_image()?, job.shown);
        let error_of = |identity: &String| {
            anyhow::Ok(metrics::compare(&picture, &self.bench.reference(identity, job)?)?)
        };
        let error = self.against(index).map(error_of).transpose()?;
        let first = (index > 0 && job.is_against_first_too()).then(|| &self.identities[0]);
        let error_of_first = first.map(error_of).transpose()?;
        if rung.keeps_picture {
            self.bench.store.keep_picture(&self.identities[index], &picture)?;
        }
        let inspection = renderer.inspect(&job.view(self.scene, 0))?;
        self.progress.steps(LOOK * rung.samples());
        let identity = self.identities[index].clone();
        let record = Record::new(identity, job.shown, &inspection, &self.subject.reflects, error);
        let missing = self.objects.get().and_then(|full| Missing::of(full, &inspection.pixels));
        let lights = self.scene.statistics.lights;
        let work = job.counts_work.then(|| {
            let demands = Demands::of(&self.subject.scene, renderer.settings())?;
            anyhow::Ok(Work::of(&inspection, &demands, lights))
        });
        let work = work.transpose()?;
        if job.counts_missing {
            self.objects.get_or_init(|| inspection.pixels);
        }
        Ok(Record { error_of_first, missing, work, ..record })
    }

    fn time(&self, index: usize, (renderer, timed_frames): &mut Self::Open) -> anyhow::Result<Frame> {
        *timed_frames += 1;
        let rung = &self.job.rungs[index];
        let view = self.job.view(self.scene, *timed_frames);
        let (frame, ms) = timed(|| renderer.render(&view))?;
        self.progress.steps(rung.samples());
        // Without timestamp queries the renderer reports no times, and the CPU clock is used.
        let frame = if frame.passes.is_empty() {
            Frame { ms, control_ms: None, passes: vec![], peak_gflops: None }
        } else {
            frame.into()
        };
        let frame = frame.times(rung.timed_frames() as f64);
        let peak = self.job.counts_work.then(|| probe::peak_gflops(self.bench.gpu)).transpose()?;
        Ok(Frame { peak_gflops: peak.flatten(), ..frame })
    }

    fn opened(&self) {
        self.bench.gpu.trim();
    }
}

impl Known {
    /// Number of settings with complete results, and number of all settings.
    pub fn complete(&self, frames: usize) -> [usize; 2] {
        let complete = self.recalled.iter().filter(|r| lacking(r.as_ref(), frames) == 0);
        [complete.count(), self.recalled.len()]
    }

    /// Whether settings remain to be searched for missing objects although full ray tracing, which shows
    /// these objects, is already recorded: it must then be inspected once more.
    fn lacks_objects(&self) -> bool {
        let [full, others @ ..] = self.recalled.as_slice() else { return false };
        self.job.counts_missing && full.is_some() && others.iter().any(Option::is_none)
    }

    /// Number of samples still to be rendered, the unit of the progress bar.
    pub fn work(&self, frames: usize) -> u64 {
        let converged = self.converged.as_ref().filter(|_| !self.has_converged);
        let rungs = self.job.rungs.iter().zip(&self.recalled);
        let objects = self.job.rungs.first().filter(|_| self.lacks_objects());
        rungs.map(|(rung, recalled)| rung.samples() * lacking(recalled.as_ref(), frames)).sum::<u64>()
            + converged.map_or(0, |(rung, _)| rung.samples())
            + objects.map_or(0, |rung| (1 + LOOK) * rung.samples())
            + self.controls(frames)
    }

    /// Number of samples of the control's frames that go into no record of its own.
    fn controls(&self, frames: usize) -> u64 {
        let Some(control) = self.job.control else { return 0 };
        let has_lacking = |record: &Option<Record>| lacking(record.as_ref(), frames) > 0;
        let own = self.recalled.get(control).and_then(Option::as_ref).map_or(0, |record| record.frames.len());
        let others = self.recalled.iter().enumerate();
        let others = others.filter(|(index, record)| *index != control && has_lacking(record)).count();
        let rounds = groups(others, true) * frames;
        self.job.rungs[control].samples() * rounds.saturating_sub(frames.saturating_sub(own)) as u64
    }
}

/// Number of frames still to be rendered, with warm-up and inspection.
fn lacking(record: Option<&Record>, frames: usize) -> u64 {
    match record {
        None => 1 + LOOK + frames as u64,
        Some(record) => match frames.saturating_sub(record.frames.len()) {
            0 => 0,
            more => 1 + more as u64,
        },
    }
}

/// Upscales a picture of reduced resolution to the frame's size.
fn shown(picture: DisplayImage, size: [u32; 2]) -> DisplayImage {
    if <[u32; 2]>::from(picture.dimensions()) == size { picture } else { bilinear(&picture, size) }
}

#[cfg(test)]
mod tests {
    use glimpse::Settings;

    use super::*;
    use crate::ladder;

    #[test]
    fn the_controls_frames_beside_every_group_are_work() {
        let known = |control| {
            let job = Job { control, ..ladder::job(&Settings::default(), [10, 10]) };
            let recalled = vec![None; job.rungs.len()];
            Known { job, identities: vec![], converged: None, recalled, has_converged: true }
        };
        let control = known(None).job.rungs.iter().position(|rung| rung.samples() == 100).unwrap();
        let others = known(None).recalled.len() - 1;
        // Two others are open beside the control, and 3 of the control's frames are those of its record.
        let rounds = others.div_ceil(2) as u64 * 3;
        assert_eq!(known(Some(control)).work(3), known(None).work(3) + 100 * (rounds - 3));
    }
}
