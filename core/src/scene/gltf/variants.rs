//! KHR_materials_variants: sets of materials, of which one can be chosen by its name.

use gltf::json;
use json::mesh::Primitive;
use serde_json::Value;

use super::text::{MAX_NAME, clipped};
use crate::{Error, Result};

const NAME: &str = "KHR_materials_variants";

/// The names of the file's variants.
pub(super) fn names(root: &json::Root) -> Vec<String> {
    let extension = root.extensions.as_ref().and_then(|extensions| extensions.others.get(NAME));
    let variants = extension.and_then(|e| e.get("variants")).and_then(Value::as_array);
    let name = |(i, variant): (usize, &Value)| match variant.get("name").and_then(Value::as_str) {
        Some(name) => clipped(name, MAX_NAME),
        None => format!("variant{i}"),
    };
    variants.into_iter().flatten().enumerate().map(name).collect()
}

/// The index of the variant of this name.
pub(super) fn index_of(names: &[String], name: &str) -> Result<usize> {
    let wanted = clipped(name, MAX_NAME);
    names.iter().position(|known| *known == wanted).ok_or_else(|| {
        let known = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
        Error::setting("variant", format!("a variant of the file, which has {known}"), name)
    })
}

/// The material of a primitive in a variant, or without one; `None` is glTF's default material.
pub(super) fn material(primitive: &Primitive, variant: Option<usize>, what: &str) -> Result<Option<usize>> {
    let default = primitive.material.map(|material| material.value());
    let extension = primitive.extensions.as_ref().and_then(|extensions| extensions.others.get(NAME));
    let mappings = extension.and_then(|e| e.get("mappings")).and_then(Value::as_array);
    let Some((variant, mappings)) = variant.zip(mappings) else { return Ok(default) };
    let chosen = mappings.iter().find(|mapping| {
        let variants = mapping.get("variants").and_then(Value::as_array);
        variants.into_iter().flatten().any(|index| index.as_u64() == Some(variant as u64))
    });
    let Some(chosen) = chosen else { return Ok(default) };
    let material = chosen.get("material").unwrap_or(&Value::Null);
    let index = material.as_u64().and_then(|index| usize::try_from(index).ok());
    let wrong =
        || Error::scene(format!("{what}, {NAME}"), format!("expected a material's index, found {material}"));
    index.ok_or_else(wrong).map(Some)
}
