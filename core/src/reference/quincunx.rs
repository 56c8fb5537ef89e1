//! The lecture's adaptive supersampling: the recursion of its slides, with two levels.

use glam::DVec3;

use super::{
    ReferenceFrame, Rounding,
    contrast::{contrasts, exceeds},
};

/// A position in the frame, in eighths of a pixel.
type Point = [u32; 2];

/// A pixel of a frame by quincunx sampling.
#[derive(Clone, Copy, Debug)]
pub struct Quincunx {
    /// Linear RGB radiance.
    pub color: DVec3,
    /// Divided quads: bit i for quarter i of the pixel, bit 4 + 4 i + j for quarter j of quarter i.
    pub divided: u32,
}

/// The recursive subdivision of one pixel.
struct Recursion<'a, 'r> {
    frame: &'a ReferenceFrame<'r>,
    decided: Option<u32>,
    divided: u32,
}

impl ReferenceFrame<'_> {
    /// A pixel of a quincunx frame. If `decided` is given, it states which quads are divided.
    #[must_use]
    pub fn quincunx(&self, pixel: [u32; 2], decided: Option<u32>, rounding: &mut Rounding) -> Quincunx {
        let mut recursion = Recursion { frame: self, decided, divided: 0 };
        let center = pixel.map(|i| 8 * i + 4);
        let mut color = DVec3::ZERO;
        for subpixel in 0..4 {
            let corner = [pixel[0] + subpixel % 2, pixel[1] + subpixel / 2].map(|i| 8 * i);
            color += recursion.quad([center, corner], 0, subpixel, rounding) / 4.0;
        }
        Quincunx { color, divided: recursion.divided }
    }
}

impl Recursion<'_, '_> {
    /// Mean radiance of a quad from its inner to its outer corner; `path` is the quad's index in its level.
    fn quad(&mut self, [inner, outer]: [Point; 2], level: u32, path: u32, rounding: &mut Rounding) -> DVec3 {
        let ends = [inner, outer].map(|point| self.at(point, rounding));
        let bit = 1 << (4 * level + path);
        let quincunx_threshold = f64::from(self.frame.settings.quincunx_threshold);
        let differs = level < 2
            && self
                .decided
                .map_or_else(|| differ(ends, quincunx_threshold, rounding), |bits| bits & bit != 0);
        if !differs {
            return (ends[0] + ends[1]) / 2.0;
        }
        self.divided |= bit;
        let middle = [0, 1].map(|i| u32::midpoint(inner[i], outer[i]));
        let corners = [inner, [outer[0], inner[1]], [inner[0], outer[1]], outer];
        let parts = (0..4).zip(corners);
        parts
            .map(|(part, corner)| self.quad([middle, corner], level + 1, 4 * path + part, rounding) / 4.0)
            .sum()
    }

    fn at(&self, point: Point, rounding: &mut Rounding) -> DVec3 {
        let side = 0.5_f64.sqrt() / f64::from(1 << level(point));
        let (ray, length) = self.frame.ray_at(point.map(|i| f64::from(i) / 8.0), side);
        self.frame.followed(&ray, length, rounding).color
    }
}

/// The level that first traces a sample: 0 for centres and corners of pixels, then those of quarters, then those
/// of quarters of quarters.
fn level(point: Point) -> u32 {
    match point.map(|i| i % 4) {
        [0, 0] if point[0] % 8 == point[1] % 8 => 0,
        [0, 0] | [2, 2] => 1,
        _ => 2,
    }
}

fn differ(ends: [DVec3; 2], quincunx_threshold: f64, rounding: &mut Rounding) -> bool {
    let contrasts = contrasts(ends.into_iter());
    exceeds(contrasts.map(|c| rounding.contrast(c)), quincunx_threshold)
}
