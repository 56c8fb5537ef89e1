//! Import tests with small files that are generated in the test.

mod bad;
mod compressed;
mod extremes;
mod features;
mod hostile;
mod image_light;
mod materials;
mod pictures;
mod poses;
mod valid;

use base64::Engine as _;
use serde_json::{Value, json};

use crate::Result;
use crate::scene::Scene;

/// A glTF file under construction: one buffer, and JSON that tests modify.
pub(super) struct File {
    pub json: Value,
    bytes: Vec<u8>,
}

impl File {
    /// A file with a node `n` and a mesh `m`: one right triangle in the plane z = 0.
    pub fn triangle() -> Self {
        let mut file = Self::empty();
        let positions = file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        file.json["meshes"] =
            json!([{ "name": "m", "primitives": [{ "attributes": { "POSITION": positions } }] }]);
        file.json["nodes"] = json!([{ "name": "n", "mesh": 0 }]);
        file
    }

    pub fn empty() -> Self {
        let json = json!({
            "asset": { "version": "2.0" },
            "scenes": [{ "nodes": [0] }],
            "bufferViews": [],
            "accessors": [],
        });
        Self { json, bytes: Vec::new() }
    }

    fn push(&mut self, array: &str, value: Value) -> usize {
        let array = self.json[array].as_array_mut().unwrap();
        array.push(value);
        array.len() - 1
    }

    /// Adds a buffer view of these bytes; returns its index.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let offset = self.bytes.len();
        self.bytes.extend(bytes);
        let view = json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() });
        self.push("bufferViews", view)
    }

    /// Adds an accessor of these bytes; returns its index.
    pub fn accessor(&mut self, component: u32, shape: &str, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        self.push(
            "accessors",
            json!({ "bufferView": view, "componentType": component, "type": shape, "count": count }),
        )
    }

    pub fn floats(&mut self, shape: &str, values: &[f32]) -> usize {
        let components = match shape {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        self.accessor(5126, shape, values.len() / components, bytemuck::cast_slice(values))
    }

    /// Sets an attribute of the first primitive.
    pub fn attribute(&mut self, name: &str, accessor: usize) {
        self.primitive()["attributes"][name] = json!(accessor);
    }

    pub fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    fn with_buffer(&self, buffer: Value) -> Vec<u8> {
        let mut json = self.json.clone();
        if json.get("buffers").is_none() {
            json["buffers"] = json!([buffer]);
        }
        serde_json::to_vec(&json).unwrap()
    }

    /// The file as `.gltf` with its buffer as a data URI.
    pub fn gltf(&self) -> Vec<u8> {
        let uri = data_uri("application/octet-stream", &self.bytes);
        self.with_buffer(json!({ "byteLength": self.bytes.len(), "uri": uri }))
    }

    /// The document as the bytes of a binary .glb file.
    pub fn glb(&self) -> Vec<u8> {
        let mut text = self.with_buffer(json!({ "byteLength": self.bytes.len() }));
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut binary = self.bytes.clone();
        binary.resize(binary.len().next_multiple_of(4), 0);
        let mut glb = b"glTF".to_vec();
        let length = 12 + 8 + text.len() + 8 + binary.len();
        glb.extend([2, length as u32].into_iter().flat_map(u32::to_le_bytes));
        for (kind, chunk) in [(b"JSON", text), (b"BIN\0", binary)] {
            glb.extend((chunk.len() as u32).to_le_bytes());
            glb.extend(kind);
            glb.extend(chunk);
        }
        glb
    }

    pub fn read(&self) -> Result<Scene> {
        import(&self.gltf())
    }

    pub fn scene(&self) -> Scene {
        self.read().unwrap()
    }

    /// Expects an error whose text contains all `parts`.
    pub fn fails(&self, parts: &[&str]) {
        fails(&self.gltf(), parts);
    }
}

pub(super) fn data_uri(kind: &str, bytes: &[u8]) -> String {
    format!("data:{kind};base64,{}", base64::engine::general_purpose::STANDARD.encode(bytes))
}

/// Encodes a PNG of this size with one colour.
pub(super) fn png(width: u32, height: u32, rgba: [u8; 4]) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let image = image::RgbaImage::from_pixel(width, height, image::Rgba(rgba));
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// Imports a file without external resources.
pub(super) fn import(bytes: &[u8]) -> Result<Scene> {
    Scene::from_gltf(bytes, &mut |uri| Err(format!("there is no `{uri}`")))
}

pub(super) fn fails(bytes: &[u8], parts: &[&str]) {
    let text = match import(bytes) {
        Err(error @ crate::Error::Scene { .. }) => error.to_string(),
        Err(other) => panic!("expected a scene error with {parts:?}, found {other:?}"),
        Ok(_) => panic!("expected a scene error with {parts:?}, found a scene"),
    };
    for part in parts {
        assert!(text.contains(part), "`{text}` does not say `{part}`");
    }
}
