//! Tests of the pose that a file rests in: skins, morph targets, instances.

use std::f32::consts::FRAC_1_SQRT_2 as HALF;

use glam::{Vec3, vec3};
use serde_json::{Value, json};

use super::{File, data_uri, png};
use crate::scene::{Scene, octahedral_decode, tangent_decode_exact};

fn near(found: Vec3, expected: Vec3) {
    assert!(found.distance(expected) < 1e-4, "{found} instead of {expected}");
}

fn corners(scene: &Scene, triangle: usize, expected: [Vec3; 3]) {
    for (found, expected) in scene.positions[triangle].into_iter().zip(expected) {
        near(found, expected);
    }
}

fn moved(by: Vec3) -> [Vec3; 3] {
    [Vec3::ZERO, Vec3::X, Vec3::Y].map(|corner| corner + by)
}

fn warned(scene: &Scene, part: &str) -> usize {
    scene.warnings.iter().filter(|w| w.contains(part)).count()
}

/// The triangle with a skin of as many joints as `nodes`; every vertex has joints 0 to 3 with `weights`.
fn skinned(nodes: Value, weights: [f32; 4]) -> File {
    let mut file = File::triangle();
    let joints = file.accessor(5121, "VEC4", 3, &[0, 1, 2, 3].repeat(3));
    let weights = file.floats("VEC4", &weights.repeat(3));
    file.attribute("JOINTS_0", joints);
    file.attribute("WEIGHTS_0", weights);
    let count = nodes.as_array().unwrap().len();
    file.json["skins"] = json!([{ "joints": (1..=count).collect::<Vec<_>>() }]);
    file.json["scenes"] = json!([{ "nodes": (0..=count).collect::<Vec<_>>() }]);
    file.json["nodes"] = json!([{ "name": "n", "mesh": 0, "skin": 0, "scale": [5, 5, 5] }]);
    file.json["nodes"].as_array_mut().unwrap().extend(nodes.as_array().unwrap().iter().cloned());
    file
}

/// Column-major matrix of a translation.
fn translation(by: [f32; 3]) -> [f32; 16] {
    let [x, y, z] = by;
    [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, x, y, z, 1.0]
}

#[test]
fn joints_place_a_skin_and_its_own_node_does_not() {
    let file = skinned(json!([{ "translation": [3, 2, 0] }]), [1.0, 0.0, 0.0, 0.0]);
    let scene = file.scene();
    corners(&scene, 0, moved(vec3(3.0, 2.0, 0.0)));
    assert_eq!(warned(&scene, "weights"), 0, "{:?}", scene.warnings);
}

#[test]
fn inverse_bind_matrices_come_before_the_joints() {
    let mut file = skinned(json!([{ "translation": [3, 2, 0], "scale": [2, 2, 2] }]), [1.0, 0.0, 0.0, 0.0]);
    let bind = file.accessor(5126, "MAT4", 1, bytemuck::cast_slice(&translation([1.0, 0.0, 0.0])));
    file.json["skins"][0]["inverseBindMatrices"] = json!(bind);
    let at = |x, y| vec3(x, y, 0.0);
    corners(&file.scene(), 0, [at(5.0, 2.0), at(7.0, 2.0), at(5.0, 4.0)]);
}

#[test]
fn weights_are_normalised_and_told_where_they_do_not_sum_to_one() {
    let joints = json!([{ "translation": [4, 0, 0] }, { "translation": [0, 0, 8] }]);
    let scene = skinned(joints.clone(), [0.75, 0.25, 0.0, 0.0]).scene();
    corners(&scene, 0, moved(vec3(3.0, 0.0, 2.0)));
    assert_eq!(warned(&scene, "do not sum to 1"), 0);
    let scene = skinned(joints.clone(), [1.5, 0.5, 0.0, 0.0]).scene();
    corners(&scene, 0, moved(vec3(3.0, 0.0, 2.0)));
    assert_eq!(
        warned(&scene, "1 objects have joints' weights that do not sum to 1"),
        1,
        "{:?}",
        scene.warnings
    );
    // Without any weight the first joint counts.
    corners(&skinned(joints, [0.0; 4]).scene(), 0, moved(vec3(4.0, 0.0, 0.0)));
}

