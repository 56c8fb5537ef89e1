//! Bounds-checked reading of typed accessors (glTF 2.0, section 3.6.2): strides, sparse values, normalised
//! integers.

use std::cell::Cell;
use std::cmp::Ordering;

use gltf::json;
use json::accessor::{ComponentType, Type};
use json::validation::Checked;
use serde_json::Value;

use super::budget::Budget;
use super::compressed::Decoded;
use crate::{Error, Result};

/// The most elements of an accessor without a buffer view, whose size the file's bytes do not bound.
const MAX_SPARSE_ONLY: u64 = 1 << 20;

/// The most sparse values of all opened accessors together: many accessors may name the same bytes, and every
/// value is checked when its accessor is opened.
const MAX_SPARSE: u64 = 1 << 26;

/// An accessor whose elements were all checked to lie inside the file's bytes.
#[derive(Clone)]
pub(super) struct Accessor<'b> {
    /// Number of elements.
    pub count: usize,
    /// Number of components per element, 1 to 16.
    pub components: usize,
    component: ComponentType,
    normalized: bool,
    /// Bytes from the first element on; empty for an accessor of zeros.
    bytes: &'b [u8],
    stride: usize,
    sparse: Option<Sparse<'b>>,
}

/// Sparse values that replace those of some elements, in the file's encoding.
#[derive(Clone)]
struct Sparse<'b> {
    /// Indices of the replaced elements, strictly ascending.
    indices: &'b [u8],
    /// Bytes per index.
    index_size: usize,
    /// The values in the order of the indices, tightly packed.
    values: &'b [u8],
}

/// The document and the buffers that accessors are read from.
pub(super) struct Source<'b> {
    /// What is read of the document's JSON, extensions without a type included.
    pub document: &'b Value,
    pub root: &'b json::Root,
    pub buffers: &'b [&'b [u8]],
    pub decoded: &'b Decoded<'b>,
    pub budget: &'b Budget,
    sparse_opened: Cell<u64>,
}

impl<'b> Source<'b> {
    pub fn new(
        document: &'b Value,
        root: &'b json::Root,
        buffers: &'b [&'b [u8]],
        decoded: &'b Decoded<'b>,
        budget: &'b Budget,
    ) -> Self {
        Self { document, root, buffers, decoded, budget, sparse_opened: Cell::new(0) }
    }

    /// The content of a buffer view.
    pub fn view(&self, index: usize) -> Result<&'b [u8]> {
        self.decoded.view(self.root, self.buffers, index)
    }

    /// Opens and checks an accessor. `what` names its use in error messages; `shapes` are the allowed types.
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
                let all = self.view(view.value())?;
                let stride = self.root.buffer_views[view.value()].byte_stride;
                let stride = stride.map(|s| s.0).filter(|s| *s != 0).unwrap_or(size);
                if stride < size {
                    return Err(fail(format!("expected a stride of at least {size} bytes, found {stride}")));
                }
                let bytes = slice(all, json.byte_offset.unwrap_or_default().0, count, stride, size);
                (bytes.map_err(&fail)?, stride)
            }
            None if count > MAX_SPARSE_ONLY => {
                return Err(fail(format!(
                    "expected at most {MAX_SPARSE_ONLY} elements without a buffer view, found {count}"
                )));
            }
            None => (&[][..], size),
        };
        let sparse = json.sparse.as_ref().map(|sparse| self.sparse(sparse, count, size));
        let sparse = sparse.transpose().map_err(|e| match e {
            Error::Scene { what, reason } => fail(format!("{what}: {reason}")),
            other => other,
        })?;
        let (component, normalized) = (component.0, json.normalized);
        Ok(Accessor { count: count as usize, components, component, normalized, bytes, stride, sparse })
    }

    fn sparse(&self, sparse: &json::accessor::sparse::Sparse, count: u64, size: usize) -> Result<Sparse<'b>> {
        let fail = |part: &str, reason: String| Error::scene(format!("sparse {part}"), reason);
        let Checked::Valid(component) = sparse.indices.component_type.as_ref() else {
            return Err(fail("indices", "their component type is none of 5121, 5123, 5125".to_owned()));
        };
        let index_size = component.0.size();
        let view = self.view(sparse.indices.buffer_view.value())?;
        let indices = slice(view, sparse.indices.byte_offset.0, sparse.count.0, index_size, index_size)
            .map_err(|r| fail("indices", r))?;
        let view = self.view(sparse.values.buffer_view.value())?;
        let values = slice(view, sparse.values.byte_offset.0, sparse.count.0, size, size)
            .map_err(|r| fail("values", r))?;
        self.sparse_opened.set(self.sparse_opened.get() + sparse.count.0);
        if self.sparse_opened.get() > MAX_SPARSE {
            return Err(fail(
                "indices",
                format!("expected at most {MAX_SPARSE} in all accessors, found more"),
            ));
        }
        let mut least = 0;
        for (i, bytes) in indices.chunks_exact(index_size).enumerate() {
            let index = u64::from(unsigned(bytes));
            if index >= count {
                return Err(fail(
                    "indices",
                    format!("number {i} is {index}, the accessor has {count} elements"),
                ));
            }
            if index < least {
                return Err(fail(
                    "indices",
                    format!("expected strictly ascending numbers, found {index} at {i}"),
                ));
            }
            least = index + 1;
        }
        Ok(Sparse { indices, index_size, values })
    }
}

