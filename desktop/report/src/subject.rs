//! The scenes of a report: their descriptions, and their uploads with the changes that tables ask for.

use std::path::{Path, PathBuf};

use anyhow::Context;
use glimpse::scene::{ImportOptions, Material, Weights};
use glimpse::{Camera, Gpu, GpuScene, Method, Renderer, Scene, Settings, Specialize};
use glimpse_measure::scene_file;
use glimpse_measure::statistics::SceneStatistics;

use crate::identity::Fingerprint;

/// Target shares of reflective pixels in table 3(b), in percent.
pub const SHARES: [u64; 5] = [20, 40, 60, 80, 100];

/// Mirror weight of the reflective surfaces of table 3(b).
pub const MIRROR: f32 = 0.3;

/// Change made to a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// The unchanged scene.
    AsIs,
    /// Up to this percentage of the pixels show reflective surfaces, and no other surface reflects.
    Reflective(u64),
}

/// A scene that was read once, which checks it before the measurements.
pub struct Prepared {
    /// Name of the scene on the command line.
    pub name: String,
    /// The same as it is opened.
    pub path: PathBuf,
    /// Fingerprint of all files read.
    pub content: Fingerprint,
    /// Selected camera.
    pub camera: Camera,
    /// Contents of the scene.
    pub statistics: SceneStatistics,
}

impl Prepared {
    /// Reads and describes the scene.
    ///
    /// # Errors
    /// Fails if the scene cannot be loaded or has no camera of that name.
    pub fn new(path: impl AsRef<Path>, camera: Option<&str>) -> anyhow::Result<Self> {
        let path = path.as_ref().to_owned();
        let name = path.display().to_string();
        let mut content = Fingerprint::new();
        let scene = scene_file::load_seen(&path, &ImportOptions::default(), &mut |_, bytes| {
            content = content.and(bytes)
        })?;
        let camera = *scene.camera(camera).with_context(|| name.clone())?;
        let statistics = SceneStatistics::of(&name, &scene, Specialize::Auto);
        Ok(Self { name, path, content, camera, statistics })
    }
}

/// A scene uploaded to the device.
pub struct Subject {
    /// The scene in device buffers.
    pub scene: GpuScene,
    /// Whether the surface of each object reflects.
    pub reflects: Vec<bool>,
}

impl Subject {
    fn upload(gpu: &Gpu, scene: Scene, name: &str) -> anyhow::Result<Self> {
        let reflects =
            scene.objects.iter().map(|o| scene.materials[o.material as usize].reflects()).collect();
        Ok(Self { scene: GpuScene::upload(gpu, scene).with_context(|| name.to_owned())?, reflects })
    }
}

/// The variants of a scene, of which one at a time is on the device.
pub struct Subjects<'s> {
    gpu: &'s Gpu,
    prepared: &'s Prepared,
    /// Side in pixels of the square frames in which pixels are counted.
    side: u32,
    current: Option<(Variant, Subject)>,
    /// Number of pixels that show each object; counted when first needed.
    visible: Option<Vec<u64>>,
}

impl<'s> Subjects<'s> {
    /// Creates the set without uploading anything.
    pub fn new(gpu: &'s Gpu, prepared: &'s Prepared, side: u32) -> Self {
        Self { gpu, prepared, side, current: None, visible: None }
    }

    /// Returns the scene with that change, uploading it unless it is the current one.
    pub fn get(&mut self, variant: Variant) -> anyhow::Result<&Subject> {
        if self.current.as_ref().is_none_or(|(current, _)| *current != variant) {
            let changed = self.changed(variant)?;
            // Free the current scene first: the device may not hold both.
            self.current = None;
            self.current = Some((variant, Subject::upload(self.gpu, changed, &self.prepared.name)?));
        }
        self.current.as_ref().map(|(_, subject)| subject).context("no scene on the device")
    }

    fn changed(&mut self, variant: Variant) -> anyhow::Result<Scene> {
        let Variant::Reflective(percent) = variant else { return scene_file::load(&self.prepared.path) };
        let visible = match self.visible.take() {
            Some(visible) => visible,
            None => self.count_visible()?,
        };
        let mut scene = scene_file::load(&self.prepared.path)?;
        reflect(&mut scene, &chosen(&visible, u64::from(self.side).pow(2), percent));
        self.visible = Some(visible);
        Ok(scene)
    }

    fn count_visible(&mut self) -> anyhow::Result<Vec<u64>> {
        let (gpu, camera, side) = (self.gpu, self.prepared.camera, self.side);
        let subject = self.get(Variant::AsIs)?;
        let settings = Settings { method: Method::Full, depth: 1, ..Settings::default() };
        let mut renderer = Renderer::new(gpu, &subject.scene, [side; 2], &settings)?;
        let mut visible = vec![0; subject.reflects.len()];
        for object in renderer.inspect(&camera)?.pixels.iter().filter_map(|p| p.object) {
            visible[object as usize] += 1;
        }
        Ok(visible)
    }
}

