//! The window's title, read from the X server.

use x11rb::{
    connection::Connection,
    protocol::xproto::{AtomEnum, ConnectionExt},
};

use crate::harness::ScriptHarness;

/// Titles of all windows of an X server without a window manager.
fn titles(display: &str) -> Vec<String> {
    let (connection, screen) = x11rb::connect(Some(display)).unwrap();
    let root = connection.setup().roots[screen].root;
    let name = connection.intern_atom(false, b"_NET_WM_NAME").unwrap().reply().unwrap().atom;
    let windows = connection.query_tree(root).unwrap().reply().unwrap().children;
    let title = |window| {
        // A window may be gone by now.
        let title =
            connection.get_property(false, window, name, AtomEnum::ANY, 0, 1024).ok()?.reply().ok()?;
        String::from_utf8(title.value).ok()
    };
    windows.into_iter().filter_map(title).filter(|title| !title.is_empty()).collect()
}

#[test]
fn the_title_names_the_scene() {
    let harness = ScriptHarness::with_window();
    let display = harness.display().to_owned();
    let mut found = Vec::new();
    let script = "settle\nprint title\nwait 1\nopen builtin:minray\nsettle\nwait 0.1\nprint title\nwait 1";
    let ended =
        harness.plays_watched("builtin:cornell --size 64x36", script, |_| found.push(titles(&display)));
    let expected = ["cornell - Glimpse", "minray - Glimpse"];
    assert_eq!(found, expected.map(|title| vec![title.to_owned()]));
    assert_eq!(ended.told("title"), expected);
}
