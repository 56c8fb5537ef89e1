//! `glimpse info`: the contents of a scene and what specialization leaves out of its kernels.

use glimpse::glam::{DVec3, Vec3};
use glimpse::scene::{Light, LightKind, Material, NotShown, Thinness};
use glimpse::{Linked, Scene, Specialize};
use glimpse_measure::statistics::SceneStatistics;
use serde::Serialize;

use crate::args::InfoOptions;
use crate::output::{self, bytes, counted, listed};
use crate::summary::{self, row};

/// A scene in the output of `--json`.
#[derive(Serialize)]
struct Info {
    #[serde(flatten)]
    scene: SceneStatistics,
    bounds: Option<Bounds>,
    cameras: Vec<CameraInfo>,
    light_list: Vec<LightInfo>,
    materials: MaterialSummary,
    images: ImageSummary,
    saved: Saved,
    variants: Vec<String>,
    warnings: Vec<String>,
    not_shown: Vec<NotShown>,
}

/// Savings of specialization for a frame of method adaptive.
#[derive(Serialize)]
struct Saved {
    /// WGSL files left out of all kernels.
    files: Vec<&'static str>,
    /// Number of WGSL files without specialization.
    files_of: usize,
    /// Buffers and images that no kernel binds.
    bindings: Vec<String>,
    /// Number of bindings without specialization.
    bindings_of: usize,
    /// Bytes of attributes saved per two vertically adjacent samples.
    attribute_bytes: usize,
    /// These bytes without specialization.
    attribute_bytes_of: usize,
}

#[derive(Serialize)]
struct Bounds {
    low: [f64; 3],
    high: [f64; 3],
}

#[derive(Serialize)]
struct CameraInfo {
    index: usize,
    name: String,
    origin: [f64; 3],
    forward: [f32; 3],
    orthographic: bool,
}

#[derive(Serialize)]
struct LightInfo {
    kind: &'static str,
    position: Option<[f64; 3]>,
    direction: Option<[f32; 3]>,
    intensity: [f32; 3],
}

#[derive(Serialize)]
struct MaterialSummary {
    total: usize,
    textured: usize,
    reflecting: usize,
    refracting: usize,
    emissive: usize,
    unlit: usize,
    alpha_masked: usize,
}

#[derive(Serialize)]
struct ImageSummary {
    total: usize,
    bytes: u64,
}

/// Runs `glimpse info`.
pub fn run(options: &InfoOptions) -> anyhow::Result<()> {
    let scene = options.file.load(&options.scene, &mut |_, _| ())?;
    let info = Info::of(&options.scene.display().to_string(), scene)?;
    output::print(&if options.json { output::json(&info)? } else { info.text() })
}

impl Info {
    fn of(name: &str, scene: Scene) -> glimpse::Result<Self> {
        let count = |is: fn(&Material) -> bool| scene.materials.iter().filter(|m| is(m)).count();
        Ok(Self {
            saved: Saved::of(&scene)?,
            bounds: scene
                .bounds()
                .map(|(low, high)| Bounds { low: in_file(&scene, low), high: in_file(&scene, high) }),
            cameras: scene
                .cameras
                .iter()
                .enumerate()
                .map(|(index, (name, camera))| CameraInfo {
                    index,
                    name: name.clone(),
                    origin: in_file(&scene, camera.origin),
                    forward: camera.forward.into(),
                    orthographic: camera.orthographic,
                })
                .collect(),
            light_list: scene.lights.iter().map(|light| LightInfo::of(&scene, light)).collect(),
            materials: MaterialSummary {
                total: scene.materials.len(),
                textured: count(|m| m.textures().next().is_some()),
                reflecting: count(Material::reflects),
                refracting: count(Material::refracts),
                emissive: count(|m| m.emission.max_element() > 0.0),
                unlit: count(|m| m.unlit),
                alpha_masked: count(|m| m.alpha_cutoff.is_some()),
            },
            images: ImageSummary {
                total: scene.images.len(),
                bytes: scene.images.iter().map(|i| i.rgba.len() as u64).sum(),
            },
            scene: SceneStatistics::of(name, &scene, Specialize::Auto),
            variants: scene.variants,
            warnings: scene.warnings,
            not_shown: scene.not_shown,
        })
    }

