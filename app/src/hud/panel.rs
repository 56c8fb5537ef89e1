//! The full overlay: a panel at the right, or a sheet over the lower half of narrow windows.

use egui::{
    Align, Area, CollapsingHeader, Context, Id, Layout, Order, Rect, RichText, ScrollArea, TextStyle, Ui,
    Vec2, pos2, vec2,
};

use glimpse::options::Group;

use super::actions::{self, Action};
use super::{
    Hud, UserRequest, graph, keys, knobs, measurements, options, places, settings, split, status, style,
};
use crate::{Overlay, Show};

const WIDTH: f32 = 340.0;
const MARGIN: f32 = 8.0;

/// Shows the panel with all its sections.
pub fn show(ctx: &Context, hud: &mut Hud<'_>, user_requests: &mut Vec<UserRequest>) {
    let place = place(ctx.content_rect(), hud.choices.text_scale);
    let area = Area::new(Id::unique("panel")).order(Order::Foreground).fixed_pos(place.min).constrain(false);
    area.show(ctx, |ui| {
        let frame = style::card();
        let inner = (place.size() - frame.total_margin().sum()).max(Vec2::ZERO);
        frame.show(ui, |ui| {
            ui.set_min_size(inner);
            ui.set_max_size(inner);
            if style::heading_with_close(ui, "Glimpse", "close overlay") {
                hud.choices.overlay = Overlay::Brief;
            }
            let scroll = ScrollArea::vertical().auto_shrink(false).max_height(ui.available_height());
            scroll.show(ui, |ui| {
                // Leaves room for the scroll bar, which floats above the right edge.
                ui.set_max_width((ui.available_width() - 12.0).max(0.0));
                sections(ui, hud, user_requests);
            });
        });
    });
}

/// The part of the window that is left of the panel; `None` where the panel covers the picture.
pub fn room_beside(ctx: &Context, text_scale: f32) -> Option<Rect> {
    let mut room = ctx.viewport_rect();
    let content = inner(ctx.content_rect());
    if !is_beside(content, text_scale) {
        return None;
    }
    room.max.x = place(ctx.content_rect(), text_scale).left() - MARGIN;
    Some(room)
}

fn inner(content: Rect) -> Rect {
    content.shrink(MARGIN.min(0.5 * content.size().min_elem()))
}

fn is_beside(inner: Rect, text_scale: f32) -> bool {
    inner.width() > 2.0 * WIDTH * text_scale
}

/// Rectangle of the panel: at the right if there is room beside it, otherwise the lower half.
fn place(content: Rect, text_scale: f32) -> Rect {
    let content = inner(content);
    let width = WIDTH * text_scale;
    if is_beside(content, text_scale) {
        return Rect::from_min_max(pos2(content.right() - width, content.top()), content.max);
    }
    let height = if content.width() > content.height() { content.height() } else { 0.5 * content.height() };
    let size = vec2(content.width().min(1.5 * width), height);
    Rect::from_min_size(content.max - size, size)
}

fn sections(ui: &mut Ui, hud: &mut Hud<'_>, user_requests: &mut Vec<UserRequest>) {
    let (hud_state, method) = (hud.hud_state, hud.choices.settings.method);
    frame_time(ui, hud);
    commands(ui, hud, user_requests);
    settings::show_method(ui, hud.choices);
    section(ui, "Scenes", true, |ui| places::scenes(ui, hud, user_requests));
    section(ui, "Cameras", true, |ui| {
        options::NAVIGATION.buttons(ui, hud.choices, None);
        places::cameras(ui, hud, user_requests);
    });
    for group in Group::ALL {
        let open = matches!(group, Group::Frame | Group::Adaptive);
        section(ui, group.title(), open, |ui| {
            let others = group.options().filter(|option| !settings::is_method(option));
            others.for_each(|option| settings::show(ui, option, hud.choices));
        });
    }
    section(ui, "What is shown", true, |ui| shown(ui, hud));
    section(ui, "Speed", true, |ui| speed(ui, hud));
    section(ui, "Passes", true, |ui| measurements::passes(ui, hud_state));
    section(ui, "Rays", true, |ui| measurements::rays(ui, hud_state, hud.choices));
    section(ui, "Failed checks", false, |ui| measurements::failed_checks(ui, hud_state));
    section(ui, "This scene", true, |ui| measurements::scene(ui, hud_state, method));
    section(ui, "Memory and adapter", true, |ui| measurements::device(ui, hud_state));
}

