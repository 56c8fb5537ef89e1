//! Typed, bounds-checked reading of accessors (glTF 2.0, section 3.6.2): strides, sparse values, normalised integers.

use std::borrow::Cow;
use std::collections::HashMap;

use gltf::json;
use json::accessor::{ComponentType, Type};
use json::validation::Checked;

use super::container;
use crate::{Error, Result};

/// The most elements of an accessor that stores nothing but its sparse values: no bytes of the file bound it.
const MAX_SPARSE_ONLY: u64 = 1 << 24;

/// An accessor whose every element lies inside the file's bytes.
pub(super) struct Accessor<'b> {
    /// Elements.
    pub count: usize,
    /// Components an element.
    pub components: usize,
    component: ComponentType,
    normalized: bool,
    /// First element to end; empty where the accessor is zero but for its sparse values.
    bytes: &'b [u8],
    stride: usize,
    /// Byte offset in `sparse_bytes` by element.
    sparse: HashMap<u32, usize>,
    sparse_bytes: &'b [u8],
}

/// Where accessors are read from.
pub(super) struct Source<'b> {
    pub root: &'b json::Root,
    pub buffers: &'b [Cow<'b, [u8]>],
}

impl<'b> Source<'b> {
    /// The accessor of that index; `what` names its use in errors, `shapes` says what may be there.
    pub fn accessor(&self, index: usize, what: &str, shapes: &[Type]) -> Result<Accessor<'b>> {
        let fail = |reason: String| Error::scene(format!("{what} (accessor {index})"), reason);
        let accessors = &self.root.accessors;
        let json = accessors
            .get(index)
            .ok_or_else(|| fail(format!("no such accessor; the file has {}", accessors.len())))?;
        let Checked::Valid(component) = json.component_type.as_ref() else {
            return Err(fail("its component type is none of 5120 to 5123, 5125, 5126".to_owned()));
        };
        let shape = match json.type_.as_ref() {
            Checked::Valid(shape) if shapes.contains(shape) => *shape,
            Checked::Valid(shape) => return Err(fail(format!("expected {shapes:?}, found {shape:?}"))),
            Checked::Invalid => return Err(fail(format!("expected {shapes:?}, found an unknown type"))),
        };
        let components = shape.multiplicity();
        let size = component.0.size() * components;
        let count = json.count.0;
        let (bytes, stride) = match &json.buffer_view {
            Some(view) => {
                let all = container::view(self.root, self.buffers, view.value())?;
                let stride = self.root.buffer_views[view.value()].byte_stride;
                let stride = stride.map(|s| s.0).filter(|s| *s != 0).unwrap_or(size);
                if stride < size {
                    return Err(fail(format!("expected a stride of at least {size} bytes, found {stride}")));
                }
                let bytes = slice(all, json.byte_offset.unwrap_or_default().0, count, stride, size);
                (bytes.map_err(&fail)?, stride)
            }
            None if json.sparse.is_none() => {
                return Err(fail("expected a buffer view or sparse values, found neither".to_owned()));
            }
            None if count > MAX_SPARSE_ONLY => {
                return Err(fail(format!(
                    "expected at most {MAX_SPARSE_ONLY} elements without a buffer view, found {count}"
                )));
            }
            None => (&[][..], size),
        };
        let (sparse, sparse_bytes) = match &json.sparse {
            Some(sparse) => self.sparse(sparse, count, size).map_err(|e| match e {
                Error::Scene { what, reason } => fail(format!("{what}: {reason}")),
                other => other,
            })?,
            None => (HashMap::new(), &[][..]),
        };
        let count = count as usize;
        let normalized = json.normalized;
        Ok(Accessor {
            count,
            components,
            component: component.0,
            normalized,
            bytes,
            stride,
            sparse,
            sparse_bytes,
        })
    }

    fn sparse(
        &self,
        sparse: &json::accessor::sparse::Sparse,
        count: u64,
        size: usize,
    ) -> Result<(HashMap<u32, usize>, &'b [u8])> {
        let fail = |part: &str, reason: String| Error::scene(format!("sparse {part}"), reason);
        let Checked::Valid(component) = sparse.indices.component_type.as_ref() else {
            return Err(fail("indices", "their component type is none of 5121, 5123, 5125".to_owned()));
        };
        let index_size = component.0.size();
        let view = container::view(self.root, self.buffers, sparse.indices.buffer_view.value())?;
        let indices = slice(view, sparse.indices.byte_offset.0, sparse.count.0, index_size, index_size)
            .map_err(|r| fail("indices", r))?;
        let view = container::view(self.root, self.buffers, sparse.values.buffer_view.value())?;
        let values = slice(view, sparse.values.byte_offset.0, sparse.count.0, size, size)
            .map_err(|r| fail("values", r))?;
        let mut places = HashMap::with_capacity(indices.len() / index_size);
        for (i, bytes) in indices.chunks_exact(index_size).enumerate() {
            let index = unsigned(bytes);
            if u64::from(index) >= count {
                return Err(fail(
                    "indices",
                    format!("number {i} is {index}, the accessor has {count} elements"),
                ));
            }
            places.insert(index, i * size);
        }
        Ok((places, values))
    }
}

