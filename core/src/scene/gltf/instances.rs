//! Adds all instances of all meshes to the scene's flat arrays.

use glam::{DMat4, Vec2};
use gltf::json;

use super::accessors::Source;
use super::container::External;
use super::coverage;
use super::images::{MAX_TEXELS, Textures};
use super::materials::{Imported, Materials};
use super::meshes::{Added, Mesh};
use super::nodes::Placed;
use super::pose::{Instancing, Placement, Pose, Skin, Transform};
use super::text::{MAX_NAME, clipped};
use super::thin;
use super::variants;
use crate::scene::{Scene, WHITE};
use crate::{Error, Result};

/// The most triangles, counted for every instance, as a small file can name one mesh a million times: those of a
/// 2 GiB binding, the largest that devices offer.
const MAX_TRIANGLES: usize = (1 << 31) / size_of::<[f32; 9]>();

/// The most objects (mesh primitives, counted for every instance), each of which has a name.
const MAX_OBJECTS: usize = 1 << 22;

/// The most vertices that are morphed or skinned, counted for every morph target, set of joints and instance.
const MAX_DEFORMED: usize = 1 << 28;

/// Number of objects that a warning names.
const NAMED: usize = 4;

/// A mesh, opened at its first instance.
struct Opened<'b> {
    parts: Vec<Part<'b>>,
    triangles: usize,
}

/// A mesh primitive with triangles, which every instance repeats.
struct Part<'b> {
    json: &'b json::mesh::Primitive,
    /// Name of the primitive in objects' names: `mesh[primitive]`.
    name: String,
    mesh: Mesh<'b>,
    material: Imported,
}

/// Opens meshes with their materials.
struct Opener<'s, 'b, 'r> {
    source: &'s Source<'b>,
    external: &'s mut External<'r>,
    /// Index of the variant of materials that was chosen.
    variant: Option<usize>,
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
            let what = format!("mesh {index} primitive {i}");
            let material = variants::material(primitive, self.variant, &what)?;
            let material =
                self.materials.load(self.source, self.external, &mut self.textures, warnings, material)?;
            let mesh = Mesh::open(self.source, primitive, material.reads, what, warnings)?;
            let name = format!("{name}[{i}]");
            parts.extend(mesh.map(|mesh| Part { json: primitive, name, mesh, material }));
        }
        let triangles = parts.iter().fold(0, |sum: usize, part| sum.saturating_add(part.mesh.triangles()));
        Ok(Opened { parts, triangles })
    }
}

/// A node with a mesh, and what its pose depends on.
struct Instance<'a, 'b> {
    node: &'a Placed<'b>,
    mesh: usize,
    instancing: Option<Instancing<'b>>,
    weights: &'b [f32],
    skin: Option<usize>,
}

impl<'a, 'b> Instance<'a, 'b> {
    fn of(source: &Source<'b>, node: &'a Placed<'b>, warnings: &mut Vec<String>) -> Result<Option<Self>> {
        let Some(mesh) = node.json.mesh.map(|mesh| mesh.value()) else { return Ok(None) };
        let json = source.root.meshes.get(mesh);
        let weights = node.json.weights.as_deref().or(json.and_then(|m| m.weights.as_deref()));
        let weights = weights.unwrap_or_default();
        if let Some(found) = weights.iter().find(|weight| !weight.is_finite()) {
            let what = format!("weights of node {}", node.index);
            return Err(Error::scene(what, format!("expected finite numbers, found {found}")));
        }
        let skin = node.json.skin.map(|skin| skin.value());
        let mut instancing = Instancing::open(source, node)?;
        if instancing.is_some() && skin.is_some() {
            warnings.push(format!(
                "node {}: its instances are ignored, for the joints of its skin place it",
                node.index
            ));
            instancing = None;
        }
        Ok(Some(Self { node, mesh, instancing, weights, skin }))
    }

