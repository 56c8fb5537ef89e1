//! Reads the JSON text of a file: what of it is shown, in the JSON types of the `gltf` crate.

use std::borrow::Cow;

use gltf::json;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::json_text;
use super::support::Survey;
use super::text::{MAX_NAME, clipped};
use crate::scene::NotShown;
use crate::{Error, Result};

/// The version of glTF that is read.
const VERSION: (u32, u32) = (2, 0);

/// What is read of a file's JSON.
pub(super) struct Document {
    /// What [`Survey::of`] keeps of the JSON.
    pub value: Value,
    /// The same in types.
    pub root: json::Root,
    pub not_shown: Vec<NotShown>,
    pub warnings: Vec<String>,
}

impl Document {
    /// Reads a JSON text.
    pub fn read(text: &[u8]) -> Result<Self> {
        let mut warnings = Vec::new();
        let text = String::from_utf8_lossy(text);
        if matches!(text, Cow::Owned(_)) {
            warnings.push("what of its JSON is not UTF-8 is replaced by U+FFFD".to_owned());
        }
        let mut whole = json_text::read(&text).map_err(|e| other_data(&text, &e))?;
        drop(text);
        version(&whole)?;
        hide(&mut whole);
        let (value, not_shown) = Survey::of(&whole)?;
        drop(whole);
        let root = json::Root::deserialize(&value).map_err(|e| misplaced(&value, &e))?;
        Ok(Self { value, root, not_shown, warnings })
    }
}

/// Names what the file holds instead of JSON.
fn other_data(text: &str, error: &serde_json::Error) -> Error {
    let start = text.trim_start();
    let starts = |with: &[&str]| with.iter().any(|with| start.starts_with(with));
    let found = if start.is_empty() {
        "an empty file".to_owned()
    } else if starts(&["version https://git-lfs"]) {
        "a Git LFS pointer: `git lfs pull` fetches the file itself".to_owned()
    } else if starts(&["{", "["]) {
        format!("JSON that is not valid: {error}")
    } else if starts(&["<!DOCTYPE", "<!doctype", "<html", "<HTML"]) {
        "a web page".to_owned()
    } else if starts(&["PK\x03\x04"]) {
        "a ZIP archive".to_owned()
    } else if starts(&["Kaydara FBX"]) {
        "an FBX file".to_owned()
    } else {
        format!("other data, which starts with `{}`", clipped(start, 16))
    };
    Error::scene("file", format!("expected glTF 2.0 (a .glb header or JSON), found {found}"))
}

/// Fails for other major versions, and for a `minVersion` above [`VERSION`].
fn version(document: &Value) -> Result<()> {
    let Some(asset) = document.get("asset") else {
        let old = ["techniques", "programs", "shaders"].iter().any(|name| document.get(name).is_some());
        let found = if old { "glTF 1.0" } else { "JSON without `asset`" };
        return Err(Error::scene("file", format!("expected glTF 2.0, found {found}")));
    };
    let number = |text: &str| {
        let (major, minor) = text.split_once('.').unwrap_or((text, "0"));
        Some((major.parse().ok()?, minor.parse().ok()?))
    };
    let stated = |name: &str| asset.get(name).and_then(Value::as_str);
    for name in ["version", "minVersion"] {
        let Some(text) = stated(name) else { continue };
        let version: Option<(u32, u32)> = number(text);
        let fits = version.is_some_and(|(major, minor)| match name {
            "version" => major == VERSION.0,
            _ => (major, minor) <= VERSION,
        });
        if !fits {
            return Err(Error::scene(
                format!("asset.{name}"),
                format!("expected version 2.0 of glTF, found `{}`", clipped(text, MAX_NAME)),
            ));
        }
    }
    Ok(())
}

/// Takes meshes and lights from nodes that KHR_node_visibility hides, and from those below them.
fn hide(document: &mut Value) {
    let Some(nodes) = document.get_mut("nodes").and_then(Value::as_array_mut) else { return };
    let hides =
        |node: &Value| node.pointer("/extensions/KHR_node_visibility/visible") == Some(&Value::Bool(false));
    let mut hidden: Vec<usize> = (0..nodes.len()).filter(|i| hides(&nodes[*i])).collect();
    let mut seen = vec![false; if hidden.is_empty() { 0 } else { nodes.len() }];
    while let Some(index) = hidden.pop() {
        let Some(node) = nodes.get_mut(index).and_then(Value::as_object_mut) else { continue };
        if std::mem::replace(&mut seen[index], true) {
            continue;
        }
        node.remove("mesh");
        if let Some(extensions) = node.get_mut("extensions").and_then(Value::as_object_mut) {
            extensions.remove("KHR_lights_punctual");
        }
        let children = node.get("children").and_then(Value::as_array).into_iter().flatten();
        hidden.extend(children.filter_map(|child| usize::try_from(child.as_u64()?).ok()));
    }
}

/// Names the element that does not have the form that the specification demands.
fn misplaced(document: &Value, error: &serde_json::Error) -> Error {
    fn first<T: DeserializeOwned>(document: &Value, list: &str) -> Option<(String, serde_json::Error)> {
        let elements = document.get(list).and_then(Value::as_array).into_iter().flatten().enumerate();
        let mut failing = elements.filter_map(|(i, element)| {
            let error = T::deserialize(element).err()?;
            let name = element.get("name").and_then(Value::as_str);
            let name = name.map_or_else(String::new, |name| format!(" `{}`", clipped(name, MAX_NAME)));
            Some((format!("{list}[{i}]{name}"), error))
        });
        failing.next()
    }
    let found = first::<json::Accessor>(document, "accessors")
        .or_else(|| first::<json::Buffer>(document, "buffers"))
        .or_else(|| first::<json::buffer::View>(document, "bufferViews"))
        .or_else(|| first::<json::Camera>(document, "cameras"))
        .or_else(|| first::<json::Image>(document, "images"))
        .or_else(|| first::<json::Material>(document, "materials"))
        .or_else(|| first::<json::Mesh>(document, "meshes"))
        .or_else(|| first::<json::Node>(document, "nodes"))
        .or_else(|| first::<json::texture::Sampler>(document, "samplers"))
        .or_else(|| first::<json::Scene>(document, "scenes"))
        .or_else(|| first::<json::Skin>(document, "skins"))
        .or_else(|| first::<json::Texture>(document, "textures"));
    match found {
        Some((place, error)) => Error::scene(place, format!("expected glTF 2.0, found other JSON: {error}")),
        None => Error::scene("file", format!("expected glTF 2.0, found other JSON: {error}")),
    }
}