    fn text(&self) -> String {
        let mut text = summary::scene(&self.scene);
        text += &row("linked", &listed(&self.scene.features));
        text += &row("saves", &self.saved.text());
        text += &row("bounds", &self.bounds.as_ref().map_or_else(|| "empty".to_owned(), Bounds::text));
        for camera in &self.cameras {
            let lens = if camera.orthographic { ", orthographic" } else { "" };
            text += &row(
                "camera",
                &format!("{} ({}) at {}{lens}", camera.index, camera.name, vector(camera.origin)),
            );
        }
        for light in &self.light_list {
            text += &row("light", &light.text());
        }
        let m = &self.materials;
        text += &row(
            "materials",
            &format!(
                "{}: {} textured, {} reflect, {} refract, {} emit, {} unlit, {} with holes",
                m.total, m.textured, m.reflecting, m.refracting, m.emissive, m.unlit, m.alpha_masked
            ),
        );
        text +=
            &row("images", &format!("{}, {}", counted(self.images.total, "image"), bytes(self.images.bytes)));
        if !self.variants.is_empty() {
            text += &row("variants", &self.variants.join(", "));
        }
        for warning in &self.warnings {
            text += &row("warning", warning);
        }
        for not_shown in &self.not_shown {
            text += &row("not shown", &not_shown.to_string());
        }
        text
    }
}

impl Saved {
    fn of(scene: &Scene) -> glimpse::Result<Self> {
        let thinness = Thinness::of(scene);
        let of = |specialize| Linked::of(scene, &thinness, specialize);
        let [auto, all] = [of(Specialize::Auto)?, of(Specialize::All)?];
        Ok(Self {
            files: all.files.difference(&auto.files).copied().collect(),
            files_of: all.files.len(),
            bindings: all.bindings.difference(&auto.bindings).cloned().collect(),
            bindings_of: all.bindings.len(),
            attribute_bytes: all.attribute_bytes - auto.attribute_bytes,
            attribute_bytes_of: all.attribute_bytes,
        })
    }

    fn text(&self) -> String {
        let names = |names: &[String]| {
            if names.is_empty() { String::new() } else { format!(" ({})", names.join(", ")) }
        };
        let stem = |file: &&str| file.rsplit('/').next().unwrap_or(file).trim_end_matches(".wgsl").to_owned();
        let files: Vec<_> = self.files.iter().map(stem).collect();
        format!(
            "{} of {} WGSL files{}, {} of {} bindings{}, {} of {} bytes of attributes every two samples",
            files.len(),
            self.files_of,
            names(&files),
            self.bindings.len(),
            self.bindings_of,
            names(&self.bindings),
            self.attribute_bytes,
            self.attribute_bytes_of
        )
    }
}

impl Bounds {
    fn text(&self) -> String {
        let sides: [f64; 3] = std::array::from_fn(|i| self.high[i] - self.low[i]);
        format!("{} to {}, sides {}", vector(self.low), vector(self.high), vector(sides))
    }
}

impl LightInfo {
    fn of(scene: &Scene, light: &Light) -> Self {
        let (kind, position, direction) = match &light.kind {
            LightKind::Point { position, .. } => ("point", Some(position), None),
            LightKind::Spot { position, direction, .. } => ("spot", Some(position), Some(direction)),
            LightKind::Directional { direction } => ("directional", None, Some(direction)),
        };
        Self {
            kind,
            position: position.map(|p| in_file(scene, *p)),
            direction: direction.map(|d| d.to_array()),
            intensity: light.intensity.into(),
        }
    }

