//! Input goes either to the overlay or to the picture.

use std::collections::BTreeSet;

use egui::{Event, Key, Modifiers, Role, pos2, vec2};
use egui_kittest::Node;
use egui_kittest::kittest::{NodeT, Queryable};

use super::*;
use crate::Navigation;

#[test]
fn the_picture_gets_what_the_overlay_does_not_cover() {
    for overlay in [Overlay::Hidden, Overlay::Brief, Overlay::Full] {
        let mut fixture = fixture(overlay);
        fixture.choices.split = Some(0.5);
        let mut harness = shown(fixture, [1280.0, 720.0]);
        // On the line beside the handle, and away from the line.
        for at in [pos2(640.0, 200.0), pos2(300.0, 500.0)] {
            harness.state_mut().picture = 0;
            harness.drag_at(at);
            harness.run_steps(2);
            harness.drop_at(at + vec2(30.0, 10.0));
            harness.run_steps(2);
            assert!(harness.state().picture > 0, "{overlay:?} {at:?}");
        }
        assert_eq!(harness.state().choices.split, Some(0.5));
    }
}

#[test]
fn the_picture_does_not_get_what_the_overlay_takes() {
    let mut harness = shown(fixture(Overlay::Brief), [1280.0, 720.0]);
    harness.get_by_label("menu").click();
    harness.run_steps(3);
    assert_eq!(harness.state().choices.overlay, Overlay::Full);
    // The panel's background, between its controls.
    harness.drag_at(pos2(940.0, 400.0));
    harness.run_steps(2);
    harness.drop_at(pos2(940.0, 500.0));
    harness.run_steps(2);
    harness.get_by_label("close overlay").click();
    harness.run_steps(2);
    assert_eq!((harness.state().choices.overlay, harness.state().picture), (Overlay::Brief, 0));
}

#[test]
fn a_finger_finds_the_way_back_from_the_hidden_overlay() {
    let mut hidden = fixture(Overlay::Hidden);
    hidden.touch = true;
    let mut harness = shown(hidden, [412.0, 915.0]);
    harness.get_by_label("menu").click();
    harness.run_steps(2);
    assert_eq!(harness.state().choices.overlay, Overlay::Brief);
}

#[test]
fn the_divider_follows_the_pointer_and_the_arrows() {
    let mut fixture = fixture(Overlay::Brief);
    fixture.choices.split = Some(0.5);
    let mut harness = shown(fixture, [1000.0, 600.0]);
    let handle = harness.get_by_label("split").rect().center();
    harness.drag_at(handle);
    harness.run_steps(2);
    harness.hover_at(handle + vec2(100.0, 0.0));
    harness.run_steps(2);
    harness.drop_at(handle + vec2(100.0, 0.0));
    harness.run_steps(2);
    let split = |harness: &Harness<'_, HudFixture>| harness.state().choices.split.unwrap();
    assert!((split(&harness) - 0.6).abs() < 1e-3, "{}", split(&harness));
    harness.get_by_label("split").focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowLeft);
    harness.run_steps(2);
    assert!((split(&harness) - 0.59).abs() < 1e-3, "{}", split(&harness));
    for _ in 0..70 {
        harness.key_press(Key::ArrowLeft);
        harness.run_steps(1);
    }
    assert_eq!(split(&harness), 0.0);
}

#[test]
fn every_control_can_be_reached_by_the_keyboard() {
    let mut fixture = fixture(Overlay::Full);
    fixture.choices.split = Some(0.5);
    let mut harness = shown(fixture, [900.0, 3600.0]);
    let roles = [Role::Button, Role::Slider, Role::SpinButton, Role::CheckBox, Role::DisclosureTriangle];
    let names = |harness: &Harness<'_, HudFixture>, wanted: fn(&Node<'_>) -> bool| {
        let nodes = roles.into_iter().flat_map(|role| harness.query_all_by_role(role));
        nodes.filter(wanted).filter_map(|node| node.accesskit_node().label()).collect::<BTreeSet<_>>()
    };
    let enabled = names(&harness, |node| !node.accesskit_node().is_disabled());
    let mut reached = BTreeSet::new();
    for _ in 0..120 {
        harness.key_press(Key::Tab);
        harness.run_steps(2);
        reached.extend(names(&harness, |node| node.is_focused()));
    }
    assert!(enabled.contains("split") && enabled.len() > 60, "{enabled:?}");
    assert_eq!(enabled.difference(&reached).collect::<Vec<_>>(), Vec::<&String>::new());
}

#[test]
fn keys_are_heard() {
    let mut harness = shown(fixture(Overlay::Hidden), [800.0, 600.0]);
    for key in [Key::S, Key::R, Key::F, Key::Num6, Key::Num9, Key::C, Key::H] {
        harness.key_press(key);
        harness.run_steps(1);
    }
    harness.key_press_modifiers(Modifiers::COMMAND, Key::O);
    harness.event(Event::Copy);
    harness.run_steps(1);
    let wished = [
        UserRequest::Screenshot,
        UserRequest::ResetCamera,
        UserRequest::FullScreen,
        UserRequest::Open("/tmp/kitchen.glb".to_owned()),
        UserRequest::Camera(1),
        UserRequest::OpenDialog,
        UserRequest::CopyCommand,
    ];
    assert_eq!(harness.state().user_requests, wished);
    assert_eq!(harness.state().choices.overlay, Overlay::Brief);
}

#[test]
fn the_camera_keeps_its_keys_while_flying() {
    let mut flying = fixture(Overlay::Brief);
    flying.choices.navigation = Navigation::Fly;
    let mut harness = shown(flying, [800.0, 600.0]);
    harness.key_press(Key::S);
    harness.run_steps(1);
    assert_eq!(harness.state().user_requests, []);
    harness.key_press(Key::F12);
    harness.run_steps(1);
    assert_eq!(harness.state().user_requests, [UserRequest::Screenshot]);
}

#[test]
fn letters_that_are_typed_into_a_field_do_nothing_else() {
    let mut harness = shown(fixture(Overlay::Full), [1280.0, 3000.0]);
    harness.get_by_label("position in digits").focus();
    harness.run_steps(3);
    harness.key_press(Key::H);
    harness.run_steps(2);
    assert_eq!(harness.state().choices.overlay, Overlay::Full);
}

#[test]
fn a_problem_waits_until_it_is_closed() {
    let mut troubled = fixture(Overlay::Brief);
    troubled.hud_state.problem = Some("scene.glb: expected a glTF header\nfound `PK`".to_owned());
    let mut harness = shown(troubled, [800.0, 600.0]);
    harness.get_by_label_contains("expected a glTF header");
    harness.key_press(Key::S);
    harness.run_steps(1);
    assert_eq!(harness.state().user_requests, []);
    harness.get_by_label("close problem").click();
    harness.run_steps(2);
    harness.key_press(Key::Escape);
    harness.run_steps(1);
    assert_eq!(harness.state().user_requests, [UserRequest::CloseProblem, UserRequest::CloseProblem]);
}

#[test]
fn the_help_names_every_shortcut_and_closes() {
    let mut harness = shown(fixture(Overlay::Brief), [800.0, 1600.0]);
    harness.key_press(Key::F1);
    harness.run_steps(3);
    for shortcut in &super::super::keys::SHORTCUTS {
        harness.get_by_label(shortcut.does);
    }
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert!(!harness.state().choices.help);
    assert!(harness.query_by_label("close help").is_none());
}
