//! Adds all instances of all meshes to the scene's flat arrays.

use glam::Vec2;

use super::accessors::Source;
use super::container::External;
use super::images::{MAX_TEXELS, Textures};
use super::materials::{Imported, Materials};
use super::meshes::Mesh;
use super::nodes::Placed;
use super::text::{MAX_NAME, clipped};
use crate::scene::Scene;
use crate::{Error, Result};

/// The most triangles, counted for every instance, as a small file can name one mesh a million times: those of a
/// 2 GiB binding, the largest that devices offer.
const MAX_TRIANGLES: usize = (1 << 31) / size_of::<[f32; 9]>();

/// The most objects (mesh primitives, counted for every instance), each of which has a name.
const MAX_OBJECTS: usize = 1 << 22;

/// Number of objects that a warning names.
const NAMED: usize = 4;

/// A mesh, opened at its first instance.
struct Opened<'b> {
    parts: Vec<Part<'b>>,
    triangles: usize,
}

/// A mesh primitive with triangles, which every instance repeats.
struct Part<'b> {
    /// Name of the primitive in objects' names: `mesh[primitive]`.
    name: String,
    mesh: Mesh<'b>,
    material: Imported,
}

/// Opens meshes with their materials.
struct Opener<'s, 'b, 'r> {
    source: &'s Source<'b>,
    external: &'s mut External<'r>,
    materials: Materials,
    textures: Textures,
}

impl<'b> Opener<'_, 'b, '_> {
    fn open(&mut self, index: usize, node: &Placed<'_>, warnings: &mut Vec<String>) -> Result<Opened<'b>> {
        let meshes = &self.source.root.meshes;
        let json = meshes.get(index).ok_or_else(|| {
            Error::scene(
                format!("mesh {index} of node {}", node.index),
                format!("no such mesh; the file has {}", meshes.len()),
            )
        })?;
        let name = json.name.as_deref().map_or_else(|| format!("mesh{index}"), |n| clipped(n, MAX_NAME));
        let mut parts = Vec::with_capacity(json.primitives.len());
        for (i, primitive) in json.primitives.iter().enumerate() {
            let material = primitive.material.map(|m| m.value());
            let material =
                self.materials.load(self.source, self.external, &mut self.textures, warnings, material)?;
            let what = format!("mesh {index} primitive {i}");
            let mesh = Mesh::open(self.source, primitive, material.reads, what, warnings)?;
            parts.extend(mesh.map(|mesh| Part { name: format!("{name}[{i}]"), mesh, material }));
        }
        let triangles = parts.iter().fold(0, |sum: usize, part| sum.saturating_add(part.mesh.triangles()));
        Ok(Opened { parts, triangles })
    }
}

/// Adds the meshes of the nodes with their materials, textures and images. Checks the limits on triangles and
/// objects before it stores the first triangle.
pub(super) fn add<'b>(
    source: &Source<'b>,
    placed: &[Placed<'_>],
    external: &mut External<'_>,
    scene: &mut Scene,
) -> Result<()> {
    let mut opener =
        Opener { source, external, materials: Materials::default(), textures: Textures::new(MAX_TEXELS) };
    let mut opened: Vec<Option<Opened<'b>>> = Vec::new();
    opened.resize_with(source.root.meshes.len(), || None);
    let (mut triangles, mut objects) = (0_usize, 0_usize);
    let instances = placed.iter().filter_map(|node| Some((node, node.json.mesh?.value())));
    for (node, index) in instances.clone() {
        let known = opened.get_mut(index).and_then(Option::take);
        let mesh = known.map_or_else(|| opener.open(index, node, &mut scene.warnings), Ok)?;
        triangles = triangles.saturating_add(mesh.triangles);
        objects = objects.saturating_add(mesh.parts.len());
        opened[index] = Some(mesh);
        for (noun, count, most) in
            [("triangles", triangles, MAX_TRIANGLES), ("mesh primitives", objects, MAX_OBJECTS)]
        {
            if count > most {
                let reason = format!("expected at most {most} {noun}, instances counted each, found more");
                return Err(Error::scene("file", reason));
            }
        }
    }
    scene.positions.reserve_exact(triangles);
    scene.normals.reserve_exact(triangles);
    scene.triangle_objects.reserve_exact(triangles);

    let mut left_out = LeftOut::default();
    for (node, index) in instances {
        for part in opened[index].iter().flat_map(|mesh| &mesh.parts) {
            let before = scene.objects.len();
            let name = format!("{}/{}", node.name(), part.name);
            let without_area = part.mesh.add(node, name.clone(), part.material, scene)?;
            left_out.count(without_area, scene.objects.len() == before, name);
        }
    }
    if !scene.texcoords.is_empty() {
        scene.texcoords.resize(scene.positions.len(), [Vec2::ZERO; 3]);
    }
    if !scene.second_texcoords.is_empty() {
        scene.second_texcoords.resize(scene.positions.len(), [Vec2::ZERO; 3]);
    }
    if !scene.tangents.is_empty() {
        scene.tangents.resize(scene.positions.len(), [0; 3]);
    }
    if !scene.colors.is_empty() {
        scene.colors.resize(scene.positions.len(), [u32::MAX; 3]);
    }
    left_out.warn(&mut scene.warnings);
    let Opener { materials, textures, .. } = opener;
    (scene.materials, scene.textures, scene.images) =
        (materials.materials, textures.textures, textures.images);
    Ok(())
}

/// Counts triangles without area, and objects that have no others.
#[derive(Default)]
struct LeftOut {
    triangles: usize,
    objects: usize,
    named: Vec<String>,
}

impl LeftOut {
    fn count(&mut self, without_area: usize, all: bool, name: String) {
        if without_area == 0 || !all {
            self.triangles += without_area;
            return;
        }
        self.objects += 1;
        if self.named.len() < NAMED {
            self.named.push(name);
        }
    }

    fn warn(&self, warnings: &mut Vec<String>) {
        if self.triangles > 0 {
            warnings.push(format!("{} triangles without area are left out", self.triangles));
        }
        if self.objects > 0 {
            let more = if self.objects > self.named.len() { ", ..." } else { "" };
            let named = self.named.join(", ");
            warnings.push(format!(
                "{} objects are left out, for all their triangles are without area: {named}{more}",
                self.objects
            ));
        }
    }
}
