//! Frames whose kernels are not compiled yet: their requests wait, and another frame stands in for them.

use std::collections::VecDeque;

use glimpse::{Camera, Compilation, Purpose, Renderer, Result, Settings, Show};

use super::{Job, RenderedFrame, SceneRenderer, full};
use crate::{compiler::CompileRequest, worker::WorkerEvent};

/// Requests that wait for kernels.
#[derive(Default)]
pub(super) struct Waiting {
    pub frame: Option<(u64, Job)>,
    pub capture: Option<Job>,
    /// Number, camera and split of the frame whose rays are to be counted.
    pub count: Option<(u64, Camera, bool)>,
}

/// What decides which kernels a job needs.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Needs {
    size: [u32; 2],
    settings: Settings,
    split: bool,
    counters: bool,
}

impl Needs {
    pub fn of(job: &Job) -> Self {
        let Job { size, settings, split, show, .. } = job;
        Self { size: *size, settings: *settings, split: *split, counters: *show != Show::Final }
    }
}

impl SceneRenderer<'_> {
    /// Serves what waited for kernels; all of it fails where these could not be compiled.
    pub(super) fn compiled(&mut self, compiled: Result<()>) -> Result<()> {
        let Waiting { frame, capture, count } = std::mem::take(&mut self.waiting);
        compiled.inspect_err(|_| self.requested = None)?;
        if let Some(job) = capture {
            self.capture(job)?;
        }
        if let Some((number, job)) = frame {
            self.frame(number, job)?;
        }
        if let Some((number, camera, split)) = count {
            self.count(number, camera, split)?;
        }
        Ok(())
    }

    /// The kernels that are not compiled yet.
    pub(super) fn missing(&mut self, needs: Needs) -> Result<VecDeque<Compilation>> {
        let mut missing = VecDeque::new();
        if self.ready == Some(needs) {
            return Ok(missing);
        }
        let Needs { size, settings, split, counters } = needs;
        let mut wanted = vec![(settings, Purpose::Frame)];
        wanted.extend(counters.then_some((settings, Purpose::Counters)));
        wanted.extend(split.then_some((full(&settings), Purpose::Frame)));
        for (settings, purpose) in wanted {
            missing.extend(self.uncompiled(size, &settings, purpose)?);
        }
        if missing.is_empty() {
            self.ready = Some(needs);
        }
        Ok(missing)
    }

    pub(super) fn uncompiled(
        &self,
        size: [u32; 2],
        settings: &Settings,
        purpose: Purpose,
    ) -> Result<Option<Compilation>> {
        let kernels = Renderer::compilation(self.gpu, self.scene, size, settings, purpose)?;
        Ok((kernels.remaining() > 0).then_some(kernels))
    }

    /// Requests kernels, unless they are being compiled.
    pub(super) fn request(&mut self, needs: Needs, missing: VecDeque<Compilation>) {
        if self.requested.replace(needs) != Some(needs) {
            self.compiler.request(CompileRequest { renderers: missing, is_told: true });
        }
    }

    /// Requests the missing kernels, and shows meanwhile what can be rendered without them.
    pub(super) fn stand_in(
        &mut self,
        number: u64,
        job: Job,
        mut missing: VecDeque<Compilation>,
    ) -> Result<()> {
        let has_last = match &self.shown {
            Some(last) => self.uncompiled(job.size, last.settings(), Purpose::Frame)?.is_none(),
            None => false,
        };
        if !has_last && let Some(preview) = self.uncompiled(job.size, &job.settings, Purpose::Preview)? {
            missing.push_front(preview);
            self.request(Needs::of(&job), missing);
            self.waiting.frame = Some((number, job));
            return Ok(());
        }
        self.request(Needs::of(&job), missing);
        self.waiting.frame = Some((number, job.clone()));
        if job.is_refined && has_last {
            // The chosen frame of the same camera is on display.
            return Ok(());
        }
        let renderer = match &mut self.shown {
            Some(last) if has_last => {
                let settings = *last.settings();
                last.change(job.size, &settings)?;
                last
            }
            _ => {
                let size = job.size.map(|side| side.div_ceil(2));
                let mut preview = match self.preview.take() {
                    Some(preview) => preview,
                    None => Renderer::preview(self.gpu, self.scene, size)?,
                };
                preview.change(size, &job.settings)?;
                self.preview.insert(preview)
            }
        };
        let time = renderer.render(&job.camera)?;
        let (memory, display) = (renderer.memory(), renderer.display().clone());
        let picture = self.handed_out(&display);
        self.event_sender.send(WorkerEvent::Frame(Box::new(RenderedFrame {
            number,
            job,
            picture,
            full: None,
            ms: time.ms,
            is_stand_in: true,
            settled: false,
            samples_share: 0.0,
            compiled: true,
            passes: time.passes,
            memory,
            legend: String::new(),
        })));
        Ok(())
    }
}
