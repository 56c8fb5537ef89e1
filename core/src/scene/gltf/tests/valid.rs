//! Files that are valid, or nearly so, though unusual: each is read, and what was mended is told.

use glam::{DVec3, Vec3};
use serde_json::{Value, json};

use super::{File, data_uri, fails, import, png};
use crate::Camera;
use crate::scene::octahedral_decode;

#[test]
fn numbers_of_the_form_4_0_are_integers() {
    let file = File::triangle();
    let text = String::from_utf8(file.gltf()).unwrap();
    let text = text.replace(r#""count":3"#, r#""count":3.0"#).replace("5126", "5.126e3");
    assert!(text.contains("3.0") && text.contains("e3"), "{text}");
    assert_eq!(import(text.as_bytes()).unwrap().positions, file.scene().positions);
    fails(text.replace("3.0", "3.5").as_bytes(), &["accessors[0]", "3.5"]);
}

#[test]
fn a_chunk_may_lack_its_padding() {
    let mut file = File::triangle();
    for name in ["m", "mm", "mmm", "mmmm"] {
        file.json["meshes"][0]["name"] = json!(name);
        let padded = file.glb();
        let length = u32::from_le_bytes(padded[12..16].try_into().unwrap()) as usize;
        let text = padded[20..20 + length].trim_ascii_end();
        let mut glb = [&padded[..20], text, &padded[20 + length..]].concat();
        glb[12..16].copy_from_slice(&(text.len() as u32).to_le_bytes());
        let whole = glb.len() as u32;
        glb[8..12].copy_from_slice(&whole.to_le_bytes());
        assert_eq!(import(&glb).unwrap().positions, file.scene().positions, "{} bytes", text.len());
    }
}

#[test]
fn data_uris_are_those_of_rfc_2397() {
    let plain = File::triangle();
    let bytes: Vec<u8> = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(f32::to_le_bytes).concat();
    let codes: String = bytes.iter().map(|byte| format!("%{byte:02x}")).collect();
    let base64 = data_uri("", &bytes);
    let (_, base64) = base64.split_once(',').unwrap();
    let coded = base64.replace('A', "%41").replace('/', "%2F").replace('=', "%3D");
    let wrapped = format!("{}\n {}", &base64[..20], &base64[20..]);
    for uri in [
        format!("data:,{codes}"),
        format!("data:application/octet-stream,{codes}"),
        format!("DATA:application/gltf-buffer;BASE64,{base64}"),
        format!("Data:;charset=utf-8;base64,{}", base64.trim_end_matches('=')),
        format!("data:;base64,{coded}"),
        format!("data:;base64,{wrapped}"),
    ] {
        let mut file = File::triangle();
        file.json["buffers"] = json!([{ "byteLength": 36, "uri": uri }]);
        assert_eq!(file.scene().positions, plain.scene().positions, "{uri}");
    }
    let mut file = File::triangle();
    file.json["buffers"] =
        json!([{ "byteLength": 36, "uri": format!("DATA:;base64,{}", "secret!".repeat(30)) }]);
    let error = file.read().unwrap_err().to_string();
    assert!(error.contains("buffer 0") && !error.contains("secret"), "{error}");
}

#[test]
fn an_accessor_without_a_buffer_view_holds_zeros() {
    let mut file = File::triangle();
    file.json["accessors"].as_array_mut().unwrap().extend([
        json!({ "componentType": 5126, "type": "VEC3", "count": 3 }),
        json!({ "componentType": 5126, "type": "VEC2", "count": 3 }),
    ]);
    file.attribute("COLOR_0", 1);
    file.attribute("TEXCOORD_0", 2);
    let black = [0, 0, 0, u16::MAX];
    assert_eq!(file.scene().colors, [[black; 3]]);
}

#[test]
fn a_normal_that_is_not_finite_is_the_faces() {
    let mut file = File::triangle();
    let normals = file.floats("VEC3", &[1.0, 0.0, 0.0, f32::NAN, 0.0, 0.0, 1.0, 0.0, f32::INFINITY]);
    file.attribute("NORMAL", normals);
    let scene = file.scene();
    let found = scene.normals[0].map(octahedral_decode);
    assert_eq!(found, [Vec3::X, Vec3::Z, Vec3::Z]);
    let told = "mesh 0 primitive 0: 2 of its normals have no direction, the faces' count";
    assert!(scene.warnings.contains(&told.to_owned()), "{:?}", scene.warnings);
}

#[test]
fn a_missing_image_leaves_the_factor_and_no_light() {
    let mut file = File::triangle();
    file.json["materials"] = json!([{
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "baseColorFactor": [0.5, 0.25, 0, 1] },
        "emissiveTexture": { "index": 0 }, "emissiveFactor": [1, 1, 1],
    }]);
    file.primitive()["material"] = json!(0);
    file.json["textures"] = json!([{ "source": 0 }]);
    file.json["images"] = json!([{ "uri": "gone%20away.png" }]);
    let scene = file.scene();
    let material = &scene.materials[0];
    assert_eq!((material.base_color, material.base_color_texture), (Vec3::new(0.5, 0.25, 0.0), None));
    assert_eq!((material.emission, material.emissive_texture), (Vec3::ZERO, None));
    let told =
        scene.warnings.iter().filter(|w| w.contains("image 0") && w.contains("gone%20away.png")).count();
    assert_eq!(told, 1, "{:?}", scene.warnings);
    file.json["images"] = json!([{ "uri": data_uri("image/png", &png(1, 1, [9; 4])) }]);
    assert_eq!(file.scene().images.len(), 1);
}

