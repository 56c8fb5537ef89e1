//! What of glTF is supported, and what of a file that leaves unshown.
//!
//! [`table`] lists the core's properties and [`extensions`] the extensions; each line says whether it is shown.
//! [`Survey::of`] walks what the file's scene shows along this table. It keeps the properties that are shown, which are
//! all that the rest of the import reads, and counts the others where they would have changed the picture. What a
//! scene does not use, and what is not shown, may therefore be anything.

mod extensions;
mod table;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde_json::{Map, Value};

use super::text::{MAX_NAME, clipped};
use crate::scene::NotShown;
use crate::{Error, Result};
use extensions::EXTENSIONS;
use table::{LISTS, ROOT, SCENES};

/// Whether a value is there that changes what is shown. The value is null where the property is absent.
type Effect = fn(&Value, &Site<'_>) -> bool;

/// How far a property or an extension is supported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Support {
    /// As the specification has it.
    Shown,
    /// Not read, as nothing that is shown depends on it.
    Ignored,
    /// Not read: told where it has an effect.
    NotShown,
    /// Not read: without it the scene cannot be drawn, so that a file is refused where it has an effect.
    Needed,
}

/// A kind of JSON object.
struct Object {
    name: &'static str,
    properties: &'static [Property],
}

/// A property of a kind of object. A name that ends in `_n` stands for all with a number there.
struct Property {
    name: &'static str,
    support: Support,
    effect: Effect,
    holds: Holds,
    /// The JSON text that stands for it where the JSON types demand it, though the file lacks it or nothing reads it.
    demanded: Option<&'static str>,
}

/// An extension.
struct Extension {
    name: &'static str,
    support: Support,
    effect: Effect,
    object: Option<&'static Object>,
}

/// The value of a property.
#[derive(Clone, Copy)]
enum Holds {
    Data,
    Object(&'static Object),
    Objects(&'static Object),
    /// An index into a list.
    Index(&'static List),
    /// Any nesting of arrays of indices into a list.
    Indices(&'static List),
    /// One of [`LISTS`], whose elements are kept where they are referred to.
    List,
    /// One of [`LISTS`], whose elements are kept all.
    Elements(&'static List),
}

/// A list of the document, whose elements others refer to by index.
struct List {
    /// JSON pointer to the list.
    pointer: &'static str,
    object: &'static Object,
    /// JSON text in place of elements that the scene does not use.
    unused: &'static str,
}

impl List {
    const fn new(pointer: &'static str, object: &'static Object, unused: &'static str) -> Self {
        Self { pointer, object, unused }
    }
}

const fn object(name: &'static str, properties: &'static [Property]) -> Object {
    Object { name, properties }
}

const fn property(name: &'static str, support: Support, effect: Effect) -> Property {
    Property { name, support, effect, holds: Holds::Data, demanded: None }
}

/// A property that is shown as the specification has it.
const fn shown(name: &'static str) -> Property {
    property(name, Support::Shown, never)
}

/// A property that changes nothing that is shown.
const fn ignored(name: &'static str) -> Property {
    property(name, Support::Ignored, never)
}

/// A property that is not shown, which is told where it has an effect.
const fn not_shown(name: &'static str, effect: Effect) -> Property {
    property(name, Support::NotShown, effect)
}

impl Property {
    const fn object(self, object: &'static Object) -> Self {
        Self { holds: Holds::Object(object), ..self }
    }

    const fn objects(self, object: &'static Object) -> Self {
        Self { holds: Holds::Objects(object), ..self }
    }

    const fn index(self, list: &'static List) -> Self {
        Self { holds: Holds::Index(list), ..self }
    }

    const fn indices(self, list: &'static List) -> Self {
        Self { holds: Holds::Indices(list), ..self }
    }

    const fn list(self) -> Self {
        Self { holds: Holds::List, ..self }
    }

    const fn elements(self, list: &'static List) -> Self {
        Self { holds: Holds::Elements(list), ..self }
    }

    const fn demanded(self, text: &'static str) -> Self {
        Self { demanded: Some(text), ..self }
    }

    /// The property's names and values in an object; where it has none, its name without a value.
    fn found<'v>(&self, owner: &'v Map<String, Value>) -> Vec<(&'v str, &'v Value)> {
        match self.name.strip_suffix('n') {
            Some(stem) if stem.ends_with('_') => {
                let numbered = |name: &str| name.strip_prefix(stem).is_some_and(|n| n.parse::<u32>().is_ok());
                owner.iter().filter(|(name, _)| numbered(name)).map(|(n, v)| (n.as_str(), v)).collect()
            }
            _ => owner
                .get_key_value(self.name)
                .map(|(name, value)| (name.as_str(), value))
                .into_iter()
                .collect(),
        }
    }
}

const fn extension(name: &'static str, support: Support, effect: Effect) -> Extension {
    Extension { name, support, effect, object: None }
}

const fn shown_extension(name: &'static str) -> Extension {
    extension(name, Support::Shown, never)
}

const fn ignored_extension(name: &'static str) -> Extension {
    extension(name, Support::Ignored, never)
}

/// An extension without which the scene can be drawn, told where it has an effect.
const fn not_shown_extension(name: &'static str, effect: Effect) -> Extension {
    extension(name, Support::NotShown, effect)
}

/// An extension without which the scene cannot be drawn where it has an effect.
const fn needed_extension(name: &'static str, effect: Effect) -> Extension {
    extension(name, Support::Needed, effect)
}

impl Extension {
    const fn object(self, object: &'static Object) -> Self {
        Self { object: Some(object), ..self }
    }
}

/// The place of a value in the document.
struct Site<'v> {
    root: &'v Value,
    /// The object that has the property or the extension.
    owner: &'v Map<String, Value>,
}

impl<'v> Site<'v> {
    /// The element of one of the document's lists.
    fn element(&self, pointer: &str, index: &Value) -> Option<&'v Value> {
        element(self.root, pointer, usize::try_from(index.as_u64()?).ok()?)
    }
}

fn never(_: &Value, _: &Site<'_>) -> bool {
    false
}

/// Whether the property is there.
fn present(value: &Value, _: &Site<'_>) -> bool {
    !value.is_null()
}

fn element<'v>(root: &'v Value, pointer: &str, index: usize) -> Option<&'v Value> {
    root.pointer(pointer)?.get(index)
}

