//! The tables against the specification, and what is told of files.

use serde_json::{Value, json};

use super::super::tests::File;
use super::table::OBJECTS;
use super::{EXTENSIONS, LISTS, Support};
use crate::scene::NotShown;

/// The properties of the specification's JSON schema (glTF 2.0, appendix A) by kind of object, without `extensions`
/// and `extras`, which every object may have. Attributes are those of sections 3.7.2.1 and 3.7.2.2.
const SPECIFICATION: &str = "
glTF: accessors animations asset bufferViews buffers cameras extensionsRequired extensionsUsed images materials meshes nodes samplers scene scenes skins textures
accessor: bufferView byteOffset componentType count max min name normalized sparse type
accessor.sparse: count indices values
accessor.sparse.indices: bufferView byteOffset componentType
accessor.sparse.values: bufferView byteOffset
animation: channels name samplers
animation.channel: sampler target
animation.channel.target: node path
animation.sampler: input interpolation output
asset: copyright generator minVersion version
buffer: byteLength name uri
bufferView: buffer byteLength byteOffset byteStride name target
camera: name orthographic perspective type
camera.orthographic: xmag ymag zfar znear
camera.perspective: aspectRatio yfov zfar znear
image: bufferView mimeType name uri
material: alphaCutoff alphaMode doubleSided emissiveFactor emissiveTexture name normalTexture occlusionTexture pbrMetallicRoughness
material.normalTextureInfo: index scale texCoord
material.occlusionTextureInfo: index strength texCoord
material.pbrMetallicRoughness: baseColorFactor baseColorTexture metallicFactor metallicRoughnessTexture roughnessFactor
mesh: name primitives weights
mesh.primitive: attributes indices material mode targets
mesh.primitive.attributes: COLOR_0 COLOR_n JOINTS_n NORMAL POSITION TANGENT TEXCOORD_n WEIGHTS_n
mesh.primitive.target: COLOR_n NORMAL POSITION TANGENT TEXCOORD_n
node: camera children matrix mesh name rotation scale skin translation weights
sampler: magFilter minFilter name wrapS wrapT
scene: name nodes
skin: inverseBindMatrices joints name skeleton
texture: name sampler source
textureInfo: index texCoord
";

/// The KHR and EXT extensions of Khronos' registry: ratified, in progress, of several vendors, and archived.
const REGISTRY: &str = "
KHR_animation_pointer KHR_draco_mesh_compression KHR_lights_punctual KHR_materials_anisotropy KHR_materials_clearcoat
KHR_materials_diffuse_transmission KHR_materials_dispersion KHR_materials_emissive_strength KHR_materials_ior
KHR_materials_iridescence KHR_materials_sheen KHR_materials_specular KHR_materials_transmission KHR_materials_unlit
KHR_materials_variants KHR_materials_volume KHR_materials_volume_scatter KHR_mesh_quantization KHR_meshopt_compression
KHR_node_hoverability KHR_node_selectability KHR_node_visibility KHR_texture_basisu KHR_texture_transform
KHR_xmp_json_ld EXT_mesh_gpu_instancing EXT_meshopt_compression EXT_texture_webp
KHR_accessor_float64 KHR_audio_emitter KHR_audio_graph KHR_collision_shapes KHR_gaussian_splatting KHR_implicit_shapes
KHR_interactivity KHR_materials_subsurface KHR_physics_rigid_bodies KHR_texture_procedurals KHR_texture_video
EXT_instance_features EXT_lights_ies EXT_lights_image_based EXT_mesh_features EXT_mesh_manifold
EXT_structural_metadata EXT_texture_avif EXT_texture_procedurals_mx_1_39
KHR_materials_pbrSpecularGlossiness KHR_techniques_webgl KHR_xmp
";

/// `extras` of scenes and materials are this program's own.
const OWN: [(&str, &str); 2] = [("scene", "extras"), ("material", "extras")];

