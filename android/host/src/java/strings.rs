//! Strings over the border: modified UTF-8, in which zero takes two bytes and what lies beyond 16 bits is a pair of
//! surrogates (JNI specification, "Modified UTF-8 Strings").

use std::ffi::{CStr, CString, c_char};

/// Encodes.
pub fn encode(text: &str) -> CString {
    let mut bytes = Vec::with_capacity(text.len());
    for unit in text.encode_utf16() {
        match unit {
            1..0x80 => bytes.push(unit as u8),
            0..0x800 => bytes.extend([0xc0 | (unit >> 6) as u8, trail(unit)]),
            _ => bytes.extend([0xe0 | (unit >> 12) as u8, trail(unit >> 6), trail(unit)]),
        }
    }
    CString::new(bytes).unwrap_or_default()
}

fn trail(unit: u16) -> u8 {
    0x80 | (unit & 0x3f) as u8
}

/// Decodes; nothing if it is not well formed, on which Android ends the process.
pub unsafe fn decode(text: *const c_char) -> Option<String> {
    let mut bytes = CStr::from_ptr(text).to_bytes().iter().map(|byte| u16::from(*byte));
    let mut units = Vec::new();
    while let Some(lead) = bytes.next() {
        let mut next = || bytes.next().filter(|byte| byte & 0xc0 == 0x80).map(|byte| byte & 0x3f);
        units.push(match lead {
            0..0x80 => lead,
            0xc0..0xe0 => (lead & 0x1f) << 6 | next()?,
            0xe0..0xf0 => (lead & 0xf) << 12 | next()? << 6 | next()?,
            _ => return None,
        });
    }
    String::from_utf16(&units).ok()
}