    fn text(&self) -> String {
        let at = self.position.map_or_else(String::new, |p| format!(" at {}", vector(p)));
        let along =
            self.direction.map_or_else(String::new, |d| format!(" along {}", vector(d.map(f64::from))));
        format!("{}{at}{along}, intensity {}", self.kind, vector(self.intensity.map(f64::from)))
    }
}

/// A point in the file's coordinates. Where the scene has the same, the digits are those of its f32.
fn in_file(scene: &Scene, point: Vec3) -> [f64; 3] {
    if scene.origin == DVec3::ZERO {
        return point.to_array().map(|c| c.to_string().parse().unwrap_or(f64::from(c)));
    }
    scene.in_file(point).to_array()
}

fn vector(v: [f64; 3]) -> String {
    // Adding zero turns -0 into 0.
    let [x, y, z] = v.map(|c| format!("{}", (c * 1000.0).round() / 1000.0 + 0.0));
    format!("({x}, {y}, {z})")
}

#[cfg(test)]
mod tests {
    use glimpse::scene::{LightKind, Object, Sphere};

    use super::*;

    fn scene() -> Scene {
        let mirror = Material { roughness: 0.0, unlit: false, ..Material::default() };
        Scene {
            spheres: vec![Sphere { center: [1.0, 2.0, 3.0].into(), radius: 1.0, object: 0 }],
            objects: vec![Object { name: "ball".into(), material: 0 }],
            materials: vec![mirror, Material { unlit: true, ..Material::default() }],
            lights: vec![Light {
                kind: LightKind::Directional { direction: [0.0, -1.0, -0.0].into() },
                intensity: [1.0, 0.5, 0.25].into(),
                radius: 0.0,
            }],
            cameras: vec![("front".into(), glimpse::Camera::framing([0.0; 3].into(), [1.0; 3].into()))],
            variants: vec!["day".into(), "night".into()],
            warnings: vec!["mesh 7: lines are left out".into()],
            not_shown: vec![NotShown {
                feature: "node.skin".into(),
                count: 2,
                places: vec!["node 3".into()],
            }],
            ..Scene::default()
        }
    }

    #[test]
    fn text_tells_what_the_scene_holds() {
        let text = Info::of("ball.glb", scene()).unwrap().text();
        for expected in [
            "scene     ball.glb: 0 triangles, 1 sphere, 1 object, 1 light, 0 textures",
            "linked    glossy, spheres, reflection, lights",
            "texture_atlas, texture_mip, vertex_attributes, vertex_buffers, ",
            "), 4 of 14 bindings (atlas_color, atlas_data, probe_points, vertices), 56 of 72 bytes of attributes every two samples",
            "bounds    (0, 1, 2) to (2, 3, 4), sides (2, 2, 2)",
            "camera    0 (front) at",
            "light     directional along (0, -1, 0), intensity (1, 0.5, 0.25)",
            "materials 2: 0 textured, 1 reflect, 0 refract, 0 emit, 1 unlit, 0 with holes",
            "variants  day, night",
            "warning   mesh 7: lines are left out",
            "not shown node.skin, 2 times: node 3, ...",
        ] {
            assert!(text.contains(expected), "no `{expected}` in\n{text}");
        }
    }

    #[test]
    fn json_has_the_statistics_names() {
        let json = serde_json::to_value(Info::of("ball.glb", scene()).unwrap()).unwrap();
        assert_eq!(json["spheres"], 1);
        assert_eq!(json["cameras"][0]["name"], "front");
        assert_eq!(json["light_list"][0]["kind"], "directional");
        assert!(json["left_out"].as_array().unwrap().contains(&"textures".into()));
        assert_eq!(json["saved"]["attribute_bytes"], 56);
        let expected = serde_json::json!([{ "feature": "node.skin", "count": 2, "where": ["node 3"] }]);
        assert_eq!(json["not_shown"], expected);
        assert!(Info::of("", Scene::default()).unwrap().text().contains("bounds    empty"));
    }
}