#[test]
fn every_property_of_the_specification_has_a_line() {
    let lines = |name: &str| {
        let object = OBJECTS.iter().find(|object| object.name == name);
        object.map(|object| object.properties.iter().map(|p| p.name).collect::<Vec<_>>()).unwrap_or_default()
    };
    let objects: Vec<_> = SPECIFICATION.trim().lines().map(|line| line.split_once(": ").unwrap()).collect();
    for (object, names) in &objects {
        let expected: Vec<_> = names.split_whitespace().collect();
        let mut found = lines(object);
        found.retain(|name| !OWN.contains(&(*object, *name)));
        assert_eq!(found, expected, "{object}");
    }
    assert_eq!(objects.len(), OBJECTS.len());
}

#[test]
fn every_extension_of_the_registry_has_a_line() {
    for name in REGISTRY.split_whitespace() {
        assert_eq!(EXTENSIONS.iter().filter(|extension| extension.name == name).count(), 1, "{name}");
    }
    assert!(EXTENSIONS.is_sorted_by_key(|extension| extension.name));
    for extension in &EXTENSIONS {
        let own = !["KHR", "EXT"].contains(&extension.name.split('_').next().unwrap());
        assert!(own || REGISTRY.split_whitespace().any(|name| name == extension.name), "{}", extension.name);
    }
}

#[test]
fn the_texts_of_the_tables_are_json() {
    for list in LISTS {
        assert!(super::json(list.unused).is_object(), "{}", list.pointer);
    }
    for property in OBJECTS.iter().flat_map(|object| object.properties) {
        assert!(property.demanded.is_none_or(|text| !super::json(text).is_null()), "{}", property.name);
    }
}

/// A file with a triangle of material 0, and the features that it does not show.
fn told(change: impl FnOnce(&mut Value)) -> Vec<NotShown> {
    let mut file = File::triangle();
    file.json["materials"] = json!([{ "name": "A" }]);
    file.primitive()["material"] = json!(0);
    change(&mut file.json);
    file.scene().not_shown
}

fn features(change: impl FnOnce(&mut Value)) -> Vec<String> {
    told(change).into_iter().map(|told| told.feature).collect()
}

/// Every line that is not shown is told by a file that has nothing else, and silent where it has no effect.
#[test]
fn what_is_not_shown_is_told_with_its_place() {
    assert_eq!(told(|_| ()), []);
    for extension in &EXTENSIONS {
        let name = extension.name;
        let material = |content: Value| features(|json| json["materials"][0]["extensions"][name] = content);
        match extension.support {
            Support::Shown | Support::Ignored => {
                assert_eq!(material(json!({ "unheard": 1 })), [""; 0], "{name}");
            }
            Support::NotShown if name.starts_with("KHR_materials") => {
                let factors = json!({
                    "anisotropyStrength": 1, "clearcoatFactor": 1, "diffuseTransmissionFactor": 1, "dispersion": 1,
                    "iridescenceFactor": 1, "sheenColorFactor": [0, 0, 1], "specularFactor": 0.5,
                    "multiscatterColor": [1, 0, 0],
                });
                assert_eq!(material(factors), [name]);
                let always =
                    ["KHR_materials_pbrSpecularGlossiness", "KHR_materials_subsurface"].contains(&name);
                assert_eq!(material(json!({})).is_empty(), !always, "{name}: without effect");
            }
            Support::NotShown => assert_eq!(material(json!({})), [name]),
            Support::Needed => {}
        }
    }
    let scatters = |color: &str| {
        let content = json!({ color: [0.5, 0.7, 0.9] });
        features(|json| json["materials"][0]["extensions"]["KHR_materials_volume_scatter"] = content)
    };
    for color in ["multiscatterColor", "multiscatterColorFactor"] {
        assert_eq!(scatters(color), ["KHR_materials_volume_scatter"], "{color}");
    }
    let unknown = told(|json| json["materials"][0]["extensions"]["ACME_glow"] = json!({}));
    assert_eq!((unknown.len(), unknown[0].to_string()), (1, "ACME_glow, once: material 0 `A`".to_owned()));
    assert_eq!(
        features(|json| json["extensionsUsed"] = json!(["ACME_glow", "KHR_materials_sheen"])),
        ["ACME_glow"]
    );
}

