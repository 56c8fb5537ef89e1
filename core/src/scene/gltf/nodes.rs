//! Reads the node tree: world transforms, cameras and lights.

use glam::{DMat4, DQuat, DVec3, DVec4, Mat4, Vec3};
use gltf::json;
use json::extensions::scene::khr_lights_punctual::Type as LightType;
use json::validation::Checked;

use super::normalized::flushed3;
use super::text::{MAX_NAME, clipped};
use crate::scene::camera::Camera;
use crate::scene::{Light, LightKind, MAX_COORDINATE, MAX_RADIANCE, MIN_RANGE, Scene};
use crate::{Error, Result};

/// Tolerance for the last row of a matrix, which exporters may round and which is not used.
const AFFINE_TOLERANCE: f64 = 1.0e-4;

/// A node of the default scene with its world transform.
pub(super) struct Placed<'a> {
    pub index: usize,
    pub json: &'a json::Node,
    pub world: DMat4,
}

impl Placed<'_> {
    /// The node's name, or `nodeN` if it has none.
    pub fn name(&self) -> String {
        self.json
            .name
            .as_deref()
            .map_or_else(|| format!("node{}", self.index), |name| clipped(name, MAX_NAME))
    }

    /// The world transform with axes of unit length (zero axes stay zero).
    fn pose(&self) -> Mat4 {
        let unit = |axis: DVec4| axis.truncate().normalize_or_zero().extend(0.0);
        let w = &self.world;
        DMat4::from_cols(unit(w.x_axis), unit(w.y_axis), unit(w.z_axis), w.w_axis).as_mat4()
    }
}

/// Collects all nodes below `roots`, parents before children.
pub(super) fn placed<'a>(root: &'a json::Root, roots: &[json::Index<json::Node>]) -> Result<Vec<Placed<'a>>> {
    let mut all = Vec::new();
    let mut seen = vec![false; root.nodes.len()];
    let mut stack: Vec<_> = roots.iter().rev().map(|n| (n.value(), DMat4::IDENTITY)).collect();
    while let Some((index, parent)) = stack.pop() {
        let what = || format!("node {index}");
        let json = root.nodes.get(index).ok_or_else(|| {
            Error::scene(what(), format!("no such node; the file has {}", root.nodes.len()))
        })?;
        if std::mem::replace(&mut seen[index], true) {
            return Err(Error::scene(what(), "expected one parent, found a second one or a cycle"));
        }
        let local = local(json);
        if !local.row(3).abs_diff_eq(DVec4::W, AFFINE_TOLERANCE) && local.is_finite() {
            return Err(Error::scene(
                what(),
                format!("expected a matrix whose last row is 0, 0, 0, 1, found {}", local.row(3)),
            ));
        }
        let world = parent * local;
        if !world.is_finite() {
            return Err(Error::scene(what(), "expected a finite matrix, found an infinity or a NaN"));
        }
        all.push(Placed { index, json, world });
        let children = json.children.iter().flatten();
        stack.extend(children.rev().map(|child| (child.value(), world)));
    }
    Ok(all)
}

/// The node's local transform; a rotation quaternion of length zero gives NaN.
fn local(node: &json::Node) -> DMat4 {
    if let Some(matrix) = node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let vector = |v: [f32; 3]| Vec3::from(v).as_dvec3();
    let [x, y, z, w] = node.rotation.unwrap_or_default().0.map(f64::from);
    let length = (x * x + y * y + z * z + w * w).sqrt();
    let rotation = DQuat::from_xyzw(x / length, y / length, z / length, w / length);
    DMat4::from_translation(vector(node.translation.unwrap_or([0.0; 3])))
        * DMat4::from_quat(rotation)
        * DMat4::from_scale(vector(node.scale.unwrap_or([1.0; 3])))
}

/// Adds the node's camera and light, if it has them, to the scene.
pub(super) fn equip(root: &json::Root, node: &Placed<'_>, scene: &mut Scene) -> Result<()> {
    if let Some(camera) = node.json.camera {
        scene.cameras.push(import_camera(root, node, camera.value())?);
    }
    let light = node.json.extensions.as_ref().and_then(|e| e.khr_lights_punctual.as_ref());
    if let Some(light) = light {
        scene.lights.push(import_light(root, node, light.light.value())?);
    }
    Ok(())
}

