//! The list of scenes, the scene on display and the requested one.

use crate::SceneFacts;

/// Number of recent files that are remembered.
const MOST_RECENT: usize = 8;

/// The scene on display, the scene requested last, and the scenes offered.
pub(crate) struct SceneList {
    shown: Option<SceneFacts>,
    wanted: String,
    /// Recent file names, the newest first; opening one cuts the list to [`MOST_RECENT`].
    recent: Vec<String>,
    /// Names offered: the built-in scenes, then the recent files.
    offered: Vec<String>,
}

impl SceneList {
    /// Starts without a scene on display; `wanted` is the requested one.
    pub fn new(wanted: &str, recent: Vec<String>) -> Self {
        let mut list = Self { shown: None, wanted: wanted.to_owned(), recent, offered: Vec::new() };
        list.offer();
        list
    }

    /// Names of the scenes offered.
    pub fn offered(&self) -> &[String] {
        &self.offered
    }

    /// The scene on display.
    pub fn shown(&self) -> Option<&SceneFacts> {
        self.shown.as_ref()
    }

    /// Name of the scene requested last.
    pub fn wanted(&self) -> &str {
        &self.wanted
    }

    /// Records a request for another scene.
    pub fn want(&mut self, name: &str) {
        name.clone_into(&mut self.wanted);
    }

    /// Records that a scene is shown. For a file, returns the recent files to store, this one first.
    pub fn opened(&mut self, facts: SceneFacts) -> Option<&[String]> {
        let from_file = !facts.name.starts_with("builtin:");
        if from_file {
            self.recent.retain(|known| *known != facts.name);
            self.recent.insert(0, facts.name.clone());
            self.recent.truncate(MOST_RECENT);
            self.offer();
        }
        self.shown = Some(facts);
        from_file.then_some(&*self.recent)
    }

    /// Records that the requested scene cannot be opened: the one on display counts as requested again. If
    /// there is none, returns the name of a scene to load instead, the first built-in one unless that is the
    /// one that failed.
    pub fn not_opened(&mut self) -> Option<String> {
        if let Some(shown) = &self.shown {
            self.wanted.clone_from(&shown.name);
            return None;
        }
        let first = crate::scenes().next().filter(|first| *first != self.wanted)?;
        self.wanted.clone_from(&first);
        Some(first)
    }

    /// Title of the window: the scene on display, without its folder, and the program.
    pub fn title(&self) -> String {
        let name = self.shown.as_ref().map(|scene| short_name(&scene.name).replace(char::is_control, " "));
        name.map_or("Glimpse".to_owned(), |name| format!("{name} - Glimpse"))
    }

    fn offer(&mut self) {
        self.offered = crate::scenes().chain(self.recent.iter().cloned()).collect();
    }
}

/// Name of a scene for display: that of its file without the folder, or of a built-in scene.
pub(crate) fn short_name(scene: &str) -> &str {
    let file = scene.rsplit(['/', '\\']).next().unwrap_or(scene);
    scene.strip_prefix("builtin:").unwrap_or(file)
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;

    fn facts(name: &str) -> SceneFacts {
        SceneFacts {
            name: name.to_owned(),
            primitives: 0,
            cameras: Vec::new(),
            start: crate::StartCamera::default(),
            origin: DVec3::ZERO,
            bounds: (Vec3::ZERO, Vec3::ONE),
            warnings: Vec::new(),
            not_shown: Vec::new(),
            not_shown_by: Vec::new(),
            features: Vec::new(),
        }
    }

    #[test]
    fn scenes_are_called_by_their_last_name() {
        assert_eq!(short_name("builtin:room"), "room");
        assert_eq!(short_name("/home/a/kitchen.glb"), "kitchen.glb");
        assert_eq!(short_name(r"C:\scenes\kitchen.glb"), "kitchen.glb");
    }

    #[test]
    fn the_title_names_the_scene_on_display() {
        let mut list = SceneList::new("/home/a/kitchen.glb", Vec::new());
        assert_eq!(list.title(), "Glimpse");
        list.opened(facts("/home/a/kit\nchen.glb"));
        assert_eq!(list.title(), "kit chen.glb - Glimpse");
        list.want("builtin:room");
        assert_eq!(list.title(), "kit chen.glb - Glimpse", "until the other one is loaded");
    }

    #[test]
    fn files_are_remembered_once_the_last_one_first() {
        let mut list = SceneList::new("builtin:room", Vec::new());
        assert_eq!(list.opened(facts("builtin:room")), None);
        for name in ["a.glb", "b.glb", "a.glb"] {
            assert!(list.opened(facts(name)).is_some());
        }
        assert_eq!(list.opened(facts("c.glb")), Some(&["c.glb", "a.glb", "b.glb"].map(str::to_owned)[..]));
        assert!(list.offered().ends_with(&["c.glb", "a.glb", "b.glb"].map(str::to_owned)));
        assert_eq!(list.offered().len(), crate::scenes().count() + 3);
        for file in 0..2 * MOST_RECENT {
            list.opened(facts(&format!("{file}.glb")));
        }
        assert_eq!(list.offered().len(), crate::scenes().count() + MOST_RECENT);
    }

    #[test]
    fn where_a_scene_cannot_be_opened_the_one_before_stays_or_the_first_comes() {
        let first = crate::scenes().next().expect("a built-in scene");
        let mut list = SceneList::new("missing.glb", Vec::new());
        assert_eq!(list.not_opened().as_ref(), Some(&first));
        assert_eq!(list.wanted(), first);
        assert_eq!(list.not_opened(), None, "the first one itself cannot be opened");
        list.opened(facts("a.glb"));
        list.want("missing.glb");
        assert_eq!(list.not_opened(), None);
        assert_eq!(list.wanted(), "a.glb");
    }
}
