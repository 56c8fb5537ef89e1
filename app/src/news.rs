//! What the app does with what the worker tells, and what it orders next.

use crate::{
    App, Busy, CameraControl, Frame, FrameReport, News, Quality, Request, SceneFacts, Worker,
    app::{Device, LOSSES, Ordered, Shown},
};

impl App {
    /// Takes all news.
    pub(crate) fn hear(&mut self) {
        while let Some(news) = self.worker().and_then(Worker::news) {
            self.take(news);
        }
    }

    pub(crate) fn take(&mut self, news: News) {
        match news {
            News::Loading(what, step) => self.readings.busy = Some(Busy { what, seconds: 0.0, step }),
            News::Opened(facts) => self.opened(*facts),
            News::NotOpened(line) => {
                self.pending.load = false;
                self.readings.busy = None;
                self.complain(line);
                self.come_back();
            }
            News::Frame(frame) => self.framed(frame),
            News::GivenUp(number) => {
                self.pending.frame.take_if(|coming| coming.number == number);
                self.pending.count.take_if(|coming| *coming == number);
            }
            News::Counted(number, counted) => {
                if self.pending.count == Some(number) {
                    self.pending.count = None;
                    self.readings.counts = Some(counted.counts);
                    self.readings.psnr_db = counted.psnr_db;
                }
            }
            News::Captured(picture) => {
                if let Some(file) = self.pending.capture.take() {
                    self.requests.push(Request::Save(file, picture));
                }
            }
            News::Picked(point) => {
                self.pending.pick = false;
                if let (Some(point), Some(control)) = (point, &mut self.control) {
                    control.focus(point);
                }
            }
            News::Failed(line) => {
                self.pending.vain = self.pending.frame.take().map(|ordered| ordered.job);
                (self.pending.count, self.pending.capture) = (None, None);
                self.pending.pick = false;
                self.readings.busy = None;
                self.complain(line);
            }
            News::Lost(reason) => self.lost(&reason),
        }
    }

    /// The scene that is shown is the one to come back to; where there is none yet, the first of the built-in ones.
    fn come_back(&mut self) {
        match (&self.scene, crate::scenes().next()) {
            (Some(scene), _) => self.wanted.clone_from(&scene.name),
            (None, Some(first)) if self.wanted != first => {
                self.load(&first);
                self.wanted = first;
            }
            _ => {}
        }
    }

    fn opened(&mut self, facts: SceneFacts) {
        let again = self.scene.as_ref().is_some_and(|scene| scene.name == facts.name);
        let readings = &mut self.readings;
        readings.scene.clone_from(&facts.name);
        readings.primitives = facts.primitives;
        readings.cameras = facts.cameras.iter().map(|(name, _)| name.clone()).collect();
        readings.warnings.clone_from(&facts.warnings);
        let named = |needed: bool| {
            let names = facts.features.iter().filter(move |(_, has)| *has == needed);
            names.map(|(name, _)| *name).collect()
        };
        (readings.features, readings.left_out) = (named(true), named(false));
        (readings.counts, readings.psnr_db) = (None, None);
        if !again || self.control.is_none() {
            readings.camera = 0;
            self.control = facts.cameras.first().map(|(_, camera)| CameraControl::new(*camera, facts.bounds));
        }
        self.pending.load = false;
        // Frames that were ordered are of the scene before, and are not made any more.
        (self.pending.frame, self.pending.count, self.pending.vain) = (None, None, None);
        self.device.iter_mut().for_each(|device| device.ready = true);
        self.remember(&facts.name);
        self.scene = Some(facts);
        self.order();
    }

    fn framed(&mut self, frame: Box<Frame>) {
        // While the view moves, orders overtake frames: every frame is shown.
        self.pending.frame.take_if(|coming| coming.number == frame.number);
        self.pending.count = (frame.job.is_still() && frame.settled).then_some(frame.number);
        self.losses = 0;
        let pixels = frame.job.size.map(u64::from).iter().product();
        let ms = self.cost.map_or(frame.ms, |cost| cost * pixels as f64 * 1e-6);
        if !frame.compiled {
            self.frames += 1;
            let governed = self.choices.governed().is_some();
            self.report = governed.then_some(FrameReport { level: frame.job.level, pixels, ms });
            if governed && !frame.job.is_still() {
                self.tally.frames += 1;
                self.tally.late += u32::from(ms > self.governor.limit_ms());
            }
            self.readings.push_frame(ms as f32);
        }
        let readings = &mut self.readings;
        readings.busy = None;
        readings.passes.clone_from(&frame.passes);
        readings.size = frame.job.size;
        readings.memory = frame.memory;
        readings.legend.clone_from(&frame.legend);
        let (known, known_full) =
            self.shown.take().map_or((None, None), |shown| (Some(shown.picture), shown.full));
        self.present(frame, known, known_full);
    }

    /// Shows a frame, in the textures that the overlay knows already.
    pub(crate) fn present(
        &mut self,
        frame: Box<Frame>,
        known: Option<egui::TextureId>,
        known_full: Option<egui::TextureId>,
    ) {
        let exact = self.is_exact(&frame);
        let Some(Device { gpu, painter, .. }) = &mut self.device else { return };
        let picture = painter.register(gpu, &frame.picture, exact, known);
        let full = match &frame.full {
            Some(full) => Some(painter.register(gpu, full, exact, known_full)),
            None => {
                known_full.iter().for_each(|id| painter.forget(*id));
                None
            }
        };
        self.shown = Some(Shown { frame, picture, full, exact });
    }

    /// The device or its thread is gone.
    pub(crate) fn lost(&mut self, reason: &str) {
        self.losses += 1;
        log::warn!("the graphics device was lost: {reason}");
        self.device = None;
        self.shown = None;
        self.readings.busy = None;
        if self.losses >= LOSSES {
            self.complain(format!("The graphics device was lost {LOSSES} times in a row: {reason}"));
        }
        self.requests.push(Request::NewDevice);
    }

    /// Orders the frame that this moment needs, if it is not there and not being made.
    pub(crate) fn order(&mut self) {
        self.quality = self.next_quality();
        self.readings.governor = self.governor_at_work();
        let Some(job) = self.job(&self.quality) else { return };
        let known = self.is_shown(&job);
        let coming = self.pending.frame.as_ref().is_some_and(|coming| coming.job == job);
        if known || coming || self.pending.vain.as_ref() == Some(&job) {
            return;
        }
        if let Some(worker) = self.ready_worker() {
            let number = worker.order(job.clone());
            self.pending.frame = Some(Ordered { number, job });
        }
    }

    /// What the governor does, for people.
    fn governor_at_work(&self) -> String {
        let Quality { level, scale, block, relax } = self.quality;
        match (self.choices.governed(), level) {
            (None, _) => String::new(),
            (Some(_), None) => "at rest: everything as chosen".to_owned(),
            (Some(_), Some(level)) => format!(
                "level {level}: {:.0} % a side, blocks from {block}, tolerances x {relax:.1}, at most {:.1} ms",
                100.0 * scale,
                self.governor.limit_ms()
            ),
        }
    }

    /// The quality that the governor allows now.
    fn next_quality(&mut self) -> Quality {
        let moving = self.is_moving();
        let Some(rate) = self.choices.governed() else {
            // What a frame keeps must not be given up with it.
            let keeps = moving && self.choices.settings.method.keeps_frames();
            return Quality { level: keeps.then_some(0), ..self.still_quality() };
        };
        self.governor.set_budget(rate.budget_ms());
        self.governor.next(self.now, self.report.take(), moving)
    }
}
