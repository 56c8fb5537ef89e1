//! Reads glTF 2.0 files into a [`Scene`].
//!
//! `support` lists what of the specification is shown; the rest of a file is not read, and told where that changes
//! the picture. Skins and morph targets have the pose in which nodes and weights are stored. Lengths are in the
//! file's unit, angles in radians, colours in linear RGB.
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
//!     + 32 x texels of the faces of an image-based light
//!     + 1024 x triangles of the largest object whose tangents are computed
//!     + 4 x bytes that compressed buffer views and meshes decode to
//! ```
//!
//! "All else" is the content of a `.glb` besides its JSON, and the content of URIs. The factor of JSON is that of
//! `{},` in a list of materials: three bytes become a struct in a list that doubles its capacity when full.
//!
//! [`ImportOptions::memory`] sets a budget, from which the same is claimed as it is requested.
//!
//! A small file can define any number of triangles, objects (both counted for every instance), texels and decoded
//! bytes. They are counted and checked against the limits of `instances.rs`, `images.rs` and `compressed.rs` before
//! memory of their size is allocated. `tests/tests/memory.rs` measures the peak.

mod accessors;
mod attributes;
mod budget;
mod compressed;
mod container;
mod coverage;
mod deformation;
mod document;
mod draco;
mod image_light;
mod images;
mod instances;
mod jpeg;
mod json_text;
#[cfg(feature = "ktx2")]
mod ktx2;
mod layers;
mod lights;
mod materials;
mod meshes;
mod meshopt;
mod nodes;
mod normalized;
mod origin;
mod pose;
mod slots;
mod support;
mod tangents;
#[cfg(test)]
mod tests;
mod text;
mod thin;
mod variants;
mod vertices;

use glam::Vec3;
use gltf::json;

use super::{Environment, EnvironmentMap, MAX_RADIANCE, Scene};
use crate::scene::camera::Camera;
use crate::{Error, Result};
use accessors::Source;
use budget::Budget;
use compressed::Decoded;
use container::{External, Resolve};
use document::Document;
use normalized::flushed3;

/// Memory for each byte of a file besides its JSON.
const CONTENT_BYTES: u64 = 8;

/// What to import of a file, and by what means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ImportOptions<'a> {
    /// Name of the variant of materials to show (KHR_materials_variants); the primitives' own materials by default.
    pub variant: Option<&'a str>,
    /// The most memory in bytes that the import may take. It is claimed before it is allocated, by what the file
    /// requests; none by default but the limits of the format.
    pub memory: Option<u64>,
}

pub(super) fn read(bytes: &[u8], resolve: &mut Resolve<'_>, options: &ImportOptions<'_>) -> Result<Scene> {
    import(bytes, resolve, options).map_err(text::error)
}

fn import(bytes: &[u8], resolve: &mut Resolve<'_>, options: &ImportOptions<'_>) -> Result<Scene> {
    let budget = Budget::new(options.memory);
    let chunks = container::chunks(bytes)?;
    budget.claim("file", budget::of_json(chunks.json))?;
    let Document { value, root, not_shown, warnings } = Document::read(chunks.json)?;
    let mut external = External::new(resolve);
    let fetched = container::fetched(&root, &mut external)?;
    let content = fetched.values().map(Vec::len).sum::<usize>() + chunks.binary.map_or(0, <[u8]>::len);
    budget.claim("file", CONTENT_BYTES * content as u64)?;
    let buffers = container::buffers(&root, chunks.binary, &fetched)?;
    let decoded = Decoded::new(&root, &budget);
    let source = Source::new(&value, &root, &buffers, &decoded, &budget);
    let mut scene = Scene { variants: variants::names(&root), not_shown, warnings, ..Scene::default() };
    let variant = options.variant.map(|name| variants::index_of(&scene.variants, name)).transpose()?;

    let shown = shown(&root)?;
    if let Some(index) = shown {
        scene.environment = environment(&source, index)?;
    }
    let orphans = orphans(&root);
    let roots = shown.and_then(|index| root.scenes.get(index)).map_or(&orphans, |scene| &scene.nodes);
    let mut placed = nodes::placed(&root, roots)?;
    scene.origin = origin::recentre(&source, &mut placed);
    for node in &placed {
        nodes::equip(&root, node, &mut scene)?;
    }
    instances::add(&source, &placed, variant, &mut external, &mut scene)?;

    let Some((low, high)) = scene.bounds() else {
        return Err(Error::scene("file", nothing(&placed)));
    };
    if scene.cameras.is_empty() {
        scene.cameras.push(("framing".to_owned(), Camera::framing(low, high)));
    }
    let image_light = shown.map(|index| image_light::map(&source, &mut external, index, &mut scene.warnings));
    if let Some(map) = image_light.transpose()?.flatten() {
        scene.surround(map);
    } else if scene.lights.is_empty() && !shown.is_some_and(|index| states_surroundings(&source, index)) {
        scene.surround(EnvironmentMap::studio());
        scene.is_lit_by_studio = true;
    }
    lights::complete(&mut scene.lights, &mut scene.warnings, (low, high));
    for warning in &mut scene.warnings {
        *warning = text::sentence(warning);
    }
    scene.validate()?;
    Ok(scene)
}

/// Why there is nothing to show.
fn nothing(placed: &[nodes::Placed<'_>]) -> String {
    let what = "the scene holds no triangles that have an area";
    if placed.is_empty() {
        return format!("{what}: it is empty, it has no nodes");
    }
    match placed.iter().any(|node| node.json.mesh.is_some()) {
        true => what.to_owned(),
        false => format!("{what}: none of its nodes has a mesh"),
    }
}

/// Index of the scene that is shown; `None` if the file has no scenes.
fn shown(root: &json::Root) -> Result<Option<usize>> {
    let index = root.scene.map_or(0, |index| index.value());
    if index < root.scenes.len() || root.scene.is_none() {
        return Ok((!root.scenes.is_empty()).then_some(index));
    }
    Err(Error::scene(format!("scene {index}"), format!("no such scene; the file has {}", root.scenes.len())))
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

/// Whether a scene states what surrounds it, in `extras`.
fn states_surroundings(source: &Source<'_>, scene: usize) -> bool {
    let stated = |name| source.document.pointer(&format!("/scenes/{scene}/extras/{name}")).is_some();
    ["background", "ambient"].into_iter().any(stated)
}

/// Reads `extras.background` and `extras.ambient` of the scene: radiance in linear RGB.
fn environment(source: &Source<'_>, scene: usize) -> Result<Environment> {
    let Some(extras) = source.document.pointer(&format!("/scenes/{scene}/extras")) else {
        return Ok(Environment::default());
    };
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
