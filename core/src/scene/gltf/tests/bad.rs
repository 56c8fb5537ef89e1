//! Invalid files: each is an error that names the element, and nothing panics.

use serde_json::{Value, json};

use super::{File, data_uri, fails, import, png};

#[test]
fn other_data() {
    fails(b"", &["file", "expected glTF 2.0"]);
    fails(b"ply\nformat ascii 1.0", &["expected glTF 2.0"]);
    fails(b"[1, 2]", &["expected glTF 2.0"]);
    fails(b"{}", &["asset"]);
    fails(br#"{"asset":{"version":"1.0"}}"#, &["asset.version", "expected version 2.0", "`1.0`"]);
    let deep = "[".repeat(100_000);
    fails(deep.as_bytes(), &["expected glTF 2.0"]);
}

#[test]
fn truncated_glb() {
    let glb = File::triangle().glb();
    fails(&glb[..glb.len() - 1], &[".glb file", "truncated"]);
    for length in 0..glb.len() {
        assert!(import(&glb[..length]).is_err(), "{length} of {} bytes", glb.len());
    }
    let mut version = glb.clone();
    version[4] = 7;
    fails(&version, &["expected version 2, found 7"]);
    let mut chunk = glb.clone();
    chunk[12..16].copy_from_slice(&u32::MAX.to_le_bytes());
    fails(&chunk, &["truncated", "4294967295"]);
    let mut no_json = glb;
    no_json[16..20].copy_from_slice(b"nope");
    fails(&no_json, &["expected a JSON chunk"]);
}

#[test]
fn buffers() {
    let with = |buffer: Value| {
        let mut file = File::triangle();
        file.json["buffers"] = json!([buffer]);
        file
    };
    with(json!({ "byteLength": 9 })).fails(&["buffer 0", "found neither"]);
    with(json!({ "byteLength": 9, "uri": "no.bin" })).fails(&["buffer 0", "no.bin", "there is no"]);
    with(json!({ "byteLength": 9, "uri": "%zz" })).fails(&["buffer 0", "%zz", "there is no"]);
    with(json!({ "byteLength": 9, "uri": "data:,abc" })).fails(&["buffer 0", "truncated", "found 3"]);
    with(json!({ "byteLength": 9, "uri": "data:;base64" })).fails(&["buffer 0", "comma"]);
    with(json!({ "byteLength": 9, "uri": "data:;base64,!!!!" })).fails(&["buffer 0", "not base64"]);
    with(json!({ "byteLength": 1_u64 << 62, "uri": "data:;base64,AAAA" })).fails(&[
        "buffer 0",
        "truncated",
        "4611686018427387904",
        "found 3",
    ]);
}

#[test]
fn views_and_accessors() {
    let change = |pointer: &str, value: Value, parts: &[&str]| {
        let mut file = File::triangle();
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        match file.json.pointer_mut(parent).unwrap() {
            Value::Array(array) => array[key.parse::<usize>().unwrap()] = value,
            object => object[key] = value,
        }
        file.fails(parts);
    };
    change("/bufferViews/0/byteLength", json!(1000), &["buffer view 0", "bytes 0 to 1000", "buffer of 36"]);
    change("/bufferViews/0/byteOffset", json!(u64::MAX), &["buffer view 0"]);
    change("/bufferViews/0/buffer", json!(3), &["buffer view 0", "no such buffer: 3"]);
    change("/bufferViews/0/byteStride", json!(4), &["POSITION", "stride of at least 12"]);
    change("/accessors/0/bufferView", json!(8), &["buffer view 8", "the file has 1"]);
    change("/accessors/0/bufferView", Value::Null, &["no triangles that have an area"]);
    change(
        "/accessors/0/count",
        json!(4),
        &["mesh 0 primitive 0, POSITION (accessor 0)", "4 elements of 12"],
    );
    change("/accessors/0/count", json!(u64::MAX), &["POSITION", "18446744073709551615"]);
    change("/accessors/0/byteOffset", json!(4), &["POSITION", "from byte 4 on"]);
    change("/accessors/0/componentType", json!(5124), &["POSITION", "component type"]);
    change("/accessors/0/type", json!("VEC2"), &["POSITION", "expected [Vec3], found Vec2"]);
    change("/accessors/0/type", json!("VEC7"), &["POSITION", "unknown type"]);
    change("/meshes/0/primitives/0/attributes/POSITION", json!(5), &["POSITION (accessor 5)", "has 1"]);
    change("/meshes/0/primitives/0/mode", json!(9), &["mesh 0 primitive 0", "mode"]);
    change("/meshes/0/primitives/0/material", json!(2), &["material 2", "no such material"]);
    change("/nodes/0/mesh", json!(2), &["mesh 2 of node 0", "no such mesh"]);
    change("/scenes/0/nodes/0", json!(2), &["node 2", "no such node"]);
    change("/scenes/0/extras", json!({ "background": [1, 2] }), &["extras.background", "[1,2]"]);
    change("/asset/version", json!(2), &["expected glTF 2.0"]);
}

#[test]
fn sparse_accessors() {
    let sparse = |count: u64, index: u8, value_bytes: usize| {
        let mut file = File::triangle();
        let indices = file.view(&[index]);
        let values = file.view(&vec![0; value_bytes]);
        file.json["accessors"][0]["sparse"] = json!({
            "count": count,
            "indices": { "bufferView": indices, "componentType": 5121 },
            "values": { "bufferView": values },
        });
        file
    };
    sparse(1, 3, 12).fails(&["POSITION", "sparse indices: number 0 is 3", "3 elements"]);
    sparse(2, 0, 24).fails(&["sparse indices: expected 2 elements"]);
    sparse(1, 0, 8).fails(&["sparse values: expected 1 elements of 12 bytes"]);
    let mut file = sparse(1, 0, 12);
    file.json["accessors"][0]["bufferView"] = Value::Null;
    file.json["accessors"][0]["count"] = json!(1_u64 << 40);
    file.fails(&["POSITION", "without a buffer view"]);
}

#[test]
fn indices_and_attributes() {
    let mut file = File::triangle();
    let indices = file.accessor(5121, "SCALAR", 3, &[0, 1, 3]);
    file.primitive()["indices"] = json!(indices);
    file.fails(&["mesh 0 primitive 0, indices", "element 2 is 3", "3 vertices"]);
    let floats = file.floats("SCALAR", &[0.0, 1.0, 2.0]);
    file.primitive()["indices"] = json!(floats);
    file.fails(&["indices", "unsigned"]);

    let mut file = File::triangle();
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0]);
    file.attribute("NORMAL", normals);
    file.fails(&["mesh 0 primitive 0, NORMAL", "expected 3 elements", "found 1"]);

    for bad in [f32::NAN, f32::INFINITY, 2.0e18] {
        let mut file = File::triangle();
        let positions = file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, bad, 0.0, 0.0, 1.0, 0.0]);
        file.attribute("POSITION", positions);
        file.fails(&["mesh 0 primitive 0, POSITION", "element 1"]);
    }
    let mut file = File::triangle();
    let values = file.floats("VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, f32::NAN, 0.0, 1.0]);
    file.attribute("COLOR_0", values);
    file.fails(&["COLOR_0", "element 2"]);
}

