//! The view: shows the picture with the overlay on it, and handles input to both.

use std::time::Duration;

use egui::{Context, Rect, Sense, Ui};
use glimpse::{Foveation, Method};

use crate::{
    App, CameraControl, Hud, Motion, RenderedFrame, Request, UserRequest, hud, input_queue::InputQueue,
    lenses::Bent,
};

/// Number of steps to which the gaze is rounded across a picture, as each change of it restarts accumulation.
const GAZE_STEPS: f32 = 32.0;

/// State of the view, as the shell and the last update left it.
#[derive(Clone, Debug, Default)]
pub(crate) struct View {
    /// Input that has not reached the overlay and the camera yet.
    pub input: InputQueue,
    /// Pixels of a frame at rest, if they are not the window's.
    pub frame_size: Option<[u32; 2]>,
    /// Pixels of the screen that the picture covers.
    picture: [u32; 2],
    /// Whether there was a touch: the overlay is then made for fingers.
    pub touch: bool,
    /// Whether the overlay is animated.
    pub animated: bool,
}

impl App {
    /// Shows picture and overlay, and moves the camera; returns the user's requests. `passed` is the time
    /// since the last update.
    pub(crate) fn show(&mut self, ui: &mut Ui, passed: Duration) -> Vec<UserRequest> {
        let context = ui.ctx().clone();
        let view = hud::picture_room(&context, &self.choices);
        let response = ui.interact(view, egui::Id::unique("picture"), Sense::CLICK | Sense::DRAG);
        let pixels = context.pixels_per_point();
        let window = [view.width(), view.height()].map(|side| ((side * pixels).round() as u32).max(1));
        self.hud_state.view = self.view.frame_size.unwrap_or(window);
        let picture = fitted(self.hud_state.view, view, pixels);
        self.sharpen((picture.size() * pixels).round());
        self.draw_picture(ui, picture);
        self.tell_what_is_going_on();
        let motions = self.gestures.read(&response, picture, self.choices.navigation, passed);
        let hud = Hud {
            choices: &mut self.choices,
            hud_state: &self.hud_state,
            scenes: self.scenes.offered(),
            picture,
            touch: self.view.touch,
        };
        let user_requests = hud.show(&context);
        self.gaze(&context, picture);
        self.steer(motions, passed);
        user_requests
    }

    /// Moves the gaze to the pointer if paths far from it stop early (foveation). With two eyes, the position
    /// within either eye's picture counts.
    fn gaze(&mut self, context: &Context, picture: Rect) {
        let at = context.input(|input| input.pointer.hover_pos()).filter(|at| picture.contains(*at));
        let at = at.map(|at| self.bent(picture).map_or(at, |bent| bent.without(at)));
        let paths = &mut self.choices.settings.paths;
        let method = self.choices.settings.method;
        let Some(at) = at.filter(|_| method.is_path_traced() && paths.foveation != Foveation::Off) else {
            return;
        };
        let eyes = if method == Method::Vr { 2.0 } else { 1.0 };
        let [x, y] =
            [eyes * (at.x - picture.left()) / picture.width(), (at.y - picture.top()) / picture.height()];
        let steps = |share: f32| (share * GAZE_STEPS).round() / GAZE_STEPS;
        paths.gaze = [steps(x % 1.0), steps(y)];
    }

    /// Lens distortion of the picture, if lenses are chosen.
    fn bent(&self, picture: Rect) -> Option<Bent> {
        let shown = self.delivery.shown().filter(|shown| shown.frame.job.settings.method == Method::Vr)?;
        self.choices.bends().then(|| Bent::new(self.choices.lenses, picture, &shown.frame.job.camera))
    }

    /// Selects nearest filtering if the picture on the screen has exactly the frame's pixels.
    fn sharpen(&mut self, picture: egui::Vec2) {
        self.view.picture = [picture.x, picture.y].map(|side| side as u32);
        if let Some(shown) = self.delivery.shown() {
            let exact = self.is_exact(&shown.frame);
            self.delivery.set_exact(&mut self.device, exact);
        }
    }

    /// Whether every pixel of the frame lies on exactly one pixel of the screen.
    pub(crate) fn is_exact(&self, frame: &RenderedFrame) -> bool {
        frame.job.size == self.view.picture && !self.choices.bends()
    }

    fn draw_picture(&self, ui: &Ui, picture: Rect) {
        let Some(shown) = self.delivery.shown() else { return };
        if let Some(bent) = self.bent(picture) {
            ui.painter().add(bent.mesh(shown.picture, shown.frame.job.size));
            return;
        }
        let (at, part) = match shown.frame.job.settings.method {
            Method::Vr => (picture, WHOLE),
            _ => overlap(shown.frame.job.size, picture),
        };
        ui.painter().image(shown.picture, at, part, egui::Color32::WHITE);
        if let (Some(full), Some(split)) = (shown.full, self.choices.split) {
            let mut right = picture;
            right.min.x = picture.left() + split * picture.width();
            ui.painter().with_clip_rect(right).image(full, at, part, egui::Color32::WHITE);
        }
    }

    fn tell_what_is_going_on(&mut self) {
        if let Some(busy) = &mut self.hud_state.busy {
            busy.seconds = self.clock.seconds_of_loading();
        }
        if self.clock.notice_is_over() {
            self.hud_state.notice = None;
        }
    }

