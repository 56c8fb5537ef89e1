//! KHR_draco_mesh_compression: meshes of Draco's edgebreaker and sequential methods.

#[cfg(feature = "draco")]
use draco_core::{
    AttributeValueIndex, DataType, DecodeLimits, DecoderBuffer, Mesh, MeshDecoder, PointAttribute, PointIndex,
};
use gltf::json::accessor::ComponentType;

/// A mesh decoded from a Draco bitstream.
pub(super) struct Geometry {
    /// Three indices for each triangle, little-endian integers of 32 bits.
    pub indices: Vec<u8>,
    pub attributes: Vec<Attribute>,
}

/// An attribute of a decoded mesh, tightly packed.
pub(super) struct Attribute {
    /// The number by which a file refers to it.
    pub id: u32,
    pub component: ComponentType,
    pub components: usize,
    pub bytes: Vec<u8>,
}

impl Geometry {
    #[cfg(not(feature = "draco"))]
    pub fn decode(_: &[u8], _: u64) -> Result<Self, String> {
        Err("glimpse was built without its feature `draco`".to_owned())
    }

    /// Decodes a mesh of at most `most` bytes of indices and attributes.
    #[cfg(feature = "draco")]
    pub fn decode(bytes: &[u8], most: u64) -> Result<Self, String> {
        let limits = DecodeLimits::default()
            .with_max_faces(most / 12)
            .with_max_points(most / 4)
            .with_max_decoded_bytes(most);
        let mut buffer = DecoderBuffer::new(bytes).with_limits(limits);
        let mut mesh = Mesh::new();
        MeshDecoder::new().decode(&mut buffer, &mut mesh).map_err(|e| e.to_string())?;
        let vertices = mesh.num_points();
        let mut room = most.checked_sub(12 * mesh.num_faces() as u64).ok_or("it holds too many triangles")?;
        let mut attributes = Vec::new();
        for i in 0..mesh.num_attributes() {
            let attribute = mesh.try_attribute(i).map_err(|e| e.to_string())?;
            let Some(component) = component(attribute.data_type()) else { continue };
            let components = usize::from(attribute.num_components());
            let size = (vertices * components * component.0) as u64;
            room = room.checked_sub(size).ok_or("it holds too many vertices")?;
            let bytes = packed(attribute, vertices, components * component.0)?;
            attributes.push(Attribute {
                id: attribute.unique_id(),
                component: component.1,
                components,
                bytes,
            });
        }
        let corners = mesh.faces().iter().flatten();
        let indices = corners.flat_map(|point| point.0.to_le_bytes()).collect();
        Ok(Self { indices, attributes })
    }

    /// Bytes of the decoded indices and attributes.
    pub fn size(&self) -> u64 {
        let attributes: usize = self.attributes.iter().map(|a| a.bytes.len()).sum();
        (attributes + self.indices.len()) as u64
    }
}

#[cfg(feature = "draco")]
/// Size and type of a component; `None` for types that glTF does not have.
fn component(kind: DataType) -> Option<(usize, ComponentType)> {
    Some(match kind {
        DataType::Int8 => (1, ComponentType::I8),
        DataType::Uint8 => (1, ComponentType::U8),
        DataType::Int16 => (2, ComponentType::I16),
        DataType::Uint16 => (2, ComponentType::U16),
        DataType::Uint32 => (4, ComponentType::U32),
        DataType::Float32 => (4, ComponentType::F32),
        _ => return None,
    })
}

#[cfg(feature = "draco")]
/// The attribute's value of each vertex.
fn packed(attribute: &PointAttribute, vertices: usize, size: usize) -> Result<Vec<u8>, String> {
    let stride = usize::try_from(attribute.byte_stride()).ok().filter(|stride| *stride >= size);
    let stride = stride.ok_or("the layout of an attribute is invalid")?;
    let stored = attribute.buffer().data();
    let mut bytes = Vec::with_capacity(vertices * size);
    for vertex in 0..vertices {
        let AttributeValueIndex(value) = attribute.mapped_index(PointIndex(vertex as u32));
        let start = (value as usize).checked_mul(stride);
        let value = start.and_then(|at| stored.get(at..)?.get(..size));
        bytes.extend(value.ok_or("a vertex has no value of an attribute")?);
    }
    Ok(bytes)
}
