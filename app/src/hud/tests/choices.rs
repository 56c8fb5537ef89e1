//! Whatever the user chooses in the overlay, a frame can be rendered with it.

use egui::{Key, Modifiers, PointerButton, Pos2, Role};
use egui_kittest::kittest::{NodeT, Queryable};
use glimpse::Method;

use super::super::keys::SHORTCUTS;
use super::*;
use crate::Show;

/// A linear congruential generator (Knuth's MMIX).
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % end
    }
}

fn pointer(harness: &Harness<'_, HudFixture>, pos: Pos2, pressed: bool) {
    let modifiers = Modifiers::NONE;
    harness.event(egui::Event::PointerMoved(pos));
    harness.event(egui::Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers });
}

/// Presses the pointer on a random control, and releases it there or on another.
fn drag_something(harness: &mut Harness<'_, HudFixture>, random: &mut Random) {
    let rects = harness.ctx.interactive_rects_last_pass();
    let window = harness.ctx.content_rect();
    let somewhere = |random: &mut Random| {
        let rect = rects[random.below(rects.len())].intersect(window);
        rect.min + rect.size() * (random.below(1000) as f32 / 1000.0)
    };
    let from = somewhere(random);
    let to = if random.below(3) == 0 { somewhere(random) } else { from };
    pointer(harness, from, true);
    harness.run_steps(1);
    pointer(harness, to, false);
    harness.run_steps(1);
}

fn press_some_key(harness: &mut Harness<'_, HudFixture>, random: &mut Random) {
    let keys: Vec<_> = SHORTCUTS.iter().flat_map(|shortcut| shortcut.keys).collect();
    let keys = keys[random.below(keys.len())];
    harness.key_press_modifiers(keys.modifiers, keys.logical_key);
    harness.run_steps(1);
}

#[test]
fn nothing_that_is_pressed_makes_settings_that_no_frame_can_have() {
    let mut methods = Vec::new();
    for seed in 0..24 {
        let mut random = Random(seed);
        let mut fixture = fixture(Overlay::Full);
        if seed % 2 == 1 {
            fixture.choices.settings.method = Method::Checkerboard;
        }
        let mut harness = shown(fixture, [900.0, 3600.0]);
        for step in 0..400 {
            if random.below(4) == 0 {
                press_some_key(&mut harness, &mut random);
            } else {
                drag_something(&mut harness, &mut random);
            }
            let choices = &mut harness.state_mut().choices;
            choices.settings.validate().unwrap_or_else(|error| panic!("seed {seed}, step {step}: {error}"));
            assert_eq!(choices.conflict(), None, "seed {seed}, step {step}: {choices:?}");
            choices.overlay = Overlay::Full;
            choices.text_scale = 1.0;
            choices.help = false;
            methods.push((
                choices.settings.method,
                choices.settings.sampling > 1,
                choices.show != Show::Final,
            ));
            harness.run_steps(1);
        }
    }
    let seen = |wanted| methods.contains(&wanted);
    assert!(
        seen((Method::Checkerboard, false, true)) && seen((Method::Adaptive, true, false)),
        "too few presses"
    );
}

#[test]
fn what_is_excluded_cannot_be_pressed_until_nothing_excludes_it() {
    let mut fixture = fixture(Overlay::Full);
    fixture.choices.settings.sampling = 2;
    let mut harness = shown(fixture, [900.0, 3600.0]);
    for name in ["method: checkerboard", "show: depth"] {
        let button = harness.get_by_label(name);
        assert!(button.accesskit_node().is_disabled(), "{name}");
        button.click();
        harness.run_steps(2);
    }
    let chosen = |harness: &Harness<'_, HudFixture>| {
        (harness.state().choices.settings.method, harness.state().choices.show)
    };
    assert_eq!(chosen(&harness), (Method::Adaptive, Show::Final));
    for name in ["samples a pixel: 1x1", "show: cost", "method: checkerboard"] {
        harness.get_by_label(name).click();
        harness.run_steps(2);
    }
    assert_eq!(chosen(&harness), (Method::Checkerboard, Show::Cost));
    assert!(harness.get_by_label("show: depth").accesskit_node().is_disabled());
}

#[test]
fn keys_skip_what_is_excluded() {
    let mut fixture = fixture(Overlay::Hidden);
    fixture.choices.settings.sampling = 4;
    let mut harness = shown(fixture, [400.0, 400.0]);
    let mut methods = Vec::new();
    for _ in 0..3 {
        harness.key_press(Key::M);
        harness.key_press(Key::V);
        harness.run_steps(1);
        methods.push(harness.state().choices.settings.method);
    }
    assert_eq!(methods, [Method::Full, Method::Adaptive, Method::Full]);
    assert_eq!(harness.state().choices.show, Show::Final);
}

