//! What every scene must keep to, whether a file, a program or a built-in scene made it.

use glam::Vec3;

use super::{LightKind, MAX_COORDINATE, MAX_LIGHTS, Material, Scene};
use crate::{Error, Result};

/// Unit vectors may be this far from unit length.
const UNIT_TOLERANCE: f32 = 1.0e-4;

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
            let finite =
                [camera.origin, camera.right, camera.up, camera.forward].iter().all(|v| v.is_finite());
            if !finite || camera.right.cross(camera.up) == Vec3::ZERO {
                return fail(format!("camera `{name}`"), "expected finite axes that span a frame".into());
            }
        }
        let e = &self.environment;
        for (name, color) in
            [("background", e.background), ("ambient", e.ambient), ("truncated", e.truncated)]
        {
            check_radiance(format!("environment, {name}"), color)?;
        }
        Ok(())
    }

    fn lengths(&self) -> Result<()> {
        let triangles = self.positions.len();
        let required = [("normals", self.normals.len()), ("triangle_objects", self.triangle_objects.len())];
        let optional = [("texcoords", self.texcoords.len()), ("colors", self.colors.len())];
        let wrong = required.iter().find(|(_, n)| *n != triangles);
        match wrong.or_else(|| optional.iter().find(|(_, n)| *n != triangles && *n != 0)) {
            Some((name, found)) => fail(
                (*name).to_owned(),
                format!("expected {triangles} elements as positions has, found {found}"),
            ),
            None => Ok(()),
        }
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
        for (i, triangle) in self.texcoords.iter().enumerate() {
            if let Some(uv) = triangle.iter().find(|uv| !uv.is_finite()) {
                return fail(
                    format!("triangle {i}"),
                    format!("expected finite texture coordinates, found {uv}"),
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
            if !(inside(position) && range > 0.0 && light.radius >= 0.0) {
                return fail(
                    what,
                    format!(
                        "expected a finite position, a range above zero and a radius that is not negative, \
                         found {position}, {range} and {}",
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
    let weights = material.weights.map_or([0.0; 3], |w| [w.diffuse, w.mirror, w.refraction]);
    let shares = [
        ("metallic", material.metallic),
        ("roughness", material.roughness),
        ("transmission", material.transmission),
        ("alpha", material.alpha),
        ("diffuse weight", weights[0]),
        ("mirror weight", weights[1]),
        ("refraction weight", weights[2]),
    ];
    if let Some((name, found)) = shares.iter().find(|(_, v)| !(0.0..=1.0).contains(v)) {
        return fail(format!("{what}, {name}"), format!("expected a number from 0 to 1, found {found}"));
    }
    if !(material.ior >= 1.0 && material.ior.is_finite()) {
        return fail(
            format!("{what}, index of refraction"),
            format!("expected at least 1, found {}", material.ior),
        );
    }
    match material.alpha_cutoff {
        Some(cutoff) if cutoff.is_nan() => fail(format!("{what}, alpha cutoff"), "found NaN".into()),
        _ => Ok(()),
    }
}

fn check_radiance(what: String, color: Vec3) -> Result<()> {
    if color.is_finite() && color.min_element() >= 0.0 {
        return Ok(());
    }
    fail(what, format!("expected three finite numbers, none negative, found {color}"))
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
