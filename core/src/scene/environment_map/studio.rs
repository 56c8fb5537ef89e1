//! The built-in studio: a grey room with soft boxes, for files without a light of their own.

use glam::DVec3;

/// A light with a soft border.
struct SoftBox {
    /// Direction of its centre, not of unit length.
    towards: [f64; 3],
    /// Half of its height and width as tangents of angles, and the width of its border.
    half: [f64; 2],
    radiance: f64,
}

const BORDER: f64 = 0.3;

const BOXES: [SoftBox; 4] = [
    SoftBox { towards: [0.1, 1.0, 0.25], half: [0.45, 0.45], radiance: 2.2 },
    SoftBox { towards: [-0.9, 0.45, 0.7], half: [0.5, 0.28], radiance: 2.4 },
    SoftBox { towards: [1.0, 0.3, 0.45], half: [0.6, 0.22], radiance: 1.5 },
    SoftBox { towards: [0.35, 0.5, -1.0], half: [0.3, 0.6], radiance: 1.6 },
];

/// Radiance from a unit direction: walls that are darker towards the floor, and the boxes.
pub(super) fn radiance(direction: DVec3) -> DVec3 {
    let rise = 0.5 + 0.5 * direction.y;
    let walls = 0.16 + 0.36 * rise * rise * (3.0 - 2.0 * rise);
    let boxes: f64 = BOXES.iter().map(|of| of.radiance * of.coverage(direction)).sum();
    DVec3::splat(walls + boxes)
}

impl SoftBox {
    /// 1 inside, 0 outside.
    fn coverage(&self, direction: DVec3) -> f64 {
        let forward = DVec3::from(self.towards).normalize();
        let along = direction.dot(forward);
        if along <= 0.0 {
            return 0.0;
        }
        let right = forward.cross(DVec3::Y).try_normalize().unwrap_or(DVec3::X);
        let up = right.cross(forward);
        [up, right]
            .into_iter()
            .zip(self.half)
            .map(|(axis, half)| {
                let inside = (half - (direction.dot(axis) / along).abs()) / BORDER + 0.5;
                let x = inside.clamp(0.0, 1.0);
                x * x * (3.0 - 2.0 * x)
            })
            .product()
    }
}
