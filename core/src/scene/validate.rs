//! Validation of scenes from files, programs or built-in functions.

use std::ops::RangeInclusive;

use glam::Vec3;

use super::{
    LightKind, MAX_COORDINATE, MAX_DISPERSION, MAX_IOR, MAX_LIGHTS, MAX_RADIANCE, MAX_THICKNESS, MIN_RANGE,
    Material, Scene,
};
use crate::{Camera, Error, Result};

/// Allowed deviation of unit vectors from unit length.
const UNIT_TOLERANCE: f32 = 1.0e-4;

/// Allowed length of a camera's axes: half the frame's sides at distance 1, or in the scene's unit of length.
const FRAME_HALVES: RangeInclusive<f32> = 1.0e-16..=MAX_COORDINATE;

/// The largest number in the transform of a slot's texture coordinates, so that their products are finite in f32.
const MAX_TRANSFORM: f32 = 1.0e18;

impl Scene {
    /// Checks the lengths of the arrays, every index and every number. An empty scene is valid.
    ///
    /// # Errors
    /// [`Error::Scene`] names the element, what was expected and what was found.
    pub fn validate(&self) -> Result<()> {
        self.lengths()?;
        self.geometry()?;
        for (i, object) in self.objects.iter().enumerate() {
            index(format!("object {i} `{}`, material", object.name), object.material, self.materials.len())?;
        }
        for (i, material) in self.materials.iter().enumerate() {
            let what = format!("material {i} `{}`", material.name);
            check_material(material, &what)?;
            for texture in material.textures() {
                index(format!("{what}, texture"), texture, self.textures.len())?;
            }
            self.slots(material, &what)?;
        }
        for (i, texture) in self.textures.iter().enumerate() {
            index(format!("texture {i}, image"), texture.image, self.images.len())?;
        }
        for (i, image) in self.images.iter().enumerate() {
            let expected = u64::from(image.width) * u64::from(image.height) * 4;
            if expected == 0 || image.rgba.len() as u64 != expected {
                return fail(
                    format!("image {i}, {} x {}", image.width, image.height),
                    format!("expected {expected} bytes and more than none, found {}", image.rgba.len()),
                );
            }
        }
        self.lights()?;
        for (name, camera) in &self.cameras {
            check_camera(camera, &format!("camera `{name}`"))?;
        }
        let e = &self.environment;
        for (name, color) in
            [("background", e.background), ("ambient", e.ambient), ("truncated", e.fallback_radiance)]
        {
            check_radiance(format!("environment, {name}"), color)?;
        }
        Ok(())
    }

    fn lengths(&self) -> Result<()> {
        let triangles = self.positions.len();
        let required = [("normals", self.normals.len()), ("triangle_objects", self.triangle_objects.len())];
        let optional = [
            ("texcoords", self.texcoords.len()),
            ("second_texcoords", self.second_texcoords.len()),
            ("tangents", self.tangents.len()),
            ("colors", self.colors.len()),
        ];
        let wrong = required.iter().find(|(_, n)| *n != triangles);
        match wrong.or_else(|| optional.iter().find(|(_, n)| *n != triangles && *n != 0)) {
            Some((name, found)) => fail(
                (*name).to_owned(),
                format!("expected {triangles} elements as positions has, found {found}"),
            ),
            None => Ok(()),
        }
    }

    /// Checks that the coordinates and tangents that slots need exist.
    fn slots(&self, material: &Material, what: &str) -> Result<()> {
        for (slot, coordinates) in &material.coordinates {
            let numbers = coordinates.transform.to_cols_array();
            if let Some(found) = numbers.iter().find(|x| x.is_nan() || x.abs() > MAX_TRANSFORM) {
                return fail(
                    format!("{what}, {} texture", slot.name()),
                    format!("expected a transform of numbers up to {MAX_TRANSFORM:e}, found {found}"),
                );
            }
            if coordinates.second && self.second_texcoords.is_empty() && !self.positions.is_empty() {
                return fail(
                    format!("{what}, {} texture", slot.name()),
                    "expected second_texcoords, found none".into(),
                );
            }
        }
        if material.reads_tangents() && self.tangents.is_empty() && !self.positions.is_empty() {
            return fail(format!("{what}, normal map or anisotropy"), "expected tangents, found none".into());
        }
        Ok(())
    }

