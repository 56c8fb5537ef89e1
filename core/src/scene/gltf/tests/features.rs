//! Tests of supported features: files, geometry, nodes, cameras, lights.

use std::f32::consts::{FRAC_1_SQRT_2 as HALF, FRAC_PI_2};

use glam::{Vec3, vec2, vec3};
use serde_json::json;

use super::{File, data_uri, import};
use crate::scene::{EnvironmentMap, ImportOptions, LightKind, Scene, WHITE, octahedral_decode};

fn face(scene: &Scene, triangle: usize) -> Vec3 {
    let [a, b, c] = scene.positions[triangle];
    (b - a).cross(c - a).normalize()
}

fn normal(scene: &Scene, triangle: usize) -> Vec3 {
    octahedral_decode(scene.normals[triangle][0])
}

#[test]
fn gltf_and_glb_give_the_same_triangle() {
    let file = File::triangle();
    let (a, b) = (import(&file.gltf()).unwrap(), import(&file.glb()).unwrap());
    assert_eq!(a.positions, [[Vec3::ZERO, Vec3::X, Vec3::Y]]);
    assert_eq!(a.positions, b.positions);
    assert_eq!(a.objects[0].name, "n/m[0]");
    assert_eq!(normal(&a, 0), Vec3::Z);
    assert_eq!(a.cameras[0].0, "framing");
    assert!(a.texcoords.is_empty() && a.colors.is_empty());
    assert!(a.warnings.is_empty(), "{:?}", a.warnings);
    let default = &a.materials[0];
    assert_eq!((default.metallic, default.roughness, default.base_color), (1.0, 1.0, Vec3::ONE));
}

#[test]
fn external_buffers_are_asked_for_as_the_file_names_them() {
    let mut file = File::triangle();
    file.json["buffers"] = json!([{ "byteLength": file.bytes.len(), "uri": "a%20b/%C3%A4.bin" }]);
    let mut asked = Vec::new();
    let scene = Scene::from_gltf(&file.gltf(), &mut |uri| {
        asked.push(uri.to_owned());
        Ok(file.bytes.clone())
    });
    assert_eq!(scene.unwrap().positions.len(), 1);
    assert_eq!(asked, ["a%20b/%C3%A4.bin"]);
}

