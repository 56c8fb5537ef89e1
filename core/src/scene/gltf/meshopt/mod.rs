//! Decoders of EXT_meshopt_compression and KHR_meshopt_compression: three modes of compression and four filters.
//!
//! A decoder of our own, since those on crates.io either lack version 1 of the attribute codec and the colour
//! filter, which KHR_meshopt_compression brings, or are C++. It follows the bitstreams in the extensions' texts.

mod attributes;
mod filters;
mod indices;
#[cfg(test)]
pub(super) mod tests;

pub(super) use attributes::attributes;
pub(super) use filters::Filter;
pub(super) use indices::{indices, triangles};

/// Why bytes cannot be decoded.
pub(super) type Decoded<T> = Result<T, String>;

/// Reads a byte string from its start.
struct Reader<'b> {
    rest: &'b [u8],
}

impl<'b> Reader<'b> {
    fn take(&mut self, count: usize) -> Decoded<&'b [u8]> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or_else(truncated)?;
        self.rest = rest;
        Ok(taken)
    }

    fn byte(&mut self) -> Decoded<u8> {
        Ok(self.take(1)?[0])
    }

    /// An unsigned integer of one to five bytes with seven bits each, the lowest first.
    fn varint(&mut self) -> Decoded<u32> {
        let mut value = 0;
        for shift in (0..35).step_by(7) {
            let byte = self.byte()?;
            value |= u32::from(byte & 127).wrapping_shl(shift);
            if byte < 128 {
                break;
            }
        }
        Ok(value)
    }

    /// A difference to `last`, with its sign in the lowest bit.
    fn difference(&mut self, last: u32) -> Decoded<u32> {
        Ok(last.wrapping_add(unzigzag(self.varint()?)))
    }

    /// Expects that everything was read.
    fn end(&self) -> Decoded<()> {
        match self.rest.len() {
            0 => Ok(()),
            left => Err(format!("{left} bytes are left after the last element")),
        }
    }
}

fn truncated() -> String {
    "it is truncated".to_owned()
}

/// Checks the first byte: a format in the upper four bits and a version, which is returned, in the lower ones.
fn version(header: u8, format: u8, newest: u8) -> Decoded<u8> {
    let (found, version) = (header & 0xf0, header & 0x0f);
    if found != format {
        return Err(format!("expected a first byte of {format:#x}, found {header:#x}"));
    }
    (version <= newest)
        .then_some(version)
        .ok_or_else(|| format!("expected a version of its format up to {newest}, found {version}"))
}

/// The signed number whose sign is the lowest bit, as its two's complement.
fn unzigzag(value: u32) -> u32 {
    (value >> 1) ^ (value & 1).wrapping_neg()
}
