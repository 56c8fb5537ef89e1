//! Sliders for numbers, with a mark at the usual value.

use egui::{Align, DragValue, Layout, Response, RichText, Slider, SliderClamping, Stroke, Ui, pos2, remap};

use super::style;
use crate::{SCALES, TEXT_SCALES};

/// A slider for a number.
pub struct Knob {
    /// Name of the value.
    pub name: &'static str,
    /// Explanation in one sentence.
    pub explained: &'static str,
    /// Lowest and highest value.
    pub range: [f64; 2],
    /// Step between neighbouring values.
    pub step: f64,
    /// Marked value and its source.
    pub mark: (f64, &'static str),
}

/// Slider of the frame's resolution scale.
pub const SCALE: Knob = Knob {
    name: "resolution scale",
    explained: "Pixels of a frame along a side, over those of the view.",
    range: [SCALES[0] as f64, SCALES[1] as f64],
    step: 0.005,
    mark: (1.0, "full"),
};

/// Slider of the overlay's text size.
pub const TEXT_SCALE: Knob = Knob {
    name: "text size",
    explained: "Size of the text and the controls.",
    range: [TEXT_SCALES[0] as f64, TEXT_SCALES[1] as f64],
    step: 0.05,
    mark: (1.0, "default"),
};

impl Knob {
    /// Shows the name, the value, a reset button for the marked value, and a slider; all are disabled if
    /// `rests` gives a reason. Returns whether the value changed.
    pub fn show(&self, ui: &mut Ui, value: &mut f64, rests: Option<&str>) -> bool {
        let before = *value;
        ui.add_enabled_ui(rests.is_none(), |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            ui.horizontal(|ui| {
                ui.label(RichText::new(self.name).weak()).on_hover_text(self.explained);
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    self.explain(self.number(ui, value), rests);
                    self.back_to_mark(ui, value);
                });
            });
            self.explain(self.slider(ui, value), rests);
        });
        *value != before
    }

    /// Shows the slider as [`Knob::show`], for a value in single precision.
    pub fn show_single(&self, ui: &mut Ui, value: &mut f32, rests: Option<&str>) {
        let mut precise = f64::from(*value);
        if self.show(ui, &mut precise, rests) {
            *value = precise as f32;
        }
    }

    /// Number of decimals that distinguishes neighbouring values.
    fn decimals(&self) -> usize {
        (-self.step.log10() - 1e-6).ceil().max(0.0) as usize
    }

    fn explain(&self, response: Response, rests: Option<&str>) {
        response.on_hover_text(self.explained).on_disabled_hover_text(rests.unwrap_or_default());
    }

    fn number(&self, ui: &mut Ui, value: &mut f64) -> Response {
        let [low, high] = self.range;
        // A value chosen elsewhere may lie outside the slider's range.
        let number = DragValue::new(value).range(low..=high).clamp_existing_to_range(false);
        let number = number.speed(self.step).fixed_decimals(self.decimals()).update_while_editing(false);
        ui.add(number).accessible_name(format!("{} in digits", self.name))
    }

    fn back_to_mark(&self, ui: &mut Ui, value: &mut f64) {
        let (usual, source) = self.mark;
        let there = (*value - usual).abs() < 0.5 * self.step;
        let button = egui::Button::new(RichText::new(source).small()).frame_when_inactive(false);
        let name = format!("{}: {source} value", self.name);
        if ui.add_enabled(!there, button).accessible_name(name).clicked() {
            *value = usual;
        }
    }

    fn slider(&self, ui: &mut Ui, value: &mut f64) -> Response {
        ui.spacing_mut().slider_width = ui.available_width().max(1.0);
        let [low, high] = self.range;
        let slider = Slider::new(value, low..=high).step_by(self.step).show_value(false);
        let response = ui.add(slider.clamping(SliderClamping::Edits));
        self.tick(ui, &response);
        response.accessible_name(self.name)
    }

    /// Draws the mark where the slider's handle has its centre at the marked value.
    fn tick(&self, ui: &Ui, response: &Response) {
        let rect = response.rect;
        let [low, high] = self.range;
        let travel = rect.x_range().shrink((rect.height() / 2.5).min(0.5 * rect.width()));
        let x = remap(self.mark.0, low..=high, f64::from(travel.min)..=f64::from(travel.max)) as f32;
        let stroke = Stroke::new(1.5, style::WARNING);
        let y = rect.bottom();
        ui.painter().line_segment([pos2(x, y - 6.0), pos2(x, y)], stroke);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Choices;

    #[test]
    fn marks_are_the_defaults_and_lie_on_their_sliders() {
        let usual = Choices::default();
        for (knob, value) in [(&SCALE, usual.scale), (&TEXT_SCALE, usual.text_scale)] {
            assert!((f64::from(value) - knob.mark.0).abs() < 1e-6, "{}", knob.name);
            assert!((knob.range[0]..=knob.range[1]).contains(&knob.mark.0), "{}", knob.name);
        }
    }

    #[test]
    fn digits_tell_neighbouring_values_apart() {
        for (step, decimals) in [(1.0, 0), (0.05, 2), (0.01, 2), (0.005, 3), (0.001, 3)] {
            let knob = Knob { step, ..SCALE };
            assert_eq!(knob.decimals(), decimals, "{step}");
        }
    }
}
