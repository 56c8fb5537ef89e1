//! Tests of reading materials, textures and images.

use glam::{Vec3, vec2, vec3};
use serde_json::{Value, json};

use super::{File, data_uri, png};
use crate::scene::{Material, Scene, SpecularGlossiness, Texture, TextureSlot, Wrap, tangent_decode_exact};

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
}

/// Opaque materials in BLEND are opaque: what lies behind them needs no ray.
#[test]
fn blend_is_coverage_where_something_is_not_opaque() {
    let blend = |alpha: f32| {
        let pbr = json!({ "baseColorFactor": [1, 1, 1, alpha], "baseColorTexture": { "index": 0 } });
        json!({ "alphaMode": "BLEND", "alphaCutoff": 0.25, "pbrMetallicRoughness": pbr })
    };
    let texel = |alpha: u8| {
        let mut file = textured(blend(1.0));
        file.json["images"][0]["uri"] = json!(data_uri("image/png", &png(2, 1, [10, 0, 0, alpha])));
        file
    };
    let vertex = |alpha: f32| {
        let mut file = textured(blend(1.0));
        let colors = file.floats("VEC4", &[1.0, 1.0, 1.0, alpha, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
        file.attribute("COLOR_0", colors);
        file
    };
    let cases = [
        (textured(blend(1.0)), false),
        (textured(blend(0.9)), true),
        (texel(254), true),
        (texel(255), false),
        (vertex(0.5), true),
        (vertex(1.0), false),
    ];
    for (file, blends) in cases {
        let scene = file.scene();
        let material = &scene.materials[0];
        assert_eq!((material.blends, material.alpha_cutoff), (blends, None), "{:?}", file.json);
    }
}

#[test]
fn sides() {
    assert!(imported(json!({ "doubleSided": true })).double_sided);
    assert!(!imported(json!({})).double_sided);
    assert!(!File::triangle().scene().materials[0].double_sided, "the default material");
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
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

#[test]
fn every_slot_keeps_its_own_coordinates() {
    let turned =
        json!({ "KHR_texture_transform": { "offset": [0.5, 0.25], "scale": [2, 4], "texCoord": 1 } });
    let plain = json!({ "KHR_texture_transform": { "offset": [0.5, 0] } });
    let mut file = textured(json!({
        "pbrMetallicRoughness": {
            "baseColorTexture": { "index": 0, "extensions": turned },
            "metallicRoughnessTexture": { "index": 1, "texCoord": 1 },
        },
        "emissiveTexture": { "index": 2 },
        "normalTexture": { "index": 1, "extensions": plain, "scale": 0.5 },
        "occlusionTexture": { "index": 2, "texCoord": 1, "extensions": turned, "strength": 0.25 },
        "extensions": { "KHR_materials_transmission": {
            "transmissionFactor": 1, "transmissionTexture": { "index": 0, "texCoord": 2 },
        } },
    }));
    let second = file.floats("VEC2", &[0.0, 0.0, 0.5, 0.0, 0.0, 0.5]);
    file.attribute("TEXCOORD_1", second);
    let scene = file.scene();
    let material = &scene.materials[0];
    let slots = [TextureSlot::MetallicRoughness, TextureSlot::Emissive, TextureSlot::Normal];
    assert_eq!(material.coordinates.keys().copied().collect::<Vec<_>>(), slots);
    // The first slot's coordinates are stored transformed: (u, v) of the second set became (2 u + 0.5, 4 v + 0.25).
    assert_eq!(scene.texcoords, [[vec2(0.5, 0.25), vec2(1.5, 0.25), vec2(0.5, 2.25)]]);
    assert_eq!(scene.second_texcoords, [[vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(0.0, 1.0)]]);
    let at = |slot, uv| material.coordinates[&slot].transform.transform_point2(uv);
    assert_eq!(at(TextureSlot::MetallicRoughness, vec2(1.5, 2.25)), vec2(0.5, 0.5));
    assert!(!material.coordinates[&TextureSlot::MetallicRoughness].second);
    assert_eq!(at(TextureSlot::Emissive, vec2(0.25, 0.75)), vec2(0.25, 0.75));
    assert_eq!(at(TextureSlot::Normal, vec2(0.25, 0.75)), vec2(0.75, 0.75));
    assert!(material.coordinates[&TextureSlot::Normal].second);
    assert_eq!((material.normal_scale, material.occlusion_strength), (0.5, 0.25));
    assert!(material.maps.contains_key(&TextureSlot::Occlusion));
    assert!(!material.maps.contains_key(&TextureSlot::Transmission), "a third set");
    assert!(scene.warnings[0].contains("transmission texture is dropped"), "{:?}", scene.warnings);
    assert!(scene.warnings[0].contains("TEXCOORD_2"), "{:?}", scene.warnings);
}

#[test]
fn layers_of_extensions() {
    let specular = json!({
        "specularFactor": 0.5, "specularColorFactor": [2, 1, 0.5], "specularTexture": { "index": 2 },
    });
    let coat = json!({ "clearcoatFactor": 0.75, "clearcoatRoughnessFactor": 0.25, "clearcoatTexture": { "index": 1 } });
    let volume =
        json!({ "thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [1, 0.5, 0.25] });
    let scene = textured(json!({ "extensions": {
        "KHR_materials_specular": specular, "KHR_materials_clearcoat": coat, "KHR_materials_volume": volume,
        "KHR_materials_transmission": { "transmissionFactor": 1 },
    } }))
    .scene();
    let material = &scene.materials[0];
    assert_eq!((material.specular, material.specular_color), (0.5, vec3(2.0, 1.0, 0.5)));
    assert_eq!((material.clearcoat, material.clearcoat_roughness), (0.75, 0.25));
    let over_two = (-2.0 * material.absorption).exp();
    assert!((over_two - vec3(1.0, 0.5, 0.25)).abs().max_element() < 1e-6, "{over_two}");
    assert_eq!(
        material.maps.keys().copied().collect::<Vec<_>>(),
        [TextureSlot::Specular, TextureSlot::Clearcoat]
    );

    let scene = textured(json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "metallicFactor": 0.5 },
        "extensions": { "KHR_materials_pbrSpecularGlossiness": {
            "diffuseFactor": [0.1, 0.2, 0.3, 0.4], "diffuseTexture": { "index": 1 },
            "specularFactor": [0.5, 0.6, 0.7], "glossinessFactor": 0.8,
            "specularGlossinessTexture": { "index": 2 },
        } },
    }))
    .scene();
    let material = &scene.materials[0];
    assert_eq!((material.base_color, material.alpha, material.metallic), (vec3(0.1, 0.2, 0.3), 0.4, 0.0));
    let glossy = SpecularGlossiness { specular: vec3(0.5, 0.6, 0.7), glossiness: 0.8 };
    assert_eq!(material.specular_glossiness, Some(glossy));
    assert_eq!(scene.images.iter().map(|i| i.rgba[0]).collect::<Vec<_>>(), [20, 30]);
    let sheen = json!({
        "sheenColorFactor": [0.5, 0.25, 1], "sheenRoughnessFactor": 0.75,
        "sheenColorTexture": { "index": 1 }, "sheenRoughnessTexture": { "index": 1 },
    });
    let scene = textured(json!({ "extensions": { "KHR_materials_sheen": sheen } })).scene();
    let material = &scene.materials[0];
    assert_eq!((material.sheen_color, material.sheen_roughness), (vec3(0.5, 0.25, 1.0), 0.75));
    assert_eq!(
        material.maps.keys().copied().collect::<Vec<_>>(),
        [TextureSlot::SheenColor, TextureSlot::SheenRoughness]
    );
    assert_eq!(scene.not_shown, []);
    with_material(json!({ "extensions": { "KHR_materials_sheen": { "sheenColorFactor": "red" } } }))
        .fails(&["material 0", "sheenColorFactor"]);
    // Without parameters, the extensions change nothing.
    let plain = imported(
        json!({ "extensions": { "KHR_materials_specular": {}, "KHR_materials_clearcoat": {}, "KHR_materials_sheen": {} } }),
    );
    assert!(!plain.is_extended(), "{plain:?}");
    with_material(json!({ "extensions": { "KHR_materials_clearcoat": { "clearcoatFactor": "much" } } }))
        .fails(&["material 0", "clearcoatFactor"]);
    with_material(json!({ "extensions": { "KHR_materials_volume": { "attenuationDistance": 0 } } }))
        .fails(&["material 0", "attenuationDistance", "above 0"]);
}

#[test]
fn anisotropy_is_read_with_its_tangents() {
    let brushed =
        json!({ "anisotropyStrength": 0.5, "anisotropyRotation": 1.25, "anisotropyTexture": { "index": 1 } });
    let scene = textured(json!({ "extensions": { "KHR_materials_anisotropy": brushed } })).scene();
    let material = &scene.materials[0];
    assert_eq!((material.anisotropy, material.anisotropy_rotation), (0.5, 1.25));
    assert_eq!(material.maps.keys().copied().collect::<Vec<_>>(), [TextureSlot::Anisotropy]);
    assert_eq!((scene.tangents.len(), scene.not_shown.len(), scene.warnings.len()), (1, 0, 0));
    let (tangent, sign) = tangent_decode_exact(scene.tangents[0][1]);
    assert!((tangent.as_vec3() - Vec3::X).length() < 2.0e-4 && sign == -1.0, "along u: {tangent} {sign}");
    // Without a texture, tangents follow the first set of coordinates.
    let plain = json!({ "extensions": { "KHR_materials_anisotropy": { "anisotropyStrength": 1 } } });
    let mut file = textured(plain.clone());
    let turned = file.floats("VEC2", &[0.0, 0.0, 0.0, 1.0, 1.0, 0.0]);
    file.attribute("TEXCOORD_0", turned);
    let scene = file.scene();
    let (tangent, _) = tangent_decode_exact(scene.tangents[0][1]);
    assert!((tangent.as_vec3() - Vec3::Y).length() < 2.0e-4, "{tangent}");
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let scene = with_material(plain).scene();
    assert!(scene.tangents.len() == 1 && scene.materials[0].is_anisotropic());
    assert!(scene.warnings[0].contains("without TANGENT and TEXCOORD_0"), "{:?}", scene.warnings);
    // Without strength there is none.
    let none = json!({ "KHR_materials_anisotropy": { "anisotropyRotation": 1, "anisotropyTexture": { "index": 1 } } });
    let scene = textured(json!({ "extensions": none })).scene();
    assert!(!scene.materials[0].is_extended() && scene.tangents.is_empty() && scene.images.is_empty());
    for (name, bad) in [("anisotropyStrength", json!("much")), ("anisotropyRotation", json!([1]))] {
        with_material(json!({ "extensions": { "KHR_materials_anisotropy": { name: bad } } }))
            .fails(&["material 0", name]);
    }
}

#[test]
fn iridescence_is_read() {
    let film = json!({
        "iridescenceFactor": 0.5, "iridescenceIor": 1.75, "iridescenceTexture": { "index": 1 },
        "iridescenceThicknessMinimum": 200, "iridescenceThicknessMaximum": 300,
    });
    let scene = textured(json!({ "extensions": { "KHR_materials_iridescence": film } })).scene();
    let material = &scene.materials[0];
    assert_eq!((material.iridescence, material.iridescence_ior), (0.5, 1.75));
    assert_eq!(material.iridescence_thickness, [200.0, 300.0]);
    assert_eq!(material.maps.keys().copied().collect::<Vec<_>>(), [TextureSlot::Iridescence]);
    assert_eq!((scene.not_shown.len(), scene.warnings.len()), (0, 0));
    let material =
        imported(json!({ "extensions": { "KHR_materials_iridescence": { "iridescenceFactor": 1 } } }));
    assert_eq!((material.iridescence_ior, material.iridescence_thickness), (1.3, [100.0, 400.0]));
    let none = json!({ "KHR_materials_iridescence": { "iridescenceTexture": { "index": 1 } } });
    assert!(!textured(json!({ "extensions": none })).scene().materials[0].is_extended());
    let bad = json!({ "KHR_materials_iridescence": { "iridescenceThicknessMaximum": "thick" } });
    with_material(json!({ "extensions": bad })).fails(&["material 0", "iridescenceThicknessMaximum"]);
}

#[test]
fn diffuse_transmission_is_read() {
    let leaf = json!({
        "diffuseTransmissionFactor": 0.5, "diffuseTransmissionColorFactor": [0.25, 0.5, 1],
        "diffuseTransmissionTexture": { "index": 1 }, "diffuseTransmissionColorTexture": { "index": 1 },
    });
    let scene = textured(json!({ "extensions": { "KHR_materials_diffuse_transmission": leaf } })).scene();
    let material = &scene.materials[0];
    let read = (material.diffuse_transmission, material.diffuse_transmission_color);
    assert_eq!(read, (0.5, vec3(0.25, 0.5, 1.0)));
    let slots = [TextureSlot::DiffuseTransmission, TextureSlot::DiffuseTransmissionColor];
    assert_eq!(material.maps.keys().copied().collect::<Vec<_>>(), slots);
    assert_eq!((scene.not_shown.len(), scene.warnings.len()), (0, 0));
    assert!(material.casts_shadow && !material.is_single_sided());
    let none =
        json!({ "KHR_materials_diffuse_transmission": { "diffuseTransmissionTexture": { "index": 1 } } });
    assert!(!textured(json!({ "extensions": none })).scene().materials[0].is_extended());
    // Its volume absorbs where it has a thickness.
    for (thickness, absorbs) in [(1, true), (0, false)] {
        let volume = json!({ "thicknessFactor": thickness, "attenuationDistance": 2, "attenuationColor": [1, 0.5, 0.25] });
        let material = imported(json!({ "extensions": {
            "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 1 }, "KHR_materials_volume": volume,
        } }));
        assert_eq!(material.absorption != Vec3::ZERO, absorbs);
    }
    let bad = json!({ "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": "half" } });
    with_material(json!({ "extensions": bad })).fails(&["material 0", "diffuseTransmissionFactor"]);
}

#[test]
fn the_normal_map_of_a_coat_is_read() {
    let coat = |factor: f32| {
        let texture = json!({ "index": 1, "scale": 0.5 });
        let coat = json!({ "clearcoatFactor": factor, "clearcoatNormalTexture": texture });
        textured(json!({ "extensions": { "KHR_materials_clearcoat": coat } })).scene()
    };
    let scene = coat(1.0);
    let material = &scene.materials[0];
    assert_eq!(material.maps.keys().copied().collect::<Vec<_>>(), [TextureSlot::ClearcoatNormal]);
    assert_eq!((material.clearcoat_normal_scale, material.has_coat_normals()), (0.5, true));
    assert_eq!((scene.tangents.len(), scene.not_shown.len(), scene.warnings.len()), (1, 0, 0));
    assert!(coat(0.0).materials[0].maps.is_empty(), "no coat");
}

#[test]
fn dispersion_is_that_of_solids() {
    let glass = |thickness: u32, dispersion: Value| {
        with_material(json!({ "extensions": {
            "KHR_materials_transmission": { "transmissionFactor": 1 },
            "KHR_materials_volume": { "thicknessFactor": thickness },
            "KHR_materials_dispersion": { "dispersion": dispersion },
        } }))
    };
    let material = &glass(1, json!(0.5)).scene().materials[0];
    assert!(material.dispersion == 0.5 && material.is_dispersive() && material.is_extended());
    assert!(!glass(0, json!(0.5)).scene().materials[0].is_dispersive(), "a pane");
    glass(1, json!("much")).fails(&["material 0", "dispersion"]);
    let scene = glass(1, json!(1e9)).scene();
    assert!(scene.warnings[0].contains("its dispersion of 1000000000"), "{:?}", scene.warnings);
}

#[test]
fn a_bad_transform_is_named() {
    let transform = json!({ "KHR_texture_transform": { "scale": "large" } });
    let mut file = textured(json!({ "normalTexture": { "index": 0, "extensions": transform } }));
    file.fails(&["material 0, normal texture", "KHR_texture_transform"]);
    let huge = json!({ "KHR_texture_transform": { "scale": [1e30, 1] } });
    file.json["materials"][0] = json!({
        "emissiveTexture": { "index": 1 }, "occlusionTexture": { "index": 0, "extensions": huge },
    });
    file.fails(&["occlusion texture", "expected a transform"]);
}

/// The tangent frame as glTF has it: the tangent along u, the bitangent against v, which grows downwards.
#[test]
fn tangents_come_from_the_file_or_are_computed() {
    let mut file = textured(json!({ "normalTexture": { "index": 0 } }));
    let frame = |scene: &Scene| {
        let (tangent, sign) = tangent_decode_exact(scene.tangents[0][1]);
        (tangent.as_vec3(), sign)
    };
    let near = |(tangent, sign): (Vec3, f64), expected: Vec3, flipped: f64| {
        assert!((tangent - expected).length() < 2.0e-4 && sign == flipped, "{tangent} {sign}");
    };
    // Here v grows upwards.
    near(frame(&file.scene()), Vec3::X, -1.0);
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    let of_file = [0.0, 1.0, 0.0, 1.0].repeat(3);
    let tangents = file.floats("VEC4", &of_file);
    file.attribute("TANGENT", tangents);
    near(frame(&file.scene()), Vec3::X, -1.0);
    file.attribute("NORMAL", normals);
    near(frame(&file.scene()), Vec3::Y, 1.0);
    // A mirrored node: x turns round, and so does the order of the corners; bumps stay bumps.
    file.json["nodes"][0]["scale"] = json!([-1, 1, 1]);
    near(frame(&file.scene()), Vec3::Y, -1.0);
    file.json["nodes"][0]["scale"] = json!([1, 1, 1]);
    let nothing = file.floats("VEC4", &[0.0; 12]);
    file.attribute("TANGENT", nothing);
    near(frame(&file.scene()), Vec3::X, -1.0);
    file.json["materials"][0] = json!({ "emissiveTexture": { "index": 0 } });
    assert!(file.scene().tangents.is_empty(), "only where there is a normal map");
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
    file.json["textures"][0] = json!({ "extensions": { "EXT_texture_avif": { "source": 0 } } });
    let scene = file.scene();
    assert_eq!(scene.materials[0].base_color_texture, None);
    assert!(scene.warnings[0].contains("no image in PNG, JPEG"), "{:?}", scene.warnings);

    let mut file =
        textured(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "texCoord": 3 } } }));
    let scene = file.scene();
    assert!(scene.warnings[0].contains("without TEXCOORD_3"), "{:?}", scene.warnings);
    assert!(scene.texcoords.is_empty() || scene.texcoords.len() == 1);

    file.json["materials"] = json!([{ "extensions": {
        "KHR_materials_transmission": { "transmissionFactor": 1, "transmissionTexture": { "index": 0 } },
        "KHR_materials_volume": { "attenuationDistance": 2, "attenuationColor": [1, 0, 0] },
    }}]);
    let scene = file.scene();
    let told: Vec<_> = scene.not_shown.iter().map(|not_shown| not_shown.feature.as_str()).collect();
    assert!(!told.contains(&"KHR_materials_volume.attenuationColor"), "a volume without thickness: {told:?}");
    assert_eq!(scene.warnings, [""; 0], "both are shown");
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

#[test]
fn extras_give_the_priority_of_a_solid() {
    let with = |extras: Value| with_material(json!({ "extras": extras }));
    assert_eq!(with(json!({ "priority": -3, "author": "me" })).scene().materials[0].priority, -3);
    assert_eq!(with(json!({ "author": "me" })).scene().materials[0].priority, 0);
    for bad in [json!(128), json!(0.5), json!("high"), json!(null)] {
        let scene = with(json!({ "priority": bad })).scene();
        assert_eq!(scene.materials[0].priority, 0);
        let told = format!("material 0: extras.priority: expected an integer from -128 to 127, found {bad}");
        assert!(scene.warnings.iter().any(|warning| warning.starts_with(&told)), "{:?}", scene.warnings);
    }
}
