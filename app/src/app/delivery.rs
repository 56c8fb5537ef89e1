//! Tracks frames from request to screen.

use super::{device::DeviceState, update::Capture};
use crate::{Job, RenderedFrame};

/// The unanswered requests to the worker, and the frame on display.
#[derive(Default)]
pub(crate) struct Delivery {
    /// Whether a scene is being loaded.
    loading: bool,
    /// Number and job of the frame requested last, until it arrives.
    requested: Option<(u64, Job)>,
    /// Job that failed to render and is not requested again.
    failed: Option<Job>,
    /// Number of the frame whose counters have not arrived.
    counting: Option<u64>,
    /// Use of the requested picture.
    capture: Option<Capture>,
    /// Whether a requested surface point has not arrived.
    picking: bool,
    /// Number of the folder requested last, until it arrives.
    listing: Option<u64>,
    shown: Option<Shown>,
}

/// The frame on display, as textures of the overlay.
pub(crate) struct Shown {
    pub frame: Box<RenderedFrame>,
    pub picture: egui::TextureId,
    /// The picture by full ray tracing, if the view is split.
    pub full: Option<egui::TextureId>,
    /// Whether pixels are repeated (nearest filtering) instead of interpolated.
    pub exact: bool,
}

impl Delivery {
    /// Records that loading a scene was requested.
    pub fn load_requested(&mut self) {
        self.loading = true;
    }

    /// Records that loading a scene failed.
    pub fn load_failed(&mut self) {
        self.loading = false;
    }

    /// Records that a scene was loaded: the worker drops frame requests for the previous one.
    pub fn scene_opened(&mut self) {
        self.loading = false;
        (self.requested, self.counting, self.failed) = (None, None, None);
    }

    /// Whether the job's frame must be requested: it is neither shown nor requested, and has not failed.
    pub fn needs(&self, job: &Job) -> bool {
        !self.is_shown(job) && !self.is_requested(job) && self.failed.as_ref() != Some(job)
    }

    /// Records a request for a frame, which replaces the previous one if that has not arrived.
    pub fn frame_requested(&mut self, number: u64, job: Job) {
        self.requested = Some((number, job));
    }

    /// Records that a frame arrived. While the camera moves, a newer request may already be pending.
    pub fn frame_arrived(&mut self, number: u64, job: &Job, settled: bool) {
        self.requested.take_if(|(requested, _)| *requested == number);
        // The worker counts rays only in frames at rest.
        self.counting = (job.is_counted() && settled).then_some(number);
    }

    /// Records that the worker cancelled a frame or its counters.
    pub fn given_up(&mut self, number: u64) {
        self.requested.take_if(|(requested, _)| *requested == number);
        self.counting.take_if(|counting| *counting == number);
    }

    /// Records that the counters of a frame arrived; returns whether they belong to the frame waiting for
    /// them.
    pub fn counts_arrived(&mut self, number: u64) -> bool {
        self.counting.take_if(|counting| *counting == number).is_some()
    }

    /// Records a request for a picture of the frame.
    pub fn capture_requested(&mut self, capture: Capture) {
        self.capture = Some(capture);
    }

    /// Records that a picture arrived and returns its use; `None` if none is expected any more.
    pub fn capture_arrived(&mut self) -> Option<Capture> {
        self.capture.take()
    }

    /// Records a request for a surface point.
    pub fn pick_requested(&mut self) {
        self.picking = true;
    }

    /// Records that a surface point arrived.
    pub fn pick_arrived(&mut self) {
        self.picking = false;
    }

    /// Records a request for a folder, which replaces the previous one.
    pub fn listing_requested(&mut self, number: u64) {
        self.listing = Some(number);
    }

    /// Records that a folder arrived; returns whether it is the one requested last.
    pub fn listing_arrived(&mut self, number: u64) -> bool {
        self.listing.take_if(|requested| *requested == number).is_some()
    }

    /// Records that no folder is wanted any more.
    pub fn listing_ended(&mut self) {
        self.listing = None;
    }

    /// Records that the worker failed at a request: none of the pending requests will be answered.
    pub fn request_failed(&mut self) {
        self.failed = self.requested.take().map(|(_, job)| job);
        (self.counting, self.capture, self.picking) = (None, None, false);
    }

    /// Whether any request is unanswered.
    pub fn is_waiting(&self) -> bool {
        let Self { loading, requested, counting, capture, picking, listing, failed: _, shown: _ } = self;
        *loading
            || requested.is_some()
            || counting.is_some()
            || capture.is_some()
            || *picking
            || listing.is_some()
    }

    /// Whether the counters of a frame have not arrived.
    pub fn is_counting(&self) -> bool {
        self.counting.is_some()
    }

    /// Whether this frame is requested and has not arrived.
    pub fn is_requested(&self, job: &Job) -> bool {
        self.requested.as_ref().is_some_and(|(_, requested)| requested == job)
    }

    /// Whether the frame of that number is the one requested last, and has not arrived.
    pub fn is_awaited(&self, number: u64) -> bool {
        self.requested.as_ref().is_some_and(|(requested, _)| *requested == number)
    }

    /// Whether a requested frame has not arrived.
    pub fn is_frame_requested(&self) -> bool {
        self.requested.is_some()
    }

    /// Whether the job's frame is on display and would not change if rendered again.
    pub fn is_shown(&self, job: &Job) -> bool {
        self.shown.as_ref().is_some_and(|shown| shown.frame.job == *job && shown.frame.settled)
    }

    /// Whether no frame needs to be requested: the job's frame is shown or has failed, or there is no job.
    pub fn is_complete(&self, job: Option<&Job>) -> bool {
        job == self.failed.as_ref() || job.is_some_and(|job| self.is_shown(job))
    }

    /// The frame on display.
    pub fn shown(&self) -> Option<&Shown> {
        self.shown.as_ref()
    }

    /// Shows a frame in place of the previous one, with nearest filtering if `exact`.
    pub fn present(&mut self, device: &mut DeviceState, frame: Box<RenderedFrame>, exact: bool) {
        let (picture, full) = self.shown.take().map_or((None, None), |old| (Some(old.picture), old.full));
        self.register(device, frame, exact, picture, full);
    }

    /// Switches the frame on display between nearest filtering (`exact`) and interpolation.
    pub fn set_exact(&mut self, device: &mut DeviceState, exact: bool) {
        if let Some(shown) = self.shown.take_if(|shown| shown.exact != exact) {
            self.register(device, shown.frame, exact, Some(shown.picture), shown.full);
        }
    }

    /// Registers a frame as textures of the overlay, reusing the ids of the previous frame's textures.
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

    /// Removes the frame on display after the device was lost.
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
            is_refined: false,
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
        delivery.capture_requested(Capture::Save(None));
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
    fn the_folder_requested_last_is_listed() {
        let mut delivery = Delivery::default();
        (1..=2).for_each(|number| delivery.listing_requested(number));
        assert!(!delivery.listing_arrived(1) && delivery.is_waiting());
        assert!(delivery.listing_arrived(2) && !delivery.is_waiting());
        delivery.listing_requested(3);
        delivery.listing_ended();
        assert!(!delivery.listing_arrived(3) && !delivery.is_waiting());
    }

    #[test]
    fn a_picture_is_saved_once_where_it_was_to_be() {
        let mut delivery = Delivery::default();
        assert_eq!(delivery.capture_arrived(), None);
        delivery.capture_requested(Capture::Save(Some("a.png".into())));
        assert!(delivery.is_waiting());
        assert_eq!(delivery.capture_arrived(), Some(Capture::Save(Some("a.png".into()))));
        assert!(!delivery.is_waiting());
    }
}
