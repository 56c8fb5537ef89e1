//! Reads the bytes of a file: the chunks of a `.glb`, buffers, data URIs and external URIs.

use std::borrow::Cow;
use std::collections::HashMap;

use base64::Engine as _;
use gltf::json;

use super::compressed::MESHOPT;
use crate::{Error, Result};

/// The most bytes of all data URIs and external files together: as many as a `.glb` with its 32-bit lengths can
/// hold.
const MAX_FETCHED: u64 = 1 << 32;

/// Returns the bytes of an external URI, or why there are none.
pub(super) type Resolve<'r> = dyn FnMut(&str) -> std::result::Result<Vec<u8>, String> + 'r;

/// The JSON text and the binary chunk of a file.
pub(super) struct Chunks<'a> {
    pub json: &'a [u8],
    pub binary: Option<&'a [u8]>,
}

/// Splits a `.glb` into chunks; any other file is taken as the JSON text of a `.gltf`.
pub(super) fn chunks(bytes: &[u8]) -> Result<Chunks<'_>> {
    if !bytes.starts_with(b"glTF") {
        return Ok(Chunks { json: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), binary: None });
    }
    let word = |at: usize| {
        let word = bytes.get(at..at + 4).and_then(|b| b.try_into().ok());
        word.map(u32::from_le_bytes)
            .ok_or_else(|| truncated(format!("a header word at byte {at}"), bytes.len()))
    };
    let version = word(4)?;
    if version != 2 {
        let old = if version == 1 { ": glTF 1.0 is not read" } else { "" };
        return Err(Error::scene(".glb header", format!("expected version 2, found {version}{old}")));
    }
    let end = word(8)? as usize;
    let whole =
        bytes.get(..end).ok_or_else(|| truncated(format!("{end} bytes, as its header says"), bytes.len()))?;
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    while at + 8 <= end {
        let (length, kind) = (word(at)? as usize, &whole[at + 4..at + 8]);
        let chunk = whole
            .get(at + 8..)
            .and_then(|rest| rest.get(..length))
            .ok_or_else(|| truncated(format!("a chunk of {length} bytes at byte {at}"), end))?;
        match kind {
            b"JSON" if json.is_none() => json = Some(chunk),
            b"BIN\0" if binary.is_none() => binary = Some(chunk),
            _ => {}
        }
        let end = at + 8 + length;
        at = if is_binary_chunk(&whole[end..]) { end } else { end.next_multiple_of(4) };
    }
    let json = json.ok_or_else(|| Error::scene(".glb file", "expected a JSON chunk, found none"))?;
    Ok(Chunks { json, binary })
}

/// Whether the bytes start with a header of a binary chunk. Some exporters do not pad the chunk before it, as they must.
fn is_binary_chunk(bytes: &[u8]) -> bool {
    bytes.get(4..8) == Some(b"BIN\0")
}

fn truncated(wanted: String, length: usize) -> Error {
    Error::scene(".glb file", format!("it is truncated: expected {wanted}, found {length} bytes in all"))
}

/// Fetches URIs within a limit on their total size.
pub(super) struct External<'r> {
    resolve: &'r mut Resolve<'r>,
    fetched: u64,
}

impl<'r> External<'r> {
    pub fn new(resolve: &'r mut Resolve<'r>) -> Self {
        Self { resolve, fetched: 0 }
    }

    /// The bytes of a URI: decoded if it is a data URI, else requested from the caller.
    pub fn fetch(&mut self, uri: &str, what: &str) -> Result<Vec<u8>> {
        let bytes = match data_of(uri) {
            Some(data) => decoded(data, what)?,
            None => (self.resolve)(uri)
                .map_err(|reason| Error::scene(what, format!("cannot read `{uri}`: {reason}")))?,
        };
        self.fetched += bytes.len() as u64;
        if self.fetched > MAX_FETCHED {
            return Err(Error::scene(
                what,
                format!("expected at most {MAX_FETCHED} bytes behind all URIs together, found more"),
            ));
        }
        Ok(bytes)
    }
}

/// Fetches the URI of every buffer once, since a small file can name a large one a million times.
pub(super) fn fetched<'r>(
    root: &'r json::Root,
    external: &mut External<'_>,
) -> Result<HashMap<&'r str, Vec<u8>>> {
    let mut all = HashMap::new();
    for (i, buffer) in root.buffers.iter().enumerate() {
        if let Some(uri) = buffer.uri.as_deref().filter(|uri| !all.contains_key(uri)) {
            all.insert(uri, external.fetch(uri, &format!("buffer {i}"))?);
        }
    }
    Ok(all)
}