    fn steer(&mut self, motions: Vec<Motion>, passed: Duration) {
        let Some(control) = &mut self.control else { return };
        for motion in motions {
            if let Motion::Focus { at } = motion {
                if let Some(worker) = self.device.ready_worker() {
                    // View coordinates of the camera range over two units of height.
                    worker.pick(control.camera(), (2.0 * at).into());
                    self.delivery.pick_requested();
                }
            } else {
                control.apply(motion, self.choices.navigation);
            }
        }
        control.advance(passed);
    }

    pub(crate) fn handle_request(&mut self, request: UserRequest, context: &Context) {
        match request {
            UserRequest::Open(name) => self.open(&name),
            UserRequest::OpenDialog => self.requests.push(Request::OpenDialog),
            UserRequest::Browse(folder) => self.list(&folder),
            UserRequest::CloseFolder => {
                self.hud_state.folder = None;
                self.delivery.listing_ended();
            }
            UserRequest::Screenshot => self.screenshot(None),
            UserRequest::CopyCommand => {
                if let Some(command) = self.command() {
                    context.copy_text(command);
                    self.notify("The command of this frame is in the clipboard.".to_owned());
                }
            }
            UserRequest::FullScreen => self.requests.push(Request::FullScreen),
            UserRequest::ResetCamera => self.control.iter_mut().for_each(CameraControl::reset),
            UserRequest::Camera(index) => {
                let camera = self.scenes.shown().and_then(|scene| scene.cameras.get(index));
                if let (Some((_, camera)), Some(control)) = (camera, &mut self.control) {
                    control.go_to(*camera);
                    self.hud_state.camera = index;
                }
            }
            UserRequest::CloseProblem => self.hud_state.problem = None,
            UserRequest::Quit => self.requests.push(Request::Quit),
        }
    }
}

/// Texture coordinates of a whole texture.
const WHOLE: Rect = Rect { min: egui::Pos2::ZERO, max: egui::pos2(1.0, 1.0) };

/// Where a frame of that size is drawn in the rectangle of the picture, and which part of it, in texture coordinates. Until
/// the frame of a new shape arrives, the last one keeps its height and its centre: the pictures of a camera at one height
/// differ in width alone.
fn overlap(frame: [u32; 2], picture: Rect) -> (Rect, Rect) {
    let [width, height] = frame.map(|side| side as f32);
    let ratio = picture.aspect_ratio() * height / width;
    // The governor rounds the sides of frames to whole pixels.
    let is_rounded = (ratio - 1.0).abs() <= 1.0 / width + 1.0 / height;
    if is_rounded || !ratio.is_finite() {
        (picture, WHOLE)
    } else if ratio < 1.0 {
        (picture, Rect::from_center_size(WHOLE.center(), egui::vec2(ratio, 1.0)))
    } else {
        let drawn = egui::vec2(picture.width() / ratio, picture.height());
        (Rect::from_center_size(picture.center(), drawn), WHOLE)
    }
}

/// The rectangle in which a frame of that size is shown: centred in the view, as large as fits, on whole pixels. A
/// rectangle that would miss the view by at most a pixel on each axis fills it.
fn fitted(frame: [u32; 2], view: Rect, pixels_per_point: f32) -> Rect {
    let [width, height] = frame.map(|side| side as f32);
    let room = view.size() * pixels_per_point;
    let scale = (room.x / width).min(room.y / height);
    let size = (egui::vec2(width, height) * scale).round().max(egui::Vec2::splat(1.0));
    let spare = (room - size).max(egui::Vec2::ZERO);
    if spare.x <= 1.0 && spare.y <= 1.0 {
        return view;
    }
    let corner = view.min + (0.5 * spare).floor() / pixels_per_point;
    Rect::from_min_size(corner, size / pixels_per_point)
}

#[cfg(test)]
mod tests {
    use egui::{pos2, vec2};

    use super::*;

    #[test]
    fn a_frame_of_another_shape_lies_in_the_middle() {
        let phone = Rect::from_min_size(pos2(0.0, 0.0), vec2(1200.0, 540.0));
        let picture = fitted([2560, 1440], phone, 2.0);
        assert_eq!(picture, Rect::from_min_size(pos2(120.0, 0.0), vec2(960.0, 540.0)));
        let upright = Rect::from_min_size(pos2(0.0, 0.0), vec2(540.0, 1200.0));
        let picture = fitted([2560, 1440], upright, 1.0);
        assert_eq!(picture, Rect::from_min_size(pos2(0.0, 448.0), vec2(540.0, 304.0)));
    }

    #[test]
    fn a_frame_of_the_shape_before_keeps_its_height_and_its_centre() {
        let picture = Rect::from_min_size(pos2(0.0, 0.0), vec2(640.0, 720.0));
        let middle = Rect::from_min_max(pos2(0.25, 0.0), pos2(0.75, 1.0));
        assert_eq!(overlap([1280, 720], picture), (picture, middle), "it was wider");
        let drawn = Rect::from_min_size(pos2(160.0, 0.0), vec2(320.0, 720.0));
        assert_eq!(overlap([320, 720], picture), (drawn, WHOLE), "it was narrower");
        assert_eq!(overlap([91, 102], picture), (picture, WHOLE), "scaled down and rounded");
    }

    #[test]
    fn a_frame_of_the_same_shape_fills_the_view() {
        let view = Rect::from_min_size(pos2(0.0, 0.0), vec2(405.0, 900.0));
        assert_eq!(fitted([1080, 2400], view, 1.0), view);
        assert_eq!(fitted([1081, 2400], view, 1.0), view, "a pixel");
    }
}
