//! The frame's way from request to screen.

use std::path::PathBuf;

use super::device::DeviceState;
use crate::{Job, RenderedFrame};

/// Requests to the worker that have not been answered, and the frame that is shown.
#[derive(Default)]
pub(crate) struct Delivery {
    /// A scene is being loaded.
    loading: bool,
    /// The number and job of the last frame that was requested, until it arrives.
    requested: Option<(u64, Job)>,
    /// The job that could not be rendered: it is not requested again.
    failed: Option<Job>,
    /// The frame whose counters have not arrived.
    counting: Option<u64>,
    /// Where the picture that was requested is to be saved; the shell chooses the name where there is none.
    capture: Option<Option<PathBuf>>,
    /// The worker has not answered a request for a surface point.
    picking: bool,
    shown: Option<Shown>,
}

/// The frame that is shown, as textures of the overlay.
pub(crate) struct Shown {
    pub frame: Box<RenderedFrame>,
    pub picture: egui::TextureId,
    /// The picture by full ray tracing, where the view is split.
    pub full: Option<egui::TextureId>,
    /// Pixels are repeated, not interpolated.
    pub exact: bool,
}

impl Delivery {
    /// A scene is being loaded.
    pub fn load_requested(&mut self) {
        self.loading = true;
    }

    /// The scene could not be loaded.
    pub fn load_failed(&mut self) {
        self.loading = false;
    }

    /// A scene was loaded: the worker drops requests for frames of the one before.
    pub fn scene_opened(&mut self) {
        self.loading = false;
        (self.requested, self.counting, self.failed) = (None, None, None);
    }

    /// The frame of the job is neither shown nor on its way, and has not failed.
    pub fn needs(&self, job: &Job) -> bool {
        let requested = self.requested.as_ref().is_some_and(|(_, requested)| requested == job);
        !self.is_shown(job) && !requested && self.failed.as_ref() != Some(job)
    }

    /// A frame was requested, in place of the one before where that had not arrived.
    pub fn frame_requested(&mut self, number: u64, job: Job) {
        self.requested = Some((number, job));
    }

    /// A frame arrived. While the camera moves, newer requests overtake it.
    pub fn frame_arrived(&mut self, number: u64, job: &Job, settled: bool) {
        self.requested.take_if(|(requested, _)| *requested == number);
        // The worker counts in frames at rest.
        self.counting = (job.is_still() && settled).then_some(number);
    }

    /// The worker gave up a frame, or counting in it.
    pub fn given_up(&mut self, number: u64) {
        self.requested.take_if(|(requested, _)| *requested == number);
        self.counting.take_if(|counting| *counting == number);
    }

    /// The counters of a frame arrived; tells whether they are those that are waited for.
    pub fn counts_arrived(&mut self, number: u64) -> bool {
        self.counting.take_if(|counting| *counting == number).is_some()
    }

    /// A picture was requested, to be saved under that name.
    pub fn capture_requested(&mut self, file: Option<PathBuf>) {
        self.capture = Some(file);
    }

    /// A picture arrived; returns where it is to be saved. `None` where it is not waited for any more.
    pub fn capture_arrived(&mut self) -> Option<Option<PathBuf>> {
        self.capture.take()
    }

    /// A surface point was requested.
    pub fn pick_requested(&mut self) {
        self.picking = true;
    }

    /// A surface point arrived.
    pub fn pick_arrived(&mut self) {
        self.picking = false;
    }

    /// The worker failed at a request, of whatever kind: no answer comes to any that was made.
    pub fn request_failed(&mut self) {
        self.failed = self.requested.take().map(|(_, job)| job);
        (self.counting, self.capture, self.picking) = (None, None, false);
    }

    /// The worker has not answered everything.
    pub fn is_waiting(&self) -> bool {
        let Self { loading, requested, counting, capture, picking, failed: _, shown: _ } = self;
        *loading || requested.is_some() || counting.is_some() || capture.is_some() || *picking
    }

    /// A frame was requested and has not arrived.
    pub fn is_frame_requested(&self) -> bool {
        self.requested.is_some()
    }

    /// The job's frame is shown, and rendering it again would not change it.
    pub fn is_shown(&self, job: &Job) -> bool {
        self.shown.as_ref().is_some_and(|shown| shown.frame.job == *job && shown.frame.settled)
    }

    /// The job's frame is shown or has failed: nothing is to be requested. So it is without a job.
    pub fn is_complete(&self, job: Option<&Job>) -> bool {
        job == self.failed.as_ref() || job.is_some_and(|job| self.is_shown(job))
    }