/// The bytes of every buffer, cut to the length that the file declares, since chunks are padded. A buffer that
/// no buffer view reads may be without any.
pub(super) fn buffers<'b>(
    root: &json::Root,
    binary: Option<&'b [u8]>,
    fetched: &'b HashMap<&str, Vec<u8>>,
) -> Result<Vec<&'b [u8]>> {
    // Whether a buffer view has its bytes from the buffer and not from a compressed place.
    let mut read = vec![false; root.buffers.len()];
    for view in root.buffer_views.iter().filter(|view| view.byte_length.0 > 0 && !is_compressed(view)) {
        if let Some(read) = read.get_mut(view.buffer.value()) {
            *read = true;
        }
    }
    let bytes = |(i, buffer): (usize, &json::Buffer)| {
        let what = || format!("buffer {i}");
        let bytes = match &buffer.uri {
            Some(uri) => fetched.get(uri.as_str()).map(Vec::as_slice),
            None => binary.filter(|_| i == 0),
        };
        let expected = buffer.byte_length.0;
        if bytes.is_none() && (!read[i] || expected == 0) {
            return Ok(&[][..]);
        }
        let bytes = bytes.ok_or_else(|| {
            Error::scene(what(), "expected a URI or the binary chunk of a .glb, found neither")
        })?;
        usize::try_from(expected).ok().and_then(|length| bytes.get(..length)).ok_or_else(|| {
            Error::scene(what(), format!("it is truncated: expected {expected} bytes, found {}", bytes.len()))
        })
    };
    root.buffers.iter().enumerate().map(bytes).collect()
}

fn is_compressed(view: &json::buffer::View) -> bool {
    let others = view.extensions.as_ref().map(|extensions| &extensions.others);
    others.is_some_and(|others| MESHOPT.iter().any(|name| others.contains_key(*name)))
}

/// The bytes of a buffer view as they are stored, checked against the buffer's length.
pub(super) fn view<'b>(root: &json::Root, buffers: &[&'b [u8]], index: usize) -> Result<&'b [u8]> {
    let what = || format!("buffer view {index}");
    let view = root.buffer_views.get(index).ok_or_else(|| {
        Error::scene(what(), format!("no such view; the file has {}", root.buffer_views.len()))
    })?;
    let buffer = buffers.get(view.buffer.value()).ok_or_else(|| {
        Error::scene(
            what(),
            format!("no such buffer: {}; the file has {}", view.buffer.value(), buffers.len()),
        )
    })?;
    let (offset, length) = (view.byte_offset.unwrap_or_default().0, view.byte_length.0);
    let range = usize::try_from(offset).ok().zip(offset.checked_add(length).and_then(|e| e.try_into().ok()));
    range.and_then(|(start, end): (usize, usize)| buffer.get(start..end)).ok_or_else(|| {
        Error::scene(
            what(),
            format!(
                "expected bytes {offset} to {}, found a buffer of {}",
                offset.saturating_add(length),
                buffer.len()
            ),
        )
    })
}

/// A data URI without its scheme, whose letters may be of either case; `None` for other URIs.
pub(super) fn data_of(uri: &str) -> Option<&str> {
    let (scheme, data) = uri.split_at_checked("data:".len())?;
    scheme.eq_ignore_ascii_case("data:").then_some(data)
}

/// Decodes a data URI (RFC 2397) without its scheme.
fn decoded(data: &str, what: &str) -> Result<Vec<u8>> {
    let (header, payload) = data
        .split_once(',')
        .ok_or_else(|| Error::scene(what, "expected a comma in its data URI, found none"))?;
    let payload = percent_decoded(payload);
    let ends = |ending: &str| header.len().checked_sub(ending.len()).and_then(|start| header.get(start..));
    if !ends(";base64").is_some_and(|end| end.eq_ignore_ascii_case(";base64")) {
        return Ok(payload.into_owned());
    }
    // Files in use often leave out the padding, or break lines.
    let engine = base64::engine::GeneralPurpose::new(
        &base64::alphabet::STANDARD,
        base64::engine::general_purpose::PAD
            .with_decode_padding_mode(base64::engine::DecodePaddingMode::Indifferent),
    );
    let payload = if payload.iter().any(u8::is_ascii_whitespace) {
        payload.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).collect()
    } else {
        payload
    };
    engine.decode(&payload).map_err(|e| Error::scene(what, format!("its data URI is not base64: {e}")))
}

/// Replaces percent codes by their bytes (RFC 3986, section 2.1); what is no code stays.
fn percent_decoded(text: &str) -> Cow<'_, [u8]> {
    if !text.contains('%') {
        return Cow::Borrowed(text.as_bytes());
    }
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        let digit = |i: usize| tail.get(i).and_then(|byte| char::from(*byte).to_digit(16));
        match (first, digit(0), digit(1)) {
            (b'%', Some(high), Some(low)) => {
                bytes.push((16 * high + low) as u8);
                rest = &tail[2..];
            }
            _ => {
                bytes.push(first);
                rest = tail;
            }
        }
    }
    Cow::Owned(bytes)
}