fn import_camera(root: &json::Root, node: &Placed<'_>, index: usize) -> Result<(String, Camera)> {
    let json = root.cameras.get(index).ok_or_else(|| {
        Error::scene(
            format!("camera {index} of node {}", node.index),
            format!("no such camera; the file has {}", root.cameras.len()),
        )
    })?;
    let name = json.name.as_deref().or(node.json.name.as_deref());
    let name = name.map_or_else(|| format!("camera{index}"), |name| clipped(name, MAX_NAME));
    let matrix = node.pose();
    let camera = match (&json.perspective, &json.orthographic) {
        (Some(lens), _) => Camera::perspective(&matrix, lens.yfov),
        (None, Some(lens)) => Camera::orthographic(&matrix, lens.ymag),
        (None, None) => {
            Err(Error::scene("", "expected `perspective` or `orthographic`, found neither".to_owned()))
        }
    };
    let camera = camera.map_err(|e| match e {
        Error::Scene { reason, .. } => Error::scene(format!("camera {index} `{name}`"), reason),
        other => other,
    })?;
    Ok((name, camera))
}

fn import_light(root: &json::Root, node: &Placed<'_>, index: usize) -> Result<Light> {
    let what = format!("light {index} of node {}", node.index);
    let fail = |reason: String| Error::scene(&what, reason);
    let lights = root.extensions.as_ref().and_then(|e| e.khr_lights_punctual.as_ref());
    let lights = lights.map_or(&[][..], |l| &l.lights);
    let json =
        lights.get(index).ok_or_else(|| fail(format!("no such light; the file has {}", lights.len())))?;
    let intensity = flushed3(Vec3::from(json.color) * json.intensity);
    if !(intensity.cmpge(Vec3::ZERO).all() && intensity.max_element() <= MAX_RADIANCE) {
        return Err(fail(format!("expected an intensity from 0 to {MAX_RADIANCE:e}, found {intensity}")));
    }
    let position = flushed3(node.world.w_axis.truncate().as_vec3());
    if position.abs().max_element() > MAX_COORDINATE {
        return Err(fail(format!("expected coordinates up to {MAX_COORDINATE:e}, found {position}")));
    }
    let range = json.range.unwrap_or(f32::INFINITY);
    if range.is_nan() || range < MIN_RANGE {
        return Err(fail(format!("expected a range of at least {MIN_RANGE:e}, found {range}")));
    }
    let direction = || {
        let direction = node.world.transform_vector3(DVec3::NEG_Z).normalize_or_zero().as_vec3();
        if direction == Vec3::ZERO {
            return Err(fail("its node's matrix leaves it no direction".to_owned()));
        }
        Ok(direction)
    };
    let kind = match &json.type_ {
        Checked::Valid(LightType::Point) => LightKind::Point { position, range, falloff: true },
        Checked::Valid(LightType::Directional) => LightKind::Directional { direction: direction()? },
        Checked::Valid(LightType::Spot) => {
            let spot = json.spot.as_ref();
            let spot = spot.ok_or_else(|| fail("expected `spot` with its cone, found none".to_owned()))?;
            let (inner, outer) = (spot.inner_cone_angle, spot.outer_cone_angle);
            // Files often round pi / 2 to a few digits.
            if !(0.0 <= inner && inner <= outer && 0.0 < outer && outer <= 1.571) {
                return Err(fail(format!(
                    "expected cone angles 0 <= inner <= outer <= pi/2 radians, found {inner} and {outer}"
                )));
            }
            let outer = outer.min(std::f32::consts::FRAC_PI_2);
            LightKind::Spot { position, range, direction: direction()?, cone: inner.min(outer)..outer }
        }
        Checked::Invalid => {
            return Err(fail("expected the type point, spot or directional, found another".to_owned()));
        }
    };
    Ok(Light { kind, intensity, radius: 0.0 })
}