    fn geometry(&self) -> Result<()> {
        for (i, triangle) in self.positions.iter().enumerate() {
            if let Some(p) = triangle.iter().find(|p| !inside(**p)) {
                return fail(
                    format!("triangle {i}"),
                    format!("expected finite coordinates up to {MAX_COORDINATE:e}, found {p}"),
                );
            }
        }
        for (i, triangle) in self.texcoords.iter().enumerate().chain(self.second_texcoords.iter().enumerate())
        {
            if let Some(uv) = triangle.iter().find(|uv| !inside(uv.extend(0.0))) {
                return fail(
                    format!("triangle {i}"),
                    format!("expected finite texture coordinates up to {MAX_COORDINATE:e}, found {uv}"),
                );
            }
        }
        for (i, object) in self.triangle_objects.iter().enumerate() {
            if *object as usize >= self.objects.len() {
                index(format!("triangle {i}, object"), *object, self.objects.len())?;
            }
        }
        for (i, sphere) in self.spheres.iter().enumerate() {
            index(format!("sphere {i}, object"), sphere.object, self.objects.len())?;
            if !(inside(sphere.center) && sphere.radius > 0.0 && sphere.radius <= MAX_COORDINATE) {
                return fail(
                    format!("sphere {i}"),
                    format!(
                        "expected a finite centre and a radius above zero, found {} and {}",
                        sphere.center, sphere.radius
                    ),
                );
            }
        }
        Ok(())
    }

    fn lights(&self) -> Result<()> {
        if self.lights.len() > MAX_LIGHTS {
            return fail(
                "lights".into(),
                format!("expected at most {MAX_LIGHTS}, found {}", self.lights.len()),
            );
        }
        for (i, light) in self.lights.iter().enumerate() {
            let what = format!("light {i}");
            check_radiance(what.clone(), light.intensity)?;
            let (position, range, direction) = match &light.kind {
                LightKind::Point { position, range, .. } => (*position, *range, Vec3::X),
                LightKind::Spot { position, range, direction, .. } => (*position, *range, *direction),
                LightKind::Directional { direction } => (Vec3::ZERO, 1.0, *direction),
            };
            if !(inside(position) && range >= MIN_RANGE && light.radius >= 0.0) {
                return fail(
                    what,
                    format!(
                        "expected a finite position, a range of at least {MIN_RANGE:e} and a radius that is \
                         not negative, found {position}, {range} and {}",
                        light.radius
                    ),
                );
            }
            let length = direction.length();
            if !length.is_finite() || (length - 1.0).abs() > UNIT_TOLERANCE {
                return fail(what, format!("expected a direction of unit length, found {direction}"));
            }
            if let LightKind::Spot { cone, .. } = &light.kind
                && !(0.0 <= cone.start && cone.start <= cone.end && cone.end <= std::f32::consts::FRAC_PI_2)
            {
                return fail(
                    what,
                    format!("expected cone angles 0 <= inner <= outer <= pi/2 radians, found {cone:?}"),
                );
            }
        }
        Ok(())
    }
}

