//! Opens the attributes and indices of a mesh primitive: accessors, or parts of a compressed mesh.

use gltf::json;
use json::accessor::{ComponentType, Type};
use json::mesh::{Primitive, Semantic};
use json::validation::Checked;
use serde_json::Value;

use super::accessors::{Accessor, Source};
use super::draco::Geometry;
use crate::{Error, Result};

/// A primitive whose attributes can be opened.
pub(super) struct Attributes<'s, 'b, 'p> {
    source: &'s Source<'b>,
    primitive: &'p Primitive,
    /// Name of the primitive in errors.
    what: &'p str,
    /// The compressed mesh, and the numbers of its attributes by name.
    compressed: Option<(&'b Geometry, &'p Value)>,
}

impl<'s, 'b, 'p> Attributes<'s, 'b, 'p> {
    pub fn of(source: &'s Source<'b>, primitive: &'p Primitive, what: &'p str) -> Result<Self> {
        let compressed = source.decoded.draco(source.root, source.buffers, primitive, what)?;
        Ok(Self { source, primitive, what, compressed })
    }

    /// Whether the triangles are those of a compressed mesh, a list whatever the primitive's mode.
    pub fn is_compressed(&self) -> bool {
        self.compressed.is_some()
    }

    /// Opens an attribute, `None` without it. `shapes` are the allowed types.
    pub fn get(&self, semantic: Semantic, shapes: &[Type]) -> Result<Option<Accessor<'b>>> {
        let name = semantic.to_string();
        let what = format!("{}, {name}", self.what);
        let Some(index) = self.primitive.attributes.get(&Checked::Valid(semantic)) else { return Ok(None) };
        let Some((geometry, id)) = self.compressed.and_then(|(g, ids)| Some((g, ids.get(&name)?))) else {
            return self.source.accessor(index.value(), &what, shapes).map(Some);
        };
        let attribute = geometry.attributes.iter().find(|a| id.as_u64() == Some(a.id.into()));
        let attribute = attribute.ok_or_else(|| {
            Error::scene(&what, format!("its compressed mesh has no attribute {id} of a type that glTF has"))
        })?;
        if !shapes.iter().any(|shape| shape.multiplicity() == attribute.components) {
            let found = attribute.components;
            return Err(Error::scene(what, format!("expected {shapes:?}, found {found} components")));
        }
        let normalized = self.source.root.accessors.get(index.value()).is_some_and(|a| a.normalized);
        let (components, component) = (attribute.components, attribute.component);
        Ok(Some(Accessor::packed(&attribute.bytes, components, component, normalized)))
    }

    /// Opens the indices, `None` without them.
    pub fn indices(&self) -> Result<Option<Accessor<'b>>> {
        if let Some((geometry, _)) = self.compressed {
            return Ok(Some(Accessor::packed(&geometry.indices, 1, ComponentType::U32, false)));
        }
        let Some(index) = self.primitive.indices else { return Ok(None) };
        let what = format!("{}, indices", self.what);
        let accessor = self.source.accessor(index.value(), &what, &[Type::Scalar])?;
        if accessor.is_unsigned() {
            return Ok(Some(accessor));
        }
        Err(Error::scene(what, "expected unsigned integers, found another component type"))
    }
}
