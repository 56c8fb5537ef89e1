//! Solids that transmit light and may touch, overlap or contain one another.

use glam::Vec3;

use super::{Material, Scene};

/// Width by which boxes are enlarged, relative to the scene's coordinates: more than the offset of rays from a face.
const TOUCHING: f32 = 64.0 / 16_777_216.0;

/// Bounding boxes of the solid objects whose boxes meet that of another one.
#[must_use]
pub(crate) fn touching_solids(scene: &Scene) -> Vec<(Vec3, Vec3)> {
    let is_solid = |material: u32| scene.materials.get(material as usize).is_some_and(Material::is_solid);
    let solid: Vec<_> = scene.objects.iter().map(|object| is_solid(object.material)).collect();
    // Most scenes have no two solids: their triangles are not looked at.
    if solid.iter().filter(|solid| **solid).count() < 2 {
        return Vec::new();
    }
    let mut boxes = vec![(Vec3::INFINITY, Vec3::NEG_INFINITY); scene.objects.len()];
    let mut extend = |object: u32, low: Vec3, high: Vec3| {
        if let Some((least, most)) = boxes.get_mut(object as usize) {
            (*least, *most) = (least.min(low), most.max(high));
        }
    };
    for (corners, &object) in scene.positions.iter().zip(&scene.triangle_objects) {
        corners.iter().for_each(|corner| extend(object, *corner, *corner));
    }
    for sphere in &scene.spheres {
        extend(sphere.object, sphere.center - sphere.radius, sphere.center + sphere.radius);
    }
    let mut solids: Vec<_> = boxes
        .into_iter()
        .zip(solid)
        .filter(|((low, high), solid)| *solid && low.cmple(*high).all())
        .map(|((low, high), _)| {
            let by = TOUCHING * (low.abs().max(high.abs()).max_element() + (high - low).max_element());
            (low - by, high + by)
        })
        .collect();
    // Sorted along one axis, so that scenes of many solids compare near ones only.
    solids.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
    let mut touches = vec![false; solids.len()];
    for (i, a) in solids.iter().enumerate() {
        for (j, b) in solids.iter().enumerate().skip(i + 1).take_while(|(_, b)| b.0.x <= a.1.x) {
            if a.0.cmple(b.1).all() && b.0.cmple(a.1).all() {
                (touches[i], touches[j]) = (true, true);
            }
        }
    }
    solids.into_iter().zip(touches).filter_map(|(solid, touches)| touches.then_some(solid)).collect()
}
