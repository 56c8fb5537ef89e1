//! Reads EXT_lights_image_based: light from infinitely far away, by the six faces of a cube.
//!
//! The first level of its images becomes an [`EnvironmentMap`], from which irradiance and levels for rough lobes are
//! computed as from any other map; the file's prefiltered levels and coefficients are not needed for that.

use std::f64::consts::PI;

use glam::{DQuat, DVec3, Vec3};
use serde::Deserialize;

use super::accessors::Source;
use super::container::External;
use super::images::Textures;
use super::text::clipped;
use crate::image::srgb_to_linear;
use crate::scene::environment_map::{EnvironmentMap, MAX_ENVIRONMENT_SIDE};
use crate::scene::{Image8, MAX_RADIANCE};
use crate::{Error, Result};

/// The most texels of all faces: those of sides of 4096.
const MAX_TEXELS: u64 = 6 << 24;

/// The largest quotient of a channel and an alpha of 8 bits.
const LARGEST: f64 = 255.0;

/// Share by which the mean irradiance of coefficients may differ from that of the images, before that is told.
const DEVIATION: f64 = 0.1;

/// Spherical harmonic of degree 0, a constant.
const Y00: f64 = 0.282_094_791_773_878_14;

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Light {
    #[serde(default = "unturned")]
    rotation: [f64; 4],
    #[serde(default = "unscaled")]
    intensity: f64,
    specular_images: Vec<[usize; 6]>,
    irradiance_coefficients: Option<Vec<[f64; 3]>>,
}

fn unturned() -> [f64; 4] {
    DQuat::IDENTITY.to_array()
}

fn unscaled() -> f64 {
    1.0
}

/// The map of the light of a scene of the file; `None` if it has none, or, with a warning, if an image is missing.
pub(super) fn map(
    source: &Source<'_>,
    external: &mut External<'_>,
    scene: usize,
    warnings: &mut Vec<String>,
) -> Result<Option<EnvironmentMap>> {
    let place = format!("/scenes/{scene}/extensions/EXT_lights_image_based/light");
    let Some(index) = source.document.pointer(&place) else { return Ok(None) };
    let what = format!("image-based light {}", clipped(&index.to_string(), 20));
    let fail = |reason: String| Error::scene(&what, reason);
    let json = source.document.pointer(&format!("/extensions/EXT_lights_image_based/lights/{index}"));
    let json = json.ok_or_else(|| fail("no such light in EXT_lights_image_based".to_owned()))?;
    let light = Light::deserialize(json).map_err(|e| {
        fail(format!("expected `specularImages` of six image indices each, found other JSON: {e}"))
    })?;
    let rotation = DQuat::from_array(light.rotation);
    if !(rotation.is_finite() && rotation.length() > 0.0) {
        return Err(fail(format!("expected a rotation by a quaternion, found {:?}", light.rotation)));
    }
    let most = f64::from(MAX_RADIANCE) / LARGEST;
    if !(0.0..=most).contains(&light.intensity) {
        return Err(fail(format!("expected an intensity from 0 to {most:e}, found {}", light.intensity)));
    }
    let first = light.specular_images.first();
    let first = first.ok_or_else(|| fail("expected at least one level in `specularImages`".to_owned()))?;
    let mut decoded = Textures::new(MAX_TEXELS);
    let faces = first.map(|image| decoded.image(source, external, image));
    warnings.append(&mut decoded.warnings);
    let mut of_faces = [0; 6];
    for (place, face) in of_faces.iter_mut().zip(faces) {
        let Some(image) = face? else {
            warnings.push(format!("{what} is left out, for an image of it is missing"));
            return Ok(None);
        };
        *place = image as usize;
    }
    let face = decoded.images[of_faces[0]].width;
    let side = (2 * face).next_power_of_two().clamp(16, MAX_ENVIRONMENT_SIDE);
    let texels = |side: u32| u64::from(side) * u64::from(side) * size_of::<Vec3>() as u64;
    source.budget.claim(&what, 6 * texels(face) + texels(side))?;
    let cube = Cube::new(&decoded.images, of_faces, light.intensity).map_err(fail)?;
    if of_faces.iter().any(|face| decoded.images[*face].rgba.iter().skip(3).step_by(4).any(|a| *a == 0)) {
        warnings.push(format!("{what}: alpha of 0, by which colours are divided, is read as 1/255"));
    }
    let places = (3 * cube.side).div_ceil(side).max(2);
    let turned_back = rotation.normalize().inverse();
    let map = EnvironmentMap::of(side, places, |direction| cube.radiance(turned_back * direction));
    let stated = light.irradiance_coefficients.as_ref().and_then(|coefficients| coefficients.first());
    warnings.extend(stated.and_then(|stated| {
        let stated = DVec3::from(*stated) * light.intensity * Y00;
        disagreement(&what, stated, PI * map.mean().as_dvec3())
    }));
    Ok(Some(map))
}