    /// How often the mesh is drawn.
    fn count(&self) -> usize {
        self.instancing.as_ref().map_or(1, |i| i.count)
    }

    fn world(&self, i: usize) -> Result<DMat4> {
        let world = self.node.world;
        self.instancing.as_ref().map_or(Ok(world), |instancing| Ok(world * instancing.matrix(i)?))
    }
}

/// Matrices of the joints of the skins that are used.
struct Joints<'s, 'b> {
    source: &'s Source<'b>,
    pose: Pose,
    matrices: Vec<Option<Vec<DMat4>>>,
}

impl Joints<'_, '_> {
    /// The joints' matrices of a skin; none, with a warning, where a joint is not shown.
    fn of(&mut self, skin: usize, warnings: &mut Vec<String>) -> Result<&[DMat4]> {
        if self.matrices.len() <= skin {
            self.matrices.resize(skin + 1, None);
        }
        let known = &mut self.matrices[skin];
        if known.is_none() {
            let matrices = Skin::open(self.source, skin)?.matrices(&self.pose);
            *known = Some(matrices.unwrap_or_else(|node| {
                warnings.push(format!(
                    "skin {skin}: node {node} of its joints is not in the scene: its meshes are drawn unskinned"
                ));
                Vec::new()
            }));
        }
        Ok(known.as_deref().unwrap_or_default())
    }
}

/// Adds the meshes of the nodes with their materials, in the given variant if any, textures and images. Checks the limits on triangles,
/// objects and deformed vertices before it stores the first triangle.
pub(super) fn add<'b>(
    source: &Source<'b>,
    placed: &[Placed<'b>],
    variant: Option<usize>,
    external: &mut External<'_>,
    scene: &mut Scene,
) -> Result<()> {
    let (materials, textures) = (Materials::default(), Textures::new(MAX_TEXELS));
    let mut opener = Opener { source, external, variant, materials, textures };
    let mut opened: Vec<Option<Opened<'b>>> = Vec::new();
    opened.resize_with(source.root.meshes.len(), || None);
    let mut counts = [0_usize; 3];
    let mut instances = Vec::new();
    for node in placed {
        let Some(instance) = Instance::of(source, node, &mut scene.warnings)? else { continue };
        let known = opened.get_mut(instance.mesh).and_then(Option::take);
        let mut mesh = known.map_or_else(|| opener.open(instance.mesh, node, &mut scene.warnings), Ok)?;
        let mut deformed = 0_usize;
        for part in &mut mesh.parts {
            deformed = deformed.saturating_add(part.mesh.deform(
                source,
                part.json,
                instance.skin.is_some(),
                instance.weights,
            )?);
        }
        let each = [mesh.triangles, mesh.parts.len(), deformed];
        opened[instance.mesh] = Some(mesh);
        for ((count, each), (noun, most)) in counts.iter_mut().zip(each).zip(LIMITS) {
            *count = count.saturating_add(each.saturating_mul(instance.count()));
            if *count > most {
                let reason = format!("expected at most {most} {noun}, instances counted each, found more");
                return Err(Error::scene("file", reason));
            }
        }
        instances.push(instance);
    }
    let [triangles, objects, _] = counts;
    source.budget.claim("file", (OBJECT_BYTES * (triangles + objects)) as u64)?;
    scene.positions.reserve_exact(triangles);
    scene.normals.reserve_exact(triangles);
    scene.triangle_objects.reserve_exact(triangles);

    let mut joints = Joints { source, pose: Pose::of(placed, source.root.nodes.len()), matrices: Vec::new() };
    let mut told = Told::default();
    let mut all_thin = Vec::new();
    for instance in instances {
        let Some(mesh) = &opened[instance.mesh] else { continue };
        let joints = instance.skin.map_or(Ok(&[][..]), |skin| joints.of(skin, &mut scene.warnings))?;
        for i in 0..instance.count() {
            let world = instance.world(i)?;
            for part in &mesh.parts {
                let before = scene.objects.len();
                let name = format!("{}/{}", instance.node.name(), part.name);
                let has_joints = part.mesh.deformation.is_skinned();
                if instance.skin.is_some() && !has_joints {
                    told.unskinned.push(&name);
                }
                let transform = match joints {
                    joints if has_joints && !joints.is_empty() => Transform::Skinned(joints),
                    _ => Transform::Rigid(world),
                };
                let placement = Placement { transform, weights: instance.weights };
                if part.mesh.is_thin() {
                    all_thin.push(part.mesh.thin(&placement, name, part.material)?);
                    continue;
                }
                if part.material.reads.tangents.is_some() {
                    source.budget.needs(&name, TANGENTS_BYTES * part.mesh.triangles() as u64)?;
                }
                let added = part.mesh.add(&placement, name.clone(), part.material, scene)?;
                told.count(&added, scene.objects.len() == before, &name);
            }
        }
    }
    thin::add(all_thin, &mut opener.materials.materials, scene);
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
        scene.colors.resize(scene.positions.len(), [WHITE; 3]);
    }
    told.warn(&mut scene.warnings);
    let Opener { materials, textures, .. } = opener;
    scene.warnings.extend(textures.warnings);
    (scene.materials, scene.textures, scene.images) =
        (materials.materials, textures.textures, textures.images);
    coverage::drop_of_opaque(scene);
    Ok(())
}