#[test]
fn every_set_of_joints_counts() {
    let mut file = skinned(
        json!([{ "translation": [8, 0, 0] }, {}, {}, {}, { "translation": [0, 8, 0] }]),
        [0.25, 0.25, 0.0, 0.0],
    );
    let bytes: Vec<u8> = [4_u16, 0, 0, 0].repeat(3).into_iter().flat_map(u16::to_le_bytes).collect();
    let joints = file.accessor(5123, "VEC4", 3, &bytes);
    // Normalised bytes, as KHR_mesh_quantization and the core specification have them.
    let weights = file.accessor(5121, "VEC4", 3, &[128, 0, 0, 0].repeat(3));
    file.json["accessors"][weights]["normalized"] = json!(true);
    file.attribute("JOINTS_1", joints);
    file.attribute("WEIGHTS_1", weights);
    let sum = 0.5 + 128.0 / 255.0;
    corners(&file.scene(), 0, moved(vec3(2.0 / sum, 8.0 * (128.0 / 255.0) / sum, 0.0)));
}

#[test]
fn joints_turn_normals_and_mirror_faces() {
    let mut file = skinned(json!([{ "rotation": [HALF, 0, 0, HALF] }]), [1.0, 0.0, 0.0, 0.0]);
    let normals = file.floats("VEC3", &[0.6, 0.0, 0.8].repeat(3));
    file.attribute("NORMAL", normals);
    let scene = file.scene();
    near(octahedral_decode(scene.normals[0][0]), vec3(0.6, -0.8, 0.0));
    file.json["nodes"][1] = json!({ "scale": [-1, 1, 1] });
    let scene = file.scene();
    let [a, b, c] = scene.positions[0];
    near((b - a).cross(c - a), Vec3::Z);
    near(octahedral_decode(scene.normals[0][0]), vec3(-0.6, 0.0, 0.8));
}

#[test]
fn bad_skins_are_told() {
    let one = || skinned(json!([{ "translation": [3, 2, 0] }]), [0.5, 0.5, 0.0, 0.0]);
    one().fails(&["mesh 0 primitive 0, JOINTS_0: element 0: expected one of 1 joints, found 1"]);
    let mut file = one();
    file.json["nodes"][0]["skin"] = json!(7);
    file.fails(&["skin 7: no such skin; the file has 1"]);
    let joints = json!([{}, { "translation": [3, 2, 0] }]);
    let mut file = skinned(joints.clone(), [0.5, 0.5, 0.0, 0.0]);
    let bind = file.accessor(5126, "MAT4", 1, bytemuck::cast_slice(&translation([0.0; 3])));
    file.json["skins"][0]["inverseBindMatrices"] = json!(bind);
    file.fails(&["skin 0, inverseBindMatrices: expected one for each of 2 joints, found 1"]);
    let mut file = skinned(json!([{}]), [1.0, 0.0, 0.0, 0.0]);
    let bind = file.accessor(5126, "MAT4", 1, bytemuck::cast_slice(&[f32::NAN; 16]));
    file.json["skins"][0]["inverseBindMatrices"] = json!(bind);
    file.fails(&["inverseBindMatrices: element 0: expected finite numbers"]);
    skinned(joints.clone(), [0.5, -0.5, 0.0, 0.0]).fails(&["WEIGHTS_0: element 0: expected finite numbers"]);
    skinned(joints.clone(), [0.5, f32::NAN, 0.0, 0.0]).fails(&["WEIGHTS_0: element 0"]);

    let mut file = skinned(joints, [0.5, 0.5, 0.0, 0.0]);
    file.json["scenes"] = json!([{ "nodes": [0, 1] }]);
    let scene = file.scene();
    assert_eq!(warned(&scene, "skin 0: node 2 of its joints is not in the scene"), 1, "{:?}", scene.warnings);
    corners(&scene, 0, [Vec3::ZERO, 5.0 * Vec3::X, 5.0 * Vec3::Y]);

    let mut file = File::triangle();
    file.json["nodes"][0]["skin"] = json!(0);
    file.json["skins"] = json!([{ "joints": [0] }]);
    let scene = file.scene();
    assert_eq!(warned(&scene, "1 objects without JOINTS_0 stay with their node"), 1, "{:?}", scene.warnings);
}

