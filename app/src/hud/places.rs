//! Lists of the scenes and of the current scene's cameras.

use egui::{Align, Button, Layout, RichText, Ui, vec2};

use super::{Hud, UserRequest, keys};
use crate::app::short_name;

/// Shows the list of scenes.
pub fn scenes(ui: &mut Ui, hud: &Hud<'_>, user_requests: &mut Vec<UserRequest>) {
    for (index, scene) in hud.scenes.iter().enumerate() {
        let chosen = *scene == hud.hud_state.scene;
        let hint = RichText::new(keys::scene_hint(ui.ctx(), index)).small().weak();
        let button = Button::selectable(chosen, short_name(scene)).right_text(hint).truncate();
        if wide(ui, button).accessible_name(format!("scene: {scene}")).on_hover_text(scene).clicked() {
            user_requests.push(UserRequest::Open(scene.clone()));
        }
    }
    if wide(ui, Button::new("Open a file...")).clicked() {
        user_requests.push(UserRequest::OpenDialog);
    }
}

/// Shows the list of cameras and the reset button.
pub fn cameras(ui: &mut Ui, hud: &Hud<'_>, user_requests: &mut Vec<UserRequest>) {
    for (index, camera) in hud.hud_state.cameras.iter().enumerate() {
        let name = if camera.is_empty() { format!("camera {index}") } else { camera.clone() };
        let button =
            Button::selectable(index == hud.hud_state.camera, name.as_str()).right_text("").truncate();
        if wide(ui, button).accessible_name(format!("camera: {index} {camera}")).clicked() {
            user_requests.push(UserRequest::Camera(index));
        }
    }
    if wide(ui, Button::new("Reset the camera")).clicked() {
        user_requests.push(UserRequest::ResetCamera);
    }
}

fn wide(ui: &mut Ui, button: Button<'_>) -> egui::Response {
    let width = ui.available_width();
    let height = ui.spacing().interact_size.y;
    ui.allocate_ui_with_layout(vec2(width, height), Layout::left_to_right(Align::Center), |ui| {
        ui.add(button.min_size(vec2(width, height)))
    })
    .inner
}
