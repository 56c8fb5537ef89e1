//! Files from other apps: content URIs that lead to a scene, to nothing, to something that is no scene.

use super::Outcome;
use super::harness::Harness;
use crate::java::{self, Content, Intent};
use crate::{log, vulkan};

const PROVIDER: &str = "content://org.example.files/document/";

/// Plays it.
pub fn play(harness: &mut Harness) -> Outcome {
    let expected = harness.expected()?;
    let scene = harness.options.content.clone().ok_or("expected the option --content, found none")?;
    let name = scene.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let no_scene = std::env::temp_dir().join(format!("android-run-{}-no-scene.glb", std::process::id()));
    std::fs::write(&no_scene, "no scene\n").map_err(|e| format!("{}: {e}", no_scene.display()))?;
    java::with_world(|world| {
        let mut add = |key: &str, content| world.content.insert(format!("{PROVIDER}{key}"), content);
        add("1", Content::File { path: scene, name });
        add("2", Content::Missing);
        add("3", Content::Forbidden);
        add("4", Content::File { path: no_scene.clone(), name: "no-scene.glb".to_owned() });
    });

    harness.step("ACTION_VIEW shows the expected picture", |harness| {
        let intent = view(harness, "1");
        harness.launch(intent);
        harness.shows(&expected)?;
        harness.destroy()
    })?;
    harness.step("ACTION_SEND shows the expected picture", |harness| {
        let mut intent = view(harness, "1");
        intent.action = Some("android.intent.action.SEND".to_owned());
        (intent.stream, intent.data) = (intent.data, None);
        harness.launch(intent);
        harness.shows(&expected)?;
        harness.destroy()
    })?;
    let plain = harness.step("without any file", |harness| {
        let intent = harness.intent();
        harness.launch(intent);
        let picture = settled(harness)?;
        harness.destroy()?;
        Ok(picture)
    })?;
    for (key, what) in [
        ("2", "a URI that leads nowhere: a message"),
        ("3", "a URI that may not be read: a message"),
        ("4", "a file that is no scene: a message"),
    ] {
        harness.step(what, |harness| {
            let mark = log::mark();
            let intent = view(harness, key);
            harness.launch(intent);
            problem(harness, mark)?;
            let picture = settled(harness)?;
            if picture == plain {
                return Err("the picture is the same as without the file".to_owned());
            }
            let first = vulkan::presents();
            harness.with(|activity| activity.redraw());
            harness.shows_within_two(first, &picture)?;
            harness.destroy()
        })?;
    }
    std::fs::remove_file(&no_scene).map_err(|e| format!("{}: {e}", no_scene.display()))
}

fn view(harness: &Harness, key: &str) -> Intent {
    let mut intent = harness.intent();
    intent.extras.remove("scene");
    Intent {
        action: Some("android.intent.action.VIEW".to_owned()),
        data: Some(format!("{PROVIDER}{key}")),
        ..intent
    }
}

/// What is shown once something is loaded: the picture before may be that of waiting.
fn settled(harness: &mut Harness) -> Outcome<std::sync::Arc<crate::picture::Picture>> {
    harness.wait(std::time::Duration::from_secs(10));
    harness.rest()
}

/// The app says that something is wrong.
pub fn problem(harness: &Harness, mark: u64) -> Outcome<String> {
    harness.log(mark, "a line `problem: ...` at WARN with the tag glimpse", |line| {
        line.strip_prefix("W/glimpse: ").filter(|text| text.contains("problem:")).map(str::to_owned)
    })
}