#[test]
fn nodes() {
    let nodes = |nodes: Value, parts: &[&str]| {
        let mut file = File::triangle();
        file.json["nodes"] = nodes;
        file.fails(parts);
    };
    nodes(json!([{ "children": [0], "mesh": 0 }]), &["node 0", "cycle"]);
    nodes(json!([{ "children": [1] }, { "children": [0] }]), &["node 0", "cycle"]);
    nodes(json!([{ "children": [1, 1] }, { "mesh": 0 }]), &["node 1", "second"]);
    nodes(json!([{ "mesh": 0, "scale": [1e39, 1, 1] }]), &["node 0", "finite matrix"]);
    nodes(json!([{ "mesh": 0, "rotation": [0, 0, 0, 0] }]), &["node 0", "finite matrix"]);
    nodes(json!([{ "mesh": 0, "scale": [1e20, 1, 1] }]), &["POSITION", "element 1"]);
    nodes(json!([{ "mesh": 0, "scale": [0, 0, 0] }]), &["the scene holds no triangles"]);
    nodes(json!([{}]), &["the scene holds no triangles"]);
    nodes(json!([{ "mesh": 0, "camera": 0 }]), &["camera 0 of node 0", "no such camera"]);
    // A chain of a hundred thousand nodes must not overflow the stack.
    let mut chain: Vec<_> = (1..100_000).map(|i| json!({ "children": [i] })).collect();
    chain.push(json!({ "mesh": 0 }));
    let mut file = File::triangle();
    file.json["nodes"] = json!(chain);
    assert_eq!(file.scene().positions.len(), 1);
}

