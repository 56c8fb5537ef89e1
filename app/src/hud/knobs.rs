//! The choices along a range: sliders with a mark at the value that is usual.

use egui::{Align, DragValue, Layout, Response, RichText, Slider, SliderClamping, Stroke, Ui, pos2, remap};

use super::style;
use crate::{Choices, SCALES, TEXT_SCALES};

/// A choice along a range.
pub struct Knob {
    name: &'static str,
    explained: &'static str,
    range: [f64; 2],
    step: f64,
    decimals: usize,
    /// The usual value and where it comes from.
    mark: (f64, &'static str),
    get: fn(&Choices) -> f64,
    set: fn(&mut Choices, f64),
}

/// The tolerances of the similarity checks, marked where Kim 2016 has them.
pub const TOLERANCES: [Knob; 4] = [
    Knob {
        name: "position",
        explained: "Positions may differ by less than this, in units of the scene's longest side. Lower traces more.",
        range: [0.0, 0.1],
        step: 0.001,
        decimals: 3,
        mark: (0.03, "paper"),
        get: |choices| choices.settings.tolerances.pos.into(),
        set: |choices, value| choices.settings.tolerances.pos = value as f32,
    },
    Knob {
        name: "normal",
        explained: "Normals must have a cosine above this. Higher traces more.",
        range: [0.5, 1.0],
        step: 0.005,
        decimals: 3,
        mark: (0.9, "paper"),
        get: |choices| choices.settings.tolerances.norm.into(),
        set: |choices, value| choices.settings.tolerances.norm = value as f32,
    },
    Knob {
        name: "texture border",
        explained: "Width of the zone at the border of a texture that is not interpolated across. Higher traces more.",
        range: [0.0, 0.5],
        step: 0.005,
        decimals: 3,
        mark: (0.3, "paper"),
        get: |choices| choices.settings.tolerances.tex.into(),
        set: |choices, value| choices.settings.tolerances.tex = value as f32,
    },
    Knob {
        name: "mirrored colour",
        explained: "Reflected and refracted colours may differ by less than this. Lower traces more.",
        range: [0.0, 0.5],
        step: 0.005,
        decimals: 3,
        mark: (0.15, "paper"),
        get: |choices| choices.settings.tolerances.gcol.into(),
        set: |choices, value| choices.settings.tolerances.gcol = value as f32,
    },
];

/// How far rays are followed.
pub const DEPTHS: [Knob; 2] = [
    Knob {
        name: "depth",
        explained: "Levels of rays; 1 is primary rays alone.",
        range: [1.0, 16.0],
        step: 1.0,
        decimals: 0,
        mark: (3.0, "default"),
        get: |choices| choices.settings.depth.into(),
        set: |choices, value| choices.settings.depth = value as u32,
    },
    Knob {
        name: "least weight",
        explained: "Rays that would contribute less than this share of a pixel are not traced.",
        range: [0.0, 0.5],
        step: 0.01,
        decimals: 2,
        mark: (0.05, "default"),
        get: |choices| choices.settings.min_weight.into(),
        set: |choices, value| choices.settings.min_weight = value as f32,
    },
];

/// What methods that keep frames do not keep.
pub const SHARE: Knob = Knob {
    name: "share renewed",
    explained: "Share of the pixels that a frame traces anew. Lower is faster and shows longer what is no longer so.",
    range: [0.01, 1.0],
    step: 0.01,
    decimals: 2,
    mark: (0.1, "default"),
    get: |choices| choices.settings.share.into(),
    set: |choices, value| choices.settings.share = value as f32,
};

/// The resolution of frames.
pub const SCALE: Knob = Knob {
    name: "resolution scale",
    explained: "Pixels of a frame along a side, over those of the view.",
    range: [SCALES[0] as f64, SCALES[1] as f64],
    step: 0.005,
    decimals: 3,
    mark: (1.0, "full"),
    get: |choices| choices.scale.into(),
    set: |choices, value| choices.scale = value as f32,
};

/// The size of the overlay.
pub const TEXT_SCALE: Knob = Knob {
    name: "text size",
    explained: "Size of the text and the controls.",
    range: [TEXT_SCALES[0] as f64, TEXT_SCALES[1] as f64],
    step: 0.05,
    decimals: 2,
    mark: (1.0, "default"),
    get: |choices| choices.text_scale.into(),
    set: |choices, value| choices.text_scale = value as f32,
};

impl Knob {
    /// The name, the value, a way back to the mark, and a slider; all disabled where `rests` says why.
    pub fn show(&self, ui: &mut Ui, choices: &mut Choices, rests: Option<&str>) {
        let mut value = (self.get)(choices);
        let before = value;
        ui.add_enabled_ui(rests.is_none(), |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            ui.horizontal(|ui| {
                ui.label(RichText::new(self.name).weak()).on_hover_text(self.explained);
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    self.explain(self.number(ui, &mut value), rests);
                    self.back_to_mark(ui, &mut value);
                });
            });
            self.explain(self.slider(ui, &mut value), rests);
        });
        if value != before {
            (self.set)(choices, value);
        }
    }

    fn explain(&self, response: Response, rests: Option<&str>) {
        response.on_hover_text(self.explained).on_disabled_hover_text(rests.unwrap_or_default());
    }

    fn number(&self, ui: &mut Ui, value: &mut f64) -> Response {
        let [low, high] = self.range;
        // What was chosen elsewhere may lie outside of the slider.
        let number = DragValue::new(value).range(low..=high).clamp_existing_to_range(false);
        let number = number.speed(self.step).fixed_decimals(self.decimals).update_while_editing(false);
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

    /// The mark, where the slider's handle has its centre at that value.
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

    #[test]
    fn marks_are_the_defaults_and_lie_on_their_sliders() {
        let usual = Choices::default();
        let knobs = TOLERANCES.iter().chain(&DEPTHS).chain([&SHARE, &SCALE, &TEXT_SCALE]);
        for knob in knobs {
            assert!(((knob.get)(&usual) - knob.mark.0).abs() < 1e-6, "{}", knob.name);
            assert!((knob.range[0]..=knob.range[1]).contains(&knob.mark.0), "{}", knob.name);
        }
    }

    #[test]
    fn the_ends_of_every_slider_are_settings() {
        for knob in TOLERANCES.iter().chain(&DEPTHS).chain([&SHARE]) {
            for end in knob.range {
                let mut choices = Choices::default();
                (knob.set)(&mut choices, end);
                assert!(((knob.get)(&choices) - end).abs() < 1e-6, "{} {end}", knob.name);
                assert_ne!(choices, Choices::default(), "{} {end}", knob.name);
                choices.settings.validate().unwrap();
            }
        }
    }
}
