//! Numbers at the limits of f32: each is an error that names it, or becomes a number that shaders can use.

use glam::{Vec3, vec3};
use serde_json::{Value, json};

use super::File;
use crate::scene::{LightKind, MAX_IOR, octahedral_decode};

fn with_positions(corners: &[f32; 9]) -> File {
    let mut file = File::triangle();
    let positions = file.floats("VEC3", corners);
    file.attribute("POSITION", positions);
    file
}

fn with_material(material: Value) -> File {
    let mut file = File::triangle();
    file.json["materials"] = json!([material]);
    file.primitive()["material"] = json!(0);
    file
}

#[test]
fn subnormal_coordinates_are_zero() {
    let scene = with_positions(&[1.0e-40, 0.0, -1.0e-45, 1.0, 0.0, 0.0, 0.0, 1.0, 2.0e-38]).scene();
    assert_eq!(scene.positions[0], [Vec3::ZERO, Vec3::X, vec3(0.0, 1.0, 2.0e-38)]);
    // The node's scale makes the coordinates subnormal.
    let mut file = with_positions(&[1.0e-30, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    file.json["nodes"][0]["scale"] = json!([1e-10, 1, 1]);
    assert_eq!(file.scene().positions[0][0], Vec3::ZERO);
}

#[test]
fn tubes_of_tiny_lines_have_no_subnormal_coordinates() {
    // The last is of a direction whose orthonormal pair has a component of 1e-21, times a radius of 3e-20.
    for end in [[1.0e-30, 0.0, 0.0], [1.0e-37, 1.0e-37, 0.0], [1.0e-17, 1.2e-38, 0.0]] {
        let mut file = with_positions(&[0.0, 0.0, 0.0, end[0], end[1], end[2], 0.0, 0.0, 0.0]);
        file.primitive()["mode"] = json!(1);
        let scene = file.scene();
        assert_eq!(scene.positions.len(), 12, "{end:?}");
        let coordinates = scene.positions.iter().flatten().flat_map(|corner| corner.to_array());
        coordinates.for_each(|coordinate| assert!(!coordinate.is_subnormal(), "{end:?}: {coordinate:e}"));
        assert!(scene.spheres.iter().all(|sphere| sphere.radius.is_normal()));
    }
}

#[test]
fn a_scene_of_nothing_but_triangles_without_area_is_an_error() {
    let no_area = &["file", "the scene holds no triangles that have an area"];
    with_positions(&[0.0; 9]).fails(no_area);
    with_positions(&[0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0]).fails(no_area);
    with_positions(&[0.0, 0.0, 0.0, 1.0e-40, 0.0, 0.0, 0.0, 1.0e-40, 0.0]).fails(no_area);
}

#[test]
fn scales_that_cancel_are_no_problem() {
    let mut file = File::triangle();
    file.json["nodes"] = json!([
        { "scale": [1e30, 1e30, 1e30], "children": [1] },
        { "scale": [1e-30, 1e-30, 1e-30], "mesh": 0 },
    ]);
    let scene = file.scene();
    assert!(
        scene.positions[0][1].distance(Vec3::X) < 1e-6 && octahedral_decode(scene.normals[0][0]) == Vec3::Z
    );
}

#[test]
fn two_mirrors_make_none() {
    let mut file = File::triangle();
    file.json["nodes"] = json!([
        { "scale": [-1, 1, 1], "children": [1] },
        { "scale": [1, -1, 1], "mesh": 0 },
    ]);
    let [a, b, c] = file.scene().positions[0];
    assert_eq!((b - a).cross(c - a), Vec3::Z);
}

#[test]
fn normals_of_any_length() {
    let mut file = File::triangle();
    let normals = file.floats("VEC3", &[0.0, 3.0e38, 0.0, 0.0, 1.0e-45, 0.0, -0.0, 0.0, 0.0]);
    file.attribute("NORMAL", normals);
    let found = file.scene().normals[0].map(octahedral_decode);
    assert_eq!(found, [Vec3::Y, Vec3::Y, Vec3::Z], "the face's where there is none");
}

#[test]
fn texture_coordinates_are_finite() {
    for bad in [f32::NAN, f32::INFINITY, 2.0e18] {
        let mut file =
            with_material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }));
        let texcoords = file.floats("VEC2", &[0.0, 0.0, 1.0, 1.0e-40, 0.0, bad]);
        file.attribute("TEXCOORD_0", texcoords);
        file.json["textures"] = json!([{ "source": 0 }]);
        file.json["images"] = json!([{ "uri": super::data_uri("image/png", &super::png(1, 1, [0; 4])) }]);
        file.fails(&["mesh 0 primitive 0, TEXCOORD_0", "element 2", "1e18"]);
        let fine = file.floats("VEC2", &[0.0, 0.0, 1.0, 1.0e-40, 0.0, 1.0e17]);
        file.attribute("TEXCOORD_0", fine);
        assert_eq!(file.scene().texcoords[0][1].to_array(), [1.0, 0.0]);
    }
}