    /// The frame that is shown.
    pub fn shown(&self) -> Option<&Shown> {
        self.shown.as_ref()
    }

    /// Shows a frame in place of the one before, with pixels repeated where they are `exact` on the screen.
    pub fn present(&mut self, device: &mut DeviceState, frame: Box<RenderedFrame>, exact: bool) {
        let (picture, full) = self.shown.take().map_or((None, None), |old| (Some(old.picture), old.full));
        self.register(device, frame, exact, picture, full);
    }

    /// Shows the same frame with or without interpolation.
    pub fn set_exact(&mut self, device: &mut DeviceState, exact: bool) {
        if let Some(shown) = self.shown.take_if(|shown| shown.exact != exact) {
            self.register(device, shown.frame, exact, Some(shown.picture), shown.full);
        }
    }

    /// Puts a frame into textures of the overlay, those of the frame before where there was one.
    fn register(
        &mut self,
        device: &mut DeviceState,
        frame: Box<RenderedFrame>,
        exact: bool,
        picture_before: Option<egui::TextureId>,
        full_before: Option<egui::TextureId>,
    ) {
        let Some((gpu, painter)) = device.painter() else { return };
        let picture = painter.register(gpu, &frame.picture, exact, picture_before);
        let full = match &frame.full {
            Some(full) => Some(painter.register(gpu, full, exact, full_before)),
            None => {
                full_before.iter().for_each(|id| painter.forget(*id));
                None
            }
        };
        self.shown = Some(Shown { frame, picture, full, exact });
    }

    /// The device is lost: nothing is shown.
    pub fn clear_shown(&mut self) {
        self.shown = None;
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use glimpse::{Camera, Settings, Show};

    use super::*;

    fn job(width: u32, level: Option<usize>) -> Job {
        Job {
            camera: Camera::framing(Vec3::NEG_ONE, Vec3::ONE),
            size: [width, 1],
            settings: Settings::default(),
            show: Show::Final,
            split: false,
            level,
        }
    }

    #[test]
    fn a_frame_is_requested_once() {
        let mut delivery = Delivery::default();
        assert!(delivery.needs(&job(1, None)) && !delivery.is_waiting());
        delivery.frame_requested(1, job(1, None));
        assert!(!delivery.needs(&job(1, None)) && delivery.is_waiting());
        assert!(delivery.needs(&job(2, None)), "another is");
    }

    #[test]
    fn a_frame_that_was_overtaken_leaves_the_newer_request() {
        let mut delivery = Delivery::default();
        delivery.frame_requested(2, job(2, Some(0)));
        delivery.frame_arrived(1, &job(1, Some(0)), true);
        assert!(delivery.is_frame_requested());
        delivery.given_up(1);
        assert!(delivery.is_frame_requested());
        delivery.frame_arrived(2, &job(2, Some(0)), true);
        assert!(!delivery.is_waiting(), "frames of a moving camera are not counted");
    }

    #[test]
    fn the_counters_of_a_frame_at_rest_are_waited_for() {
        let mut delivery = Delivery::default();
        delivery.frame_arrived(1, &job(1, None), false);
        assert!(!delivery.is_waiting(), "a frame that is not settled is not counted");
        delivery.frame_arrived(2, &job(1, None), true);
        assert!(delivery.is_waiting());
        assert!(!delivery.counts_arrived(1) && delivery.is_waiting(), "those of an older frame");
        assert!(delivery.counts_arrived(2) && !delivery.is_waiting());
    }

    #[test]
    fn a_job_that_failed_is_not_requested_again_until_another_scene_opens() {
        let mut delivery = Delivery::default();
        assert!(!delivery.is_complete(Some(&job(1, None))));
        delivery.frame_requested(1, job(1, None));
        delivery.capture_requested(None);
        delivery.pick_requested();
        delivery.request_failed();
        assert!(!delivery.is_waiting() && !delivery.needs(&job(1, None)));
        assert!(delivery.is_complete(Some(&job(1, None))));
        delivery.load_requested();
        assert!(delivery.is_waiting());
        delivery.scene_opened();
        assert!(!delivery.is_waiting() && delivery.needs(&job(1, None)));
    }

    #[test]
    fn a_picture_is_saved_once_where_it_was_to_be() {
        let mut delivery = Delivery::default();
        assert_eq!(delivery.capture_arrived(), None);
        delivery.capture_requested(Some("a.png".into()));
        assert!(delivery.is_waiting());
        assert_eq!(delivery.capture_arrived(), Some(Some("a.png".into())));
        assert!(!delivery.is_waiting());
    }
}
