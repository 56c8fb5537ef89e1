//! The list of files by keyboard, mouse and finger.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

use super::*;
use crate::{App, Folder, FolderEntry};

fn folder(scenes: usize) -> Folder {
    let entry = |name: &str, is_folder| FolderEntry {
        name: name.to_owned(),
        path: std::path::Path::new("/models").join(name),
        is_folder,
    };
    let scenes = (0..scenes).map(|index| entry(&format!("scene {index:03}.glb"), false));
    Folder {
        path: "/models".into(),
        entries: [entry("parts", true)].into_iter().chain(scenes).collect(),
        problem: None,
    }
}

fn listing(folder: Folder) -> Harness<'static, HudFixture> {
    let mut fixture = fixture(Overlay::Full);
    fixture.hud_state.folder = Some(folder);
    shown(fixture, [800.0, 600.0])
}

fn press(harness: &mut Harness<'static, HudFixture>, keys: &[Key]) {
    for key in keys {
        harness.key_press(*key);
        harness.run_steps(2);
    }
}

fn scene(name: &str) -> UserRequest {
    UserRequest::Open(App::file_name(&std::path::Path::new("/models").join(name)))
}

#[test]
fn a_click_opens_a_folder_or_a_scene() {
    let mut harness = listing(folder(3));
    for name in ["parts/", "scene 001.glb", "Up", "close file list"] {
        harness.get_by_label(name).click();
        harness.run_steps(2);
    }
    let wished = [
        UserRequest::Browse("/models/parts".into()),
        scene("scene 001.glb"),
        UserRequest::Browse("/".into()),
        UserRequest::CloseFolder,
    ];
    assert_eq!(harness.state().user_requests, wished);
}

#[test]
fn keys_choose_and_open_and_do_nothing_else() {
    let mut harness = listing(folder(200));
    let before = harness.state().choices;
    press(&mut harness, &[Key::Enter, Key::ArrowDown, Key::ArrowDown, Key::ArrowUp, Key::Enter]);
    press(&mut harness, &[Key::End, Key::Enter, Key::PageUp, Key::Enter, Key::Home, Key::Enter]);
    press(&mut harness, &[Key::Backspace, Key::M, Key::Num3, Key::Escape]);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::O);
    harness.run_steps(2);
    let wished = [
        UserRequest::Browse("/models/parts".into()),
        scene("scene 000.glb"),
        scene("scene 199.glb"),
        scene("scene 189.glb"),
        UserRequest::Browse("/models/parts".into()),
        UserRequest::Browse("/".into()),
        UserRequest::CloseFolder,
    ];
    assert_eq!(harness.state().user_requests, wished);
    assert_eq!(harness.state().choices, before);
}

#[test]
fn the_chosen_entry_is_in_sight() {
    let mut harness = listing(folder(200));
    assert!(harness.query_by_label("scene 199.glb").is_none());
    press(&mut harness, &[Key::End]);
    harness.run_steps(20);
    let rect = harness.get_by_label("scene 199.glb").rect();
    assert!(rect.bottom() < 600.0, "{rect:?}");
    press(&mut harness, &[Key::Home]);
    harness.run_steps(20);
    harness.get_by_label("parts/");
}

#[test]
fn a_folder_that_is_empty_or_cannot_be_read_says_so() {
    let empty = Folder { path: "/".into(), ..Folder::default() };
    let harness = listing(empty.clone());
    harness.get_by_label_contains("No folder and no .glb or .gltf file is here.");
    let problem = Some("cannot read /: Permission denied".to_owned());
    let mut harness = listing(Folder { problem, ..empty });
    harness.get_by_label_contains("Permission denied");
    press(&mut harness, &[Key::Enter, Key::ArrowDown, Key::Backspace]);
    assert_eq!(harness.state().user_requests, [], "nothing is above the root");
}

#[test]
fn the_camera_stays_while_a_dialog_is_open() {
    let harness = listing(folder(3));
    assert!(harness.ctx.memory(|memory| memory.top_modal_layer().is_some()));
}