#[test]
fn a_number_that_is_none_is_not_taken() {
    for text in ["nan", "inf", "-1e30", "", "x"] {
        let mut harness = shown(fixture(Overlay::Full), [900.0, 3600.0]);
        for name in ["position in digits", "normal in digits", "depth in digits", "least weight in digits"] {
            harness.get_by_label(name).focus();
            harness.run_steps(3);
            harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
            harness.event(egui::Event::Text(text.to_owned()));
            harness.key_press(Key::Enter);
            harness.run_steps(3);
        }
        harness.state().choices.settings.validate().unwrap_or_else(|error| panic!("{text:?}: {error}"));
    }
}

#[test]
fn a_number_is_taken_and_the_paper_has_its_own_back() {
    let mut harness = shown(fixture(Overlay::Full), [900.0, 3600.0]);
    harness.get_by_label("position in digits").focus();
    harness.run_steps(3);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.event(egui::Event::Text("0.07".to_owned()));
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    let pos = |harness: &Harness<'_, HudFixture>| harness.state().choices.settings.tolerances.pos;
    assert_eq!(pos(&harness), 0.07);
    harness.get_by_label("position: paper value").click();
    harness.run_steps(2);
    assert_eq!(pos(&harness), 0.03);
}

#[test]
fn settings_from_elsewhere_are_left_as_they_are() {
    let mut fixture = fixture(Overlay::Full);
    let settings = &mut fixture.choices.settings;
    settings.depth = 40;
    settings.sampling = 3;
    settings.tolerances.norm = -0.5;
    settings.tolerances.pos = 4.0;
    let before = fixture.choices;
    assert_eq!(shown(fixture, [900.0, 3600.0]).state().choices, before);
}

#[test]
fn what_is_excluded_says_why() {
    let mut fixture = fixture(Overlay::Full);
    fixture.choices.settings.sampling = 2;
    fixture.choices.settings.method = Method::Full;
    let mut harness = shown(fixture, [900.0, 3600.0]);
    let reasons = [
        (Role::Button, "method: checkerboard", "sampling: expected 1 with method checkerboard, found 2"),
        (Role::Button, "show: depth", "is about pixels of one sample"),
        (Role::Button, "block: 8x8", "The adaptive method alone interpolates."),
        (Role::Slider, "position", "The adaptive method alone interpolates."),
        (Role::SpinButton, "resolution scale in digits", "The governor chooses the scale"),
    ];
    for (role, name, reason) in reasons {
        harness.get_by_role_and_label(role, name).hover();
        harness.run_steps(12);
        assert!(harness.query_by_label_contains(reason).is_some(), "{name}");
    }
}

#[test]
fn the_governor_rests_with_methods_that_it_does_not_govern() {
    for method in Method::ALL {
        let mut fixture = fixture(Overlay::Full);
        fixture.choices.settings = fixture.choices.settings.with_method(method);
        let governed = fixture.choices.governed().is_some();
        let before = fixture.choices.governor;
        let mut harness = shown(fixture, [900.0, 3600.0]);
        let button = harness.get_by_label("governor: 60 fps");
        assert_eq!(button.accesskit_node().is_disabled(), !governed, "{method:?}");
        harness.key_press(Key::G);
        harness.run_steps(2);
        assert_eq!(harness.state().choices.governor != before, governed, "{method:?}");
    }
}

#[test]
fn a_value_as_text_is_taken_where_it_is_one() {
    for (text, expected) in [("0.25,0.75", [0.25, 0.75]), ("wide", [0.5, 0.5]), ("1e9,0", [0.5, 0.5])] {
        let mut fixture = fixture(Overlay::Full);
        fixture.choices.settings = fixture.choices.settings.with_method(Method::Vr);
        let mut harness = shown(fixture, [900.0, 6000.0]);
        harness.get_by_label("Path tracing").click();
        harness.run_steps(12);
        harness.get_by_role_and_label(Role::TextInput, "gaze").focus();
        harness.run_steps(3);
        harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
        harness.event(egui::Event::Text(text.to_owned()));
        harness.key_press(Key::Enter);
        harness.run_steps(3);
        assert_eq!(harness.state().choices.settings.paths.gaze, expected, "{text}");
    }
}