fn check_material(material: &Material, what: &str) -> Result<()> {
    check_radiance(format!("{what}, emission"), material.emission)?;
    check_radiance(format!("{what}, base colour"), material.base_color)?;
    check_radiance(format!("{what}, specular colour"), material.specular_color)?;
    check_radiance(format!("{what}, absorption"), material.absorption)?;
    let specular = material.specular_glossiness.map_or(Vec3::ZERO, |s| s.specular);
    check_radiance(format!("{what}, specular reflectance"), specular)?;
    let weights = material.weights.map_or([0.0; 3], |w| [w.diffuse, w.mirror, w.refraction]);
    let shares = [
        ("metallic", material.metallic),
        ("roughness", material.roughness),
        ("transmission", material.transmission),
        ("alpha", material.alpha),
        ("occlusion strength", material.occlusion_strength),
        ("specular strength", material.specular),
        ("glossiness", material.specular_glossiness.map_or(0.0, |s| s.glossiness)),
        ("clearcoat", material.clearcoat),
        ("clearcoat roughness", material.clearcoat_roughness),
        ("sheen roughness", material.sheen_roughness),
        ("anisotropy", material.anisotropy),
        ("iridescence", material.iridescence),
        ("diffuse transmission", material.diffuse_transmission),
        ("red of diffuse transmission", material.diffuse_transmission_color.x),
        ("green of diffuse transmission", material.diffuse_transmission_color.y),
        ("blue of diffuse transmission", material.diffuse_transmission_color.z),
        ("red of the sheen", material.sheen_color.x),
        ("green of the sheen", material.sheen_color.y),
        ("blue of the sheen", material.sheen_color.z),
        ("diffuse weight", weights[0]),
        ("mirror weight", weights[1]),
        ("refraction weight", weights[2]),
    ];
    if let Some((name, found)) = shares.iter().find(|(_, v)| !(0.0..=1.0).contains(v)) {
        return fail(format!("{what}, {name}"), format!("expected a number from 0 to 1, found {found}"));
    }
    let indices =
        [("index of refraction", material.ior), ("index of the thin film", material.iridescence_ior)];
    if let Some((name, found)) = indices.iter().find(|(_, v)| !(1.0..=MAX_IOR).contains(v)) {
        return fail(
            format!("{what}, {name}"),
            format!("expected a number from 1 to {MAX_IOR}, found {found}"),
        );
    }
    if !(0.0..=MAX_DISPERSION).contains(&material.dispersion) {
        return fail(
            format!("{what}, dispersion"),
            format!("expected a number from 0 to {MAX_DISPERSION}, found {}", material.dispersion),
        );
    }
    if let Some(found) = material.iridescence_thickness.iter().find(|v| !(0.0..=MAX_THICKNESS).contains(*v)) {
        return fail(
            format!("{what}, thickness of the thin film"),
            format!("expected a number from 0 to {MAX_THICKNESS}, found {found}"),
        );
    }
    let numbers = [
        ("normal scale", material.normal_scale),
        ("normal scale of the clearcoat", material.clearcoat_normal_scale),
        ("rotation of the anisotropy", material.anisotropy_rotation),
    ];
    if let Some((name, found)) = numbers.iter().find(|(_, v)| !v.is_finite()) {
        return fail(format!("{what}, {name}"), format!("expected a finite number, found {found}"));
    }
    match material.alpha_cutoff {
        Some(cutoff) if cutoff.is_nan() => fail(format!("{what}, alpha cutoff"), "found NaN".into()),
        _ => Ok(()),
    }
}

fn check_radiance(what: String, color: Vec3) -> Result<()> {
    if color.cmpge(Vec3::ZERO).all() && color.cmple(Vec3::splat(MAX_RADIANCE)).all() {
        return Ok(());
    }
    fail(what, format!("expected three numbers from 0 to {MAX_RADIANCE:e}, found {color}"))
}

/// Checks that the frame's axes span a plane and that their products neither vanish nor overflow.
fn check_camera(camera: &Camera, what: &str) -> Result<()> {
    let measurable = |axis: Vec3| FRAME_HALVES.contains(&axis.length());
    let spans = camera.right.cross(camera.up) != Vec3::ZERO;
    let axes = [camera.right, camera.up, camera.forward];
    if inside(camera.origin) && axes.into_iter().all(measurable) && spans {
        return Ok(());
    }
    fail(
        what.to_owned(),
        format!(
            "expected a finite position, and axes of a length from {:e} to {:e} that span a frame, found {camera:?}",
            FRAME_HALVES.start(),
            FRAME_HALVES.end()
        ),
    )
}

fn inside(p: Vec3) -> bool {
    p.is_finite() && p.abs().max_element() <= MAX_COORDINATE
}

fn index(what: String, found: u32, length: usize) -> Result<()> {
    if (found as usize) < length {
        return Ok(());
    }
    fail(what, format!("expected an index below {length}, found {found}"))
}

