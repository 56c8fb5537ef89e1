//! Mode ATTRIBUTES: blocks of elements, of which each byte is a lane of differences to the element before.

use super::{Decoded, Reader, truncated, unzigzag, version};

/// Elements whose byte of a lane is stored together.
const GROUP: usize = 16;

/// Decodes `count` elements of `stride` bytes, a multiple of 4 up to 256.
pub(in super::super) fn attributes(bytes: &[u8], count: usize, stride: usize) -> Decoded<Vec<u8>> {
    let mut reader = Reader { rest: bytes };
    let version = version(reader.byte()?, 0xa0, 1)?;
    // The last bytes are the element before the first one and, in version 1, the kind of each four lanes.
    let kinds = if version == 0 { 0 } else { stride / 4 };
    let padded = (stride + kinds).max(if version == 0 { 32 } else { 24 });
    let blocks = reader.rest.len().checked_sub(padded).ok_or_else(truncated)?;
    let (_, tail) = bytes.split_at(bytes.len() - stride - kinds);
    let (baseline, kinds) = tail.split_at(stride);
    reader.rest = &reader.rest[..blocks];

    let block = ((8192 / stride) & !(GROUP - 1)).min(256);
    let least = match version {
        0 => count.div_ceil(block) * stride,
        _ => count.div_ceil(block) * (stride / 4),
    };
    if blocks < least {
        return Err(format!("its {} bytes cannot hold {count} elements of {stride}", bytes.len()));
    }
    let mut elements = Vec::with_capacity(count * stride);
    let mut last = baseline.to_vec();
    while elements.len() < count * stride {
        let size = block.min(count - elements.len() / stride);
        let start = elements.len();
        elements.resize(start + size * stride, 0);
        let controls = if version == 0 { &[][..] } else { reader.take(stride / 4)? };
        for lane in (0..stride).step_by(4) {
            let control = controls.get(lane / 4).copied();
            let mut differences = Vec::with_capacity(4);
            for i in 0..4 {
                differences.push(differences_of_lane(&mut reader, control.map(|c| c >> (2 * i) & 3), size)?);
            }
            let kind = kinds.get(lane / 4).copied().unwrap_or(0);
            let to = &mut elements[start + lane..];
            undo(kind, &differences, &last[lane..lane + 4], to, stride)?;
        }
        last.copy_from_slice(&elements[elements.len() - stride..]);
    }
    reader.end()?;
    Ok(elements)
}

/// The differences of one byte of `size` elements.
fn differences_of_lane(reader: &mut Reader<'_>, control: Option<u8>, size: usize) -> Decoded<Vec<u8>> {
    let widths: [u8; 4] = match control {
        None => [0, 2, 4, 8],
        Some(0) => [0, 1, 2, 4],
        Some(1) => [1, 2, 4, 8],
        Some(2) => return Ok(vec![0; size]),
        Some(_) => return Ok(reader.take(size)?.to_vec()),
    };
    let groups = size.div_ceil(GROUP);
    let header = reader.take(groups.div_ceil(4))?;
    let mut lane = Vec::with_capacity(groups * GROUP);
    for group in 0..groups {
        let width = widths[usize::from(header[group / 4] >> (2 * (group % 4)) & 3)];
        read_group(reader, width, &mut lane)?;
    }
    lane.truncate(size);
    Ok(lane)
}

/// Reads 16 bytes of `width` bits each; all bits set stand for a whole byte behind the group.
fn read_group(reader: &mut Reader<'_>, width: u8, lane: &mut Vec<u8>) -> Decoded<()> {
    let packed = reader.take(GROUP * usize::from(width) / 8)?;
    if width == 0 || width == 8 {
        lane.extend(if width == 0 { &[0; GROUP] } else { packed });
        return Ok(());
    }
    let (per_byte, escape) = (usize::from(8 / width), (1 << width) - 1);
    for i in 0..GROUP {
        let place = (i % per_byte) as u8;
        // Single bits begin at the lowest one, the others at the highest.
        let shift = if width == 1 { place } else { 8 - width * (place + 1) };
        let value = packed[i / per_byte] >> shift & escape;
        lane.push(if value == escape { reader.byte()? } else { value });
    }
    Ok(())
}

/// Adds up the differences of four lanes, as bytes, 16-bit or rotated 32-bit integers, and stores them in elements
/// `stride` bytes apart.
fn undo(kind: u8, differences: &[Vec<u8>], last: &[u8], to: &mut [u8], stride: usize) -> Decoded<()> {
    let bytes = match kind & 3 {
        0 => 1,
        1 => 2,
        2 => 4,
        _ => return Err(format!("expected a kind of lane from 0 to 2, found {}", kind & 3)),
    };
    let mask = u32::MAX >> (32 - 8 * bytes);
    for first in (0..4).step_by(bytes) {
        let word = |byte: &dyn Fn(usize) -> u8| {
            (0..bytes).fold(0, |word, j| word | u32::from(byte(first + j)) << (8 * j))
        };
        let mut value = word(&|lane| last[lane]);
        for (at, i) in (first..).step_by(stride).zip(0..differences[0].len()) {
            let difference = word(&|lane| differences[lane][i]);
            value = match bytes {
                4 => difference.rotate_right(u32::from(kind >> 4)) ^ value,
                _ => unzigzag(difference).wrapping_add(value) & mask,
            };
            to[at..at + bytes].copy_from_slice(&value.to_le_bytes()[..bytes]);
        }
    }
    Ok(())
}