/// `count` elements from `offset` on.
fn slice(
    bytes: &[u8],
    offset: u64,
    count: u64,
    stride: usize,
    size: usize,
) -> std::result::Result<&[u8], String> {
    let length = match count.checked_sub(1) {
        Some(last) => last.checked_mul(stride as u64).and_then(|l| l.checked_add(size as u64)),
        None => Some(0),
    };
    let end = length.and_then(|l| offset.checked_add(l));
    let range = usize::try_from(offset).ok().zip(end.and_then(|e| usize::try_from(e).ok()));
    range.and_then(|(start, end)| bytes.get(start..end)).ok_or_else(|| {
        format!(
            "expected {count} elements of {size} bytes, {stride} apart, from byte {offset} on; \
             found a buffer view of {} bytes",
            bytes.len()
        )
    })
}

/// One to four little-endian bytes.
fn unsigned(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |value, byte| value << 8 | u32::from(*byte))
}

impl Accessor<'_> {
    /// The bytes of an element, `None` where it is zero; `index` is below `count`.
    fn element(&self, index: usize) -> Option<&[u8]> {
        let size = self.component.size() * self.components;
        match self.sparse.get(&(index as u32)) {
            Some(&place) => self.sparse_bytes.get(place..place + size),
            None => self.bytes.get(index * self.stride..index * self.stride + size),
        }
    }

    /// An element as floats (glTF 2.0, section 3.6.2.2); components that are not there are zero.
    pub fn floats<const N: usize>(&self, index: usize) -> [f32; N] {
        let mut values = [0.0; N];
        let Some(bytes) = self.element(index) else { return values };
        let chunks = bytes.chunks_exact(self.component.size());
        for (value, b) in values.iter_mut().zip(chunks) {
            let scale = |v: f32, max: f32| if self.normalized { (v / max).max(-1.0) } else { v };
            *value = match self.component {
                ComponentType::I8 => scale(f32::from(b[0] as i8), 127.0),
                ComponentType::U8 => scale(f32::from(b[0]), 255.0),
                ComponentType::I16 => scale(f32::from(unsigned(b) as u16 as i16), 32767.0),
                ComponentType::U16 => scale(f32::from(unsigned(b) as u16), 65535.0),
                ComponentType::U32 => scale(unsigned(b) as f32, u32::MAX as f32),
                ComponentType::F32 => f32::from_bits(unsigned(b)),
            };
        }
        values
    }

    /// Whether elements may be indices.
    pub fn is_unsigned(&self) -> bool {
        matches!(self.component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32)
    }

    /// An element of a scalar accessor of unsigned integers.
    pub fn index(&self, index: usize) -> u32 {
        self.element(index).map_or(0, unsigned)
    }
}
