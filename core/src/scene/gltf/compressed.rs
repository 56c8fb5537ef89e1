//! Buffer views and primitives that a file stores compressed, decoded when they are first used.

use std::cell::{Cell, OnceCell};

use gltf::json;
use json::mesh::{Primitive, Semantic};
use json::validation::Checked;
use serde_json::Value;

use super::budget::Budget;
use super::container;
use super::draco::Geometry;
use super::meshopt::{self, Filter};
use crate::{Error, Result};

/// The most bytes that all compressed buffer views and primitives decode to.
const MAX_DECODED: u64 = 1 << 30;

/// Memory that a decoder takes for each byte that it decodes to.
const DECODED_BYTES: u64 = 4;

/// The extensions of buffer views, the preferred one first.
pub(super) const MESHOPT: [&str; 2] = ["KHR_meshopt_compression", "EXT_meshopt_compression"];

const DRACO: &str = "KHR_draco_mesh_compression";

/// What was decoded so far.
pub(super) struct Decoded<'b> {
    /// Content of the buffer views with one of meshoptimizer's extensions.
    views: Vec<OnceCell<Vec<u8>>>,
    /// Content of the buffer views that primitives with Draco's extension name.
    geometries: Vec<OnceCell<Geometry>>,
    /// Number of bytes that may still be decoded.
    room: Cell<u64>,
    budget: &'b Budget,
}

impl<'a> Decoded<'a> {
    pub fn new(root: &json::Root, budget: &'a Budget) -> Self {
        let views = root.buffer_views.len();
        Self {
            views: std::iter::repeat_with(OnceCell::new).take(views).collect(),
            geometries: std::iter::repeat_with(OnceCell::new).take(views).collect(),
            room: Cell::new(MAX_DECODED),
            budget,
        }
    }

    fn reserve(&self, bytes: u64) -> std::result::Result<(), String> {
        let left = self.room.get().checked_sub(bytes).ok_or_else(|| {
            format!("expected at most {MAX_DECODED} bytes of all that is compressed, found {bytes} where {} are left", self.room.get())
        })?;
        self.budget.take(DECODED_BYTES.saturating_mul(bytes))?;
        self.room.set(left);
        Ok(())
    }

