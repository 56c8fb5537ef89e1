//! Moves scenes that lie far from the origin of their file to the scene's: f32 would not resolve them there.

use std::collections::HashMap;

use glam::{DMat4, DVec3, Vec3};
use gltf::json;
use json::accessor::Type;
use json::mesh::Semantic;
use json::validation::Checked;

use super::accessors::Source;
use super::nodes::Placed;
use crate::scene::MAX_COORDINATE;

/// A scene is far where its middle is more than so many longest sides from the origin: f32 has lost three bits.
const FAR: f64 = 8.0;

/// Moves the nodes by a common translation if the scene is far from the origin. Returns the point of the file that
/// becomes the scene's origin: multiples of a power of two, so that the translation of a node is exact.
pub(super) fn recentre(source: &Source<'_>, placed: &mut [Placed<'_>]) -> DVec3 {
    let mut meshes = Meshes { source, meshes: HashMap::new(), accessors: HashMap::new() };
    let boxes = placed.iter().filter_map(|node| meshes.bounds(node));
    let Some((low, high)) = boxes.reduce(union) else { return DVec3::ZERO };
    let (middle, side) = (0.5 * (low + high), (high - low).max_element());
    let reach = low.abs().max(high.abs()).max_element();
    if !(side > 0.0 && reach <= f64::from(MAX_COORDINATE) && middle.abs().max_element() > FAR * side) {
        return DVec3::ZERO;
    }
    let step = side.log2().ceil().exp2();
    let origin = (middle / step).round() * step;
    if !origin.is_finite() {
        return DVec3::ZERO;
    }
    let moved = DMat4::from_translation(-origin);
    for node in placed {
        node.world = moved * node.world;
    }
    origin
}

/// Lowest and highest corner.
type Bounds = (DVec3, DVec3);

fn union(a: Bounds, b: Bounds) -> Bounds {
    (a.0.min(b.0), a.1.max(b.1))
}

/// The boxes of meshes in their own space, each found once: files may use one a million times.
struct Meshes<'s, 'b> {
    source: &'s Source<'b>,
    meshes: HashMap<usize, Option<Bounds>>,
    accessors: HashMap<usize, Option<Bounds>>,
}

impl Meshes<'_, '_> {
    /// The box of a node's mesh, without skins and instances; `None` if it has no positions that can be read.
    fn bounds(&mut self, node: &Placed<'_>) -> Option<Bounds> {
        let (low, high) = self.mesh(node.json.mesh?.value())?;
        let corner = |i: usize| {
            let pick = |axis: usize| if i >> axis & 1 == 0 { low[axis] } else { high[axis] };
            node.world.transform_point3(DVec3::new(pick(0), pick(1), pick(2)))
        };
        (0..8).map(corner).map(|corner| (corner, corner)).reduce(union)
    }

    fn mesh(&mut self, index: usize) -> Option<Bounds> {
        if let Some(known) = self.meshes.get(&index) {
            return *known;
        }
        let primitives = &self.source.root.meshes.get(index)?.primitives;
        let positions = primitives.iter().filter_map(|primitive| {
            let index = primitive.attributes.get(&Checked::Valid(Semantic::Positions))?.value();
            *self.accessors.entry(index).or_insert_with(|| positions(self.source, index))
        });
        let found = positions.reduce(union);
        self.meshes.insert(index, found);
        found
    }
}

/// The box of positions: the accessor's `min` and `max` where they are there and hold its first element, else that of
/// the elements.
fn positions(source: &Source<'_>, index: usize) -> Option<Bounds> {
    let json = source.root.accessors.get(index)?;
    let stated = |value: &Option<json::Value>| {
        let numbers: [f64; 3] = serde_json::from_value(value.clone()?).ok()?;
        Some(DVec3::from(numbers))
    };
    let stated = stated(&json.min).zip(stated(&json.max));
    if json.sparse.is_some() {
        return stated;
    }
    let accessor = source.accessor(index, "POSITION", &[Type::Vec3]).ok()?;
    let element = |i: usize| Vec3::from(accessor.floats::<3>(i)).as_dvec3();
    let first = (accessor.count > 0).then(|| element(0))?;
    let holds = |(low, high): &Bounds| first.cmpge(*low).all() && first.cmple(*high).all();
    let elements = || (0..accessor.count).map(element).filter(|position| position.is_finite());
    let stated = stated.filter(|stated| accessor.is_float() && holds(stated));
    stated.or_else(|| elements().map(|position| (position, position)).reduce(union))
}
