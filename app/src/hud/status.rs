//! The brief overlay: a line of readings, and the button that opens the panel.

use egui::{
    Align, Area, Context, Id, Layout, Order, Rect, Response, RichText, Role, Sense, TextStyle, Ui,
    WidgetInfo, pos2, vec2,
};

use super::{amounts, style};
use crate::{Choices, HudState, Overlay, Show};

/// Shows the line, and below it the legend if a quantity other than the frame is shown.
pub fn show(ctx: &Context, choices: &mut Choices, hud_state: &HudState) {
    let content = ctx.content_rect();
    let area =
        Area::new(Id::unique("status")).order(Order::Foreground).fixed_pos(content.min + vec2(8.0, 8.0));
    area.show(ctx, |ui| {
        let width = content.width() - 16.0;
        style::card().inner_margin(0).show(ui, |ui| {
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                if menu_button(ui).clicked() {
                    choices.overlay = Overlay::Full;
                }
                let room = width - style::TOUCH_TARGET - 24.0;
                let line = fitting(ui, &segments(choices, hud_state), room);
                if !line.is_empty() {
                    ui.label(RichText::new(line).monospace());
                    ui.add_space(4.0);
                }
            });
        });
        if choices.show != Show::Final && !hud_state.legend.is_empty() {
            style::card().show(ui, |ui| {
                ui.set_max_width((width - 24.0).min(520.0 * choices.text_scale).max(0.0));
                ui.label(RichText::new(hud_state.legend.as_str()).small());
            });
        }
    });
}

/// Shows only the menu button, nearly transparent.
pub fn faint_menu(ctx: &Context, choices: &mut Choices) {
    let area = Area::new(Id::unique("faint menu")).order(Order::Foreground);
    area.fixed_pos(ctx.content_rect().min + vec2(8.0, 8.0)).show(ctx, |ui| {
        ui.set_opacity(0.3);
        if menu_button(ui).clicked() {
            choices.overlay = Overlay::Brief;
        }
    });
}

fn menu_button(ui: &mut Ui) -> Response {
    let (rect, response) =
        ui.allocate_exact_size(vec2(style::TOUCH_TARGET, style::TOUCH_TARGET), Sense::click());
    let visuals = ui.style().interact(&response);
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 10.0, visuals.weak_bg_fill);
    }
    for row in [-6.0, 0.0, 6.0] {
        let center = rect.center() + vec2(0.0, row);
        let bar = Rect::from_center_size(pos2(center.x, center.y), vec2(18.0, 2.0));
        ui.painter().rect_filled(bar, 1.0, visuals.fg_stroke.color);
    }
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, "menu"));
    response
}

/// Segments of the line, the most important first.
fn segments(choices: &Choices, hud_state: &HudState) -> Vec<String> {
    let mut segments = Vec::new();
    if let Some(ms) = hud_state.recent_ms().filter(|ms| *ms > 0.0) {
        segments.push(format!("{ms:6.1} ms"));
        segments.push(format!("{:4.0} fps", 1000.0 / ms));
    }
    if let Some(counts) = hud_state.counts {
        segments.push(format!("rays {:>7}", amounts::percent(counts.rt_ratio())));
    }
    if hud_state.size != [0, 0] {
        segments.push(size(hud_state));
        segments.push(choices.settings.method.name().to_owned());
    }
    segments
}

/// Size of the frame in pixels, with the ratio of its side to the view's unless it is 1.
pub fn size(hud_state: &HudState) -> String {
    let ([width, height], [view, _]) = (hud_state.size, hud_state.view);
    if width == view || view == 0 {
        format!("{width}x{height}")
    } else {
        format!("{width}x{height} ({:.0} %)", 100.0 * f64::from(width) / f64::from(view))
    }
}

/// Joins as many segments as fit into `room` points.
fn fitting(ui: &Ui, segments: &[String], room: f32) -> String {
    let font = TextStyle::Monospace.resolve(ui.style());
    let digit = ui.fonts_mut(|fonts| fonts.glyph_width(&font, '0'));
    let mut line = String::new();
    for segment in segments {
        let longer = if line.is_empty() { segment.clone() } else { format!("{line}  {segment}") };
        if longer.chars().count() as f32 * digit > room {
            break;
        }
        line = longer;
    }
    line
}
