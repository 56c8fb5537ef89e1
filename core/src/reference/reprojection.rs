//! Reprojection (lecture): which pixels show points of the last frame again, and with which radiance.

use glam::{DVec2, DVec3};

use super::{ReferenceFrame, Rounding};

/// Side of the tile whose pixels are ranked for tracing.
const TILE: u32 = 16;

/// A pixel may be a gap if pixels on both sides are nearer than this fraction of its depth.
const NEARER: f64 = 0.96875;

/// A pixel is traced if the estimate of its error is larger, in square roots of radiance.
const ERROR: f64 = 0.0625;

/// Least distance between points in the error estimate, in pixels.
const LEAST_WAY: f64 = 0.25;

/// A pixel of the last frame, kept for reprojection.
#[derive(Clone, Copy, Debug)]
pub struct Kept {
    /// The world-space point that it shows; `None` if it is not valid from other positions.
    pub point: Option<DVec3>,
    /// Linear RGB radiance.
    pub radiance: DVec3,
}

/// A kept point, projected into the current view.
#[derive(Clone, Copy, Debug)]
struct Reprojected {
    at: DVec2,
    depth: f64,
    radiance: DVec3,
}

impl Reprojected {
    /// Sort key: depth to one part in 2^11, then distance from the pixel's centre.
    fn order(&self) -> (u32, f64) {
        ((self.depth as f32).to_bits() >> 12, (self.at.fract() - 0.5).length_squared())
    }
}

impl ReferenceFrame<'_> {
    /// Whether a frame that traces `count` ranks from `first` on traces this pixel. Ranks follow Bayer's
    /// recursion, with quarters 0 2 / 3 1, the finest first.
    #[must_use]
    pub fn refreshes([x, y]: [u32; 2], first: u32, count: u32) -> bool {
        let [mut side, mut rank] = [TILE / 2, 0];
        let [mut x, mut y] = [x % TILE, y % TILE];
        while side > 0 {
            rank += side * side * [[0, 2], [3, 1]][(y % 2) as usize][(x % 2) as usize];
            [x, y, side] = [x / 2, y / 2, side / 2];
        }
        (rank + TILE * TILE - first) % (TILE * TILE) < count
    }

    /// Radiances of the pixels reprojected from the last frame, row by row; `None` if a pixel must be traced.
    #[must_use]
    pub fn reprojected(&self, before: &[Kept]) -> Vec<Option<DVec3>> {
        let nearest_points = self.nearest_points(before);
        let [width, height] = self.size;
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        pixels.map(|pixel| self.reused(&nearest_points, pixel)).collect()
    }

    /// The nearest kept point in each pixel.
    fn nearest_points(&self, before: &[Kept]) -> Vec<Option<Reprojected>> {
        let mut nearest_points: Vec<Option<Reprojected>> = vec![None; before.len()];
        for kept in before {
            let Some(point) = kept.point else { continue };
            let at = self.place(point, &mut Rounding::none());
            let Some([x, y]) = self.pixel_at(at) else { continue };
            let depth = (point - self.camera.origin.as_dvec3()).dot(self.camera.forward.as_dvec3());
            let new = Reprojected { at, depth, radiance: kept.radiance };
            let there = &mut nearest_points[(y * self.size[0] + x) as usize];
            if there.is_none_or(|old| new.order() < old.order()) {
                *there = Some(new);
            }
        }
        nearest_points
    }

    fn reused(&self, nearest_points: &[Option<Reprojected>], [x, y]: [u32; 2]) -> Option<DVec3> {
        let at = |dx: i64, dy: i64| {
            let (x, y) = (i64::from(x) + dx, i64::from(y) + dy);
            let inside =
                (0..i64::from(self.size[0])).contains(&x) && (0..i64::from(self.size[1])).contains(&y);
            inside.then(|| nearest_points[(y * i64::from(self.size[0]) + x) as usize]).flatten()
        };
        let own = at(0, 0)?;
        let nearer = |dx, dy| at(dx, dy).is_some_and(|other| other.depth < NEARER * own.depth);
        if [(1, 0), (0, 1), (1, 1), (1, -1)].iter().any(|&(dx, dy)| nearer(dx, dy) && nearer(-dx, -dy)) {
            return None;
        }
        let centre = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
        let aside = own.at - centre;
        let [right, down] = [aside.x, aside.y].map(|aside| if aside > 0.0 { -1 } else { 1 });
        let across = [(right, 0), (0, down), (right, down)].into_iter().filter_map(|(dx, dy)| at(dx, dy));
        let mut sum = weight(aside) * own.radiance;
        let mut weights = weight(aside);
        for other in across {
            let beyond = other.at - centre;
            let contrast = (root(other.radiance) - root(own.radiance)).abs().max_element();
            if contrast * aside.length() / (beyond - aside).length().max(LEAST_WAY) > ERROR {
                return None;
            }
            sum += weight(beyond) * other.radiance;
            weights += weight(beyond);
        }
        Some(sum / weights)
    }
}

/// Bilinear weight of a point by its offset from the pixel's centre.
fn weight(aside: DVec2) -> f64 {
    (1.0 - aside.x.abs()).max(0.0) * (1.0 - aside.y.abs()).max(0.0)
}

fn root(radiance: DVec3) -> DVec3 {
    radiance.max(DVec3::ZERO).map(f64::sqrt)
}
