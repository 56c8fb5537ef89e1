//! How the app handles messages of the worker, and which frame it requests next.

use crate::{App, Busy, CameraControl, Frame, News, Request, SceneFacts, Worker, app::MAX_LOSSES};

impl App {
    /// Handles all messages that have arrived.
    pub(crate) fn hear(&mut self) {
        while let Some(news) = self.device.worker().and_then(Worker::news) {
            self.take(news);
        }
    }

    pub(crate) fn take(&mut self, news: News) {
        match news {
            News::Loading(what, step) => self.readings.busy = Some(Busy { what, seconds: 0.0, step }),
            News::Opened(facts) => self.opened(*facts),
            News::NotOpened(line) => {
                self.delivery.load_failed();
                self.readings.busy = None;
                self.complain(line);
                if let Some(other) = self.scenes.not_opened() {
                    self.load(&other);
                }
            }
            News::Frame(frame) => self.framed(frame),
            News::GivenUp(number) => self.delivery.given_up(number),
            News::Counted(number, counted) => {
                if self.delivery.counts_arrived(number) {
                    self.readings.counts = Some(counted.counts);
                    self.readings.psnr_db = counted.psnr_db;
                }
            }
            News::Captured(picture) => {
                if let Some(file) = self.delivery.capture_arrived() {
                    self.requests.push(Request::Save(file, picture));
                }
            }
            News::Picked(point) => {
                self.delivery.pick_arrived();
                if let (Some(point), Some(control)) = (point, &mut self.control) {
                    control.focus(point);
                }
            }
            News::Failed(line) => {
                self.delivery.request_failed();
                self.readings.busy = None;
                self.complain(line);
            }
            News::Lost(reason) => self.lost(&reason),
        }
    }

    fn opened(&mut self, facts: SceneFacts) {
        let again = self.scenes.shown().is_some_and(|scene| scene.name == facts.name);
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
        self.delivery.scene_opened();
        self.device.scene_opened();
        if let Some(files) = self.scenes.opened(facts) {
            self.requests.push(Request::Remember(files.to_vec()));
        }
        self.order();
    }

    fn framed(&mut self, frame: Box<Frame>) {
        self.delivery.frame_arrived(frame.number, &frame.job, frame.settled);
        self.device.frame_arrived();
        if let Some(ms) = self.pacing.frame_arrived(&self.choices, &frame.job, frame.ms, frame.compiled) {
            self.readings.push_frame(ms as f32);
        }
        let readings = &mut self.readings;
        readings.busy = None;
        readings.passes.clone_from(&frame.passes);
        readings.size = frame.job.size;
        readings.memory = frame.memory;
        readings.legend.clone_from(&frame.legend);
        let exact = self.is_exact(&frame);
        self.delivery.present(&mut self.device, frame, exact);
    }

    /// Drops a lost device, or one whose worker ended, and requests a new one from the shell.
    pub(crate) fn lost(&mut self, reason: &str) {
        log::warn!("the graphics device was lost: {reason}");
        let losses = self.device.detach();
        self.delivery.clear_shown();
        self.readings.busy = None;
        if losses >= MAX_LOSSES {
            self.complain(format!("The graphics device was lost {MAX_LOSSES} times in a row: {reason}"));
        }
        self.requests.push(Request::NewDevice);
    }

    /// Requests the frame for the present state, unless it is shown, requested, or has failed.
    pub(crate) fn order(&mut self) {
        let moving = self.is_moving();
        let quality = self.pacing.advance(&self.choices, self.clock.now(), moving);
        self.readings.governor = self.pacing.description(&self.choices);
        let Some(job) = self.job(&quality).filter(|job| self.delivery.needs(job)) else { return };
        if let Some(worker) = self.device.ready_worker() {
            let number = worker.order(job.clone());
            self.delivery.frame_requested(number, job);
        }
    }
}
