//! Feeds bytes to the importer: the result is an error of one readable line, or a valid scene.
//!
//! Input that begins with `patch` is read as patches of a valid document; other input is a file in which every URI
//! names the file itself.

#![no_main]

mod document;

use arbitrary::Unstructured;
use glimpse::{Error, Scene};
use libfuzzer_sys::fuzz_target;

/// Upper bound on the length of an error message, in bytes.
const LINE: usize = 900;

fuzz_target!(|data: &[u8]| {
    let Some(patches) = data.strip_prefix(b"patch") else {
        return judge(Scene::from_gltf(data, &mut |_| Ok(data.to_vec())));
    };
    if let Ok(patched) = document::Patched::read(&mut Unstructured::new(patches)) {
        judge(Scene::from_gltf(&patched.text, &mut |name| patched.file(name)));
    }
});

fn judge(result: glimpse::Result<Scene>) {
    match result {
        Err(error) => {
            assert!(matches!(error, Error::Scene { .. }), "{error:?}");
            readable(&error.to_string());
        }
        Ok(scene) => {
            scene.validate().expect("what is imported is valid");
            scene.warnings.iter().for_each(|warning| readable(warning));
            assert!(!scene.positions.is_empty() && !scene.cameras.is_empty());
            let corners = scene.positions.iter().flatten().flat_map(|p| p.to_array());
            let texcoords = scene.texcoords.iter().flatten().flat_map(|t| t.to_array());
            for number in corners.chain(texcoords) {
                assert!(number.is_finite() && !number.is_subnormal(), "{number:e}");
            }
        }
    }
}

fn readable(text: &str) {
    assert!(!text.is_empty() && text.len() <= LINE, "{} bytes: {text}", text.len());
    assert!(!text.contains(char::is_control), "{text:?}");
}