/// Memory for each triangle, with all its attributes, and for each object with its name.
const OBJECT_BYTES: usize = 256;

/// Memory for each triangle of an object while its tangents are computed.
const TANGENTS_BYTES: u64 = 1024;

/// What is limited, instances counted each.
const LIMITS: [(&str, usize); 3] = [
    ("triangles", MAX_TRIANGLES),
    ("mesh primitives", MAX_OBJECTS),
    ("vertices to morph and to skin", MAX_DEFORMED),
];

/// Names of objects, of which a warning shows the first few.
#[derive(Default)]
struct Names {
    count: usize,
    first: Vec<String>,
}

impl Names {
    fn push(&mut self, name: &str) {
        self.count += 1;
        if self.first.len() < NAMED {
            self.first.push(name.to_owned());
        }
    }

    /// The names for a warning; `None` without any.
    fn listed(&self) -> Option<String> {
        let more = if self.count > self.first.len() { ", ..." } else { "" };
        (self.count > 0).then(|| format!("{}{more}", self.first.join(", ")))
    }
}

/// Counts what an import leaves out or changes.
#[derive(Default)]
struct Told {
    /// Triangles without area, of objects that have others.
    triangles: usize,
    /// Objects without any other triangles.
    empty: Names,
    /// Objects with vertices whose weights do not sum to 1.
    unnormalized: Names,
    /// Objects without joints at a node with a skin.
    unskinned: Names,
}

impl Told {
    fn count(&mut self, added: &Added, all: bool, name: &str) {
        if added.unnormalized > 0 {
            self.unnormalized.push(name);
        }
        if added.without_area == 0 || !all {
            self.triangles += added.without_area;
            return;
        }
        self.empty.push(name);
    }

    fn warn(&self, warnings: &mut Vec<String>) {
        if self.triangles > 0 {
            warnings.push(format!("{} triangles without area are left out", self.triangles));
        }
        warnings.extend(self.empty.listed().map(|names| {
            let count = self.empty.count;
            format!("{count} objects are left out, for all their triangles are without area: {names}")
        }));
        warnings.extend(self.unnormalized.listed().map(|names| {
            let count = self.unnormalized.count;
            format!(
                "{count} objects have joints' weights that do not sum to 1, which are normalised: {names}"
            )
        }));
        warnings.extend(self.unskinned.listed().map(|names| {
            let count = self.unskinned.count;
            format!("{count} objects without JOINTS_0 stay with their node, which has a skin: {names}")
        }));
    }
}
