//! Tests of reading materials, textures and images.

use glam::{Vec3, vec3};
use serde_json::{Value, json};

use super::{File, data_uri, png};
use crate::scene::gltf::NO_LIGHTS;
use crate::scene::{Material, Texture, Wrap};

fn with_material(material: Value) -> File {
    let mut file = File::triangle();
    file.json["materials"] = json!([material]);
    file.primitive()["material"] = json!(0);
    file
}

fn imported(material: Value) -> Material {
    with_material(material).scene().materials.remove(0)
}

/// A file with three images as textures 0 to 2, and `material` to use them.
fn textured(material: Value) -> File {
    let mut file = with_material(material);
    let texcoords = file.floats("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    file.attribute("TEXCOORD_0", texcoords);
    file.attribute("TEXCOORD_1", texcoords);
    let image = |c: u8| json!({ "uri": data_uri("image/png", &png(2, 1, [c, 0, 0, 255])) });
    file.json["images"] = json!([image(10), image(20), image(30)]);
    file.json["textures"] = json!([{ "source": 0 }, { "source": 1 }, { "source": 2 }]);
    file
}

#[test]
fn factors_and_extensions() {
    let material = imported(json!({
        "name": "all",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.25,
        },
        "emissiveFactor": [1, 0.5, 0],
        "doubleSided": true,
        "normalTexture": { "index": 7 },
        "extensions": {
            "KHR_materials_emissive_strength": { "emissiveStrength": 8 },
            "KHR_materials_ior": { "ior": 1.33 },
            "KHR_materials_unlit": {},
        },
    }));
    assert_eq!(material.name, "all");
    assert_eq!((material.base_color, material.alpha), (vec3(0.1, 0.2, 0.3), 0.4));
    assert_eq!((material.metallic, material.roughness, material.ior), (0.5, 0.25, 1.33));
    assert_eq!(material.emission, vec3(8.0, 4.0, 0.0));
    assert!(material.unlit && material.casts_shadow && material.alpha_cutoff.is_none());
}

#[test]
fn transmission_is_thin_without_volume() {
    let glass = |volume: Value| {
        let mut extensions = json!({ "KHR_materials_transmission": { "transmissionFactor": 1 } });
        if !volume.is_null() {
            extensions["KHR_materials_volume"] = volume;
        }
        imported(json!({ "extensions": extensions }))
    };
    for (volume, thin) in [
        (Value::Null, true),
        (json!({}), true),
        (json!({ "thicknessFactor": 0 }), true),
        (json!({ "thicknessFactor": 1 }), false),
    ] {
        let material = glass(volume);
        assert_eq!((material.transmission, material.thin, material.casts_shadow), (1.0, thin, false));
    }
}

#[test]
fn alpha_modes() {
    assert_eq!(imported(json!({ "alphaMode": "MASK" })).alpha_cutoff, Some(0.5));
    assert_eq!(imported(json!({ "alphaMode": "MASK", "alphaCutoff": 0.25 })).alpha_cutoff, Some(0.25));
    let scene = with_material(json!({ "alphaMode": "BLEND", "alphaCutoff": 0.25 })).scene();
    assert_eq!(scene.materials[0].alpha_cutoff, Some(0.5));
    assert!(scene.warnings[0].contains("BLEND"), "{:?}", scene.warnings);
}

#[test]
fn three_slots_share_coordinates() {
    let scene = textured(json!({
        "pbrMetallicRoughness": {
            "baseColorTexture": { "index": 0 }, "metallicRoughnessTexture": { "index": 1 },
        },
        "emissiveTexture": { "index": 2 },
    }))
    .scene();
    let material = &scene.materials[0];
    assert_eq!(material.textures().collect::<Vec<_>>(), [0, 1, 2]);
    assert_eq!(scene.images.iter().map(|i| i.rgba[0]).collect::<Vec<_>>(), [10, 20, 30]);
    assert_eq!((scene.images[0].width, scene.images[0].height), (2, 1));
    assert_eq!(scene.warnings, [NO_LIGHTS]);
}