#[test]
fn what_nothing_uses_is_neither_read_nor_told() {
    let wrong = json!({ "baseColorFactor": "red", "extensions": { "ACME_glow": {} } });
    let unused = |json: &mut Value| {
        json["materials"].as_array_mut().unwrap().push(json!({ "pbrMetallicRoughness": wrong }));
        json["images"] = json!([{ "uri": 7 }]);
        json["animations"] = json!([{ "channels": [{ "sampler": 0, "target": { "path": "weights" } }] }, 5]);
        json["cameras"] = json!([{}]);
        json["buffers"] = Value::Null;
        json["asset"]["generator"] = json!(3);
        json["materials"][0]["name"] = json!(["B"]);
        json["meshes"][0]["extras"] = json!({ "extensions": 3 });
        json["accessors"][0]["max"] = json!("none");
    };
    let mut file = File::triangle();
    file.json["materials"] = json!([{}]);
    file.primitive()["material"] = json!(0);
    unused(&mut file.json);
    file.json.as_object_mut().unwrap().remove("buffers");
    assert_eq!(file.scene().not_shown, []);
}

#[test]
fn properties_that_are_not_shown_are_told_where_they_have_an_effect() {
    let properties =
        |name: &str| OBJECTS.iter().find(|object| object.name == name).unwrap().properties.iter();
    for (object, list) in [("node", "nodes"), ("mesh", "meshes")] {
        for property in properties(object).filter(|property| property.support == Support::NotShown) {
            let value = if property.name == "weights" { json!([0, 0.5]) } else { json!(0) };
            let found = features(|json| json[list][0][property.name] = value);
            assert_eq!(found, [format!("{object}.{}", property.name)]);
            let zeros = if property.name == "weights" { json!([0, 0.0]) } else { Value::Null };
            assert_eq!(features(|json| json[list][0][property.name] = zeros), [""; 0]);
        }
    }
    if properties("glTF")
        .any(|property| property.name == "animations" && property.support == Support::NotShown)
    {
        let channel =
            |target: Value| json!({ "name": "walk", "channels": [{ "sampler": 0, "target": target }] });
        let [moves, idle] = [json!({ "node": 0, "path": "scale" }), json!({ "path": "scale" })].map(channel);
        let found = told(|json| json["animations"] = json!([idle, moves]));
        assert_eq!(
            (found.len(), found[0].to_string()),
            (1, "glTF.animations, once: animation 1 `walk`".to_owned())
        );
    }
}

#[test]
fn what_cannot_be_drawn_without_an_extension_is_refused_by_its_name() {
    for extension in EXTENSIONS.iter().filter(|extension| extension.support == Support::Needed) {
        let mut file = File::triangle();
        file.json["extensionsRequired"] = json!([extension.name]);
        file.fails(&["required extension", extension.name, "not supported"]);
    }
    let mut file = File::triangle();
    file.json["extensionsRequired"] = json!(["ACME_shape"]);
    file.fails(&["required extension ACME_shape"]);
    if EXTENSIONS.iter().any(|e| e.name == "KHR_draco_mesh_compression" && e.support == Support::Needed) {
        let mut file = File::triangle();
        file.primitive()["extensions"]["KHR_draco_mesh_compression"] = json!({ "bufferView": 0 });
        assert_eq!(file.scene().not_shown, [], "the positions are there without it");
        file.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
        file.fails(&["mesh 0 `m`", "KHR_draco_mesh_compression"]);
    }
}

#[test]
fn nodes_that_are_hidden_are_not_there() {
    let mut file = File::triangle();
    file.json["nodes"] = json!([{ "mesh": 0, "children": [1] }, { "children": [2] }, { "mesh": 0 }]);
    assert_eq!(file.scene().objects.len(), 2);
    file.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = json!(false);
    assert_eq!(file.scene().objects.len(), 1);
    file.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = json!(true);
    assert_eq!(file.scene().objects.len(), 2);
}