#[test]
fn the_32_lights_that_matter_are_kept() {
    let mut file = File::triangle();
    file.json["extensions"]["KHR_lights_punctual"]["lights"] =
        json!([{ "type": "point", "intensity": 9 }, { "type": "point", "intensity": 0.5 }]);
    let node =
        |i: usize| json!({ "extensions": { "KHR_lights_punctual": { "light": usize::from(i == 5) } } });
    let mut nodes = vec![json!({ "mesh": 0, "children": (1..=33).collect::<Vec<_>>() })];
    nodes.extend((0..33).map(node));
    file.json["nodes"] = json!(nodes);
    let scene = file.scene();
    assert_eq!(scene.lights.len(), 32);
    assert!(scene.lights.iter().all(|light| light.intensity == Vec3::splat(9.0)));
    assert!(scene.warnings.iter().any(|w| w.starts_with("33 lights: the 32")), "{:?}", scene.warnings);
}

#[test]
fn names_that_are_not_utf_8_are_replaced_and_told() {
    let mut file = File::triangle();
    file.json["nodes"][0]["name"] = json!("cafe_");
    let mut text = file.gltf();
    let at = text.windows(5).position(|w| w == b"cafe_").unwrap();
    text[at + 4] = 0xe9;
    let scene = import(&text).unwrap();
    assert_eq!(scene.objects[0].name, "caf\u{e9}/m[0]".replace('\u{e9}', "e\u{fffd}"));
    assert!(scene.warnings[0].contains("UTF-8"), "{:?}", scene.warnings);
}

