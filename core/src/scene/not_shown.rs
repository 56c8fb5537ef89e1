//! What of a file the picture does not show.

use std::fmt::{self, Display, Formatter};

use serde::Serialize;

use super::{LEAST_ROUGHNESS, Material, Scene};
use crate::settings::Method;

/// A feature of a file's format that the picture does not show as the format's specification has it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NotShown {
    /// The property as `object.property`, or the extension's name.
    pub feature: String,
    /// Number of its occurrences in what the scene shows.
    pub count: usize,
    /// The first few elements of the file that have it.
    #[serde(rename = "where")]
    pub places: Vec<String>,
}

impl NotShown {
    /// The most places that are named.
    pub(crate) const PLACES: usize = 4;
}

/// One line: the feature, how many times it occurs, and where.
impl Display for NotShown {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let times = if self.count == 1 { "once" } else { &format!("{} times", self.count) };
        let more = if self.count > self.places.len() { ", ..." } else { "" };
        write!(f, "{}, {times}: {}{more}", self.feature, self.places.join(", "))
    }
}

/// A feature, and whether a material has it.
type OfMaterial = (&'static str, fn(&Material) -> bool);

/// What Whitted methods approximate of materials without explicit weights.
const BY_WHITTED: [OfMaterial; 2] = [
    ("rough refraction, which is smooth in all methods but path and vr", |material| {
        material.weights.is_none() && material.refracts() && material.roughness >= LEAST_ROUGHNESS
    }),
    ("dispersion, which path and vr alone show", Material::is_dispersive),
];

impl Scene {
    /// What the pictures of a method show of the scene otherwise than its file has it, besides what no method shows
    /// ([`Scene::not_shown`]); the places are names of objects.
    #[must_use]
    pub fn not_shown_by(&self, method: Method) -> Vec<NotShown> {
        if method.is_path_traced() {
            return Vec::new();
        }
        let of = |(feature, concerns): OfMaterial| {
            let concerned: Vec<_> = self.materials.iter().map(concerns).collect();
            let has = |object: &&super::Object| concerned.get(object.material as usize) == Some(&true);
            let count = self.objects.iter().filter(has).count();
            let places = self
                .objects
                .iter()
                .filter(has)
                .take(NotShown::PLACES)
                .map(|object| object.name.clone())
                .collect();
            (count > 0).then(|| NotShown { feature: feature.to_owned(), count, places })
        };
        BY_WHITTED.into_iter().filter_map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Object;

    #[test]
    fn whitted_methods_say_what_paths_show_alone() {
        let glass = Material { transmission: 1.0, roughness: 0.3, ..Material::default() };
        let prism = Material { dispersion: 1.0, thin: false, roughness: 0.0, ..glass.clone() };
        let smooth = Material { roughness: 0.0, ..glass.clone() };
        let names = ["frosted", "prism", "clear"];
        let objects = (0..).zip(names).map(|(material, name)| Object { name: name.to_owned(), material });
        let scene =
            Scene { materials: vec![glass, prism, smooth], objects: objects.collect(), ..Scene::default() };
        let told = scene.not_shown_by(Method::Adaptive);
        let places: Vec<_> = told.iter().map(|told| (told.count, told.places.clone())).collect();
        assert_eq!(places, [(1, vec!["frosted".to_owned()]), (1, vec!["prism".to_owned()])]);
        assert!(told[0].feature.contains("rough refraction") && told[1].feature.contains("dispersion"));
        assert_eq!(scene.not_shown_by(Method::Path), []);
    }

    #[test]
    fn a_line_says_what_how_often_and_where() {
        let (feature, places) = ("KHR_materials_sheen".to_owned(), vec!["material 0 `A`".to_owned()]);
        let once = NotShown { feature, count: 1, places };
        assert_eq!(once.to_string(), "KHR_materials_sheen, once: material 0 `A`");
        let twice = NotShown { count: 2, ..once };
        assert_eq!(twice.to_string(), "KHR_materials_sheen, 2 times: material 0 `A`, ...");
    }
}