#[test]
fn matrices_are_affine() {
    let mut file = File::triangle();
    file.json["nodes"][0]["matrix"] = json!([1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1]);
    file.fails(&["node 0", "last row is 0, 0, 0, 1"]);
    file.json["nodes"][0]["matrix"] = json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 0]);
    file.fails(&["node 0", "last row is 0, 0, 0, 1"]);
    // A singular matrix that does not flatten the triangle is accepted.
    file.json["nodes"][0]["matrix"] = json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 5, 1]);
    assert_eq!(file.scene().positions[0][0], vec3(0.0, 0.0, 5.0));
}

fn with_camera(camera: Value, node: Value) -> File {
    let mut file = File::triangle();
    file.json["cameras"] = json!([camera]);
    file.json["nodes"] = json!([{ "mesh": 0, "children": [1] }, node]);
    file.json["nodes"][1]["camera"] = json!(0);
    file
}

#[test]
fn cameras() {
    let perspective =
        |yfov: f64| json!({ "type": "perspective", "perspective": { "yfov": yfov, "znear": 1 } });
    for yfov in [0.0, -1.0, std::f64::consts::PI, 4.0, 1e39] {
        with_camera(perspective(yfov), json!({})).fails(&["camera 0", "vertical field of view", "found"]);
    }
    with_camera(perspective(1e-30), json!({})).fails(&["camera `camera0`", "axes of a length"]);
    for yfov in [1e-6, 3.1] {
        assert!(with_camera(perspective(yfov), json!({})).scene().cameras[0].1.up.y > 0.0);
    }
    let orthographic = |ymag: f64| json!({ "type": "orthographic", "orthographic": { "xmag": 1, "ymag": ymag, "znear": 0, "zfar": 1 } });
    for ymag in [0.0, -1.0, 1e39] {
        with_camera(orthographic(ymag), json!({})).fails(&["camera 0", "orthographic height"]);
    }
    with_camera(orthographic(1e30), json!({})).fails(&["camera `camera0`", "axes of a length"]);
    // Properties that the renderer does not use are not checked: the frame has its own aspect ratio, and rays
    // have no far plane.
    let odd = json!({ "yfov": 1, "znear": -7, "zfar": -9, "aspectRatio": 0 });
    with_camera(json!({ "type": "perspective", "perspective": odd }), json!({})).scene();
}

#[test]
fn cameras_on_nodes_of_any_scale() {
    let lens = json!({ "type": "perspective", "perspective": { "yfov": 1, "znear": 1 } });
    for scale in [1e-30, 1e30] {
        let node = json!({ "scale": [scale, scale, scale] });
        let camera = with_camera(lens.clone(), node).scene().cameras[0].1;
        assert_eq!(camera.forward, -Vec3::Z);
    }
    with_camera(lens.clone(), json!({ "scale": [1, 0, 1] })).fails(&["camera 0", "singular"]);
    let sheared = json!({ "matrix": [1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] });
    with_camera(lens.clone(), sheared).fails(&["camera `camera0`", "span a frame"]);
    let far = json!({ "translation": [0, 1e19, 0] });
    with_camera(lens, far).fails(&["camera `camera0`", "finite position"]);
}

