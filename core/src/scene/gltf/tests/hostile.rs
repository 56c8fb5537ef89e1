//! Malicious files: small ones that ask for much work or memory, or inject control sequences into a terminal.

use serde_json::{Value, json};

use super::{File, fails, import};
use crate::scene::{Scene, octahedral_decode};

#[test]
fn keys_that_stand_twice() {
    fails(br#"{"asset":{"version":"2.0"},"asset":{"version":"2.0"}}"#, &["file", "duplicate field `asset`"]);
    let twice = br#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0,"mesh":1}]}"#;
    fails(twice, &["file", "duplicate field `mesh`"]);
}

#[test]
fn deep_nesting_where_nobody_looks() {
    let mut file = File::triangle();
    file.json["scenes"][0]["extras"] = json!("EXTRAS");
    let text = String::from_utf8(file.gltf()).unwrap();
    let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    let nested = import(text.replace("\"EXTRAS\"", &deep).as_bytes()).unwrap();
    assert_eq!(nested.positions.len(), 1, "extras that say nothing to us are passed over");
}

#[test]
fn what_a_file_says_is_quoted_short_and_without_control_characters() {
    let loud = format!("\u{1b}[2J\n{}", "x".repeat(1_000_000));
    let mut file = File::triangle();
    file.json["nodes"][0]["name"] = json!(loud);
    file.json["meshes"][0]["name"] = json!(loud);
    file.json["cameras"] =
        json!([{ "name": loud, "type": "perspective", "perspective": { "yfov": 1, "znear": 1 } }]);
    file.json["nodes"][0]["camera"] = json!(0);
    file.json["materials"] = json!([{ "name": loud, "alphaCutoff": -1, "alphaMode": "MASK" }]);
    file.primitive()["material"] = json!(0);
    let scene = file.scene();
    let said = [&scene.objects[0].name, &scene.cameras[0].0, &scene.materials[0].name, &scene.warnings[0]];
    let mut version = File::triangle();
    version.json["asset"]["version"] = json!(loud);
    let mut uri = File::triangle();
    uri.json["buffers"] = json!([{ "byteLength": 9, "uri": loud }]);
    let errors = [version, uri].map(|file| file.read().unwrap_err().to_string());
    for text in said.into_iter().chain(&errors) {
        assert!(text.len() < 900 && !text.contains(char::is_control), "{text:?}");
    }
}

#[test]
fn glb_chunks_that_leave_their_file() {
    let glb = File::triangle().glb();
    let with = |at: usize, value: u32| {
        let mut glb = glb.clone();
        glb[at..at + 4].copy_from_slice(&value.to_le_bytes());
        glb
    };
    let text_length = u32::from_le_bytes(glb[12..16].try_into().unwrap());
    let binary = 20 + text_length as usize;
    fails(&with(8, glb.len() as u32 + 1), &[".glb file", "truncated", "as its header says"]);
    fails(&with(8, glb.len() as u32 - 4), &[".glb file", "truncated", "a chunk of"]);
    fails(&with(8, 0), &[".glb file", "expected a JSON chunk"]);
    fails(&with(12, text_length + 1), &["file"]);
    fails(&with(binary, 40), &["a chunk of 40 bytes"]);
    fails(&with(binary, 32), &["buffer 0", "expected 36 bytes, found 32"]);
    fails(&with(binary + 4, 0), &["buffer 0", "found neither"]);
    let longer = [glb.clone(), vec![7; 100]].concat();
    assert_eq!(
        import(&longer).unwrap().positions.len(),
        1,
        "what follows the file's own end is not part of it"
    );
}

#[test]
fn a_file_that_many_buffers_name_is_read_once() {
    let mut file = File::triangle();
    let buffer = json!({ "byteLength": file.bytes.len(), "uri": "a.bin" });
    file.json["buffers"] = Value::Array(vec![buffer; 1000]);
    let mut asked = 0;
    let scene = Scene::from_gltf(&file.gltf(), &mut |_| {
        asked += 1;
        Ok(file.bytes.clone())
    });
    assert_eq!((scene.unwrap().positions.len(), asked), (1, 1));
}

#[test]
fn sparse_indices_ascend() {
    let sparse = |indices: [u8; 2]| {
        let mut file = File::triangle();
        let [indices, values] = [file.view(&indices), file.view(&[0; 24])];
        file.json["accessors"][0]["sparse"] = json!({
            "count": 2,
            "indices": { "bufferView": indices, "componentType": 5121 },
            "values": { "bufferView": values },
        });
        file
    };
    sparse([1, 1]).fails(&["POSITION", "sparse indices", "ascending", "found 1 at 1"]);
    sparse([2, 0]).fails(&["POSITION", "sparse indices", "ascending", "found 0 at 1"]);
}

#[test]
fn sparse_values_that_many_accessors_share_are_limited() {
    const VALUES: usize = 1 << 20;
    let mut file = File::triangle();
    let indices: Vec<u32> = (0..VALUES as u32).collect();
    let [indices, values] = [file.view(bytemuck::cast_slice(&indices)), file.view(&vec![0; 3 * VALUES])];
    let accessor = json!({
        "componentType": 5121, "type": "VEC3", "count": VALUES,
        "sparse": {
            "count": VALUES,
            "indices": { "bufferView": indices, "componentType": 5125 },
            "values": { "bufferView": values },
        },
    });
    file.json["accessors"] = Value::Array(vec![accessor; 65]);
    let primitive = |i: usize| json!({ "attributes": { "POSITION": i }, "mode": 5 });
    file.json["meshes"][0]["primitives"] = (0..65).map(primitive).collect();
    fails(&file.glb(), &["mesh 0 primitive 64, POSITION", "at most 67108864 in all accessors"]);
}

#[test]
fn instances_of_meshes_of_many_primitives_are_limited() {
    let mut file = File::triangle();
    let primitive = file.primitive().clone();
    file.json["meshes"][0]["primitives"] = Value::Array(vec![primitive; 2048]);
    file.json["nodes"] = Value::Array(vec![json!({ "mesh": 0 }); 2049]);
    file.json["scenes"][0]["nodes"] = (0..2049).collect();
    file.fails(&["file", "at most 4194304 mesh primitives, instances counted each"]);
}

#[test]
fn a_few_vertices_of_a_long_array() {
    let mut file = File::triangle();
    let positions: Vec<f32> = (0..3000).map(|i| ((i * i) % 1009) as f32).collect();
    let texcoords: Vec<f32> = (0..2000).map(|i| i as f32).collect();
    let [positions_at, texcoords_at] = [file.floats("VEC3", &positions), file.floats("VEC2", &texcoords)];
    file.attribute("POSITION", positions_at);
    file.attribute("TEXCOORD_0", texcoords_at);
    let indices: [u16; 6] = [999, 3, 500, 500, 3, 998];
    let indices_at = file.accessor(5123, "SCALAR", 6, bytemuck::cast_slice(&indices));
    file.primitive()["indices"] = json!(indices_at);
    file.json["materials"] = json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
    file.primitive()["material"] = json!(0);
    file.json["textures"] = json!([{ "source": 0 }]);
    file.json["images"] = json!([{ "uri": super::data_uri("image/png", &super::png(1, 1, [0; 4])) }]);
    let scene = file.scene();
    assert_eq!(scene.positions.len(), 2);
    for (found, vertex) in scene.positions.iter().flatten().zip(indices) {
        assert_eq!(found.to_array(), positions[3 * usize::from(vertex)..][..3], "vertex {vertex}");
    }
    for (found, vertex) in scene.texcoords.iter().flatten().zip(indices) {
        assert_eq!(found.to_array(), texcoords[2 * usize::from(vertex)..][..2], "vertex {vertex}");
    }
}

#[test]
fn what_is_wrong_with_a_primitive_is_said_once_for_all_instances() {
    let mut file = File::triangle();
    file.json["materials"] = json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
    file.primitive()["material"] = json!(0);
    file.json["textures"] = json!([{ "source": 0 }]);
    file.json["images"] = json!([{ "uri": super::data_uri("image/png", &super::png(1, 1, [0; 4])) }]);
    file.json["nodes"] = Value::Array(vec![json!({ "mesh": 0 }); 100]);
    file.json["scenes"][0]["nodes"] = (0..100).collect();
    let scene = file.scene();
    assert_eq!(scene.objects.len(), 100);
    let said = scene.warnings.iter().filter(|w| w.contains("without TEXCOORD_0")).count();
    assert_eq!(said, 1, "{:?}", scene.warnings);
}

#[test]
fn many_cameras_are_not_all_listed() {
    let mut file = File::triangle();
    file.json["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 1, "znear": 1 } }]);
    file.json["nodes"] = Value::Array(vec![json!({ "mesh": 0, "camera": 0 }); 1000]);
    file.json["scenes"][0]["nodes"] = (0..1000).collect();
    let error = file.scene().camera(Some("stage")).unwrap_err().to_string();
    assert!(error.contains("15 (camera0), 984 more") && error.len() < 400, "{error}");
}

/// Surfaces are two-sided, so meshes need be neither closed nor consistently wound.
#[test]
fn inside_out_and_non_manifold_meshes_are_taken_as_they_are() {
    let mut file = File::triangle();
    let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0];
    let positions = file.floats("VEC3", &corners);
    file.attribute("POSITION", positions);
    // Three faces on one edge, the first repeated, and once more reversed.
    let indices = file.accessor(5121, "SCALAR", 15, &[0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 2, 0, 2, 1]);
    file.primitive()["indices"] = json!(indices);
    let scene = file.scene();
    assert_eq!(scene.positions.len(), 5);
    let normals: Vec<_> = scene.normals.iter().map(|n| octahedral_decode(n[0]).to_array()).collect();
    let z = [0.0, 0.0, 1.0];
    let minus_z = [0.0, 0.0, -1.0];
    assert_eq!(normals, [z, minus_z, [0.0, -1.0, 0.0], z, minus_z]);
}
