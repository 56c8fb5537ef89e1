//! Tests of compressed buffer views and meshes.

use glam::{Vec2, Vec3, vec2, vec3};
use serde_json::{Value, json};

use super::File;
use crate::scene::gltf::meshopt::tests::ATTRIBUTES_V0;

/// Two triangles by meshoptimizer's modes: 16-bit positions, and indices in both modes. The values are those of the
/// decoders' own tests.
fn meshopt(extension: &str, indices: &[u8], mode: &str) -> File {
    let mut file = File::triangle();
    file.json["bufferViews"] = json!([]);
    let mut compressed = |bytes: &[u8], count: usize, stride: usize, mode: &str| {
        let view = file.view(bytes);
        let stored = file.json["bufferViews"][view].clone();
        file.json["bufferViews"][view] = json!({
            "buffer": 1, "byteLength": count * stride, "byteStride": stride,
            "extensions": { extension: {
                "buffer": 0, "byteOffset": stored["byteOffset"], "byteLength": bytes.len(),
                "byteStride": stride, "count": count, "mode": mode,
            } },
        });
    };
    compressed(&ATTRIBUTES_V0, 4, 12, "ATTRIBUTES");
    compressed(indices, 6, 4, mode);
    file.json["bufferViews"][1].as_object_mut().unwrap().remove("byteStride");
    file.json["accessors"] = json!([
        { "bufferView": 0, "componentType": 5123, "type": "VEC3", "count": 4 },
        { "bufferView": 1, "componentType": 5125, "type": "SCALAR", "count": 6 },
    ]);
    file.primitive()["indices"] = json!(1);
    file.json["buffers"] = json!([
        { "byteLength": file.bytes.len(), "uri": super::data_uri("application/octet-stream", &file.bytes) },
        { "byteLength": 1000 },
    ]);
    file.json["extensionsRequired"] = json!([extension, "KHR_mesh_quantization"]);
    file
}

/// Indices 0, 1, 2, 2, 1, 3 in the two modes, and codes of triangles in the last 16 bytes.
const TRIANGLES: [u8; 19] = [
    0xe1, 0xf0, 0x10, 0x00, 0x76, 0x87, 0x56, 0x67, 0x78, 0xa9, 0x86, 0x65, 0x89, 0x68, 0x98, 0x01, 0x69, 0,
    0,
];
const SEQUENCE: [u8; 11] = [0xd1, 0, 4, 4, 0, 2, 8, 0, 0, 0, 0];

#[test]
fn buffer_views_of_meshoptimizer_are_decoded_by_both_names() {
    let corner = |x, y| vec3(x, y, 0.0) * 300.0;
    let mut short = meshopt("EXT_meshopt_compression", &SEQUENCE, "INDICES");
    short.json["bufferViews"][1]["byteLength"] = json!(12);
    short.json["bufferViews"][1]["extensions"]["EXT_meshopt_compression"]["byteStride"] = json!(2);
    short.json["accessors"][1]["componentType"] = json!(5123);
    assert_eq!(short.scene().positions.len(), 2);
    for extension in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
        for (indices, mode) in [(&TRIANGLES[..], "TRIANGLES"), (&SEQUENCE, "INDICES")] {
            let scene = meshopt(extension, indices, mode).scene();
            let first = [corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)];
            let second = [corner(0.0, 1.0), corner(1.0, 0.0), corner(1.0, 1.0)];
            assert_eq!(scene.positions, [first, second], "{extension} {mode}");
        }
    }
}

#[test]
fn bad_buffer_views_of_meshoptimizer_are_told() {
    const NAME: &str = "EXT_meshopt_compression";
    let with = |view: usize, member: &str, value: Value| {
        let mut file = meshopt(NAME, &TRIANGLES, "TRIANGLES");
        file.json["bufferViews"][view]["extensions"][NAME][member] = value;
        file
    };
    with(0, "mode", json!("LINES")).fails(&["buffer view 0, EXT_meshopt_compression", "found \"LINES\""]);
    with(0, "filter", json!("SEPIA")).fails(&["filter: expected NONE", "found \"SEPIA\""]);
    with(0, "filter", json!("QUATERNION")).fails(&["does not apply to elements of 12 bytes"]);
    with(0, "byteStride", json!(6))
        .fails(&["a stride of a multiple of 4 up to 256, found 4 elements of 6 bytes"]);
    with(0, "count", json!(-1)).fails(&["count: expected a number from 0 on, found -1"]);
    with(0, "count", json!(5_000_000)).fails(&["cannot hold 5000000 elements of 12"]);
    with(0, "count", json!(1_u64 << 40))
        .fails(&["expected at most 1073741824 bytes of all that is compressed"]);
    with(0, "byteLength", json!(9000)).fails(&["expected 9000 bytes from byte", "found a buffer of"]);
    with(0, "byteLength", json!(84)).fails(&["buffer view 0"]);
    with(0, "buffer", json!(7)).fails(&["no such buffer: 7; the file has 2"]);
    with(1, "count", json!(5)).fails(&["three indices for each triangle, found 5 elements"]);
    with(1, "byteStride", json!(3)).fails(&["indices of 2 or 4 bytes, found 6 elements of 3"]);
}

