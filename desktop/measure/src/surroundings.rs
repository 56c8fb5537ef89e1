//! What surrounds a scene: its file's own environment, a map, or nothing.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::Context;
use glimpse::{Picture, Scene, scene::EnvironmentMap};

use crate::files;

/// The choice of `--environment` and `--environment-rotation`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// `None` for what the file states.
    pub environment: Option<EnvironmentChoice>,
    /// Rotation of the map about the vertical axis in degrees, counter-clockwise seen from above.
    pub rotation: f32,
}

/// A named environment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EnvironmentChoice {
    /// None but what the file states, not even the studio of a file without a light.
    Nothing,
    /// The built-in studio.
    Studio,
    /// A map in a Radiance (.hdr) or OpenEXR (.exr) file.
    File(PathBuf),
}

const STUDIO: &str = "builtin:studio";

impl FromStr for EnvironmentChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::try_from(OsString::from(text))
    }
}

impl TryFrom<OsString> for EnvironmentChoice {
    type Error = String;

    fn try_from(name: OsString) -> Result<Self, String> {
        let path = PathBuf::from(name);
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match (path.to_str(), ending.as_deref()) {
            (Some("none"), _) => Ok(Self::Nothing),
            (Some(STUDIO), _) => Ok(Self::Studio),
            (_, Some("hdr" | "exr")) => Ok(Self::File(path)),
            _ => Err(format!("expected a .hdr or .exr file, {STUDIO} or none, found {}", path.display())),
        }
    }
}

impl Surroundings {
    /// The file that the map is read from, if it is.
    pub fn file(&self) -> Option<&Path> {
        match &self.environment {
            Some(EnvironmentChoice::File(path)) => Some(path),
            _ => None,
        }
    }

    /// Fails early, without reading any content, where [`Surroundings::apply`] cannot succeed.
    pub fn check(&self) -> anyhow::Result<()> {
        self.file().map_or(Ok(()), files::readable)
    }

    /// Surrounds a scene.
    pub fn apply(&self, scene: &mut Scene) -> anyhow::Result<()> {
        match &self.environment {
            None => {}
            Some(EnvironmentChoice::Nothing) => scene.leave_studio(),
            Some(EnvironmentChoice::Studio) => scene.surround(EnvironmentMap::studio()),
            Some(EnvironmentChoice::File(path)) => {
                let name = || path.display().to_string();
                let picture = Picture::decode(&files::read(path)?).with_context(name)?;
                let Picture::Linear(image) = picture else {
                    anyhow::bail!(
                        "{}: expected linear radiance (.hdr, .exr), found a display picture",
                        name()
                    );
                };
                scene.surround(EnvironmentMap::from_equirectangular(&image).with_context(name)?);
            }
        }
        if self.rotation != 0.0
            && let Some(map) = scene.environment_map.take()
        {
            scene.environment_map = Some(map.rotated(self.rotation.to_radians()));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glimpse::scene::builtin;

    #[test]
    fn environments_are_named() {
        assert_eq!("none".parse(), Ok(EnvironmentChoice::Nothing));
        assert_eq!("builtin:studio".parse(), Ok(EnvironmentChoice::Studio));
        assert_eq!("a/b.HDR".parse(), Ok(EnvironmentChoice::File("a/b.HDR".into())));
        let error = EnvironmentChoice::from_str("sky.png").unwrap_err();
        assert!(error.contains("builtin:studio") && error.contains("sky.png"), "{error}");
    }

    #[test]
    fn a_map_is_turned_and_none_leaves_what_the_file_states() {
        let mut scene = builtin("room").unwrap();
        let before = scene.environment;
        let nothing = Surroundings { environment: Some(EnvironmentChoice::Nothing), rotation: 0.0 };
        nothing.apply(&mut scene).unwrap();
        assert_eq!((scene.environment, scene.environment_map.is_none()), (before, true));
        Surroundings { environment: Some(EnvironmentChoice::Studio), rotation: 90.0 }
            .apply(&mut scene)
            .unwrap();
        let turned = scene.environment_map.unwrap().rotation();
        assert!((turned - std::f32::consts::FRAC_PI_2).abs() < 1e-6);
    }

    #[test]
    fn a_missing_or_wrong_map_is_named() {
        let of = |path: &Path| Surroundings {
            environment: Some(EnvironmentChoice::File(path.into())),
            rotation: 0.0,
        };
        let gone = of("gone.hdr".as_ref()).check().unwrap_err().to_string();
        assert!(gone.contains("gone.hdr"), "{gone}");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sky.hdr");
        std::fs::write(&path, b"#?RADIANCE\n\nnonsense").unwrap();
        let error = format!("{:#}", of(&path).apply(&mut builtin("room").unwrap()).unwrap_err());
        assert!(error.contains("sky.hdr"), "{error}");
    }
}
