//! What can be looked at: scenes and their cameras.

use egui::{Align, Button, Layout, Ui, vec2};

use super::{Hud, Wish};

/// The scenes to choose from.
pub fn scenes(ui: &mut Ui, hud: &Hud<'_>, wishes: &mut Vec<Wish>) {
    for scene in hud.scenes {
        let (name, origin) = names(scene);
        let button = Button::selectable(*scene == hud.readings.scene, name).right_text(origin).truncate();
        if wide(ui, button).accessible_name(format!("scene: {scene}")).on_hover_text(scene).clicked() {
            wishes.push(Wish::Open(scene.clone()));
        }
    }
    if wide(ui, Button::new("Open a file...")).clicked() {
        wishes.push(Wish::OpenDialog);
    }
}

/// The cameras of the scene, and the way back.
pub fn cameras(ui: &mut Ui, hud: &Hud<'_>, wishes: &mut Vec<Wish>) {
    for (index, camera) in hud.readings.cameras.iter().enumerate() {
        let name = if camera.is_empty() { format!("camera {index}") } else { camera.clone() };
        let button = Button::selectable(index == hud.readings.camera, name.as_str()).truncate();
        if wide(ui, button).accessible_name(format!("camera: {index} {camera}")).clicked() {
            wishes.push(Wish::Camera(index));
        }
    }
    if wide(ui, Button::new("Reset the camera")).clicked() {
        wishes.push(Wish::ResetCamera);
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

/// What a scene is called in the list, and where it is from.
fn names(scene: &str) -> (&str, &str) {
    match scene.strip_prefix("builtin:") {
        Some(name) => (name, "built in"),
        None => (scene.rsplit(['/', '\\']).next().unwrap_or(scene), "file"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_are_called_by_their_last_name() {
        assert_eq!(names("builtin:room"), ("room", "built in"));
        assert_eq!(names("/home/a/kitchen.glb"), ("kitchen.glb", "file"));
        assert_eq!(names(r"C:\scenes\kitchen.glb"), ("kitchen.glb", "file"));
    }
}
