//! The list of files, where the system has no file dialog.

use std::path::Path;

use egui::{
    Align, Button, Context, Id, Key, Label, Layout, Modal, Rect, RichText, ScrollArea, Ui, pos2, vec2,
};

use super::{UserRequest, style};
use crate::{App, Folder, FolderEntry, HudState};

/// Entries that Page Up and Page Down pass.
const PAGE: usize = 10;

/// Shows the list while a folder is open. Clicks and keys ask for another folder or a scene; the Escape key arrives as an
/// action.
pub fn show(ctx: &Context, hud_state: &HudState, text_scale: f32, user_requests: &mut Vec<UserRequest>) {
    let Some(folder) = &hud_state.folder else { return };
    let size = ctx.content_rect().size();
    let modal = Modal::new(Id::unique("files")).frame(style::card()).show(ctx, |ui| {
        ui.set_width((520.0 * text_scale).min(size.x - 48.0).max(0.0));
        let closed = style::heading_with_close(ui, "Open a scene", "close file list");
        place(ui, folder, user_requests);
        ui.separator();
        let room = (size.y - 160.0 * text_scale).max(0.0);
        entries(ui, folder, room, user_requests);
        closed
    });
    if modal.inner || modal.backdrop_response.clicked() {
        user_requests.push(UserRequest::CloseFolder);
    }
}

/// Shows the folder's path, and a button for the one above.
fn place(ui: &mut Ui, folder: &Folder, user_requests: &mut Vec<UserRequest>) {
    let above = folder.path.parent();
    ui.horizontal(|ui| {
        let up = ui.add_enabled(above.is_some(), Button::new("Up")).on_hover_text("Backspace");
        let is_pressed = !has_focus(ui) && ui.input(|input| input.key_pressed(Key::Backspace));
        if up.clicked() || is_pressed {
            user_requests.extend(above.map(|above| UserRequest::Browse(above.to_owned())));
        }
        ui.add(Label::new(RichText::new(shown(&folder.path)).weak()).truncate());
    });
}

fn entries(ui: &mut Ui, folder: &Folder, room: f32, user_requests: &mut Vec<UserRequest>) {
    let id = Id::unique("file list").with(&folder.path);
    let last = folder.entries.len().saturating_sub(1);
    let before = ui.data(|data| data.get_temp(id)).unwrap_or(0_usize).min(last);
    let chosen = if has_focus(ui) { before } else { moved(ui, before, last) };
    ui.data_mut(|data| data.insert_temp(id, chosen));
    if !has_focus(ui)
        && ui.input(|input| input.key_pressed(Key::Enter))
        && let Some(entry) = folder.entries.get(chosen)
    {
        user_requests.push(opened(entry));
    }
    if let Some(problem) = &folder.problem {
        ui.add(Label::new(RichText::new(problem).color(style::WARNING)).wrap());
    } else if folder.entries.is_empty() {
        ui.label(RichText::new("No folder and no .glb or .gltf file is here.").weak());
    }
    let height = ui.spacing().interact_size.y;
    let scroll = ScrollArea::vertical().auto_shrink([false, true]).max_height(room).min_scrolled_height(room);
    scroll.show_rows(ui, height, folder.entries.len(), |ui, rows| {
        // Leaves room for the scroll bar, which floats above the right edge.
        ui.set_max_width((ui.available_width() - 12.0).max(0.0));
        if chosen != before {
            let step = height + ui.spacing().item_spacing.y;
            let top = ui.max_rect().top() + (chosen as f32 - rows.start as f32) * step;
            let row = Rect::from_min_size(pos2(ui.max_rect().left(), top), vec2(1.0, height));
            ui.scroll_to_rect(row, None);
        }
        for (index, entry) in folder.entries.iter().enumerate().take(rows.end).skip(rows.start) {
            let name = if entry.is_folder { format!("{}/", entry.name) } else { entry.name.clone() };
            let button = Button::selectable(index == chosen, name.as_str()).right_text("").truncate();
            let width = ui.available_width();
            let row = Layout::left_to_right(Align::Center);
            let response = ui.allocate_ui_with_layout(vec2(width, height), row, |ui| {
                ui.add(button.min_size(vec2(width, height)))
            });
            if response.inner.accessible_name(&name).clicked() {
                user_requests.push(opened(entry));
            }
        }
    });
}

/// Whether a control has the keyboard focus, whose keys are its own.
fn has_focus(ui: &Ui) -> bool {
    ui.memory(|memory| memory.focused()).is_some()
}

/// The entry that the pressed keys lead to from another one.
fn moved(ui: &Ui, from: usize, last: usize) -> usize {
    ui.input(|input| {
        let down = input.num_presses(Key::ArrowDown) + PAGE * input.num_presses(Key::PageDown);
        let up = input.num_presses(Key::ArrowUp) + PAGE * input.num_presses(Key::PageUp);
        let to = from.saturating_add(down).min(last).saturating_sub(up);
        match (input.key_pressed(Key::Home), input.key_pressed(Key::End)) {
            (true, _) => 0,
            (_, true) => last,
            _ => to,
        }
    })
}

fn opened(entry: &FolderEntry) -> UserRequest {
    if entry.is_folder {
        UserRequest::Browse(entry.path.clone())
    } else {
        UserRequest::Open(App::file_name(&entry.path))
    }
}

fn shown(path: &Path) -> String {
    path.to_string_lossy().replace(char::is_control, " ")
}
