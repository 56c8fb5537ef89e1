//! Handles messages of the worker, and requests the next frame.

use crate::{
    App, Busy, CameraControl, RenderedFrame, Request, SceneFacts, StartCamera, Worker, WorkerEvent,
    app::MAX_LOSSES,
};

impl App {
    /// Handles all messages that have arrived.
    pub(crate) fn poll_worker(&mut self) {
        while let Some(event) = self.device.worker().and_then(Worker::poll) {
            self.take(event);
        }
    }

    pub(crate) fn take(&mut self, event: WorkerEvent) {
        match event {
            WorkerEvent::Loading(what, step) => {
                self.hud_state.busy = Some(Busy { what, seconds: 0.0, unit: "step", step });
            }
            WorkerEvent::Compiling([done, of]) => {
                let what = format!("compiling for {}", self.hud_state.scene);
                let step = [(done + 1).min(of), of];
                self.hud_state.busy = Some(Busy { what, seconds: 0.0, unit: "kernel", step });
            }
            WorkerEvent::Opened(facts) => self.opened(*facts),
            WorkerEvent::OpenFailed(line) => {
                self.delivery.load_failed();
                self.hud_state.busy = None;
                self.report_problem(line);
                if let Some(other) = self.scenes.not_opened() {
                    self.load(&other);
                }
            }
            WorkerEvent::Rendering(number, share) => {
                if self.delivery.is_awaited(number) {
                    self.hud_state.rendered = Some(share);
                }
            }
            WorkerEvent::Frame(frame) => self.framed(frame),
            WorkerEvent::Cancelled(number) => {
                if self.delivery.is_awaited(number) {
                    self.hud_state.rendered = None;
                }
                self.delivery.given_up(number);
            }
            WorkerEvent::Counted(number, counted) => {
                self.requests.push(Request::KeepKernels);
                if self.delivery.counts_arrived(number) {
                    self.hud_state.counts = Some(counted.counts);
                    self.hud_state.psnr_db = counted.psnr_db;
                }
            }
            WorkerEvent::Captured(picture) => {
                if let Some(capture) = self.delivery.capture_arrived() {
                    self.requests.push(Request::Captured(capture, picture));
                }
            }
            WorkerEvent::Picked(point) => {
                self.delivery.pick_arrived();
                if let (Some(point), Some(control)) = (point, &mut self.control) {
                    control.focus(point);
                }
            }
            WorkerEvent::Listed(number, folder) => {
                if self.delivery.listing_arrived(number) {
                    self.hud_state.folder = Some(folder);
                }
            }
            WorkerEvent::Failed(line) => {
                self.delivery.request_failed();
                (self.hud_state.busy, self.hud_state.rendered) = (None, None);
                self.report_problem(line);
            }
            WorkerEvent::Lost(reason) => self.lost(&reason),
        }
    }

    fn opened(&mut self, facts: SceneFacts) {
        let again = self.scenes.shown().is_some_and(|scene| scene.name == facts.name);
        let hud_state = &mut self.hud_state;
        hud_state.scene.clone_from(&facts.name);
        hud_state.primitives = facts.primitives;
        hud_state.cameras = facts.cameras.iter().map(|(name, _)| name.clone()).collect();
        hud_state.warnings.clone_from(&facts.warnings);
        hud_state.not_shown.clone_from(&facts.not_shown);
        hud_state.not_shown_by.clone_from(&facts.not_shown_by);
        let named = |needed: bool| {
            let names = facts.features.iter().filter(move |(_, has)| *has == needed);
            names.map(|(name, _)| *name).collect()
        };
        (hud_state.features, hud_state.left_out) = (named(true), named(false));
        (hud_state.counts, hud_state.psnr_db) = (None, None);
        if !again || self.control.is_none() {
            let (index, free) = match facts.start {
                StartCamera::OfScene(index) => (index, None),
                StartCamera::Free(camera) => (0, Some(camera)),
            };
            hud_state.camera = index;
            let control = facts.cameras.get(index).map(|(_, home)| CameraControl::new(*home, facts.bounds));
            self.control = match free {
                Some(camera) => control.map(|control| control.moved_to(&camera)),
                None => control,
            };
        }
        self.delivery.scene_opened();
        self.device.scene_opened();
        if let Some(files) = self.scenes.opened(facts) {
            self.requests.push(Request::Remember(files.to_vec()));
        }
        self.order();
    }

    fn framed(&mut self, frame: Box<RenderedFrame>) {
        self.device.frame_arrived();
        if !frame.is_stand_in {
            self.requests.extend(frame.compiled.then_some(Request::KeepKernels));
            self.delivery.frame_arrived(frame.number, &frame.job, frame.settled);
            if let Some(ms) = self.pacing.frame_arrived(&self.choices, &frame.job, frame.ms, frame.compiled) {
                self.hud_state.push_frame(ms as f32);
            }
            self.hud_state.busy = None;
            let is_accumulating = frame.job.is_still() && !frame.settled;
            self.hud_state.rendered = is_accumulating.then_some(frame.samples_share.min(1.0));
        }
        let hud_state = &mut self.hud_state;
        hud_state.passes.clone_from(&frame.passes);
        hud_state.size = frame.job.size;
        hud_state.memory = frame.memory;
        hud_state.legend.clone_from(&frame.legend);
        let exact = self.is_exact(&frame);
        self.delivery.present(&mut self.device, frame, exact);
    }

    /// Drops a lost device, or one whose worker ended, and requests a new one from the shell.
    pub(crate) fn lost(&mut self, reason: &str) {
        log::warn!("the graphics device was lost: {reason}");
        let losses = self.device.detach();
        self.delivery.clear_shown();
        (self.hud_state.busy, self.hud_state.rendered) = (None, None);
        if losses >= MAX_LOSSES {
            self.report_problem(format!(
                "The graphics device was lost {MAX_LOSSES} times in a row: {reason}"
            ));
        }
        self.requests.push(Request::NewDevice);
    }

    /// Requests the frame for the current state, unless it is shown, requested, or has failed.
    pub(crate) fn order(&mut self) {
        let moving = self.is_moving();
        let quality = self.pacing.advance(&self.choices, self.clock.now(), moving);
        self.hud_state.governor = self.pacing.description(&self.choices);
        let Some(job) = self.next_job(&quality).filter(|job| self.delivery.needs(job)) else { return };
        if let Some(worker) = self.device.ready_worker() {
            let number = worker.order(job.clone());
            self.delivery.frame_requested(number, job);
        }
    }
}
