//! EXT_lights_image_based.

use glam::DVec3;
use serde_json::{Value, json};

use super::{File, data_uri, png};
use crate::scene::{EnvironmentMap, Scene};

const AXES: [DVec3; 6] = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];

/// A triangle in the light of six images.
fn lit(images: &[Vec<u8>; 6]) -> File {
    let mut file = File::triangle();
    file.json["images"] = images.iter().map(|image| json!({ "uri": data_uri("image/png", image) })).collect();
    file.json["scenes"][0]["extensions"]["EXT_lights_image_based"] = json!({ "light": 0 });
    file.json["extensions"]["EXT_lights_image_based"]["lights"] = json!([{
        "irradianceCoefficients": vec![[0.0; 3]; 9],
        "specularImageSize": 4,
        "specularImages": [[0, 1, 2, 3, 4, 5], [9, 9, 9, 9, 9, 9]],
    }]);
    file
}

fn light(file: &mut File) -> &mut Value {
    &mut file.json["extensions"]["EXT_lights_image_based"]["lights"][0]
}

/// Six faces of one colour each.
fn colors() -> [Vec<u8>; 6] {
    [0, 1, 2, 3, 4, 5].map(|face| png(4, 4, [40 * face, 255 - 40 * face, 10, 255]))
}

fn map(scene: Scene) -> EnvironmentMap {
    assert!(!scene.is_lit_by_studio);
    assert_eq!(scene.not_shown, []);
    scene.environment_map.unwrap()
}

fn byte(radiance: DVec3) -> [f64; 3] {
    let encode = |c: f64| if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
    radiance.to_array().map(|c| (255.0 * encode(c)).round())
}

#[test]
fn each_face_is_seen_along_its_axis() {
    let map = map(lit(&colors()).scene());
    for (face, axis) in (0..).zip(AXES) {
        let expected = [40.0 * f64::from(face), 255.0 - 40.0 * f64::from(face), 10.0];
        assert_eq!(byte(map.radiance(axis)), expected, "{axis}");
    }
}

/// Each image is what is seen from the middle, so that a point of the world on an edge has one colour on both faces.
#[test]
fn faces_continue_over_their_edges() {
    // The colour of a direction is its coordinates, by the formulas of the extension's figure for each face.
    let side = 16;
    let along = |x: u32| (2.0 * f64::from(x) + 1.0) / f64::from(side) - 1.0;
    let faces: [fn(f64, f64) -> [f64; 3]; 6] = [
        |u, v| [1.0, -v, u],
        |u, v| [-1.0, -v, -u],
        |u, v| [-u, 1.0, v],
        |u, v| [-u, -1.0, -v],
        |u, v| [-u, -v, 1.0],
        |u, v| [u, -v, -1.0],
    ];
    let images = faces.map(|direction| {
        let pixel = |x, y| {
            let color = direction(along(x), along(y)).map(|c| (127.5 + 127.5 * c).round() as u8);
            image::Rgb(color)
        };
        let mut bytes = std::io::Cursor::new(Vec::new());
        image::RgbImage::from_fn(side, side, pixel).write_to(&mut bytes, image::ImageFormat::Png).unwrap();
        bytes.into_inner()
    });
    let map = map(lit(&images).scene());
    for i in 0..500 {
        let (z, angle) = (1.0 - 2.0 * (f64::from(i) + 0.5) / 500.0, 2.4 * f64::from(i));
        let direction = (DVec3::new(angle.cos(), angle.sin(), 0.0) * (1.0 - z * z).sqrt()).with_z(z);
        let on_cube = direction / direction.abs().max_element();
        let expected = on_cube * 127.5 + 127.5;
        let error = (DVec3::from(byte(map.radiance(direction))) - expected).abs().max_element();
        assert!(error < 255.0 / f64::from(side), "{direction}: {error} is more than a texel");
    }
}

#[test]
fn the_light_is_turned_and_scaled() {
    let mut file = lit(&colors());
    let half = std::f64::consts::FRAC_1_SQRT_2;
    // A quarter turn about +X takes +Y to +Z.
    light(&mut file)["rotation"] = json!([half, 0, 0, half]);
    light(&mut file)["intensity"] = json!(3.0);
    let turned = map(file.scene());
    let plain = map(lit(&colors()).scene());
    let error = (turned.radiance(DVec3::Z) - 3.0 * plain.radiance(DVec3::Y)).abs().max_element();
    assert!(error < 1e-5, "{error}");
}

#[test]
fn colours_are_divided_by_alpha() {
    let of = |alpha| map(lit(&[(); 6].map(|()| png(2, 2, [128, 0, 0, alpha]))).scene()).mean().x;
    assert!((of(51) / of(255) - 5.0).abs() < 1e-5, "{}", of(51));
    let scene = lit(&[(); 6].map(|()| png(2, 2, [128, 0, 0, 0]))).scene();
    assert!(scene.warnings[0].contains("alpha of 0"), "{:?}", scene.warnings);
    assert_eq!(map(scene).mean().x, of(1));
}

#[test]
fn coefficients_that_contradict_the_images_are_told() {
    let white = [(); 6].map(|()| png(2, 2, [255; 4]));
    let warnings = |first: f64| {
        let mut file = lit(&white);
        light(&mut file)["irradianceCoefficients"][0] = json!([first, first, first]);
        file.scene().warnings
    };
    // The irradiance of radiance 1 from everywhere is pi.
    assert_eq!(warnings(std::f64::consts::PI / 0.282_094_8), [""; 0]);
    let told = warnings(1.0);
    assert!(told[0].contains("image-based light 0") && told[0].contains("0.282"), "{told:?}");
}

#[test]
fn bad_lights_are_named() {
    let fails = |change: fn(&mut Value), parts: &[&str]| {
        let mut file = lit(&colors());
        change(light(&mut file));
        file.fails(&[&["image-based light 0"], parts].concat());
    };
    fails(|light| light["intensity"] = json!(-1), &["intensity", "-1"]);
    fails(|light| light["rotation"] = json!([0, 0, 0, 0]), &["quaternion"]);
    fails(|light| light["specularImages"] = json!([]), &["at least one level"]);
    fails(|light| light["specularImages"] = json!([[0, 1]]), &["six image indices"]);
    fails(|light| light["specularImages"] = json!([[0, 1, 2, 3, 4, 4.5]]), &["six image indices"]);
    let mut file = lit(&colors());
    file.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = json!(7);
    file.fails(&["7"]);
    let mut images = colors();
    images[3] = png(4, 2, [1; 4]);
    lit(&images).fails(&["image-based light 0", "(4, 2)"]);
}

#[test]
fn a_light_whose_image_is_missing_is_left_out() {
    let mut file = lit(&colors());
    file.json["images"][2] = json!({ "uri": "gone.png" });
    let scene = file.scene();
    assert!(scene.is_lit_by_studio);
    assert!(scene.warnings.iter().any(|w| w.contains("gone.png")), "{:?}", scene.warnings);
    assert!(scene.warnings.iter().any(|w| w.contains("image-based light 0 is left out")));
}

#[test]
fn lights_of_other_scenes_light_nothing() {
    let mut file = lit(&colors());
    file.json["scenes"][0]["extensions"] = json!({});
    assert!(file.scene().is_lit_by_studio);
}
