//! The view: the picture, the overlay on it, and what a person does to both.

use std::time::Duration;

use egui::{Rect, Sense, Ui};

use crate::{App, CameraControl, Hud, Motion, Request, Wish, app::Device};

impl App {
    /// Shows the picture and the overlay, and lets the camera follow; returns what is wished.
    pub(crate) fn show(&mut self, ui: &mut Ui, passed: Duration) -> Vec<Wish> {
        let context = ui.ctx().clone();
        let view = context.viewport_rect();
        let response = ui.interact(view, egui::Id::unique("picture"), Sense::CLICK | Sense::DRAG);
        let pixels = context.pixels_per_point();
        let window = [view.width(), view.height()].map(|side| ((side * pixels).round() as u32).max(1));
        self.readings.view = self.view.unwrap_or(window);
        self.draw_picture(ui, view);
        self.tell_what_is_going_on();
        let motions = self.gestures.read(&response, self.choices.navigation, passed);
        let hud = Hud {
            choices: &mut self.choices,
            readings: &self.readings,
            scenes: &self.scenes,
            touch: self.touch,
        };
        let wishes = hud.show(&context);
        self.steer(motions, passed);
        wishes
    }

    fn draw_picture(&self, ui: &Ui, view: Rect) {
        let Some(shown) = &self.shown else { return };
        let whole = Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
        ui.painter().image(shown.picture, view, whole, egui::Color32::WHITE);
        if let (Some(full), Some(split)) = (shown.full, self.choices.split) {
            let mut right = view;
            right.min.x = view.left() + split * view.width();
            ui.painter().with_clip_rect(right).image(full, view, whole, egui::Color32::WHITE);
        }
    }

    fn tell_what_is_going_on(&mut self) {
        if let Some(busy) = &mut self.readings.busy {
            busy.seconds = (self.now - self.busy_since).as_secs_f64();
        }
        if self.now >= self.notice_until {
            self.readings.notice = None;
        }
    }

    fn steer(&mut self, motions: Vec<Motion>, passed: Duration) {
        let Some(control) = &mut self.control else { return };
        for motion in motions {
            if let Motion::Focus { at } = motion {
                if let Some(worker) = self.device.as_mut().and_then(Device::ready_worker) {
                    // A view is two of the camera's units high.
                    worker.pick(control.camera(), (2.0 * at).into());
                    self.pending.pick = true;
                }
            } else {
                control.apply(motion, self.choices.navigation);
            }
        }
        control.advance(passed);
    }

    pub(crate) fn grant(&mut self, wish: Wish, context: &egui::Context) {
        match wish {
            Wish::Open(name) => self.open(&name),
            Wish::OpenDialog => self.requests.push(Request::OpenDialog),
            Wish::Screenshot => self.screenshot(None),
            Wish::CopyCommand => {
                if let Some(command) = self.command() {
                    context.copy_text(command);
                    self.notify("The command of this frame is in the clipboard.".to_owned());
                }
            }
            Wish::FullScreen => self.requests.push(Request::FullScreen),
            Wish::ResetCamera => self.control.iter_mut().for_each(CameraControl::reset),
            Wish::Camera(index) => {
                let camera = self.scene.as_ref().and_then(|scene| scene.cameras.get(index));
                if let (Some((_, camera)), Some(control)) = (camera, &mut self.control) {
                    control.go_to(*camera);
                    self.readings.camera = index;
                }
            }
            Wish::CloseProblem => self.readings.problem = None,
            Wish::Quit => self.requests.push(Request::Quit),
        }
    }
}
