//! The bytes behind a file: the chunks of a `.glb`, buffers, data URIs and external URIs.

use std::borrow::Cow;

use base64::Engine as _;
use gltf::json;

use crate::{Error, Result};

/// Gives the bytes of an external URI, or says why it cannot.
pub(super) type Resolve<'r> = dyn FnMut(&str) -> std::result::Result<Vec<u8>, String> + 'r;

/// The JSON text and the binary chunk of a file.
pub(super) struct Chunks<'a> {
    pub json: &'a [u8],
    pub binary: Option<&'a [u8]>,
}

/// Splits a `.glb`; anything else is taken as the JSON text of a `.gltf`.
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
        return Err(Error::scene(".glb header", format!("expected version 2, found {version}")));
    }
    let end = word(8)? as usize;
    if end > bytes.len() {
        return Err(truncated(format!("{end} bytes, as its header says"), bytes.len()));
    }
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    while at + 8 <= end {
        let (length, kind) = (word(at)? as usize, bytes.get(at + 4..at + 8));
        let chunk = bytes
            .get(at + 8..at + 8 + length)
            .ok_or_else(|| truncated(format!("a chunk of {length} bytes at byte {at}"), bytes.len()))?;
        match kind {
            Some(b"JSON") if json.is_none() => json = Some(chunk),
            Some(b"BIN\0") if binary.is_none() => binary = Some(chunk),
            _ => {}
        }
        at += 8 + length.next_multiple_of(4);
    }
    let json = json.ok_or_else(|| Error::scene(".glb file", "expected a JSON chunk, found none"))?;
    Ok(Chunks { json, binary })
}

fn truncated(wanted: String, length: usize) -> Error {
    Error::scene(".glb file", format!("it is truncated: expected {wanted}, found {length} bytes in all"))
}

/// The bytes of every buffer, as long as the file says (longer ones are cut: chunks are padded).
pub(super) fn buffers<'a>(
    root: &json::Root,
    binary: Option<&'a [u8]>,
    resolve: &mut Resolve<'_>,
) -> Result<Vec<Cow<'a, [u8]>>> {
    let mut all = Vec::with_capacity(root.buffers.len());
    for (i, buffer) in root.buffers.iter().enumerate() {
        let what = format!("buffer {i}");
        let bytes = match (&buffer.uri, binary) {
            (Some(uri), _) => Cow::Owned(fetch(uri, &what, resolve)?),
            (None, Some(binary)) if i == 0 => Cow::Borrowed(binary),
            (None, _) => {
                return Err(Error::scene(
                    what,
                    "expected a URI or the binary chunk of a .glb, found neither",
                ));
            }
        };
        let expected = buffer.byte_length.0;
        if (bytes.len() as u64) < expected {
            return Err(Error::scene(
                what,
                format!("it is truncated: expected {expected} bytes, found {}", bytes.len()),
            ));
        }
        let expected = expected as usize;
        all.push(match bytes {
            Cow::Borrowed(bytes) => Cow::Borrowed(&bytes[..expected]),
            Cow::Owned(mut bytes) => {
                bytes.truncate(expected);
                Cow::Owned(bytes)
            }
        });
    }
    Ok(all)
}

/// The bytes of a buffer view.
pub(super) fn view<'b>(root: &json::Root, buffers: &'b [Cow<'_, [u8]>], index: usize) -> Result<&'b [u8]> {
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

/// The bytes of a URI: decoded if it is a data URI, else asked for under its percent-decoded name.
pub(super) fn fetch(uri: &str, what: &str, resolve: &mut Resolve<'_>) -> Result<Vec<u8>> {
    let Some(data) = uri.strip_prefix("data:") else {
        let name = percent_decoded(uri)
            .ok_or_else(|| Error::scene(what, format!("its URI `{uri}` is not percent-encoded UTF-8")))?;
        return resolve(&name)
            .map_err(|reason| Error::scene(what, format!("cannot read `{name}`: {reason}")));
    };
    let (header, payload) = data
        .split_once(',')
        .ok_or_else(|| Error::scene(what, "expected a comma in its data URI, found none"))?;
    if !header.ends_with(";base64") {
        return Err(Error::scene(what, format!("expected a base64 data URI, found `data:{header:.40}`")));
    }
    // Padding is optional in the wild.
    let engine = base64::engine::GeneralPurpose::new(
        &base64::alphabet::STANDARD,
        base64::engine::general_purpose::PAD
            .with_decode_padding_mode(base64::engine::DecodePaddingMode::Indifferent),
    );
    engine.decode(payload).map_err(|e| Error::scene(what, format!("its data URI is not base64: {e}")))
}

fn percent_decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        rest = tail;
        if first != b'%' {
            bytes.push(first);
            continue;
        }
        let digits = rest.get(..2).filter(|d| d.iter().all(u8::is_ascii_hexdigit))?;
        bytes.push(u8::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok()?);
        rest = &rest[2..];
    }
    String::from_utf8(bytes).ok()
}
