//! Textures: glTF's wrap modes and filters (glTF 2.0, section 3.8.4), sRGB by its formula (IEC 61966-2-1).

use glam::{DVec2, DVec3, DVec4};

use super::Reference;
use crate::scene::{Image8, Material, Texture, Wrap};

/// Greatest ratio of a footprint's length to its width.
const MOST_LENGTH: f64 = 5.0;
/// Greatest numbers of points along the longer and the shorter axis.
const LONGEST: [f64; 2] = [9.0, 3.0];
/// Fraction of a level above which the next one is blended in.
const SETS_IN: f64 = 0.75;

/// The encoding of an image's bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// sRGB-encoded colour with linear alpha.
    Srgb,
    /// Linear values.
    Linear,
}

impl Reference {
    /// Average of a texture over a footprint with these second moments (ss, tt, st) of its axes in texture
    /// coordinates, as linear RGBA; ones without a texture.
    ///
    /// It is taken over points of one mip level, or of two, along both axes at distances of the level's texels.
    /// The number of points is such that second moments match those of an average over the image itself.
    #[must_use]
    pub fn texture(
        &self,
        texture: Option<u32>,
        encoding: Encoding,
        texcoord: DVec2,
        footprint: DVec3,
    ) -> DVec4 {
        let Some(texture) = texture.and_then(|i| self.scene.textures.get(i as usize)) else {
            return DVec4::ONE;
        };
        let image = &self.scene.images[texture.image as usize];
        let size = DVec2::new(f64::from(image.width), f64::from(image.height));
        let (longer2, shorter2, axis) =
            axes(footprint * DVec3::new(size.x * size.x, size.y * size.y, size.x * size.y));
        if longer2 <= 1.0 {
            return self.point(texture, 0, texture.nearest, encoding, texcoord);
        }
        let (longer2, shorter2) = (longer2 - 1.0, (shorter2 - 1.0).max(0.0));
        let texel2 = (1.0 + shorter2 / 3.0).max((longer2 + 3.0) / (MOST_LENGTH * MOST_LENGTH + 2.0));
        let level = (0.5 * texel2.log2()).min(self.levels[texture.image as usize].len() as f64);
        let points = |level: f64| {
            let side = level.exp2();
            let length =
                |axis2: f64, longest: f64| ((axis2 + 3.0) / (side * side) - 2.0).max(1.0).sqrt().min(longest);
            let (columns, rows) = (length(longer2, LONGEST[0]), length(shorter2, LONGEST[1]));
            let weight = |i: i32, length: f64| (0.5 * length + 0.5 - f64::from(i.abs())).clamp(0.0, 1.0);
            let grid = (-2..=2).flat_map(|j| (-5..=5).map(move |i| (i, j)));
            grid.map(|(i, j)| (i, j, weight(i, columns) * weight(j, rows)))
                .filter(|(.., weight)| *weight > 0.0)
                .map(|(i, j, weight)| {
                    let away = f64::from(i) * axis + f64::from(j) * axis.perp();
                    let at = texcoord + side * away / size;
                    weight * self.point(texture, level as usize, false, encoding, at)
                })
                .sum::<DVec4>()
                / (columns * rows)
        };
        let (below, part) = (level.floor(), level - level.floor());
        let finer = points(below);
        if part <= SETS_IN {
            finer
        } else {
            finer.lerp(points(below + 1.0), (part - SETS_IN) / (1.0 - SETS_IN))
        }
    }

    /// Samples one mip level of a texture at a point.
    fn point(
        &self,
        texture: &Texture,
        level: usize,
        nearest: bool,
        encoding: Encoding,
        texcoord: DVec2,
    ) -> DVec4 {
        let image = texture.image as usize;
        let image = if level == 0 { &self.scene.images[image] } else { &self.levels[image][level - 1] };
        let size = DVec2::new(f64::from(image.width), f64::from(image.height));
        let texel = |x: f64, y: f64| {
            let x = wrapped(x, size.x, texture.wrap[0]);
            let y = wrapped(y, size.y, texture.wrap[1]);
            self.texel(image, x, y, encoding)
        };
        if nearest {
            let at = (texcoord * size).floor();
            return texel(at.x, at.y);
        }
        let at = texcoord * size - 0.5;
        let (low, part) = (at.floor(), at - at.floor());
        let top = texel(low.x, low.y).lerp(texel(low.x + 1.0, low.y), part.x);
        let bottom = texel(low.x, low.y + 1.0).lerp(texel(low.x + 1.0, low.y + 1.0), part.x);
        top.lerp(bottom, part.y)
    }

