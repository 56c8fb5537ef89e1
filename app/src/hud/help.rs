//! The help page with keys and gestures.

use egui::{Context, Grid, Id, KeyboardShortcut, Modal, RichText, ScrollArea, Ui};

use super::keys::{self, SHORTCUTS, Shortcut};
use super::style;
use crate::{Choices, Navigation};

/// Gestures of fingers and mouse on the picture.
const GESTURES: [(&str, &str); 8] = [
    ("drag", "orbit around the centre, or look around while flying"),
    ("two fingers, right button", "pan"),
    ("pinch, wheel", "nearer and farther"),
    ("double tap, double click", "orbit around the point that was hit"),
    ("W A S D", "fly: forward, left, back, right"),
    ("Q E", "fly: down, up (all six by their places on a US keyboard)"),
    ("Tab, Shift+Tab", "next and previous control of the overlay"),
    ("Left, Right on the divider", "move the split"),
];

/// Shows the page while it is open. The Escape key arrives as an action.
pub fn show(ctx: &Context, choices: &mut Choices) {
    if !choices.help {
        return;
    }
    let size = ctx.content_rect().size();
    let modal = Modal::new(Id::unique("help")).frame(style::card()).show(ctx, |ui| {
        ui.set_width((520.0 * choices.text_scale).min(size.x - 48.0).max(0.0));
        let closed = style::heading_with_close(ui, "Keys and gestures", "close help");
        let room = (size.y - 140.0).max(0.0);
        ScrollArea::vertical().max_height(room).min_scrolled_height(room).show(ui, |ui| {
            table(ui, "gestures", GESTURES.map(|(gesture, does)| (gesture.to_owned(), does)));
            ui.separator();
            table(ui, "keys", SHORTCUTS.iter().map(|shortcut| (names(ctx, shortcut), shortcut.does)));
        });
        closed
    });
    if modal.inner || modal.backdrop_response.clicked() {
        choices.help = false;
    }
}

fn table(ui: &mut Ui, name: &str, rows: impl IntoIterator<Item = (String, &'static str)>) {
    let width = ui.available_width();
    Grid::new(name).num_columns(2).spacing([16.0, 6.0]).min_row_height(0.0).show(ui, |ui| {
        for (keys, does) in rows {
            ui.scope(|ui| {
                ui.set_max_width(0.4 * width);
                ui.add(egui::Label::new(RichText::new(keys).monospace().color(style::ACCENT)).wrap());
            });
            ui.scope(|ui| {
                ui.set_max_width(0.5 * width);
                ui.add(egui::Label::new(does).wrap());
            });
            ui.end_row();
        }
    });
}

/// Names of a row's keys, such as `S (orbit), F12, Ctrl+S`.
fn names(ctx: &Context, shortcut: &Shortcut) -> String {
    let name = |keys: &KeyboardShortcut| {
        let note = if keys::flies(*keys, Navigation::Fly) { " (orbit)" } else { "" };
        ctx.format_shortcut(keys) + note
    };
    match shortcut.keys {
        [first, _, _, .., last] if shortcut.keys.len() > 3 => format!("{} to {}", name(first), name(last)),
        keys => keys.iter().map(name).collect::<Vec<_>>().join(", "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_named_and_those_that_fly_are_marked() {
        let ctx = Context::default();
        ctx.set_os(egui::os::OperatingSystem::Nix);
        let named = |does: &str| names(&ctx, SHORTCUTS.iter().find(|s| s.does.starts_with(does)).unwrap());
        assert_eq!(named("save"), "S (orbit), F12, Ctrl+S");
        assert_eq!(named("the scene of"), "1 to 9");
    }
}