/// The triangle with two morph targets: one moves the vertices up, a sparse one only the last of them.
fn morphed() -> File {
    let mut file = File::triangle();
    let up = file.floats("VEC3", &[0.0, 0.0, 2.0].repeat(3));
    let (indices, values) = (file.view(&[2]), file.view(bytemuck::cast_slice(&[0.0_f32, 4.0, 0.0])));
    let sparse = file.push(
        "accessors",
        json!({
            "componentType": 5126, "type": "VEC3", "count": 3,
            "sparse": {
                "count": 1,
                "indices": { "bufferView": indices, "componentType": 5121 },
                "values": { "bufferView": values },
            },
        }),
    );
    file.primitive()["targets"] = json!([{ "POSITION": up }, { "POSITION": sparse }]);
    file
}

#[test]
fn morph_targets_apply_by_the_weights_of_the_mesh_or_of_the_node() {
    let mut file = morphed();
    corners(&file.scene(), 0, moved(Vec3::ZERO));
    file.json["meshes"][0]["weights"] = json!([0.5, 0.25]);
    corners(&file.scene(), 0, [Vec3::Z, vec3(1.0, 0.0, 1.0), vec3(0.0, 2.0, 1.0)]);
    file.json["nodes"][0]["weights"] = json!([0, -1]);
    corners(&file.scene(), 0, [Vec3::ZERO, Vec3::X, -3.0 * Vec3::Y]);
}

#[test]
fn morph_targets_come_before_the_node_and_the_joints() {
    let mut file = morphed();
    file.json["meshes"][0]["weights"] = json!([0.5, 0]);
    file.json["nodes"][0]["scale"] = json!([1, 1, 3]);
    corners(&file.scene(), 0, moved(vec3(0.0, 0.0, 3.0)));
    let mut file = skinned(json!([{ "scale": [2, 2, 2] }]), [1.0, 0.0, 0.0, 0.0]);
    let up = file.floats("VEC3", &[0.0, 0.0, 2.0].repeat(3));
    file.primitive()["targets"] = json!([{ "POSITION": up }]);
    file.json["meshes"][0]["weights"] = json!([1]);
    corners(&file.scene(), 0, [4.0 * Vec3::Z, vec3(2.0, 0.0, 4.0), vec3(0.0, 2.0, 4.0)]);
}

#[test]
fn morph_targets_turn_normals() {
    let mut file = morphed();
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
    file.attribute("NORMAL", normals);
    let turned = file.floats("VEC3", &[1.0, 0.0, 0.0].repeat(3));
    file.primitive()["targets"][0]["NORMAL"] = json!(turned);
    file.json["meshes"][0]["weights"] = json!([1, 0]);
    near(octahedral_decode(file.scene().normals[0][1]), vec3(HALF, 0.0, HALF));
}

#[test]
fn bad_morph_targets_are_told_where_they_are_used() {
    let mut file = morphed();
    let short = file.floats("VEC3", &[0.0; 3]);
    file.primitive()["targets"][1]["POSITION"] = json!(short);
    file.json["meshes"][0]["weights"] = json!([1, 0]);
    corners(&file.scene(), 0, moved(2.0 * Vec3::Z));
    file.json["meshes"][0]["weights"] = json!([0, 1]);
    file.fails(&["mesh 0 primitive 0, POSITION of target 1", "expected 3 elements as POSITION has, found 1"]);
    let mut file = morphed();
    file.json["nodes"][0]["weights"] = json!([1e39]);
    file.fails(&["node 0", "finite"]);
}