    /// The content of a buffer view, decoded where it is compressed.
    pub fn view<'b>(&'b self, root: &json::Root, buffers: &[&'b [u8]], index: usize) -> Result<&'b [u8]> {
        let others = root.buffer_views.get(index).and_then(|view| Some(&view.extensions.as_ref()?.others));
        let found = MESHOPT.iter().find_map(|name| Some((*name, others?.get(*name)?)));
        let Some((name, extension)) = found else { return container::view(root, buffers, index) };
        let cell = &self.views[index];
        if let Some(known) = cell.get() {
            return Ok(known);
        }
        let decoded = self.meshopt(buffers, extension);
        let decoded = decoded.map_err(|e| Error::scene(format!("buffer view {index}, {name}"), e))?;
        Ok(cell.get_or_init(|| decoded))
    }

    fn meshopt(&self, buffers: &[&[u8]], extension: &Value) -> std::result::Result<Vec<u8>, String> {
        let number = |name: &str, default: Option<u64>| {
            let value = extension.get(name);
            let number = value.map_or(default, Value::as_u64).and_then(|n| usize::try_from(n).ok());
            number.ok_or_else(|| format!("{name}: expected a number from 0 on, found {}", found(value)))
        };
        let (buffer, offset) = (number("buffer", None)?, number("byteOffset", Some(0))?);
        let (length, count) = (number("byteLength", None)?, number("count", None)?);
        let stride = number("byteStride", None)?;
        let bytes = buffers
            .get(buffer)
            .ok_or_else(|| format!("no such buffer: {buffer}; the file has {}", buffers.len()))?;
        let bytes = bytes.get(offset..).and_then(|b| b.get(..length)).ok_or_else(|| {
            format!("expected {length} bytes from byte {offset} on, found a buffer of {}", bytes.len())
        })?;
        let size = count.checked_mul(stride).and_then(|size| u64::try_from(size).ok()).unwrap_or(u64::MAX);
        self.reserve(size)?;
        let wrong =
            |expected: &str| Err(format!("expected {expected}, found {count} elements of {stride} bytes"));
        let mut decoded = match extension.get("mode").and_then(Value::as_str) {
            Some("ATTRIBUTES") if stride == 0 || stride > 256 || !stride.is_multiple_of(4) => {
                return wrong("a stride of a multiple of 4 up to 256");
            }
            Some("TRIANGLES") if !count.is_multiple_of(3) => return wrong("three indices for each triangle"),
            Some("TRIANGLES" | "INDICES") if !matches!(stride, 2 | 4) => {
                return wrong("indices of 2 or 4 bytes");
            }
            Some("ATTRIBUTES") => meshopt::attributes(bytes, count, stride)?,
            Some("TRIANGLES") => meshopt::triangles(bytes, count, stride)?,
            Some("INDICES") => meshopt::indices(bytes, count, stride)?,
            _ => {
                let value = found(extension.get("mode"));
                return Err(format!("mode: expected ATTRIBUTES, TRIANGLES or INDICES, found {value}"));
            }
        };
        let filter = extension.get("filter");
        let known = filter.map_or(Some(Filter::None), |name| Filter::named(name.as_str()?));
        let known = known.ok_or_else(|| {
            let value = found(filter);
            format!("filter: expected NONE, OCTAHEDRAL, QUATERNION, EXPONENTIAL or COLOR, found {value}")
        })?;
        if !known.applies_to(stride) {
            return Err(format!("its filter {} does not apply to elements of {stride} bytes", found(filter)));
        }
        known.apply(&mut decoded, stride);
        Ok(decoded)
    }

    /// The decoded mesh of a primitive with Draco's extension, and the numbers of its attributes by name.
    pub fn draco<'b, 'p>(
        &'b self,
        root: &json::Root,
        buffers: &[&'b [u8]],
        primitive: &'p Primitive,
        what: &str,
    ) -> Result<Option<(&'b Geometry, &'p Value)>> {
        let others = primitive.extensions.as_ref().map(|extensions| &extensions.others);
        let Some(extension) = others.and_then(|others| others.get(DRACO)) else { return Ok(None) };
        if !cfg!(feature = "draco") && has_plain_positions(root, primitive) {
            return Ok(None);
        }
        let what = format!("{what}, {DRACO}");
        let view = extension.get("bufferView");
        let index = view.and_then(Value::as_u64).and_then(|index| usize::try_from(index).ok());
        let index = index.ok_or_else(|| {
            Error::scene(&what, format!("bufferView: expected its index, found {}", found(view)))
        })?;
        let bytes = container::view(root, buffers, index)?;
        let attributes = extension.get("attributes").unwrap_or(&Value::Null);
        let cell = &self.geometries[index];
        if let Some(known) = cell.get() {
            return Ok(Some((known, attributes)));
        }
        let geometry = Geometry::decode(bytes, self.room.get().min(self.budget.left() / DECODED_BYTES))
            .and_then(|geometry| {
                self.reserve(geometry.size())?;
                Ok(geometry)
            });
        let geometry = geometry.map_err(|e| Error::scene(what, format!("cannot be decoded: {e}")))?;
        Ok(Some((cell.get_or_init(|| geometry), attributes)))
    }
}

/// Whether the positions of a primitive are stored uncompressed too.
fn has_plain_positions(root: &json::Root, primitive: &Primitive) -> bool {
    let index = primitive.attributes.get(&Checked::Valid(Semantic::Positions));
    let accessor = index.and_then(|index| root.accessors.get(index.value()));
    accessor.is_some_and(|accessor| accessor.buffer_view.is_some())
}

/// A JSON value for a message.
fn found(value: Option<&Value>) -> String {
    value.map_or_else(|| "none".to_owned(), Value::to_string)
}
