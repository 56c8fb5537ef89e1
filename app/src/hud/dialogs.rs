//! Messages that appear unasked: errors, notices, progress of long tasks, and the screen before the first
//! picture.

use std::time::Duration;

use egui::{
    Align2, Area, Color32, Context, Id, Label, LayerId, Modal, Order, ProgressBar, Rect, RichText, Role,
    ScrollArea, Sense, Ui, WidgetInfo,
};

use super::{UserRequest, picture_room, style};
use crate::{Busy, Choices, HudState};

/// Shows the error message, above everything else until it is closed.
pub fn problem(ctx: &Context, hud_state: &HudState, text_scale: f32, user_requests: &mut Vec<UserRequest>) {
    let Some(problem) = &hud_state.problem else { return };
    let size = ctx.content_rect().size();
    let modal = Modal::new(Id::unique("problem")).frame(style::card()).show(ctx, |ui| {
        ui.set_width((440.0 * text_scale).min(size.x - 48.0).max(0.0));
        ui.label(RichText::new("That did not work").heading().color(style::WARNING));
        ScrollArea::vertical().max_height((size.y - 180.0).max(0.0)).show(ui, |ui| {
            ui.add(Label::new(problem).wrap().selectable(true));
        });
        ui.add_space(6.0);
        ui.button("Close").accessible_name("close problem").clicked()
    });
    // The Escape key arrives as an action.
    if modal.inner || modal.backdrop_response.clicked() {
        user_requests.push(UserRequest::CloseProblem);
    }
}

/// Time between two pictures of a task's progress.
const TICK: Duration = Duration::from_millis(200);

/// Shows notices and progress at the lower edge of the picture; neither takes input.
pub fn messages(ctx: &Context, hud_state: &HudState, choices: &Choices) {
    let nothing_yet = hud_state.size == [0, 0];
    if nothing_yet {
        splash(ctx);
    }
    let anchor = if nothing_yet { Align2::CENTER_CENTER } else { Align2::CENTER_BOTTOM };
    if hud_state.busy.is_none() && hud_state.notice.is_none() {
        return;
    }
    let lift = if nothing_yet { 64.0 } else { -16.0 };
    let area = Area::new(Id::unique("messages")).order(Order::Foreground).interactable(false);
    let room = picture_room(ctx, choices).intersect(ctx.content_rect());
    area.constrain_to(room).anchor(anchor, [0.0, lift]).show(ctx, |ui| {
        ui.set_max_width((320.0 * choices.text_scale).min(room.width() - 32.0).max(0.0));
        if let Some(text) = &hud_state.notice {
            style::card().show(ui, |ui| ui.add(Label::new(text).wrap()));
        }
        if let Some(busy) = &hud_state.busy {
            ctx.request_repaint_after(TICK);
            style::card().show(ui, |ui| progress(ui, busy));
        }
    });
}

/// Height in points of the line that shows the progress of a frame.
const PROGRESS: f32 = 3.0;

/// Shows how much of the frame at rest is rendered, as a line at the lower edge of the picture.
pub fn rendered(ctx: &Context, hud_state: &HudState, picture: Rect) {
    let Some(share) = hud_state.rendered.filter(|share| share.is_finite()) else { return };
    let mut line = picture;
    line.min.y = line.max.y - PROGRESS;
    let area = Area::new(Id::unique("rendered")).order(Order::Middle).interactable(false).fixed_pos(line.min);
    area.constrain(false).show(ctx, |ui| {
        let (rect, response) = ui.allocate_exact_size(line.size(), Sense::hover());
        ui.painter().rect_filled(rect, 0.0, Color32::from_black_alpha(110));
        let done = rect.with_max_x(rect.left() + share.clamp(0.0, 1.0) * rect.width());
        ui.painter().rect_filled(done, 0.0, style::ACCENT);
        let name = format!("rendered {:.0} %", 100.0 * share);
        response.widget_info(|| WidgetInfo::labeled(Role::ProgressIndicator, true, name.clone()));
    });
}

fn splash(ctx: &Context) {
    let rect = ctx.viewport_rect();
    let painter = ctx.layer_painter(LayerId::new(Order::Middle, Id::unique("splash")));
    painter.rect_filled(rect, 0.0, Color32::from_rgb(14, 16, 20));
    let font = egui::FontId::proportional((0.08 * rect.width()).clamp(8.0, 44.0));
    painter.text(rect.center(), Align2::CENTER_CENTER, "Glimpse", font, style::ACCENT);
}

fn progress(ui: &mut Ui, busy: &Busy) {
    let [step, of] = busy.step;
    ui.add(Label::new(&busy.what).wrap());
    let share = if of == 0 { 0.0 } else { step.min(of) as f32 / of as f32 };
    ui.add(ProgressBar::new(share).desired_height(6.0));
    let steps = if of == 0 { String::new() } else { format!("{} {step} of {of}", busy.unit) };
    style::reading(ui, &steps, &format!("{:.1} s", busy.seconds));
}
