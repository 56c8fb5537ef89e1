//! Style of the overlay: dark and translucent.

use egui::style::HandleShape;
use egui::{
    Align, Color32, Context, CornerRadius, FontFamily, FontId, Frame, Label, Layout, Margin, Response,
    RichText, Stroke, Style, TextStyle, Theme, Ui, Visuals, vec2,
};

/// Colour of measurements and selected values.
pub const ACCENT: Color32 = Color32::from_rgb(110, 190, 245);
/// Colour of frame times over the limit, warnings, errors and the marks of sliders.
pub const WARNING: Color32 = Color32::from_rgb(250, 170, 90);
/// Least side in points of a control for fingers.
pub const TOUCH_TARGET: f32 = 44.0;

const TEXT: Color32 = Color32::from_gray(225);
const WEAK: Color32 = Color32::from_gray(160);
const MOUSE_TARGET: f32 = 26.0;

/// Sets sizes and colours of the overlay. With `touch`, controls are large enough for fingers.
pub fn apply(ctx: &Context, text_scale: f32, touch: bool) {
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
    ctx.set_theme(Theme::Dark);
    ctx.style_mut_of(Theme::Dark, |style| {
        text_sizes(style, text_scale);
        spacing(style, text_scale, touch);
        colors(&mut style.visuals);
        style.interaction.selectable_labels = false;
    });
}

fn text_sizes(style: &mut Style, scale: f32) {
    let sizes = [
        (TextStyle::Small, 11.5, FontFamily::Proportional),
        (TextStyle::Body, 14.0, FontFamily::Proportional),
        (TextStyle::Button, 14.0, FontFamily::Proportional),
        (TextStyle::Monospace, 13.0, FontFamily::Monospace),
        (TextStyle::Heading, 18.0, FontFamily::Proportional),
    ];
    style.text_styles =
        sizes.into_iter().map(|(name, size, family)| (name, FontId::new(size * scale, family))).collect();
}

fn spacing(style: &mut Style, scale: f32, touch: bool) {
    let spacing = &mut style.spacing;
    let target = if touch { TOUCH_TARGET.max(MOUSE_TARGET * scale) } else { MOUSE_TARGET * scale };
    spacing.interact_size = vec2(target, target);
    spacing.item_spacing = vec2(8.0, 6.0);
    spacing.button_padding = vec2(10.0, 4.0);
    spacing.slider_rail_height = 4.0;
    spacing.tooltip_width = 280.0 * scale;
}

fn colors(visuals: &mut Visuals) {
    visuals.handle_shape = HandleShape::Circle;
    visuals.slider_trailing_fill = true;
    visuals.window_corner_radius = CornerRadius::same(10);
    visuals.window_fill = Color32::from_rgb(22, 24, 28);
    visuals.selection.bg_fill = Color32::from_rgb(34, 82, 118);
    visuals.selection.stroke = Stroke::new(1.0, Color32::WHITE);
    visuals.weak_text_color = Some(WEAK);
    visuals.widgets.noninteractive.fg_stroke.color = TEXT;
    visuals.widgets.noninteractive.bg_stroke.color = Color32::from_white_alpha(22);
    visuals.widgets.inactive.weak_bg_fill = Color32::from_white_alpha(16);
    visuals.widgets.hovered.weak_bg_fill = Color32::from_white_alpha(34);
    // Slider rails and handles are opaque, so that the rail does not show through the handle.
    visuals.widgets.inactive.bg_fill = Color32::from_gray(72);
    visuals.widgets.hovered.bg_fill = Color32::from_gray(104);
    visuals.widgets.active.bg_fill = Color32::from_gray(128);
}

/// Background of the parts of the overlay.
pub fn card() -> Frame {
    Frame::new()
        .fill(Color32::from_rgba_unmultiplied(14, 16, 20, 218))
        .stroke(Stroke::new(1.0, Color32::from_white_alpha(18)))
        .corner_radius(10)
        .inner_margin(Margin::symmetric(12, 8))
}

/// A small caption above a control.
pub fn caption(ui: &mut Ui, text: &str) -> Response {
    ui.add(Label::new(RichText::new(text).small().weak()).truncate())
}

/// A name and, at the right edge, its value in monospace digits.
pub fn reading(ui: &mut Ui, name: &str, value: &str) {
    ui.scope(|ui| {
        // Rows may be closer than a finger needs, as nothing here is pressed.
        ui.spacing_mut().interact_size.y = 0.0;
        ui.horizontal(|ui| {
            ui.label(RichText::new(name).weak());
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                ui.add(Label::new(RichText::new(value).monospace()).truncate());
            });
        });
    });
}

/// A title and, at the right edge, a close button; returns whether it was pressed.
pub fn heading_with_close(ui: &mut Ui, title: &str, close: &str) -> bool {
    ui.horizontal(|ui| {
        ui.heading(title);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.button("Close").accessible_name(close).clicked()
        })
        .inner
    })
    .inner
}
