//! Which code and data the kernels of an adaptive frame link; shows what specialization to a scene saves.

use std::collections::BTreeSet;

use super::{FrameSpec, stages};
use crate::{
    Postcorrect, Result, Scene, Settings, Specialize, device::gpu_scene::SceneFacts, device::shader::link,
    frame::plan::Plan, scene::Thinness,
};

/// Size of the assumed frame in pixels; only `postcorrect auto` depends on it.
const SIZE: [u32; 2] = [2560, 1440];

/// What the kernels of an adaptive frame of 2560x1440 with default settings link.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Linked {
    /// Linked WGSL files.
    pub files: BTreeSet<&'static str>,
    /// Names of the buffers and images that the kernels bind.
    pub bindings: BTreeSet<String>,
    /// Bytes of stored attributes for two samples, one below the other.
    pub attribute_bytes: usize,
}

impl Linked {
    /// Links the kernels for a scene that need not be on a device, and has this [`Thinness::of`].
    ///
    /// # Errors
    /// [`crate::Error::Shader`] if a kernel does not link.
    pub fn of(scene: &Scene, thinness: &Thinness, specialize: Specialize) -> Result<Self> {
        let settings = Settings { specialize, ..Settings::default() };
        // `All` links postcorrection even if the scene has nothing thin.
        let everything = specialize == Specialize::All;
        let corrects = everything || thinness.is_thin(SIZE[1], settings.block);
        let postcorrect = if corrects { Postcorrect::On } else { Postcorrect::Off };
        let spec = FrameSpec::of_scene(scene, thinness, &Settings { postcorrect, ..settings });
        let probe_points = spec.scene.probe_points.max(u32::from(everything));
        let spec = FrameSpec { scene: SceneFacts { probe_points, ..spec.scene }, ..spec };
        let mut linked = Self {
            files: BTreeSet::new(),
            bindings: BTreeSet::new(),
            attribute_bytes: size_of::<u32>() * spec.channels().len(),
        };
        let passes = Plan::new(&spec, SIZE, SIZE[1]).passes();
        for stage in stages().filter(|stage| passes.contains(stage)) {
            let sources = spec.sources(stage);
            let kernel = link(&sources)?;
            linked.bindings.extend(kernel.used_resources().map(|(name, ..)| name.to_owned()));
            linked.files.extend(sources.iter().map(|source| source.file));
        }
        Ok(linked)
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::scene::{Material, TextureSlot, builtin};

    #[test]
    fn a_plain_scene_is_spared_what_it_does_not_need() {
        let wires = builtin("wires").expect("wires");
        let thinness = Thinness::of(&wires);
        let [auto, all] = [Specialize::Auto, Specialize::All]
            .map(|specialize| Linked::of(&wires, &thinness, specialize).expect("links"));
        let spared: Vec<_> = all.bindings.difference(&auto.bindings).map(String::as_str).collect();
        assert_eq!(spared, ["atlas_color", "atlas_data", "vertices"]);
        assert!(auto.bindings.is_subset(&all.bindings));
        assert_eq!((auto.attribute_bytes, all.attribute_bytes), (16, 72));
        for file in [
            "wgsl/scene/texture_atlas.wgsl",
            "wgsl/trace/ray_cone.wgsl",
            "wgsl/shade/scatter_dielectric.wgsl",
            "wgsl/trace/sphere_analytic.wgsl",
            "wgsl/adaptive/maps.wgsl",
            "wgsl/adaptive/similarity_maps.wgsl",
            "wgsl/trace/surface_maps.wgsl",
            "wgsl/shade/material_extended.wgsl",
            "wgsl/shade/material_maps.wgsl",
        ] {
            assert!(all.files.contains(file) && !auto.files.contains(file), "{file}");
        }
    }

    /// What lobes of materials need is linked where a material has the lobe.
    #[test]
    fn lobes_are_linked_where_materials_have_them() {
        type Change = fn(&mut Material);
        let of = |change: Change| {
            let mut scene = builtin("room").expect("room");
            scene.tangents = vec![[0; 3]; scene.positions.len()];
            scene.materials.iter_mut().for_each(change);
            Linked::of(&scene, &Thinness::of(&scene), Specialize::Auto).expect("links").files
        };
        let extended = of(|m| m.specular = 0.5);
        let lobes: [(Change, &[&str]); 5] = [
            (|m| m.sheen_color = Vec3::ONE, &["wgsl/shade/sheen.wgsl", "wgsl/shade/lobe_albedos.wgsl"]),
            (|m| m.anisotropy = 0.5, &["wgsl/shade/anisotropy.wgsl"]),
            (|m| m.iridescence = 0.5, &["wgsl/shade/iridescence.wgsl"]),
            (
                |m| m.diffuse_transmission = 0.5,
                &["wgsl/shade/translucency.wgsl", "wgsl/shade/translucency_lights.wgsl"],
            ),
            (
                |m| {
                    m.clearcoat = 0.5;
                    m.maps.insert(TextureSlot::Normal, 0);
                },
                &["wgsl/shade/coat_normal.wgsl", "wgsl/shade/coat_lights.wgsl"],
            ),
        ];
        for (change, files) in lobes {
            let linked = of(change);
            for file in files {
                assert!(linked.contains(file) && !extended.contains(file), "{file}");
            }
        }
    }

    #[test]
    fn postcorrection_is_linked_where_it_is_on() {
        let files = |name, specialize| {
            let scene = builtin(name).expect(name);
            Linked::of(&scene, &Thinness::of(&scene), specialize).expect("links").files
        };
        let of_postcorrection =
            ["passes/postcorrect/postcorrect.wgsl", "passes/postcorrect/postcorrect_seed.wgsl"];
        for (name, specialize, corrects) in [
            ("wires", Specialize::Auto, true),
            ("cornell", Specialize::Auto, false),
            ("cornell", Specialize::All, true),
        ] {
            let files = files(name, specialize);
            assert!(
                of_postcorrection.iter().all(|file| files.contains(file) == corrects),
                "{name}, {specialize:?}"
            );
        }
    }

    #[test]
    fn other_frames_are_not_counted() {
        let room = builtin("room").expect("room");
        let all = Linked::of(&room, &Thinness::of(&room), Specialize::All).expect("links").files;
        for other in ["full", "checkerboard", "fill", "resolve", "postcorrect_scan"] {
            assert!(!all.contains(format!("passes/{other}.wgsl").as_str()), "{other}");
        }
    }

    #[test]
    fn everything_is_the_same_for_every_scene() {
        let of = |name| {
            let scene = builtin(name).expect(name);
            Linked::of(&scene, &Thinness::of(&scene), Specialize::All).expect("links")
        };
        assert_eq!(of("wires"), of("room"));
        assert_eq!(of("furnace"), of("room"));
    }
}
