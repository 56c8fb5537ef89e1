//! Loads scenes as the options of their files say.

use std::path::Path;

use glimpse::Scene;
use glimpse::scene::ImportOptions;

use crate::args::SceneOptions;
use crate::scene_file;

impl SceneOptions {
    /// Loads a scene as [`scene_file::load_seen`] does.
    pub fn load(&self, name: &Path, seen: &mut dyn FnMut(&Path, &[u8])) -> anyhow::Result<Scene> {
        let memory = self.memory.map(|size| size.0);
        let scene =
            scene_file::load_seen(name, &ImportOptions { variant: self.variant.as_deref(), memory }, seen)?;
        if self.strict {
            scene_file::check_whole(name, &scene.warnings, &scene.not_shown)?;
        }
        Ok(scene)
    }
}
