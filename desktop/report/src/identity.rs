//! Identities of measurements: the keys of the store.

use std::fmt;

use anyhow::Context;
use glimpse::{Camera, Settings};
use glimpse_measure::files;
use serde::Serialize;

/// 128-bit FNV-1a hash (Fowler, Noll, Vo; draft-eastlake-fnv) over byte strings, each preceded by its length.
/// It names cache files and need not resist forgery.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fingerprint(u128);

impl Fingerprint {
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

    /// Fingerprint of an empty list of parts.
    pub fn new() -> Self {
        Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d)
    }

    /// Appends a part and its length.
    pub fn and(self, part: &[u8]) -> Self {
        self.bytes(&(part.len() as u64).to_le_bytes()).bytes(part)
    }

    fn bytes(self, bytes: &[u8]) -> Self {
        Self(bytes.iter().fold(self.0, |hash, byte| (hash ^ u128::from(*byte)).wrapping_mul(Self::PRIME)))
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

/// Fingerprint of the running executable, which contains the shaders, the built-in scenes and the metrics.
pub fn program() -> anyhow::Result<Fingerprint> {
    let path = std::env::current_exe().context("cannot find this program's own file")?;
    Ok(Fingerprint::new().and(&files::read(&path)?))
}

/// Everything that a picture and its time depend on; measurements of equal identity are made once.
#[derive(Clone, Debug, Serialize)]
pub struct Identity {
    /// Fingerprint of the program's executable.
    pub program: String,
    /// Adapter name and driver; empty where the time does not matter.
    pub adapter: String,
    /// Fingerprint of all files of the scene.
    pub scene: String,
    /// Change made to the scene: [`Variant`](crate::subject::Variant) as text.
    pub variant: String,
    /// All fields of the camera as text.
    pub camera: String,
    /// Settings of the renderer.
    pub settings: Settings,
    /// Size in pixels at which the frame is rendered.
    pub rendered: [u32; 2],
    /// Size in pixels at which the picture is compared with the reference and shown.
    pub shown: [u32; 2],
    /// Name of the reference that the error is measured against.
    pub against: String,
}

impl Identity {
    /// Formats all fields of a camera, so that different cameras give different text.
    pub fn camera(camera: &Camera) -> String {
        format!("{camera:?}")
    }

    /// Serialises the identity into the one line of JSON that the store compares.
    pub fn line(&self) -> anyhow::Result<String> {
        serde_json::to_string(self).context("JSON")
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// An identity for tests.
    pub fn example() -> Identity {
        Identity {
            program: "p".into(),
            adapter: "a".into(),
            scene: Fingerprint::new().and(b"scene").to_string(),
            variant: String::new(),
            camera: "c".into(),
            settings: Settings::default(),
            rendered: [4, 3],
            shown: [4, 3],
            against: "full".into(),
        }
    }

    #[test]
    fn the_hash_is_fnv_1a() {
        let hash = |bytes: &[u8]| Fingerprint::new().bytes(bytes).to_string();
        assert_eq!(hash(b""), "6c62272e07bb014262b821756295c58d");
        assert_eq!(hash(b"a"), "d228cb696f1a8caf78912b704e4a8964");
    }

    #[test]
    fn parts_do_not_run_together() {
        let of = |parts: [&[u8]; 2]| Fingerprint::new().and(parts[0]).and(parts[1]);
        assert_ne!(of([b"ab", b"c"]), of([b"a", b"bc"]));
        assert_ne!(of([b"", b"abc"]), of([b"abc", b""]));
    }

    #[test]
    fn whatever_changes_makes_another_identity() {
        let line = |change: &dyn Fn(&mut Identity)| {
            let mut identity = example();
            change(&mut identity);
            identity.line().unwrap()
        };
        let changed = [
            line(&|_| ()),
            line(&|i| i.program = "q".into()),
            line(&|i| i.adapter = "b".into()),
            line(&|i| i.scene = Fingerprint::new().and(b"scenf").to_string()),
            line(&|i| i.variant = "20 %".into()),
            line(&|i| i.camera = "d".into()),
            line(&|i| i.settings.depth = 4),
            line(&|i| i.settings.min_weight = 0.1),
            line(&|i| i.settings.refresh_fraction = 0.2),
            line(&|i| i.settings.tolerances.pos = 0.1),
            line(&|i| i.rendered = [3, 4]),
            line(&|i| i.shown = [3, 4]),
            line(&|i| i.against = "256 samples".into()),
        ];
        for (i, a) in changed.iter().enumerate() {
            assert!(changed[..i].iter().all(|b| a != b), "{a}");
        }
    }
}