/// A square of two triangles as Draco stores it sequentially (Draco bitstream specification, sections 3.3 to 3.6):
/// positions and texture coordinates as floats, joints as bytes, in attributes 5, 6 and 7.
#[cfg(feature = "draco")]
fn draco_stream() -> Vec<u8> {
    // Version 2.2, a triangular mesh, sequential, without flags; triangles, points, indices of a byte each.
    let mut stream = b"DRACO\x02\x02\x01\x00\x00\x00\x02\x04\x01\x00\x01\x02\x02\x01\x03".to_vec();
    // One decoder of three attributes: type, component, number of components, normalised, id.
    stream.extend([1, 3, 0, 9, 3, 0, 5, 3, 9, 2, 0, 6, 4, 2, 4, 0, 7, 0, 0, 0]);
    for [x, y] in SQUARE {
        stream.extend([x, y, 0.5].into_iter().flat_map(f32::to_le_bytes));
    }
    stream.extend(SQUARE.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
    stream.extend([1, 0, 0, 0].repeat(4));
    stream
}

#[cfg(feature = "draco")]
const SQUARE: [[f32; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];

#[cfg(feature = "draco")]
fn draco(stream: &[u8]) -> File {
    let mut file = File::triangle();
    let view = file.view(stream);
    file.json["accessors"] = json!([
        { "componentType": 5126, "type": "VEC3", "count": 4 },
        { "componentType": 5126, "type": "VEC2", "count": 4 },
        { "componentType": 5121, "type": "VEC4", "count": 4 },
    ]);
    let weights = file.floats("VEC4", &[1.0, 0.0, 0.0, 0.0].repeat(4));
    file.json["materials"] = json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
    file.json["textures"] = json!([{ "source": 0 }]);
    file.json["images"] = json!([{ "uri": super::data_uri("image/png", &super::png(1, 1, [9; 4])) }]);
    *file.primitive() = json!({
        "mode": 5,
        "material": 0,
        "attributes": { "POSITION": 0, "TEXCOORD_0": 1, "JOINTS_0": 2, "WEIGHTS_0": weights },
        "extensions": { "KHR_draco_mesh_compression": {
            "bufferView": view, "attributes": { "POSITION": 5, "TEXCOORD_0": 6, "JOINTS_0": 7 },
        } },
    });
    file.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    file
}

#[cfg(feature = "draco")]
#[test]
fn draco_brings_indices_and_attributes() {
    let mut file = draco(&draco_stream());
    let corner = |[x, y]: [f32; 2]| vec3(x, y, 0.5);
    let scene = file.scene();
    let [a, b, c, d] = SQUARE.map(corner);
    assert_eq!(scene.positions, [[a, b, c], [c, b, d]]);
    assert_eq!(scene.texcoords[1], [vec2(0.0, 1.0), vec2(1.0, 0.0), Vec2::ONE]);
    file.json["scenes"] = json!([{ "nodes": [0, 1, 2] }]);
    file.json["nodes"] = json!([{ "mesh": 0, "skin": 0 }, {}, { "translation": [0, 0, 2] }]);
    file.json["skins"] = json!([{ "joints": [1, 2] }]);
    assert_eq!(file.scene().positions[0], [a, b, c].map(|p| p + 2.0 * Vec3::Z));
}

#[cfg(feature = "draco")]
#[test]
fn bad_draco_meshes_are_told() {
    let stream = draco_stream();
    for length in 0..stream.len() {
        draco(&stream[..length])
            .fails(&["mesh 0 primitive 0, KHR_draco_mesh_compression: cannot be decoded"]);
    }
    for at in 0..stream.len() {
        for byte in [0, 1, 0x7f, 0xff] {
            let mut damaged = stream.clone();
            damaged[at] = byte;
            let _ = draco(&damaged).read();
        }
    }
    let with = |member: &str, value: Value| {
        let mut file = draco(&stream);
        file.primitive()["extensions"]["KHR_draco_mesh_compression"][member] = value;
        file
    };
    with("bufferView", json!(99)).fails(&["buffer view 99: no such view"]);
    with("bufferView", Value::Null).fails(&["bufferView: expected its index, found null"]);
    with("attributes", json!({ "POSITION": 9 })).fails(&["POSITION: its compressed mesh has no attribute 9"]);
    with("attributes", json!({ "POSITION": 6 })).fails(&["POSITION: expected [Vec3], found 2 components"]);
}
