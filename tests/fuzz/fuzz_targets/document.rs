//! A valid document that uses all features, with patches that make it invalid in a few places: random bytes as JSON
//! would fail in the parser, while patched documents reach the importer.

use arbitrary::{Result, Unstructured};
use serde_json::{Value, json};

const DOCUMENT: &str = include_str!("../document/everything.gltf");
const FILES: [(&str, &[u8]); 6] = [
    ("everything.bin", include_bytes!("../document/everything.bin")),
    ("texture.png", include_bytes!("../document/texture.png")),
    ("compressed.bin", include_bytes!("../document/compressed.bin")),
    ("texture.jpg", include_bytes!("../document/texture.jpg")),
    ("texture.webp", include_bytes!("../document/texture.webp")),
    ("texture.ktx2", include_bytes!("../document/texture.ktx2")),
];

/// Boundary values: limits of types and of the importer's ranges, and constants of glTF.
const INTEGERS: [u64; 28] = [
    0,
    1,
    2,
    3,
    4,
    5,
    6,
    255,
    256,
    5120,
    5121,
    5122,
    5123,
    5125,
    5126,
    9728,
    10497,
    16384,
    65535,
    1 << 20,
    (1 << 20) + 1,
    1 << 24,
    u32::MAX as u64 - 1,
    u32::MAX as u64,
    1 << 32,
    1 << 53,
    u64::MAX - 1,
    u64::MAX,
];
const FLOATS: [f64; 24] = [
    0.0,
    -0.0,
    0.5,
    -1.0,
    1.571,
    std::f64::consts::PI,
    1.0e-45,
    1.0e-38,
    1.2e-38,
    1.0e-16,
    1.0e-9,
    1.0e4,
    1.0e9,
    1.0e18,
    2.0e18,
    1.0e30,
    2.0e30,
    3.4e38,
    -3.4e38,
    1.0e39,
    -1.0e39,
    1.0e300,
    f64::MAX,
    f64::MIN_POSITIVE,
];
const TEXTS: [&str; 12] = [
    "",
    "2.1",
    "VEC2",
    "VEC3",
    "VEC4",
    "SCALAR",
    "MASK",
    "BLEND",
    "everything.bin",
    "texture.png",
    "data:;base64,AAAA",
    "\u{1b}[2J%00",
];

/// A document with the files that it references.
pub struct Patched {
    pub text: Vec<u8>,
    files: Vec<(&'static str, Vec<u8>)>,
}

impl Patched {
    pub fn read(u: &mut Unstructured<'_>) -> Result<Self> {
        let mut document: Value = serde_json::from_str(DOCUMENT).expect("the document is JSON");
        for _ in 0..u.int_in_range(0..=6)? {
            patch(&mut document, u)?;
        }
        let mut files = FILES.map(|(name, bytes)| (name, bytes.to_vec())).to_vec();
        for _ in 0..u.int_in_range(0..=4)? {
            let (_, bytes) = &mut files[u.choose_index(FILES.len())?];
            damage(bytes, u)?;
        }
        Ok(Self { text: document.to_string().into_bytes(), files })
    }

    /// Bytes of a file that the document references.
    pub fn file(&self, name: &str) -> std::result::Result<Vec<u8>, String> {
        let found = self.files.iter().find(|(known, _)| *known == name);
        found.map(|(_, bytes)| bytes.clone()).ok_or_else(|| "there is none".to_owned())
    }
}

/// JSON pointers to all values below `value`.
fn pointers(value: &Value, path: &str, all: &mut Vec<String>) {
    all.push(path.to_owned());
    match value {
        Value::Array(items) => {
            for (i, item) in items.iter().enumerate() {
                pointers(item, &format!("{path}/{i}"), all);
            }
        }
        Value::Object(members) => {
            for (name, member) in members {
                pointers(member, &format!("{path}/{name}"), all);
            }
        }
        _ => {}
    }
}

fn patch(document: &mut Value, u: &mut Unstructured<'_>) -> Result<()> {
    let mut places = Vec::new();
    pointers(document, "", &mut places);
    let place = u.choose(&places)?;
    let value = match u.int_in_range(0..=9)? {
        0..=2 => json!(u.choose(&INTEGERS)?),
        3..=4 => json!(u.choose(&FLOATS)?),
        5 => json!(u.choose(&TEXTS)?),
        6 => json!(u.arbitrary::<f32>()?),
        7 => document.pointer(u.choose(&places)?).cloned().unwrap_or_default(),
        8 => return Ok(remove(document, place)),
        _ => repeated(document.pointer(place), u.int_in_range(0..=40)?),
    };
    if let Some(target) = document.pointer_mut(place) {
        *target = value;
    }
    Ok(())
}

fn remove(document: &mut Value, place: &str) {
    let Some((parent, name)) = place.rsplit_once('/') else { return };
    match document.pointer_mut(parent) {
        Some(Value::Object(members)) => drop(members.remove(name)),
        Some(Value::Array(items)) => items.retain(|_| false),
        _ => {}
    }
}

/// Repeats the items of a list.
fn repeated(value: Option<&Value>, times: usize) -> Value {
    match value {
        Some(Value::Array(items)) => items.iter().cycle().take(items.len() * times).cloned().collect(),
        Some(Value::String(text)) => json!(text.repeat(times)),
        other => Value::Array(vec![other.cloned().unwrap_or_default(); times]),
    }
}

fn damage(bytes: &mut Vec<u8>, u: &mut Unstructured<'_>) -> Result<()> {
    let at = u.int_in_range(0..=bytes.len())?;
    match u.int_in_range(0..=3)? {
        0 => bytes.truncate(at),
        1 => {
            let float: f32 = *u.choose(&FLOATS)? as f32;
            let values = [float, f32::NAN, f32::from_bits(u.arbitrary()?)];
            replace(bytes, at / 4 * 4, &u.choose(&values)?.to_le_bytes());
        }
        2 => replace(bytes, at, &u.arbitrary::<u32>()?.to_be_bytes()),
        _ => replace(bytes, at, &[u.arbitrary()?]),
    }
    Ok(())
}

fn replace(bytes: &mut [u8], at: usize, by: &[u8]) {
    if let Some(target) = bytes.get_mut(at..at + by.len()) {
        target.copy_from_slice(by);
    }
}