fn fail(what: String, reason: String) -> Result<()> {
    Err(Error::scene(what, reason))
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, vec3};

    use super::*;
    use crate::scene::{Image8, Light, Object, Sphere, Texture, builtin};

    /// Applies `change` to a valid scene and expects an error that contains all `parts`.
    fn fails(change: impl Fn(&mut Scene), parts: &[&str]) {
        static ROOM: std::sync::OnceLock<Scene> = std::sync::OnceLock::new();
        let mut scene = ROOM.get_or_init(|| builtin("room").expect("room")).clone();
        change(&mut scene);
        let text = scene.validate().expect_err("invalid").to_string();
        for part in parts {
            assert!(text.contains(part), "`{text}` does not say `{part}`");
        }
    }

    #[test]
    fn an_empty_scene_is_valid() {
        Scene::default().validate().expect("empty");
    }

    #[test]
    fn every_mistake_is_named() {
        fails(|s| s.normals.truncate(9), &["normals", "expected", "found"]);
        fails(|s| s.texcoords.push([Vec2::ZERO; 3]), &["texcoords"]);
        fails(|s| s.colors.push([[0; 4]; 3]), &["colors"]);
        fails(|s| s.positions[7][2].y = f32::NAN, &["triangle 7", "finite"]);
        fails(|s| s.positions[0][0].x = 2.0e18, &["triangle 0", "1e18"]);
        fails(|s| s.texcoords[3][0].x = f32::INFINITY, &["triangle 3", "texture coordinates"]);
        fails(|s| s.triangle_objects[4] = 9999, &["triangle 4, object", "found 9999"]);
        fails(
            |s| s.spheres.push(Sphere { center: Vec3::ZERO, radius: 0.0, object: 0 }),
            &["sphere", "radius"],
        );
        fails(|s| s.spheres[0].object = 9999, &["sphere 0, object"]);
        fails(|s| s.objects.push(Object { name: "o".into(), material: 99 }), &["`o`, material", "found 99"]);
        fails(|s| s.materials[0].base_color_texture = Some(77), &["texture", "found 77"]);
        fails(|s| s.materials[0].roughness = 1.5, &["roughness", "1.5"]);
        fails(|s| s.materials[0].ior = 0.5, &["index of refraction", "0.5"]);
        fails(|s| s.materials[0].emission.x = -1.0, &["emission"]);
        fails(|s| s.textures[0] = Texture { image: 50, ..s.textures[0] }, &["texture 0, image"]);
        fails(|s| s.images[0] = Image8 { width: 2, height: 2, rgba: vec![0; 15] }, &["image 0", "16", "15"]);
        fails(|s| s.images[0] = Image8::default(), &["image 0", "more than none"]);
        fails(|s| s.lights.extend(vec![s.lights[0].clone(); 32]), &["lights", "at most 32, found 36"]);
        let down = |direction| Light {
            kind: LightKind::Directional { direction },
            intensity: Vec3::ONE,
            radius: 0.0,
        };
        fails(|s| s.lights[0] = down(vec3(0.0, -2.0, 0.0)), &["light 0", "unit length"]);
        fails(|s| s.lights[0].radius = f32::NAN, &["light 0", "radius"]);
        fails(|s| s.lights[0].intensity.x = 2.0e30, &["light 0", "1e30"]);
        fails(|s| s.environment.background.z = 2.0e30, &["environment, background", "1e30"]);
        fails(|s| s.materials[0].ior = f32::NAN, &["index of refraction", "NaN"]);
        fails(|s| s.materials[0].ior = 2.0e4, &["index of refraction", "10000"]);
        fails(|s| s.texcoords[3][0].x = -2.0e18, &["triangle 3", "texture coordinates", "1e18"]);
        fails(|s| s.cameras[0].1.up = Vec3::ZERO, &["camera `main`"]);
        fails(|s| s.cameras[0].1.up = s.cameras[0].1.right, &["camera `main`", "span"]);
        fails(|s| s.cameras[0].1.right *= 1.0e-20, &["camera `main`", "1e-16"]);
        fails(|s| s.cameras[0].1.forward = Vec3::ZERO, &["camera `main`"]);
        fails(|s| s.cameras[0].1.origin.x = 2.0e18, &["camera `main`"]);
        fails(|s| s.cameras[0].1.origin.x = f32::NAN, &["camera `main`"]);
        fails(|s| s.environment.ambient.y = f32::NAN, &["environment, ambient"]);
    }
}