fn section(ui: &mut Ui, title: &str, open: bool, contents: impl FnOnce(&mut Ui)) {
    ui.add_space(4.0);
    CollapsingHeader::new(RichText::new(title).strong()).default_open(open).show_unindented(ui, |ui| {
        ui.scope(contents);
        ui.add_space(4.0);
    });
}

fn frame_time(ui: &mut Ui, hud: &Hud<'_>) {
    let hud_state = hud.hud_state;
    if let Some(ms) = hud_state.recent_ms().filter(|ms| *ms > 0.0) {
        let text = format!("{ms:.1} ms  {:3.0} fps", 1000.0 / ms);
        let size = TextStyle::Heading.resolve(ui.style()).size;
        ui.with_layout(Layout::top_down(Align::Max), |ui| {
            ui.label(RichText::new(text).monospace().size(size).color(style::ACCENT));
        });
    }
    graph::show(ui, hud_state, hud.choices.governor);
    style::reading(ui, "frame", &status::size(hud_state));
}

fn commands(ui: &mut Ui, hud: &mut Hud<'_>, user_requests: &mut Vec<UserRequest>) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
        let commands = [
            ("Open", Action::Open),
            ("Screenshot", Action::Screenshot),
            ("Copy command", Action::CopyCommand),
            ("Full screen", Action::FullScreen),
            ("Help", Action::Help),
        ];
        for (name, action) in commands {
            let hint = keys::hint(ui.ctx(), action);
            if ui.button(name).on_hover_text(hint).clicked() {
                user_requests.extend(actions::act(hud, action, 0));
            }
        }
    });
}

fn shown(ui: &mut Ui, hud: &mut Hud<'_>) {
    options::SHOW.buttons(ui, hud.choices, None);
    if hud.choices.show != Show::Final {
        ui.label(RichText::new(hud.hud_state.legend.as_str()).small());
    }
    split::switch(ui, hud.choices, hud.hud_state);
    let rests = hud.choices.lenses_inapplicable();
    options::LENSES.buttons(ui, hud.choices, rests);
}

fn speed(ui: &mut Ui, hud: &mut Hud<'_>) {
    let rests = hud.choices.governor_rests();
    options::GOVERNOR.buttons(ui, hud.choices, rests);
    if hud.choices.governed().is_some() {
        ui.label(RichText::new(hud.hud_state.governor.as_str()).small().weak());
    }
    let rests = hud.choices.at_rest_inapplicable();
    options::AT_REST.buttons(ui, hud.choices, rests);
    let rests = hud.choices.scale_inapplicable();
    knobs::SCALE.show_single(ui, &mut hud.choices.scale, rests);
    options::VSYNC.buttons(ui, hud.choices, None);
    knobs::TEXT_SCALE.show_single(ui, &mut hud.choices.text_scale, None);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placed(width: f32, height: f32) -> Rect {
        place(Rect::from_min_size(pos2(0.0, 0.0), vec2(width, height)), 1.0)
    }

    #[test]
    fn the_panel_is_beside_the_picture_or_below_it() {
        assert_eq!(placed(1280.0, 720.0), Rect::from_min_max(pos2(932.0, 8.0), pos2(1272.0, 712.0)));
        assert_eq!(placed(400.0, 800.0), Rect::from_min_max(pos2(8.0, 400.0), pos2(392.0, 792.0)));
    }

    #[test]
    fn the_panel_is_never_outside() {
        for (width, height) in [(44.0, 44.0), (44.0, 4000.0), (700.0, 60.0), (3840.0, 2160.0)] {
            let place = placed(width, height);
            assert!(place.is_positive(), "{place:?}");
            assert!(
                Rect::from_min_size(pos2(0.0, 0.0), vec2(width, height)).contains_rect(place),
                "{place:?}"
            );
        }
    }
}