impl Sparse<'_> {
    /// The sparse value of an element of `size` bytes; `None` if it is not replaced.
    fn value(&self, element: usize, size: usize) -> Option<&[u8]> {
        let at = |i: usize| unsigned(&self.indices[i * self.index_size..][..self.index_size]) as usize;
        let (mut low, mut high) = (0, self.indices.len() / self.index_size);
        while low < high {
            let middle = low + (high - low) / 2;
            match at(middle).cmp(&element) {
                Ordering::Less => low = middle + 1,
                Ordering::Greater => high = middle,
                Ordering::Equal => return self.values.get(middle * size..(middle + 1) * size),
            }
        }
        None
    }
}

/// The bytes of `count` tightly packed elements from byte `offset` on.
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

/// Reads an unsigned integer of one to four little-endian bytes.
fn unsigned(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |value, byte| value << 8 | u32::from(*byte))
}

impl<'b> Accessor<'b> {
    /// Tightly packed elements, as many as there are bytes for.
    pub fn packed(bytes: &'b [u8], components: usize, component: ComponentType, normalized: bool) -> Self {
        let stride = components * component.size();
        Self { count: bytes.len() / stride, components, component, normalized, bytes, stride, sparse: None }
    }

    /// The bytes of an element; `None` if it is zero. `index` must be below `count`.
    fn element(&self, index: usize) -> Option<&[u8]> {
        let size = self.component.size() * self.components;
        let replaced = self.sparse.as_ref().and_then(|sparse| sparse.value(index, size));
        replaced.or_else(|| self.bytes.get(index * self.stride..index * self.stride + size))
    }

    /// An element converted to floats (glTF 2.0, section 3.6.2.2); missing components are zero.
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

    /// Whether the components are floats.
    pub fn is_float(&self) -> bool {
        self.component == ComponentType::F32
    }

    /// Whether the components are unsigned integers, as indices must be.
    pub fn is_unsigned(&self) -> bool {
        matches!(self.component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32)
    }

    /// An element of a scalar accessor as an unsigned integer.
    pub fn index(&self, index: usize) -> u32 {
        self.element(index).map_or(0, unsigned)
    }

    /// The components of an element as unsigned integers; missing components are zero.
    pub fn integers<const N: usize>(&self, index: usize) -> [u32; N] {
        let mut values = [0; N];
        let components = self.element(index).unwrap_or_default().chunks_exact(self.component.size());
        for (value, bytes) in values.iter_mut().zip(components) {
            *value = unsigned(bytes);
        }
        values
    }
}
