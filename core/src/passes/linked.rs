//! What the kernels of an adaptive frame are made of: what leaving out saves is the difference of two of these.

use std::collections::BTreeSet;

use super::{Stage, Variant};
use crate::{Linking, Result, Scene, gpu::shader::link};

/// Everything that is linked into the kernels of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Linked {
    /// WGSL files.
    pub files: BTreeSet<&'static str>,
    /// Buffers and images that some kernel binds.
    pub bindings: BTreeSet<String>,
    /// Bytes of the attributes that are stored of a sample.
    pub attribute_bytes: usize,
}

impl Linked {
    /// Of a scene that is not on a device yet.
    ///
    /// # Errors
    /// [`crate::Error::Shader`] where a kernel does not link.
    pub fn of(scene: &Scene, linking: Linking) -> Result<Self> {
        let variant = Variant::of_scene(scene, linking);
        let mut linked = Self {
            files: BTreeSet::new(),
            bindings: BTreeSet::new(),
            attribute_bytes: size_of::<u32>() * variant.planes().len(),
        };
        for stage in Stage::ALL {
            let sources = variant.sources(stage);
            let kernel = link(&sources)?;
            linked.bindings.extend(kernel.used_resources().map(|(name, ..)| name.to_owned()));
            linked.files.extend(sources.iter().map(|source| source.file));
        }
        Ok(linked)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin;

    #[test]
    fn a_plain_scene_is_spared_what_it_does_not_need() {
        let wires = builtin("wires").expect("wires");
        let all = Linked::of(&wires, Linking::All).expect("links");
        let auto = Linked::of(&wires, Linking::Auto).expect("links");
        let spared: Vec<_> = all.bindings.difference(&auto.bindings).map(String::as_str).collect();
        assert_eq!(spared, ["atlas_color", "atlas_data", "vertices"]);
        assert!(auto.bindings.is_subset(&all.bindings));
        assert_eq!((auto.attribute_bytes, all.attribute_bytes), (12, 32));
        for file in ["wgsl/texture_atlas.wgsl", "wgsl/bounce_glass.wgsl", "wgsl/sphere_analytic.wgsl"] {
            assert!(all.files.contains(file) && !auto.files.contains(file), "{file}");
        }
    }

    #[test]
    fn everything_is_the_same_for_every_scene() {
        let of = |name| Linked::of(&builtin(name).expect(name), Linking::All).expect("links");
        assert_eq!(of("wires"), of("room"));
        assert_eq!(of("furnace"), of("room"));
    }
}