#[test]
fn lights() {
    let with_light = |light: Value| {
        let mut file = File::triangle();
        file.json["extensions"]["KHR_lights_punctual"]["lights"] = json!([light]);
        file.json["nodes"][0]["extensions"] = json!({ "KHR_lights_punctual": { "light": 0 } });
        file
    };
    let intensity = &["light 0 of node 0", "an intensity from 0 to 1e30"];
    with_light(json!({ "type": "point", "intensity": 2e30 })).fails(intensity);
    with_light(json!({ "type": "point", "intensity": 1e39 })).fails(intensity);
    with_light(json!({ "type": "point", "color": [1, -1, 1] })).fails(intensity);
    with_light(json!({ "type": "point", "color": [0, 1, 1], "intensity": 1e39 })).fails(intensity);
    with_light(json!({ "type": "point", "range": 1e-10 })).fails(&["light 0", "at least 1e-9"]);
    let faint = with_light(json!({ "type": "point", "intensity": 1e-40, "range": 1e39 })).scene();
    assert_eq!(faint.lights[0].intensity, Vec3::ZERO);
    assert!(matches!(faint.lights[0].kind, LightKind::Point { range: f32::INFINITY, .. }));
    assert_eq!(
        with_light(json!({ "type": "point", "intensity": 1e30 })).scene().lights[0].intensity.x,
        1.0e30
    );
    let mut far = with_light(json!({ "type": "point" }));
    far.json["nodes"][0]["translation"] = json!([0, 0, 2e18]);
    far.fails(&["1e18"]);
    let mut flat = with_light(json!({ "type": "directional" }));
    flat.json["nodes"][0]["scale"] = json!([1, 1, 0]);
    flat.fails(&["light 0", "no direction"]);
}

#[test]
fn radiances() {
    let strength = |strength: f64| {
        with_material(json!({
            "emissiveFactor": [1, 0, 0],
            "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": strength } },
        }))
    };
    strength(2e30).fails(&["material 0", "emissiveFactor x emissiveStrength", "1e30", "found 2"]);
    assert_eq!(strength(1e30).scene().materials[0].emission.x, 1.0e30);
    let mut file = File::triangle();
    for bad in [json!([2e30, 0, 0]), json!([-1, 0, 0]), json!([1e39, 0, 0])] {
        file.json["scenes"][0]["extras"] = json!({ "background": bad });
        file.fails(&["extras.background", "from 0 to 1e30"]);
    }
}

#[test]
fn indices_of_refraction() {
    let with_ior = |ior: f64| with_material(json!({ "extensions": { "KHR_materials_ior": { "ior": ior } } }));
    for (ior, expected) in [(0.0, MAX_IOR), (1.0, 1.0), (1.5, 1.5), (1e4, MAX_IOR)] {
        assert_eq!(with_ior(ior).scene().materials[0].ior, expected, "{ior}");
    }
    for bad in [-1.0, 1e-40, 0.5, 1.1e4, 1e39] {
        with_ior(bad).fails(&["material 0", "ior: expected 0 or a number from 1"]);
    }
}

#[test]
fn factors_outside_their_range_are_said() {
    let material = json!({ "pbrMetallicRoughness": { "metallicFactor": 1.5, "roughnessFactor": -0.5 } });
    let scene = with_material(material).scene();
    assert_eq!((scene.materials[0].metallic, scene.materials[0].roughness), (1.0, 0.0));
    assert!(
        scene.warnings[0].contains("material 0: its metallicFactor of 1.5 is read as 1"),
        "{:?}",
        scene.warnings
    );
    assert!(scene.warnings[1].contains("roughnessFactor of -0.5 is read as 0"));
}