    fn texel(&self, image: &Image8, x: f64, y: f64, encoding: Encoding) -> DVec4 {
        let at = 4 * (y as usize * image.width as usize + x as usize);
        let color = |byte: u8| match encoding {
            Encoding::Srgb => self.srgb[usize::from(byte)],
            Encoding::Linear => f64::from(byte) / 255.0,
        };
        let [r, g, b, a] = [0, 1, 2, 3].map(|i| image.rgba[at + i]);
        DVec4::new(color(r), color(g), color(b), f64::from(a) / 255.0)
    }

    /// Texture coordinates wrapped into [0, 1] by the object's first texture; (0, 0) in a scene without textures.
    pub(super) fn folded(&self, object: u32, texcoord: DVec2) -> DVec2 {
        if !self.features.textures {
            return DVec2::ZERO;
        }
        let wrap = match self.first_texture(object) {
            Some(texture) => self.scene.textures[texture as usize].wrap,
            None => [Wrap::Repeat; 2],
        };
        DVec2::new(folded(texcoord.x, wrap[0]), folded(texcoord.y, wrap[1]))
    }

    /// The footprint at [`Reference::folded`] coordinates: its correlation flips if exactly one coordinate is
    /// mirrored.
    pub(super) fn folded_footprint(&self, object: u32, texcoord: DVec2, footprint: DVec3) -> DVec3 {
        let wrap =
            self.first_texture(object).map_or([Wrap::Repeat; 2], |t| self.scene.textures[t as usize].wrap);
        let backwards = |x: f64, wrap| wrap == Wrap::MirroredRepeat && x.rem_euclid(2.0) >= 1.0;
        let turned = backwards(texcoord.x, wrap[0]) != backwards(texcoord.y, wrap[1]);
        DVec3::new(footprint.x, footprint.y, if turned { -footprint.z } else { footprint.z })
    }

    /// The object's texture whose wrap modes apply to stored coordinates.
    pub(super) fn first_texture(&self, object: u32) -> Option<u32> {
        self.material_of(object).textures().next()
    }

    pub(super) fn material_of(&self, object: u32) -> &Material {
        &self.scene.materials[self.scene.objects[object as usize].material as usize]
    }
}

/// Squared lengths of an ellipse's axes, the longer one first, and the longer one's direction: eigenvalues and
/// eigenvector of the second moments.
fn axes(moments: DVec3) -> (f64, f64, DVec2) {
    let (mean, difference) = (0.5 * (moments.x + moments.y), 0.5 * (moments.x - moments.y));
    let angle = 0.5 * moments.z.atan2(difference);
    let spread = difference.hypot(moments.z);
    (mean + spread, mean - spread, DVec2::from_angle(angle))
}

/// The linear values of all 256 sRGB bytes.
pub(super) fn srgb_table() -> [f64; 256] {
    std::array::from_fn(|byte| {
        let c = byte as f64 / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    })
}

/// Wraps a texel index `i` in a row of `size` texels.
fn wrapped(i: f64, size: f64, wrap: Wrap) -> f64 {
    match wrap {
        Wrap::Repeat => i.rem_euclid(size),
        Wrap::MirroredRepeat => {
            let within = i.rem_euclid(2.0 * size);
            within.min(2.0 * size - 1.0 - within)
        }
        Wrap::ClampToEdge => i.clamp(0.0, size - 1.0),
    }
}

fn folded(x: f64, wrap: Wrap) -> f64 {
    match wrap {
        Wrap::Repeat => x.rem_euclid(1.0),
        Wrap::MirroredRepeat => x.rem_euclid(2.0).min(2.0 - x.rem_euclid(2.0)),
        Wrap::ClampToEdge => x.clamp(0.0, 1.0),
    }
}