#[test]
fn cameras_and_lights() {
    let mut file = File::triangle();
    file.json["nodes"] = json!([{ "mesh": 0, "camera": 0 }]);
    file.json["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 4, "znear": 1 } }]);
    file.fails(&["camera 0", "field of view", "found 4"]);
    file.json["cameras"] = json!([{ "type": "perspective" }]);
    file.fails(&["camera 0", "found neither"]);

    let light = |light: Value, parts: &[&str]| {
        let mut file = File::triangle();
        file.json["extensions"]["KHR_lights_punctual"]["lights"] = json!([light]);
        file.json["nodes"][0]["extensions"] = json!({ "KHR_lights_punctual": { "light": 0 } });
        file.fails(parts);
    };
    light(json!({ "type": "point", "intensity": -1 }), &["light 0 of node 0", "intensity"]);
    light(json!({ "type": "point", "range": 0 }), &["light 0", "range of at least 1e-9"]);
    light(json!({ "type": "area" }), &["light 0", "point, spot or directional"]);
    light(json!({ "type": "spot" }), &["light 0", "`spot`"]);
    light(
        json!({ "type": "spot", "spot": { "innerConeAngle": 0.5, "outerConeAngle": 0.2 } }),
        &["cone angles", "0.5 and 0.2"],
    );

    let mut file = File::triangle();
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = json!([{ "type": "point" }]);
    let node = |i: usize| json!({ "KHR_lights_punctual": { "light": i } });
    file.json["nodes"][0]["extensions"] = node(1);
    file.fails(&["light 1 of node 0", "no such light; the file has 1"]);
    let lit = |n: usize| {
        let mut nodes = vec![json!({ "mesh": 0, "children": (1..=n).collect::<Vec<_>>() })];
        nodes.extend((0..n).map(|_| json!({ "extensions": node(0) })));
        json!(nodes)
    };
    for lights in [32, 33] {
        file.json["nodes"] = lit(lights);
        assert_eq!(file.scene().lights.len(), 32);
    }
}

#[test]
fn extensions_and_instances() {
    let mut file = File::triangle();
    file.json["extensionsRequired"] = json!(["KHR_materials_volume", "EXT_unheard_of"]);
    file.fails(&["required extension EXT_unheard_of", "not supported", "KHR_lights_punctual"]);

    // Three megabytes that define a hundred million triangles.
    let mut file = File::triangle();
    let many = file.accessor(5121, "SCALAR", 3_000_000, &vec![0; 3_000_000]);
    file.primitive()["indices"] = json!(many);
    let mut nodes = vec![json!({ "children": (1..100).collect::<Vec<_>>() })];
    nodes.extend((1..100).map(|_| json!({ "mesh": 0 })));
    file.json["nodes"] = json!(nodes);
    file.fails(&["at most 59652323 triangles"]);
}

#[test]
fn images_and_textures() {
    let textured = || {
        let mut file = File::triangle();
        let info = json!({ "baseColorTexture": { "index": 0 } });
        file.json["materials"] = json!([{ "pbrMetallicRoughness": info }]);
        file.primitive()["material"] = json!(0);
        file.json["textures"] = json!([{ "source": 0 }]);
        file.json["images"] = json!([{ "uri": data_uri("image/png", &png(1, 1, [0; 4])) }]);
        file
    };
    let change = |array: &str, value: Value, parts: &[&str]| {
        let mut file = textured();
        file.json[array] = value;
        file.fails(parts);
    };
    assert!(textured().read().is_ok());
    change("textures", json!([]), &["texture 0", "the file has 0"]);
    change("textures", json!([{ "source": 4 }]), &["image 4", "no such image"]);
    change("textures", json!([{ "source": 0, "sampler": 1 }]), &["texture 0", "no such sampler: 1"]);
    let mut file = textured();
    file.json["textures"] = json!([{ "source": 0, "sampler": 0 }]);
    file.json["samplers"] = json!([{ "wrapS": 1 }]);
    file.fails(&["texture 0", "wrap mode"]);
    change("images", json!([{}]), &["image 0", "found neither"]);
    change("images", json!([{ "bufferView": 9 }]), &["buffer view 9"]);
    change("images", json!([{ "uri": "data:;base64,AAAA" }]), &["image 0", "decoded"]);
    let whole = png(64, 64, [1; 4]);
    let cut = data_uri("image/png", &whole[..whole.len() / 2]);
    change("images", json!([{ "uri": cut }]), &["image 0", "decoded"]);
    let wide = data_uri("image/png", &png(16_385, 1, [1; 4]));
    change("images", json!([{ "uri": wide }]), &["image 0", "decoded"]);
}

#[test]
fn materials() {
    let material = |material: Value, parts: &[&str]| {
        let mut file = File::triangle();
        file.json["materials"] = json!([material]);
        file.primitive()["material"] = json!(0);
        file.fails(parts);
    };
    material(json!({ "alphaMode": "HOLES" }), &["material 0", "alphaMode"]);
    material(json!({ "name": "x", "emissiveFactor": [1e39, 0, 0] }), &["material 0 `x`", "emissive"]);
    material(
        json!({ "pbrMetallicRoughness": { "roughnessFactor": 1e39 } }),
        &["material 0", "roughnessFactor", "inf"],
    );
}

/// Changing any single byte of a file gives an error or a scene, never a panic.
#[test]
fn damaged_bytes_do_not_panic() {
    let mut file = File::triangle();
    let indices = file.accessor(5121, "SCALAR", 3, &[0, 1, 2]);
    file.primitive()["indices"] = json!(indices);
    let glb = file.glb();
    for i in 0..glb.len() {
        for value in [0, b'9', b'-', b'"', 0xff] {
            let mut damaged = glb.clone();
            damaged[i] = value;
            let _ = import(&damaged);
        }
    }
}