/// The warning that coefficients state another mean irradiance than images.
fn disagreement(what: &str, stated: DVec3, shown: DVec3) -> Option<String> {
    let differs = (stated - shown).abs().max_element() > DEVIATION * shown.max_element();
    let [stated, shown] = [stated, shown].map(|irradiance| format!("{:.3?}", irradiance.to_array()));
    differs.then(|| {
        format!(
            "{what}: its coefficients have a mean irradiance of {stated}, its images, which are shown, {shown}"
        )
    })
}

/// The faces of a cube in the order +X, -X, +Y, -Y, +Z, -Z, each as it is seen from the middle: with +Y up on the
/// four sides, -Z up on +Y and +Z up on -Y.
struct Cube {
    side: u32,
    /// Radiance of each texel, face by face, row by row.
    texels: Vec<Vec3>,
}

/// Directions of each face: to its middle, to the right and down.
const AXES: [[DVec3; 3]; 6] = [
    [DVec3::X, DVec3::Z, DVec3::NEG_Y],
    [DVec3::NEG_X, DVec3::NEG_Z, DVec3::NEG_Y],
    [DVec3::Y, DVec3::NEG_X, DVec3::Z],
    [DVec3::NEG_Y, DVec3::NEG_X, DVec3::NEG_Z],
    [DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y],
    [DVec3::NEG_Z, DVec3::X, DVec3::NEG_Y],
];

impl Cube {
    fn new(images: &[Image8], faces: [usize; 6], intensity: f64) -> std::result::Result<Self, String> {
        let side = images[faces[0]].width;
        let found = faces.map(|face| (images[face].width, images[face].height));
        if side == 0 || found.iter().any(|size| *size != (side, side)) {
            return Err(format!("expected six square images of one size, found {found:?}"));
        }
        let texels = faces.into_iter().flat_map(|face| radiances(&images[face].rgba));
        Ok(Self { side, texels: texels.map(|radiance| radiance * intensity as f32).collect() })
    }

    /// Bilinear interpolation, beyond the edge of a face with its neighbours.
    fn radiance(&self, direction: DVec3) -> DVec3 {
        let (face, x, y) = self.place(direction);
        let (left, above) = ((x - 0.5).floor(), (y - 0.5).floor());
        let (right, below) = (x - 0.5 - left, y - 0.5 - above);
        let top = self.texel(face, left, above).lerp(self.texel(face, left + 1.0, above), right);
        let bottom =
            self.texel(face, left, above + 1.0).lerp(self.texel(face, left + 1.0, above + 1.0), right);
        top.lerp(bottom, below)
    }

    /// The face that a direction meets, and where, in texels from its upper left corner.
    fn place(&self, direction: DVec3) -> (usize, f64, f64) {
        let along = |face: &usize| AXES[*face][0].dot(direction);
        let face = (0..6).max_by(|a, b| along(a).total_cmp(&along(b))).unwrap_or_default();
        let [middle, right, down] = AXES[face].map(|axis| axis.dot(direction));
        let half = 0.5 * f64::from(self.side);
        (face, half * (1.0 + right / middle), half * (1.0 + down / middle))
    }

    /// A texel of a face, or the one behind its edge that its plane's continuation meets.
    fn texel(&self, face: usize, x: f64, y: f64) -> DVec3 {
        let side = f64::from(self.side);
        let inside = |at: f64| (0.0..side).contains(&at);
        let (face, x, y) = if inside(x) && inside(y) {
            (face, x, y)
        } else {
            let [middle, right, down] = AXES[face];
            let across = |at: f64| 2.0 * (at + 0.5) / side - 1.0;
            self.place(middle + across(x) * right + across(y) * down)
        };
        let [x, y] = [x, y].map(|at| (at as usize).min(self.side as usize - 1));
        let index = (face * self.side as usize + y) * self.side as usize + x;
        self.texels[index].as_dvec3()
    }
}

/// Decodes linear radiance: colours in sRGB, divided by alpha (RGBD), which is 1 where a file has none.
fn radiances(rgba: &[u8]) -> impl Iterator<Item = Vec3> {
    let linear = srgb_to_linear();
    rgba.as_chunks::<4>().0.iter().map(move |[r, g, b, alpha]| {
        Vec3::from([r, g, b].map(|c| linear[usize::from(*c)])) * (LARGEST as f32 / f32::from((*alpha).max(1)))
    })
}