#[test]
fn a_slot_with_other_coordinates_is_dropped() {
    let scene = textured(json!({
        "pbrMetallicRoughness": { "metallicRoughnessTexture": { "index": 1, "texCoord": 1 } },
        "emissiveTexture": { "index": 2 },
    }))
    .scene();
    let material = &scene.materials[0];
    assert_eq!(material.metallic_roughness_texture, Some(0));
    assert_eq!(material.emissive_texture, None);
    assert_eq!(scene.images.len(), 1, "only what is shown is decoded");
    assert!(scene.warnings[0].contains("emissive texture is dropped"), "{:?}", scene.warnings);
}

#[test]
fn an_image_is_decoded_once_for_all_textures_and_entries_that_name_it() {
    let mut file = textured(json!({
        "pbrMetallicRoughness": {
            "baseColorTexture": { "index": 0 }, "metallicRoughnessTexture": { "index": 1 },
        },
    }));
    let view = file.view(&png(4, 4, [1, 2, 3, 4]));
    file.json["images"] = json!([{ "bufferView": view, "mimeType": "image/png" }, { "bufferView": view }]);
    file.json["samplers"] = json!([{ "magFilter": 9728, "wrapS": 33071, "wrapT": 33648 }]);
    file.json["textures"] = json!([{ "source": 0, "sampler": 0 }, { "source": 1 }]);
    let scene = file.scene();
    assert_eq!((scene.images.len(), scene.textures.len()), (1, 2));
    assert_eq!(scene.images[0].rgba[..4], [1, 2, 3, 4]);
    let wrap = [Wrap::ClampToEdge, Wrap::MirroredRepeat];
    assert_eq!(scene.textures[0], Texture { image: 0, wrap, nearest: true });
    assert_eq!(scene.textures[1], Texture { image: 0, wrap: [Wrap::Repeat; 2], nearest: false });
}

#[test]
fn unused_materials_and_images_are_not_read() {
    let mut file = textured(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }));
    file.json["images"][2] = json!({ "uri": "not-there.png" });
    file.json["materials"].as_array_mut().unwrap().push(json!({ "emissiveTexture": { "index": 2 } }));
    assert_eq!(file.scene().materials.len(), 1);
}

#[test]
fn what_cannot_be_shown_is_said() {
    let mut file = textured(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }));
    file.json["textures"][0] = json!({ "extensions": { "KHR_texture_basisu": { "source": 0 } } });
    let scene = file.scene();
    assert_eq!(scene.materials[0].base_color_texture, None);
    assert!(scene.warnings[0].contains("no PNG or JPEG"), "{:?}", scene.warnings);

    let mut file =
        textured(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "texCoord": 3 } } }));
    let scene = file.scene();
    assert!(scene.warnings[0].contains("without TEXCOORD_3"), "{:?}", scene.warnings);
    assert!(scene.texcoords.is_empty() || scene.texcoords.len() == 1);

    file.json["materials"] = json!([{ "extensions": {
        "KHR_materials_transmission": { "transmissionFactor": 1, "transmissionTexture": { "index": 0 } },
        "KHR_materials_volume": { "attenuationDistance": 2, "attenuationColor": [1, 0, 0] },
    }}]);
    assert_eq!(file.scene().warnings.len(), 3);
}

#[test]
fn untextured_objects_next_to_textured_ones_get_zero_coordinates() {
    let mut file = textured(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }));
    let textured = file.primitive().clone();
    file.primitive()["material"] = Value::Null;
    file.json["meshes"][0]["primitives"].as_array_mut().unwrap().push(textured);
    let scene = file.scene();
    assert_eq!(scene.texcoords.len(), 2);
    assert_eq!(scene.texcoords[1][1].x, 1.0);
    assert_eq!(scene.materials.iter().map(|m| m.base_color).collect::<Vec<_>>(), [Vec3::ONE; 2]);
}