#[test]
fn instances_have_transforms_of_their_own() {
    let mut file = File::triangle();
    let translations = file.floats("VEC3", &[0.0, 0.0, 0.0, 3.0, 0.0, 0.0]);
    let rotations = file.accessor(5120, "VEC4", 2, &[0, 0, 0, 127, 0, 0, 90, 90]);
    file.json["accessors"][rotations]["normalized"] = json!(true);
    let scales = file.floats("VEC3", &[1.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
    let attributes = json!({ "TRANSLATION": translations, "ROTATION": rotations, "SCALE": scales });
    file.json["nodes"][0]["extensions"] = json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
    file.json["nodes"][0]["translation"] = json!([0, 0, 7]);
    file.json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    let scene = file.scene();
    assert_eq!((scene.positions.len(), scene.objects.len()), (2, 2));
    corners(&scene, 0, moved(7.0 * Vec3::Z));
    corners(&scene, 1, [vec3(3.0, 0.0, 7.0), vec3(3.0, 2.0, 7.0), vec3(1.0, 0.0, 7.0)]);

    let three = file.floats("VEC3", &[0.0; 9]);
    let attributes = &mut file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes["SCALE"] = json!(three);
    file.fails(&[
        "node 0, EXT_mesh_gpu_instancing, SCALE",
        "expected 2 elements as the other attributes, found 3",
    ]);
}

#[test]
fn bad_instances_are_told() {
    let instanced = |attributes: Value| {
        let mut file = File::triangle();
        file.floats("VEC4", &[0.0; 4]);
        file.json["nodes"][0]["extensions"] =
            json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
        file
    };
    instanced(json!({})).fails(&["node 0, EXT_mesh_gpu_instancing", "expected TRANSLATION"]);
    instanced(json!({ "_ID": 0 })).fails(&["found none of them"]);
    instanced(json!({ "TRANSLATION": -1 })).fails(&["TRANSLATION: expected an accessor's index, found -1"]);
    instanced(json!({ "ROTATION": 0 })).fails(&["ROTATION (accessor 0): expected [Vec4], found Vec3"]);
    instanced(json!({ "ROTATION": 1 })).fails(&["instance 0: expected a finite transform"]);
}

#[test]
fn what_deforms_is_limited_before_it_is_computed() {
    let mut file = File::triangle();
    let zeros = file.push("accessors", json!({ "componentType": 5126, "type": "VEC3", "count": 1 << 20,
        "sparse": { "count": 1, "indices": { "bufferView": 0, "componentType": 5121 }, "values": { "bufferView": 0 } } }));
    file.attribute("POSITION", zeros);
    let target = json!({ "POSITION": zeros });
    file.primitive()["targets"] = json!(vec![target; 300]);
    file.json["meshes"][0]["weights"] = json!(vec![1.0; 300]);
    file.fails(&["expected at most 268435456 vertices to morph and to skin"]);
    file.json["meshes"][0]["weights"] = json!([]);
    file.json["nodes"][0]["extensions"] =
        json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": zeros } } });
    file.fails(&["expected at most 59652323 triangles, instances counted each"]);
}

#[test]
fn tangents_follow_morph_targets_and_joints() {
    let mut file = skinned(json!([{ "rotation": [0, 0, HALF, HALF] }]), [1.0, 0.0, 0.0, 0.0]);
    file.json["materials"] = json!([{ "normalTexture": { "index": 0 } }]);
    file.primitive()["material"] = json!(0);
    file.json["textures"] = json!([{ "source": 0 }]);
    file.json["images"] = json!([{ "uri": data_uri("image/png", &png(1, 1, [127, 127, 255, 255])) }]);
    let texcoords = file.floats("VEC2", &[0.0; 6]);
    file.attribute("TEXCOORD_0", texcoords);
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
    file.attribute("NORMAL", normals);
    let tangents = file.floats("VEC4", &[1.0, 0.0, 0.0, -1.0].repeat(3));
    file.attribute("TANGENT", tangents);
    let turned = file.floats("VEC3", &[0.0, 1.0, 0.0].repeat(3));
    file.primitive()["targets"] = json!([{ "TANGENT": turned }]);
    let frame = |file: &File| {
        let (tangent, sign) = tangent_decode_exact(file.scene().tangents[0][0]);
        (tangent.as_vec3(), sign)
    };
    let is = |(tangent, sign): (Vec3, f64), expected: Vec3, expected_sign: f64| {
        assert!(tangent.distance(expected) < 2e-4 && sign == expected_sign, "{tangent} {sign}");
    };
    is(frame(&file), Vec3::Y, -1.0);
    file.json["meshes"][0]["weights"] = json!([1]);
    is(frame(&file), vec3(-HALF, HALF, 0.0), -1.0);
    file.json["nodes"][1] = json!({ "scale": [1, -1, 1] });
    is(frame(&file), vec3(HALF, -HALF, 0.0), 1.0);
}
