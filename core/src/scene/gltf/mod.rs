//! Reads glTF 2.0 files into a [`Scene`].
//!
//! Ignored, as the shading model has no use for them: normal and occlusion textures, `doubleSided` (every surface
//! has two sides here), skins, morph targets and animations (nodes and meshes keep their stored pose),
//! attenuation inside volumes, and a camera's aspect ratio and depth range (the frame has its own, rays do not
//! end). Lengths are in the file's unit, angles in radians, colours in linear RGB.
//!
//! # Untrusted files
//!
//! Files are untrusted. An import returns a scene that passes [`Scene::validate`] and has at least one triangle
//! with an area, or a short error that names the element; whatever is left out or replaced is a warning.
//! Coordinates and factors that are subnormal in f32 become zero, as they may on GPUs.
//!
//! The peak memory of an import, the result included, is at most
//!
//! ```text
//! 8 MiB + 1024 x bytes of JSON + 8 x bytes of all else + 256 x (triangles + objects) + 16 x texels
//! ```
//!
//! "All else" is the content of a `.glb` besides its JSON, and the content of URIs. The factor of JSON is that of
//! `{},` in a list of materials: three bytes become a struct in a list that doubles its capacity when full.
//!
//! A small file can define any number of triangles, objects (both counted for every instance) and texels. They
//! are counted and checked against the limits of `instances.rs` and `images.rs` before memory of their size is
//! allocated. `tests/tests/memory.rs` measures the peak.

mod accessors;
mod container;
mod images;
mod instances;
mod materials;
mod meshes;
mod nodes;
mod normalized;
#[cfg(test)]
mod tests;
mod text;
mod vertices;

use glam::Vec3;
use gltf::json;

use super::{Environment, Light, LightKind, MAX_RADIANCE, Material, Scene};
use crate::scene::camera::Camera;
use crate::{Error, Result};
use accessors::Source;
use container::{External, Resolve};
use normalized::flushed3;

/// Extensions that a file may require.
const SUPPORTED: [&str; 8] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

pub(super) fn read(bytes: &[u8], resolve: &mut Resolve<'_>) -> Result<Scene> {
    import(bytes, resolve).map_err(text::error)
}

fn import(bytes: &[u8], resolve: &mut Resolve<'_>) -> Result<Scene> {
    let chunks = container::chunks(bytes)?;
    let root = parse(chunks.json)?;
    let mut external = External::new(resolve);
    let fetched = container::fetched(&root, &mut external)?;
    let buffers = container::buffers(&root, chunks.binary, &fetched)?;
    let source = Source::new(&root, &buffers);
    let mut scene = Scene::default();

    let shown = match root.scene {
        Some(index) => Some(root.scenes.get(index.value()).ok_or_else(|| {
            Error::scene(
                format!("scene {}", index.value()),
                format!("no such scene; the file has {}", root.scenes.len()),
            )
        })?),
        None => root.scenes.first(),
    };
    if let Some(shown) = shown {
        scene.environment = environment(shown)?;
    }
    let orphans = orphans(&root);
    let placed = nodes::placed(&root, shown.map_or(&orphans, |s| &s.nodes))?;
    for node in &placed {
        nodes::equip(&root, node, &mut scene)?;
    }
    instances::add(&source, &placed, &mut external, &mut scene)?;

    let Some((low, high)) = scene.bounds() else {
        return Err(Error::scene("file", "the scene holds no triangles that have an area"));
    };
    if scene.cameras.is_empty() {
        scene.cameras.push(("framing".to_owned(), Camera::framing(low, high)));
    }
    if scene.lights.is_empty() {
        light_from_the_camera(&mut scene);
    }
    for light in &mut scene.lights {
        light.radius = FIXTURE * (high - low).max_element();
    }
    for warning in &mut scene.warnings {
        *warning = text::sentence(warning);
    }
    scene.validate()?;
    Ok(scene)
}

const NO_LIGHTS: &str = "the file has no lights: a directional one from behind the first camera is added";

/// Adds a directional light to a scene without any light: from behind the first camera, above its left shoulder.
fn light_from_the_camera(scene: &mut Scene) {
    let lit = |m: &Material| m.unlit || m.emission != Vec3::ZERO;
    let Some((_, camera)) = scene.cameras.first().filter(|_| !scene.materials.iter().any(lit)) else {
        return;
    };
    let [forward, right, up] = [camera.forward, camera.right, camera.up].map(Vec3::normalize_or_zero);
    let direction = (forward + 0.5 * right - 0.7 * up).normalize_or_zero();
    let kind = LightKind::Directional { direction };
    scene.lights.push(Light { kind, intensity: Vec3::splat(std::f32::consts::PI), radius: 0.0 });
    scene.warnings.push(NO_LIGHTS.to_owned());
}

/// Radius of an imported light in units of the scene's longest side. Files place lights inside fixtures and flush
/// with ceilings, and the extension defines no size.
const FIXTURE: f32 = 0.01;

fn parse(text: &[u8]) -> Result<json::Root> {
    let root: json::Root = json::deserialize::from_slice(text).map_err(|e| {
        Error::scene("file", format!("expected glTF 2.0 (a .glb header or JSON), found other data: {e}"))
    })?;
    if root.asset.version.split('.').next() != Some("2") {
        return Err(Error::scene(
            "asset.version",
            format!("expected version 2.0 of glTF, found `{}`", root.asset.version),
        ));
    }
    match root.extensions_required.iter().find(|e| !SUPPORTED.contains(&e.as_str())) {
        Some(unknown) => Err(Error::scene(
            format!("required extension {unknown}"),
            format!("not supported; those that are: {}", SUPPORTED.join(", ")),
        )),
        None => Ok(root),
    }
}

/// Nodes without a parent, which a file without scenes shows.
fn orphans(root: &json::Root) -> Vec<json::Index<json::Node>> {
    let mut has_parent = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|n| n.children.iter().flatten()) {
        if let Some(flag) = has_parent.get_mut(child.value()) {
            *flag = true;
        }
    }
    (0..).zip(has_parent).filter(|(_, child)| !child).map(|(i, _)| json::Index::new(i)).collect()
}

/// Reads `extras.background` and `extras.ambient` of the scene: radiance in linear RGB.
fn environment(shown: &json::Scene) -> Result<Environment> {
    let Some(extras) = &shown.extras else { return Ok(Environment::default()) };
    let extras: serde_json::Value = serde_json::from_str(extras.get()).unwrap_or_default();
    let color = |name: &str| match extras.get(name) {
        None => Ok(None),
        Some(value) => serde_json::from_value::<[f32; 3]>(value.clone())
            .ok()
            .map(|c| flushed3(c.into()))
            .filter(|c| c.cmpge(Vec3::ZERO).all() && c.max_element() <= MAX_RADIANCE)
            .map(Some)
            .ok_or_else(|| {
                Error::scene(
                    format!("extras.{name} of the scene"),
                    format!("expected three numbers from 0 to {MAX_RADIANCE:e}, found {value}"),
                )
            }),
    };
    let mut environment = Environment::with_background(color("background")?.unwrap_or(Vec3::ZERO));
    if let Some(ambient) = color("ambient")? {
        environment.ambient = ambient;
        environment.fallback_radiance = ambient;
    }
    Ok(environment)
}