#[test]
fn nodes_nest_and_instances_are_flattened() {
    let mut file = File::triangle();
    file.json["nodes"] = json!([
        { "children": [1, 2], "translation": [1, 0, 0] },
        { "name": "a", "mesh": 0, "scale": [2, 2, 2] },
        { "mesh": 0, "rotation": [0, 0, HALF, HALF] },
    ]);
    let scene = file.scene();
    assert_eq!(scene.positions[0], [vec3(1.0, 0.0, 0.0), vec3(3.0, 0.0, 0.0), vec3(1.0, 2.0, 0.0)]);
    assert!(scene.positions[1][1].distance(vec3(1.0, 1.0, 0.0)) < 1e-6);
    assert_eq!(scene.triangle_objects, [0, 1]);
    assert_eq!(scene.objects[1].name, "node2/m[0]");
    file.json["nodes"] = json!([{ "mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1] }]);
    assert_eq!(file.scene().positions[0][0], vec3(0.0, 0.0, 5.0));
}

#[test]
fn a_mirrored_node_keeps_normals_on_the_side_of_the_face() {
    let mut file = File::triangle();
    let normals = file.floats("VEC3", &[0.6, 0.0, 0.8, 0.6, 0.0, 0.8, 0.6, 0.0, 0.8]);
    file.attribute("NORMAL", normals);
    file.json["nodes"] = json!([{ "mesh": 0, "scale": [-2, 1, 1] }]);
    let scene = file.scene();
    assert_eq!(face(&scene, 0), Vec3::Z);
    let expected = vec3(-0.3, 0.0, 0.8).normalize();
    assert!(normal(&scene, 0).distance(expected) < 1e-4, "{}", normal(&scene, 0));
    // Mirrored through the triangle's plane: winding and normal both flip.
    file.json["nodes"] = json!([{ "mesh": 0, "scale": [1, 1, -1] }]);
    let scene = file.scene();
    assert_eq!(face(&scene, 0), -Vec3::Z);
    assert!(normal(&scene, 0).distance(vec3(0.6, 0.0, -0.8)) < 1e-4);
}

#[test]
fn a_flattened_node_keeps_its_area_and_normal() {
    let mut file = File::triangle();
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    file.attribute("NORMAL", normals);
    file.json["nodes"] = json!([{ "mesh": 0, "scale": [1, 1, 0] }]);
    let scene = file.scene();
    // The second normal has zero length and is replaced by the face normal.
    assert!(scene.normals[0].iter().all(|n| octahedral_decode(*n) == Vec3::Z));
}

#[test]
fn indices_of_every_width_strips_and_fans() {
    for (component, bytes) in [
        (5121, vec![0, 2, 1]),
        (5123, vec![0, 0, 2, 0, 1, 0]),
        (5125, vec![0, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0]),
    ] {
        let mut file = File::triangle();
        let indices = file.accessor(component, "SCALAR", 3, &bytes);
        file.primitive()["indices"] = json!(indices);
        assert_eq!(file.scene().positions[0], [Vec3::ZERO, Vec3::Y, Vec3::X]);
    }
    let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0];
    let mut file = File::triangle();
    let square = file.floats("VEC3", &corners);
    file.attribute("POSITION", square);
    file.primitive()["mode"] = json!(5);
    let strip = file.scene();
    assert_eq!(strip.positions.len(), 2);
    assert_eq!((face(&strip, 0), face(&strip, 1)), (Vec3::Z, Vec3::Z));
    let indices = file.accessor(5121, "SCALAR", 4, &[0, 1, 3, 2]);
    file.primitive()["indices"] = json!(indices);
    file.primitive()["mode"] = json!(6);
    let fan = file.scene();
    assert_eq!(fan.positions[1], [vec3(1.0, 1.0, 0.0), Vec3::Y, Vec3::ZERO]);
    assert_eq!(face(&fan, 0), Vec3::Z);
}

#[test]
fn points_and_lines_are_spheres_and_tubes() {
    let drawn = |mode: u32| {
        let mut file = File::triangle();
        file.primitive()["mode"] = json!(mode);
        file.scene()
    };
    for (mode, lines) in [(0, 0), (1, 1), (2, 3), (3, 2)] {
        let scene = drawn(mode);
        let spheres = if mode == 0 { 3 } else { 2 * lines };
        assert_eq!((scene.spheres.len(), scene.positions.len()), (spheres, 12 * lines), "mode {mode}");
        assert!(scene.materials[scene.objects[0].material as usize].unlit, "there are no normals");
        let radius = scene.spheres[0].radius;
        assert_eq!(radius, 1.0 / 300.0);
        // Tubes are a radius thick around their line and face outwards.
        for [a, b, c] in &scene.positions {
            let center = (*a + *b + *c) / 3.0;
            let from_lines =
                [(Vec3::ZERO, Vec3::X), (Vec3::X, Vec3::Y), (Vec3::Y, Vec3::ZERO)].map(|(p, q)| {
                    let along = (q - p).normalize();
                    center - p - along * (center - p).dot(along)
                });
            let nearest = from_lines.into_iter().min_by(|p, q| p.length().total_cmp(&q.length())).unwrap();
            assert!((0.4..1.0).contains(&(nearest.length() / radius)), "{nearest}");
            assert!((*b - *a).cross(*c - *a).dot(nearest) > 0.0);
        }
    }
    let mut file = File::triangle();
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
    file.attribute("NORMAL", normals);
    let mut points = file.primitive().clone();
    points["mode"] = json!(0);
    points["attributes"]["COLOR_0"] = json!(normals);
    file.json["meshes"][0]["primitives"].as_array_mut().unwrap().push(points);
    let scene = file.scene();
    assert_eq!((scene.positions.len(), scene.spheres.len(), scene.materials.len()), (1, 3, 1));
    let told = "mesh 0 primitive 1: its points and lines have one colour, without textures";
    assert!(scene.warnings.contains(&told.to_owned()), "{:?}", scene.warnings);
}

#[test]
fn sparse_values_replace_stored_ones_and_zeros() {
    let mut file = File::triangle();
    let indices = file.view(&[2]);
    let values = file.view(bytemuck::cast_slice(&[0.0_f32, 3.0, 0.0]));
    let sparse = json!({
        "count": 1,
        "indices": { "bufferView": indices, "componentType": 5121 },
        "values": { "bufferView": values },
    });
    file.json["accessors"][0]["sparse"] = sparse;
    assert_eq!(file.scene().positions[0], [Vec3::ZERO, Vec3::X, Vec3::Y * 3.0]);

    let indices = file.view(&[1, 2]);
    let values = file.view(bytemuck::cast_slice(&[5.0_f32, 0.0, 0.0, 0.0, 6.0, 0.0]));
    file.json["accessors"][0] = json!({
        "componentType": 5126, "type": "VEC3", "count": 3,
        "sparse": {
            "count": 2,
            "indices": { "bufferView": indices, "componentType": 5121 },
            "values": { "bufferView": values },
        },
    });
    assert_eq!(file.scene().positions[0], [Vec3::ZERO, Vec3::X * 5.0, Vec3::Y * 6.0]);
}

#[test]
fn quantised_attributes_are_read_with_stride_and_norm() {
    let mut file = File::triangle();
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    // Three signed 16-bit components and two bytes of padding per element.
    let words: [i16; 12] = [0, 0, 0, 99, 32767, 0, 0, 99, 0, -32768, 0, 99];
    let positions = file.accessor(5122, "VEC3", 3, bytemuck::cast_slice(&words));
    file.json["accessors"][positions]["normalized"] = json!(true);
    let view = file.json["accessors"][positions]["bufferView"].as_u64().unwrap() as usize;
    file.json["bufferViews"][view]["byteStride"] = json!(8);
    file.attribute("POSITION", positions);
    let normals = file.accessor(5120, "VEC3", 3, &[0, 127, 0, 0, 127, 0, 0, 127, 0]);
    file.json["accessors"][normals]["normalized"] = json!(true);
    file.attribute("NORMAL", normals);
    let scene = file.scene();
    assert_eq!(scene.positions[0], [Vec3::ZERO, Vec3::X, -Vec3::Y]);
    assert_eq!(normal(&scene, 0), Vec3::Y);
    file.json["accessors"][positions]["normalized"] = json!(false);
    assert_eq!(file.scene().positions[0][1], Vec3::X * 32767.0);
}

#[test]
fn vertex_colours_are_packed_and_others_stay_white() {
    let mut file = File::triangle();
    let plain = file.primitive().clone();
    let colors =
        file.accessor(5123, "VEC3", 3, bytemuck::cast_slice(&[65535_u16, 0, 32768, 0, 0, 0, 0, 0, 0]));
    file.json["accessors"][colors]["normalized"] = json!(true);
    file.json["meshes"][0]["primitives"].as_array_mut().unwrap().push(plain);
    file.attribute("COLOR_0", colors);
    let scene = file.scene();
    let black = [0, 0, 0, 65535];
    assert_eq!(scene.colors, [[[65535, 0, 32768, 65535], black, black], [WHITE; 3]]);
}

#[test]
fn triangles_without_area_are_counted_once() {
    let mut file = File::triangle();
    let indices = file.accessor(5121, "SCALAR", 9, &[0, 1, 2, 0, 1, 1, 2, 2, 2]);
    file.primitive()["indices"] = json!(indices);
    let scene = file.scene();
    assert_eq!(scene.positions.len(), 1);
    assert_eq!(scene.warnings, ["2 triangles without area are left out"]);
    file.json["nodes"] =
        json!([{ "children": [1] , "mesh": 0}, { "name": "flat", "mesh": 0, "scale": [1, 0, 0] }]);
    let scene = file.scene();
    assert_eq!((scene.objects.len(), scene.warnings.len()), (1, 2));
    assert!(scene.warnings.iter().any(|w| w.contains("flat/m[0]")), "{:?}", scene.warnings);
}

#[test]
fn cameras_keep_their_names_and_stand_where_their_nodes_stand() {
    let mut file = File::triangle();
    file.json["cameras"] = json!([
        { "name": "wide", "type": "perspective", "perspective": { "yfov": FRAC_PI_2, "znear": 0.1 } },
        { "type": "orthographic", "orthographic": { "xmag": 2, "ymag": 3, "znear": 0, "zfar": 9 } },
    ]);
    file.json["nodes"] = json!([
        { "mesh": 0, "children": [1, 2] },
        { "camera": 0, "translation": [0, 0, 4] },
        { "name": "plan", "camera": 1, "rotation": [-HALF, 0, 0, HALF] },
    ]);
    let scene = file.scene();
    let [(wide, a), (plan, b)] = &scene.cameras[..] else { panic!("{:?}", scene.cameras) };
    assert_eq!((wide.as_str(), plan.as_str()), ("wide", "plan"));
    assert_eq!((a.origin, a.forward, a.orthographic), (vec3(0.0, 0.0, 4.0), -Vec3::Z, false));
    assert!((a.up.length() - 1.0).abs() < 1e-6);
    assert!(b.orthographic && b.forward.distance(-Vec3::Y) < 1e-6 && (b.up.length() - 3.0).abs() < 1e-6);
}

#[test]
fn lights_shine_along_minus_z_of_their_nodes() {
    let mut file = File::triangle();
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = json!([
        { "type": "point", "color": [1, 0.5, 0], "intensity": 4, "range": 7 },
        { "type": "spot", "spot": { "innerConeAngle": 0.1, "outerConeAngle": 0.2 } },
        { "type": "directional" },
    ]);
    let light = |i: usize| json!({ "KHR_lights_punctual": { "light": i } });
    file.json["nodes"] = json!([
        { "mesh": 0, "children": [1, 2, 3] },
        { "extensions": light(0), "translation": [0, 2, 0] },
        { "extensions": light(1), "rotation": [-HALF, 0, 0, HALF], "scale": [3, 3, 3] },
        { "extensions": light(2) },
    ]);
    let scene = file.scene();
    assert_eq!(scene.lights[0].intensity, vec3(4.0, 2.0, 0.0));
    let point = LightKind::Point { position: Vec3::Y * 2.0, range: 7.0, falloff: true };
    assert_eq!(scene.lights[0].kind, point);
    let LightKind::Spot { direction, range, cone, .. } = &scene.lights[1].kind else { panic!() };
    assert!(direction.distance(-Vec3::Y) < 1e-6);
    assert_eq!((*range, cone), (f32::INFINITY, &(0.1..0.2)));
    assert_eq!(scene.lights[2].kind, LightKind::Directional { direction: -Vec3::Z });
}

#[test]
fn extras_give_the_environment() {
    let mut file = File::triangle();
    file.json["scenes"][0]["extras"] = json!({ "background": [0, 0, 0] });
    assert_eq!(file.scene().environment.ambient, Vec3::splat(0.05));
    file.json["scenes"][0]["extras"] = json!({ "background": [1, 2, 4], "author": "me" });
    let environment = file.scene().environment;
    assert_eq!(environment.background, vec3(1.0, 2.0, 4.0));
    assert_eq!(environment.fallback_radiance, vec3(0.25, 0.5, 1.0));
    file.json["scenes"][0]["extras"]["ambient"] = json!([0, 0, 0]);
    assert_eq!(file.scene().environment.ambient, Vec3::ZERO);
    file.json["scenes"][0]["extras"] = json!("only words");
    assert!(file.scene().is_lit_by_studio);
}

#[test]
fn without_scenes_every_root_node_is_shown() {
    let mut file = File::triangle();
    file.json.as_object_mut().unwrap().remove("scenes");
    file.json["nodes"] = json!([{ "mesh": 0 }, { "children": [0] }, { "mesh": 0 }]);
    assert_eq!(file.scene().positions.len(), 2);
}

#[test]
fn texture_transforms_are_baked_into_the_coordinates() {
    let mut file = File::triangle();
    let texcoords = file.floats("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    file.attribute("TEXCOORD_1", texcoords);
    file.json["images"] = json!([{ "uri": data_uri("image/png", &super::png(1, 1, [9; 4])) }]);
    file.json["textures"] = json!([{ "source": 0 }]);
    let transform = json!({ "offset": [10, 20], "rotation": FRAC_PI_2, "scale": [2, 3], "texCoord": 1 });
    let info = json!({ "index": 0, "extensions": { "KHR_texture_transform": transform } });
    file.json["materials"] = json!([{ "pbrMetallicRoughness": { "baseColorTexture": info } }]);
    file.primitive()["material"] = json!(0);
    let found = file.scene().texcoords[0];
    // Counter-clockwise in the image, where v grows downwards: (1, 0) rotates to (0, -1).
    for (found, expected) in found.iter().zip([vec2(10.0, 20.0), vec2(10.0, 18.0), vec2(13.0, 20.0)]) {
        assert!(found.distance(expected) < 1e-5, "{found} {expected}");
    }
}

#[test]
fn variants_choose_materials_by_name() {
    let mut file = File::triangle();
    let material = |red: f32| json!({ "pbrMetallicRoughness": { "baseColorFactor": [red, 0, 0, 1] } });
    file.json["materials"] = json!([material(0.1), material(0.2), material(0.3)]);
    file.json["extensions"]["KHR_materials_variants"]["variants"] =
        json!([{ "name": "day" }, { "name": "night" }, { "name": "dawn" }]);
    file.json["extensionsRequired"] = json!(["KHR_materials_variants"]);
    file.primitive()["material"] = json!(0);
    file.primitive()["extensions"]["KHR_materials_variants"]["mappings"] =
        json!([{ "material": 1, "variants": [0] }, { "material": 2, "variants": [9, 1] }]);
    let red = |variant: Option<&str>| {
        let mut none = |_: &str| Err(String::new());
        let options = ImportOptions { variant, ..ImportOptions::default() };
        let scene = Scene::from_gltf_with(&file.gltf(), &mut none, &options);
        scene.map(|scene| (scene.materials[0].base_color.x, scene.variants))
    };
    let names = ["day", "night", "dawn"].map(str::to_owned).to_vec();
    for (variant, expected) in [(None, 0.1), (Some("day"), 0.2), (Some("night"), 0.3), (Some("dawn"), 0.1)] {
        assert_eq!(red(variant).unwrap(), (expected, names.clone()), "{variant:?}");
    }
    let error = red(Some("noon")).unwrap_err().to_string();
    assert!(
        error.contains("variant") && error.contains("day, night, dawn") && error.contains("noon"),
        "{error}"
    );
}

#[test]
fn a_file_without_light_stands_in_the_studio_whatever_glows_in_it() {
    let studio = |file: &File| {
        let scene = file.scene();
        assert_eq!(scene.is_lit_by_studio, scene.environment_map == Some(EnvironmentMap::studio()));
        scene.is_lit_by_studio
    };
    let mut file = File::triangle();
    assert!(studio(&file));
    file.json["materials"] = json!([{ "emissiveFactor": [0.001, 0, 0] }]);
    file.primitive()["material"] = json!(0);
    assert!(studio(&file), "a speck that glows is no light");
    file.json["scenes"][0]["extras"] = json!({ "background": [0, 0, 0] });
    assert!(!studio(&file), "the file states its surroundings");
    file.json["scenes"][0]["extras"] = json!({ "author": "somebody" });
    assert!(studio(&file));
    let mut scene = file.scene();
    scene.leave_studio();
    assert!(!scene.is_lit_by_studio && scene.environment_map.is_none());
    assert_eq!(scene.environment, crate::scene::Environment::default());
}