/// An element of a list of the document; `None` stands for the file.
type Place = Option<(&'static List, usize)>;

/// The walk over what a document's scene shows.
pub(super) struct Survey<'v> {
    root: &'v Value,
    /// What is kept of the elements of [`LISTS`]; `None` where the scene does not use them.
    kept: Vec<Vec<Option<Value>>>,
    waiting: Vec<(&'static List, usize)>,
    not_shown: BTreeMap<String, NotShown>,
    /// The first place that cannot be drawn without an extension, and this extension.
    needed: Option<(String, &'static str)>,
}

impl<'v> Survey<'v> {
    /// Returns what is shown of a document, and what is not.
    ///
    /// # Errors
    /// Fails where the file requires or needs an extension without which it cannot be drawn.
    pub fn of(root: &'v Value) -> Result<(Value, Vec<NotShown>)> {
        required(root)?;
        let length = |list: &&List| root.pointer(list.pointer).and_then(Value::as_array).map_or(0, Vec::len);
        let kept = LISTS.iter().map(|list| vec![None; length(list)]).collect();
        let (waiting, not_shown) = (Vec::new(), BTreeMap::new());
        let mut survey = Self { root, kept, waiting, not_shown, needed: None };
        let mut document = match root.as_object() {
            Some(members) => survey.object(&ROOT, members, None),
            None => root.clone(),
        };
        survey.start();
        while let Some((list, index)) = survey.waiting.pop() {
            survey.element(list, index);
        }
        survey.unknown_extensions();
        for (list, elements) in LISTS.into_iter().zip(std::mem::take(&mut survey.kept)) {
            let unused = json(list.unused);
            let elements = elements.into_iter().map(|element| element.unwrap_or_else(|| unused.clone()));
            insert(&mut document, list.pointer, elements.collect());
        }
        match survey.needed {
            Some((place, name)) => Err(Error::scene(
                place,
                format!("it cannot be drawn without the extension {name}, which is not supported"),
            )),
            None => Ok((document, survey.not_shown.into_values().collect())),
        }
    }

    /// Starts with the scene that is shown, or with the nodes without a parent.
    fn start(&mut self) {
        let scenes = self.root.pointer(SCENES.pointer).and_then(Value::as_array);
        if scenes.is_some_and(|scenes| !scenes.is_empty()) {
            let shown = self.root.get("scene").map_or(Some(0), Value::as_u64);
            self.waiting.extend(shown.and_then(|shown| usize::try_from(shown).ok()).map(|i| (&SCENES, i)));
            return;
        }
        let nodes = self.root.get("nodes").and_then(Value::as_array).into_iter().flatten();
        let lists = nodes.clone().filter_map(|node| node.get("children")?.as_array());
        let children: std::collections::HashSet<_> = lists.flatten().filter_map(Value::as_u64).collect();
        let orphans = (0..nodes.count()).rev().filter(|node| !children.contains(&(*node as u64)));
        self.waiting.extend(orphans.map(|node| (&table::NODES, node)));
    }

    /// Keeps an element of a list, once.
    fn element(&mut self, list: &'static List, index: usize) {
        let Some(place) = LISTS.iter().position(|other| std::ptr::eq(*other, list)) else { return };
        let Some(value) = element(self.root, list.pointer, index) else { return };
        if self.kept[place].get(index).is_none_or(Option::is_some) {
            return;
        }
        self.kept[place][index] = Some(match value.as_object() {
            Some(members) => self.object(list.object, members, Some((list, index))),
            None => value.clone(),
        });
    }

    /// What is shown of an object.
    fn object(&mut self, object: &'static Object, owner: &'v Map<String, Value>, place: Place) -> Value {
        let site = Site { root: self.root, owner };
        let mut kept = Map::new();
        for property in object.properties {
            let found = property.found(owner);
            if found.is_empty() {
                if (property.effect)(&Value::Null, &site) {
                    self.tell(format!("{}.{}", object.name, property.name), place);
                }
                kept.extend(property.demanded.map(|text| (property.name.to_owned(), json(text))));
            }
            for (name, value) in found {
                if let Some(value) = self.property(object, property, value, &site, place) {
                    kept.insert(name.to_owned(), value);
                }
            }
        }
        if let Some(extensions) = self.extensions(&site, place) {
            kept.insert("extensions".to_owned(), extensions);
        }
        Value::Object(kept)
    }

    /// What is shown of a property; `None` if nothing.
    fn property(
        &mut self,
        object: &'static Object,
        property: &'static Property,
        value: &'v Value,
        site: &Site<'v>,
        place: Place,
    ) -> Option<Value> {
        let places: Vec<_> = match (property.holds, value) {
            (Holds::Elements(list), Value::Array(all)) => {
                all.iter().enumerate().map(|(i, element)| (Some((list, i)), element)).collect()
            }
            _ => vec![(place, value)],
        };
        for (place, _) in places.into_iter().filter(|(_, value)| (property.effect)(value, site)) {
            self.tell(format!("{}.{}", object.name, property.name), place);
        }
        // Names are for messages only.
        if property.support != Support::Shown || property.name == "name" && !value.is_string() {
            return property.demanded.map(json);
        }
        Some(match (property.holds, value) {
            (Holds::List, _) => return None,
            (Holds::Elements(list), _) => {
                self.waiting.extend(value.as_array().map_or(0..0, |all| 0..all.len()).map(|i| (list, i)));
                return None;
            }
            (Holds::Object(object), Value::Object(members)) => self.object(object, members, place),
            (Holds::Objects(object), Value::Array(all)) => all
                .iter()
                .map(|value| match value.as_object() {
                    Some(members) => self.object(object, members, place),
                    None => value.clone(),
                })
                .collect(),
            (Holds::Index(list) | Holds::Indices(list), _) => {
                self.refer(list, value);
                value.clone()
            }
            _ => value.clone(),
        })
    }

    fn refer(&mut self, list: &'static List, value: &Value) {
        match value {
            Value::Array(all) => all.iter().rev().for_each(|value| self.refer(list, value)),
            _ => {
                let index = value.as_u64().and_then(|index| usize::try_from(index).ok());
                self.waiting.extend(index.map(|index| (list, index)));
            }
        }
    }

    /// What is shown of an object's extensions; `None` if nothing.
    fn extensions(&mut self, site: &Site<'v>, place: Place) -> Option<Value> {
        let mut kept = Map::new();
        for (name, value) in site.owner.get("extensions")?.as_object()? {
            let Some(extension) = EXTENSIONS.iter().find(|e| e.name == name) else {
                self.tell(clipped(name, MAX_NAME), place);
                continue;
            };
            let has_effect = (extension.effect)(value, site);
            match extension.support {
                Support::Needed if has_effect && self.needed.is_none() => {
                    self.needed = Some((self.name(place), extension.name));
                }
                Support::Shown | Support::NotShown if has_effect => self.tell(name.clone(), place),
                _ => {}
            }
            if extension.support == Support::Shown {
                let value = match (extension.object, value) {
                    (Some(object), Value::Object(members)) => self.object(object, members, place),
                    _ => value.clone(),
                };
                kept.insert(name.clone(), value);
            }
        }
        (!kept.is_empty()).then_some(Value::Object(kept))
    }

    /// Tells of the extensions that the file uses, but are not known.
    fn unknown_extensions(&mut self) {
        let used = self.root.get("extensionsUsed").and_then(Value::as_array).into_iter().flatten();
        for name in used.filter_map(Value::as_str) {
            let name = clipped(name, MAX_NAME);
            if !EXTENSIONS.iter().any(|e| e.name == name) && !self.not_shown.contains_key(&name) {
                self.tell(name, None);
            }
        }
    }

    /// Counts an occurrence of a feature that is not shown.
    fn tell(&mut self, feature: String, place: Place) {
        let place = self.name(place);
        let told = self.not_shown.entry(feature).or_insert_with_key(|feature| NotShown {
            feature: feature.clone(),
            count: 0,
            places: Vec::new(),
        });
        told.count += 1;
        if told.places.len() < NotShown::PLACES && told.places.last() != Some(&place) {
            told.places.push(place);
        }
    }

    /// Name of an element, such as `material 3 `Glass``.
    fn name(&self, place: Place) -> String {
        let Some((list, index)) = place else { return "file".to_owned() };
        let kind = list.object.name.rsplit('.').next().unwrap_or_default();
        let name = element(self.root, list.pointer, index).and_then(|element| element.get("name")?.as_str());
        match name {
            Some(name) => format!("{kind} {index} `{}`", clipped(name, MAX_NAME)),
            None => format!("{kind} {index}"),
        }
    }
}

/// Fails for required extensions without which nothing can be drawn, and for unknown ones.
fn required(root: &Value) -> Result<()> {
    let required = root.get("extensionsRequired").and_then(Value::as_array).into_iter().flatten();
    for name in required.filter_map(Value::as_str) {
        let known = EXTENSIONS.iter().find(|extension| extension.name == name);
        if known.is_none_or(|extension| extension.support == Support::Needed) {
            let shown = EXTENSIONS.iter().filter(|e| e.support == Support::Shown).map(|e| e.name);
            return Err(Error::scene(
                format!("required extension {name}"),
                format!("not supported; those that are: {}", shown.collect::<Vec<_>>().join(", ")),
            ));
        }
    }
    Ok(())
}

/// The value of a JSON text of the tables.
fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_default()
}

/// Puts a list into the document, unless it is empty and nothing there has it.
fn insert(document: &mut Value, pointer: &str, elements: Vec<Value>) {
    let (parents, name) = pointer.rsplit_once('/').unwrap_or_default();
    if elements.is_empty() && document.pointer(parents).is_none() {
        return;
    }
    let parent = parents.split('/').skip(1).fold(document, |object, name| &mut object[name]);
    if parent.is_object() || parent.is_null() {
        parent[name] = Value::Array(elements);
    }
}