/// Selects the objects made reflective. For each share up to the wanted one, adds the largest objects that
/// keep the sum within that share, so that a larger share contains every smaller one; at 100 % all objects.
fn chosen(visible: &[u64], pixels: u64, percent: u64) -> Vec<bool> {
    let mut order: Vec<usize> = (0..visible.len()).collect();
    order.sort_by_key(|i| std::cmp::Reverse(visible[*i]));
    let mut chosen = vec![false; visible.len()];
    let mut sum = 0;
    for share in SHARES.into_iter().filter(|share| *share <= percent) {
        for &i in &order {
            if !chosen[i] && 100 * (sum + visible[i]) <= share * pixels {
                chosen[i] = true;
                sum += visible[i];
            }
        }
    }
    chosen
}

/// Gives every object an opaque material of its own with constant weights, with mirror weight [`MIRROR`] or
/// 0.
fn reflect(scene: &mut Scene, reflective: &[bool]) {
    let surface = |material: &Material, reflective: bool| {
        let mirror = if reflective { MIRROR } else { 0.0 };
        let weights = Some(Weights { diffuse: 1.0 - MIRROR, mirror, refraction: 0.0 });
        Material { weights, unlit: false, thin: false, transmission: 0.0, ..material.clone() }
    };
    let materials = &scene.materials;
    let surfaces =
        scene.objects.iter().zip(reflective).map(|(o, r)| surface(&materials[o.material as usize], *r));
    scene.materials = surfaces.collect();
    for (index, object) in scene.objects.iter_mut().enumerate() {
        object.material = index as u32;
    }
}

/// Rotates the camera about the world's vertical axis, in place.
pub fn turned(camera: &Camera, degrees: f32) -> Camera {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let mut turned = *camera;
    for axis in [&mut turned.right, &mut turned.up, &mut turned.forward] {
        let (x, z) = (axis.x, axis.z);
        (axis.x, axis.z) = (cos * x + sin * z, cos * z - sin * x);
    }
    turned
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn another_content_is_another_fingerprint() {
        let content = |name: &str| Prepared::new(name, None).unwrap().content;
        assert_eq!(content("builtin:minray"), content("builtin:minray"));
        assert_ne!(content("builtin:minray"), content("builtin:cornell"));
        let folder = tempfile::tempdir().unwrap();
        let document = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"uri":"a.bin","byteLength":36}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
            "bufferViews":[{"buffer":0,"byteLength":36}]}"#;
        let scene = folder.path().join("a.gltf");
        fs::write(&scene, document).unwrap();
        let of_corner = |x: f32| {
            let corners = [0.0, 0.0, 0.0, x, 0.0, 0.0, 0.0, 1.0, 0.0_f32];
            fs::write(folder.path().join("a.bin"), corners.map(f32::to_le_bytes).concat()).unwrap();
            content(scene.to_str().unwrap())
        };
        let first = of_corner(1.0);
        assert_ne!(first, of_corner(0.5), "an external buffer changed");
        assert_eq!(first, of_corner(1.0));
    }

    #[test]
    fn reflective_shares_grow_and_stay_below_their_aim() {
        let visible = [50, 5, 12, 8, 25];
        let sum = |percent| -> u64 {
            chosen(&visible, 100, percent).iter().zip(visible).map(|(c, v)| if *c { v } else { 0 }).sum()
        };
        assert_eq!(SHARES.map(sum), [20, 25, 50, 50, 100]);
        for pair in SHARES.windows(2) {
            let (small, large) = (chosen(&visible, 100, pair[0]), chosen(&visible, 100, pair[1]));
            assert!(small.iter().zip(&large).all(|(s, l)| !s || *l), "{pair:?}");
        }
        assert_eq!(chosen(&[3, 0], 10, 100), [true, true], "what is not seen reflects too");
    }

    #[test]
    fn only_the_chosen_objects_reflect() {
        let mut scene = scene_file::load("builtin:room").unwrap();
        let reflective: Vec<bool> = (0..scene.objects.len()).map(|i| i % 3 == 0).collect();
        reflect(&mut scene, &reflective);
        for (object, expected) in scene.objects.iter().zip(reflective) {
            let material = &scene.materials[object.material as usize];
            assert_eq!((material.reflects(), material.refracts()), (expected, false), "{}", object.name);
        }
    }

    #[test]
    fn a_camera_turns_about_the_vertical() {
        let camera = Prepared::new("builtin:room", None).unwrap().camera;
        let quarter = turned(&camera, 90.0);
        assert_eq!(quarter.origin, camera.origin);
        assert!((quarter.forward.x - camera.forward.z).abs() < 1e-6);
        assert!((quarter.forward.z + camera.forward.x).abs() < 1e-6);
        assert_eq!(quarter.up.y, camera.up.y);
        let back = turned(&turned(&quarter, 90.0), 180.0);
        assert!((back.right - camera.right).length() < 1e-6);
    }
}
