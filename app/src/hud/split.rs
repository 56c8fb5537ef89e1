//! The divider between the chosen method and full ray tracing.

use egui::{
    Align2, Area, Color32, Context, CursorIcon, EventFilter, Id, Key, LayerId, Order, Painter, Rect,
    Response, RichText, Sense, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::{amounts, style};
use crate::{Choices, HudState};

/// Distance by which an arrow key moves the divider, as a share of the width.
const KEY_STEP: f32 = 0.01;

/// Shows the divider while the view is split. Only the handle takes input; a drag elsewhere moves the camera.
pub fn show(ctx: &Context, choices: &mut Choices, hud_state: &HudState, picture: Rect) {
    let Some(share) = choices.split else { return };
    let x = picture.left() + share.clamp(0.0, 1.0) * picture.width();
    let line = ctx.layer_painter(LayerId::new(Order::Middle, Id::unique("split line")));
    line.vline(x, picture.y_range(), Stroke::new(3.0, Color32::from_black_alpha(110)));
    line.vline(x, picture.y_range(), Stroke::new(1.0, Color32::WHITE));
    labels(&line, ctx, choices, hud_state, x);
    let content = ctx.content_rect();
    let size = Vec2::splat(style::TOUCH_TARGET);
    let corner = pos2(x, content.center().y) - 0.5 * size;
    let area = Area::new(Id::unique("split")).order(Order::Middle).fixed_pos(corner).constrain_to(content);
    area.show(ctx, |ui| {
        let moved = handle(ui, size, share, picture.width());
        choices.split = Some(moved.clamp(0.0, 1.0));
    });
}

/// Shows the handle; returns its new position as a share of the width.
fn handle(ui: &mut Ui, size: Vec2, share: f32, width: f32) -> f32 {
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let response = response.on_hover_and_drag_cursor(CursorIcon::ResizeHorizontal);
    paint_handle(ui, rect, &response);
    response.widget_info(|| WidgetInfo::slider(true, share.into(), "split"));
    if response.clicked() {
        response.request_focus();
    }
    let mut moved = share;
    if response.dragged() {
        moved += response.drag_delta().x / width;
    }
    if response.has_focus() {
        let arrows = EventFilter { horizontal_arrows: true, ..Default::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
        let presses = |key| ui.input(|input| input.num_presses(key)) as f32;
        moved += KEY_STEP * (presses(Key::ArrowRight) - presses(Key::ArrowLeft));
    }
    moved
}

fn paint_handle(ui: &Ui, rect: Rect, response: &Response) {
    let visuals = ui.style().interact(response);
    let painter = ui.painter();
    painter.circle_filled(rect.center(), 17.0, Color32::from_rgba_unmultiplied(14, 16, 20, 218));
    painter.circle_stroke(rect.center(), 17.0, Stroke::new(1.5, visuals.fg_stroke.color));
    for side in [-1.0, 1.0] {
        let tip = rect.center() + vec2(10.0 * side, 0.0);
        let arrow = [-4.0, 4.0].map(|y| tip + vec2(-4.0 * side, y));
        for end in arrow {
            painter.line_segment([tip, end], visuals.fg_stroke);
        }
    }
}

/// Names of the methods on both sides of the line, and the PSNR between them below the handle.
fn labels(painter: &Painter, ctx: &Context, choices: &Choices, hud_state: &HudState, x: f32) {
    let y = ctx.content_rect().center().y;
    let below = y + 0.5 * style::TOUCH_TARGET + 10.0;
    label(painter, pos2(x - 10.0, below), Align2::RIGHT_TOP, choices.settings.method.name());
    label(painter, pos2(x + 10.0, below), Align2::LEFT_TOP, "full");
    let error = format!("PSNR {}", amounts::decibels(hud_state.psnr_db));
    label(painter, pos2(x, below + 28.0 * choices.text_scale), Align2::CENTER_TOP, &error);
}

fn label(painter: &Painter, at: egui::Pos2, anchor: Align2, text: &str) {
    let style = painter.ctx().global_style();
    let font = egui::TextStyle::Monospace.resolve(&style);
    let galley = painter.layout_no_wrap(text.to_owned(), font, Color32::WHITE);
    let rect = anchor.anchor_size(at, galley.size());
    painter.rect_filled(rect.expand2(vec2(6.0, 3.0)), 6.0, Color32::from_black_alpha(170));
    painter.galley(rect.min, galley, Color32::WHITE);
}

/// Shows the checkbox of the split view, and the PSNR between its halves.
pub fn switch(ui: &mut Ui, choices: &mut Choices, hud_state: &HudState) {
    let mut split = choices.split.is_some();
    if ui.checkbox(&mut split, "split screen against full tracing").changed() {
        choices.toggle_split();
    }
    if split {
        style::reading(ui, "PSNR", &amounts::decibels(hud_state.psnr_db));
        ui.label(RichText::new("Left and Right move the divider while it has the focus.").small().weak());
    }
}