#[test]
fn what_a_file_is_instead_is_said() {
    let lfs = b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n";
    fails(lfs, &["expected glTF 2.0", "Git LFS pointer", "git lfs pull"]);
    fails(b"<!DOCTYPE html><html>", &["web page"]);
    fails(b"PK\x03\x04\x14\0", &["ZIP archive"]);
    fails(b"Kaydara FBX Binary  \0", &["FBX"]);
    fails(br#"{"asset": {"version": "2.0"},}"#, &["JSON that is not valid", "line 1"]);
    fails(br#"{"materials": {}, "techniques": {}}"#, &["glTF 1.0"]);
    fails(b"glTF\x01\0\0\0\x20\0\0\0", &["expected version 2, found 1", "glTF 1.0"]);
    let mut file = File::triangle();
    for (version, fits) in [("2.0", true), ("1.9", true), ("2.1", false), ("3.0", false), ("x", false)] {
        file.json["asset"]["minVersion"] = json!(version);
        match file.read() {
            Ok(_) => assert!(fits, "{version}"),
            Err(error) => assert!(!fits && error.to_string().contains("asset.minVersion"), "{error}"),
        }
    }
    let nothing = |change: fn(&mut Value), parts: &[&str]| {
        let mut file = File::triangle();
        change(&mut file.json);
        file.fails(parts);
    };
    nothing(|json| json["scenes"] = json!([{ "name": "empty" }]), &["holds no triangles", "it is empty"]);
    nothing(|json| json["nodes"] = json!([{}]), &["none of its nodes has a mesh"]);
}

/// A pyramid at `position` below a node with a translation, a point light and a camera.
fn pyramid(position: [f64; 3]) -> File {
    let mut file = File::empty();
    let corners = [[0.0, 1.0, 0.0], [-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 0.0, -1.0_f32]];
    let positions = file.floats("VEC3", corners.as_flattened());
    let indices = file.accessor(5121, "SCALAR", 12, &[0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2]);
    file.json["meshes"] =
        json!([{ "primitives": [{ "attributes": { "POSITION": positions }, "indices": indices }] }]);
    file.json["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 1, "znear": 1 } }]);
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = json!([{ "type": "point" }]);
    file.json["nodes"] = json!([
        { "translation": position, "children": [1, 2, 3] },
        { "mesh": 0 },
        { "translation": [0, 0.5, 4], "camera": 0 },
        { "translation": [1, 3, 2], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
    ]);
    file
}

#[test]
fn a_scene_far_from_the_origin_is_as_exact_as_at_the_origin() {
    let near = pyramid([0.0; 3]).scene();
    assert_eq!(near.origin, DVec3::ZERO);
    for position in [[6_378_137.0, 0.0, 0.0], [-1e5, 3e6, 128.0]] {
        let mut file = pyramid(position);
        for stated in [false, true] {
            if stated {
                file.json["accessors"][0]["min"] = json!([-1, 0, -1]);
                file.json["accessors"][0]["max"] = json!([1, 1, 1.0]);
            }
            let far = file.scene();
            let moved = (far.origin - DVec3::from(position)).as_vec3();
            assert!(far.origin != DVec3::ZERO && moved.length() < 8.0, "{}", far.origin);
            for (near, far) in near.positions.as_flattened().iter().zip(far.positions.as_flattened()) {
                assert_eq!(*near, *far + moved);
            }
            assert_eq!(
                near.cameras[0].1,
                Camera { origin: far.cameras[0].1.origin + moved, ..far.cameras[0].1 }
            );
            let position = |scene: &crate::Scene| match scene.lights[0].kind {
                crate::scene::LightKind::Point { position, .. } => position,
                _ => Vec3::NAN,
            };
            assert_eq!(position(&near), position(&far) + moved);
            let eye = far.in_file(far.cameras[0].1.origin);
            assert_eq!(
                eye,
                DVec3::from(
                    file.json["nodes"][0]["translation"]
                        .as_array()
                        .map_or([0.0; 3], |t| { [0, 1, 2].map(|i| t[i].as_f64().unwrap()) })
                ) + DVec3::new(0.0, 0.5, 4.0)
            );
        }
    }
    let beside = pyramid([10.0, 0.0, 0.0]).scene();
    assert_eq!(beside.origin, DVec3::ZERO, "near enough: the scene stays as it is");
}

/// Bounds that the file states wrongly do not move the scene away.
#[test]
fn stated_bounds_are_not_trusted_blindly() {
    let mut file = pyramid([0.0; 3]);
    file.json["accessors"][0]["min"] = json!([1e7, 1e7, 1e7]);
    file.json["accessors"][0]["max"] = json!([1.1e7, 1.1e7, 1.1e7]);
    assert_eq!(file.scene().origin, DVec3::ZERO);
}

#[test]
fn the_default_camera_looks_at_the_front_and_frames_it() {
    let mut file = pyramid([5.0, 1.0, 2.0]);
    file.json.as_object_mut().unwrap().remove("cameras");
    file.json["nodes"][2].as_object_mut().unwrap().remove("camera");
    let scene = file.scene();
    let (low, high) = scene.bounds().unwrap();
    let camera = scene.cameras[0].1;
    let middle = 0.5 * (low + high);
    assert!(camera.origin.z > high.z && (camera.origin.x - middle.x).abs() < 1e-5, "{camera:?}");
    assert!(camera.right.normalize().distance(Vec3::X) < 1e-6);
    for corner in scene.positions.as_flattened() {
        let seen = *corner - camera.origin;
        let depth = seen.dot(camera.forward);
        let on = |axis: Vec3| seen.dot(axis) / axis.length_squared() / depth;
        assert!(on(camera.right).abs() < 1.0 && on(camera.up).abs() < 1.0, "{corner}");
    }
}
