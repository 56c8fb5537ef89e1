//! Mip levels by exact box filtering: each texel of a level is the average of the area of the image that it
//! covers, with fractional weights at the borders, so that odd sizes lose no row or column.

use glam::{Vec4, Vec4Swizzles as _};

use crate::image::{linear_to_srgb, srgb_to_linear};
use crate::scene::{Image8, Scene, TextureSlot};

/// The encoding of an image's bytes, which determines how texels are averaged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Content {
    /// Linear values.
    Data,
    /// Unit vectors, each component as twice the channel minus one; averages are shorter where they differ.
    Normal,
    /// sRGB colour, averaged in linear light; alpha is linear and is not a weight.
    Color,
    /// sRGB colour with alpha cutouts or coverage, weighted by alpha, as the colour of holes is never visible. Fully
    /// transparent texels take the colour of the next smaller level, since filters reach across the edges of
    /// holes.
    CutColor,
}

impl Content {
    /// The content of each image of a scene; among several uses, the variant declared last wins.
    pub fn of_images(scene: &Scene) -> Vec<Self> {
        let mut contents = vec![Self::Data; scene.images.len()];
        for m in &scene.materials {
            let base = if m.alpha_cutoff.is_some() || m.blends { Self::CutColor } else { Self::Color };
            for slot in TextureSlot::ALL {
                let content = match slot {
                    TextureSlot::BaseColor => base,
                    TextureSlot::Normal => Self::Normal,
                    slot if slot.is_color() => Self::Color,
                    _ => continue,
                };
                let image = m.texture(slot).map(|t| scene.textures[t as usize].image as usize);
                if let Some(image) = image {
                    contents[image] = contents[image].max(content);
                }
            }
        }
        contents
    }

    /// Decodes a texel's bytes to the values that are averaged.
    fn decode(self, texel: [u8; 4], linear: &[f32; 256]) -> Vec4 {
        let plain = Vec4::from(texel.map(f32::from)) / 255.0;
        let [r, g, b, _] = texel.map(|byte| linear[usize::from(byte)]);
        match self {
            Self::Data => plain,
            Self::Normal => {
                let normal = (2.0 * plain.xyz() - 1.0).normalize_or_zero();
                (0.5 * normal + 0.5).extend(plain.w)
            }
            Self::Color => Vec4::new(r, g, b, plain.w),
            Self::CutColor => Vec4::new(r * plain.w, g * plain.w, b * plain.w, plain.w),
        }
    }

    fn encode(self, average: Vec4) -> [u8; 4] {
        let color = match self {
            Self::CutColor if average.w > 0.0 => average / average.w,
            _ => average,
        };
        let byte = |x: f32| (255.0 * x).round() as u8;
        let linear = matches!(self, Self::Data | Self::Normal);
        let [r, g, b, _] = color.to_array().map(|c| byte(if linear { c } else { linear_to_srgb(c) }));
        [r, g, b, byte(average.w)]
    }
}

/// Width and height of a level in texels; level 0 is the image.
pub fn level_size(size: [u32; 2], level: u32) -> [u32; 2] {
    size.map(|side| (side >> level).max(1))
}

/// Index of the level of a single texel.
pub fn last_level([width, height]: [u32; 2]) -> u32 {
    width.max(height).max(1).ilog2()
}

/// The mip levels of an image, from level 1 on.
pub fn levels(image: &Image8, content: Content) -> Vec<Image8> {
    let linear = srgb_to_linear();
    let size = [image.width, image.height];
    let texels = |i: usize| {
        let [r, g, b, a] = [0, 1, 2, 3].map(|channel| image.rgba[4 * i + channel]);
        content.decode([r, g, b, a], &linear)
    };
    let mut averages: Vec<([u32; 2], Vec<Vec4>)> = Vec::new();
    for level in 1..=last_level(size) {
        let smaller = level_size(size, level);
        let texels = match averages.last() {
            None => averaged(size, smaller, texels),
            Some((larger, of)) => averaged(*larger, smaller, |i| of[i]),
        };
        averages.push((smaller, texels));
    }
    let mut levels: Vec<Image8> = averages
        .iter()
        .map(|([width, height], texels)| {
            let rgba = texels.iter().flat_map(|average| content.encode(*average)).collect();
            Image8 { width: *width, height: *height, rgba }
        })
        .collect();
    if content == Content::CutColor {
        fill_holes(&mut levels);
    }
    levels
}

/// Averages a grid of texels over the areas that the texels of a smaller grid cover.
fn averaged(larger: [u32; 2], smaller: [u32; 2], texel: impl Fn(usize) -> Vec4) -> Vec<Vec4> {
    let [columns, rows] = [0, 1].map(|axis| shares(larger[axis], smaller[axis]));
    let mut averages = Vec::with_capacity(rows.len() * columns.len());
    for row in &rows {
        for column in &columns {
            let in_row = |y: usize| -> Vec4 {
                column.iter().map(|(x, share)| *share * texel(y * larger[0] as usize + x)).sum()
            };
            averages.push(row.iter().map(|(y, share)| *share * in_row(*y)).sum());
        }
    }
    averages
}

/// For each of `few` equal parts of a row of `many` texels: the texels that it covers and their weights, which
/// sum to 1.
fn shares(many: u32, few: u32) -> Vec<Vec<(usize, f32)>> {
    let covered = f64::from(many) / f64::from(few);
    let part = |i: u32| {
        // In units of 1 / `few` texel, which is exact.
        let (low, high) = (u64::from(i) * u64::from(many), u64::from(i + 1) * u64::from(many));
        let few = u64::from(few);
        let share = |x: u64| ((x + 1) * few).min(high) - (x * few).max(low);
        let texels = low / few..high.div_ceil(few);
        texels.map(|x| (x as usize, (share(x) as f64 / (few as f64 * covered)) as f32)).collect()
    };
    (0..few).map(part).collect()
}

/// Gives fully transparent texels the colour of the next smaller level.
fn fill_holes(levels: &mut [Image8]) {
    for larger in (1..levels.len()).rev() {
        let (larger, smaller) = levels.split_at_mut(larger);
        let (Some(larger), Some(smaller)) = (larger.last_mut(), smaller.first()) else { continue };
        for i in 0..larger.rgba.len() / 4 {
            if larger.rgba[4 * i + 3] == 0 {
                let (x, y) = (i as u32 % larger.width, i as u32 / larger.width);
                let [x, y] = [(x, larger.width, smaller.width), (y, larger.height, smaller.height)]
                    .map(|(at, of, to)| u64::from(at) * u64::from(to) / u64::from(of));
                let from = 4 * (y * u64::from(smaller.width) + x) as usize;
                larger.rgba[4 * i..4 * i + 3].copy_from_slice(&smaller.rgba[from..from + 3]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: u32, height: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Image8 {
        let rgba = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).flat_map(|(x, y)| texel(x, y));
        Image8 { width, height, rgba: rgba.collect() }
    }

    fn noise(width: u32, height: u32) -> Image8 {
        let byte = |i: u32| (i.wrapping_mul(2_654_435_761) >> 24) as u8;
        image(width, height, |x, y| [0, 1, 2, 3].map(|channel| byte(4 * (y * width + x) + channel + 1)))
    }

    /// The mean of each decoded channel, computed in f64.
    fn mean(image: &Image8) -> [f64; 4] {
        let count = image.rgba.len() as f64 / 4.0;
        let linear = srgb_to_linear();
        std::array::from_fn(|channel| {
            let values = image.rgba.iter().skip(channel).step_by(4).map(|b| match channel {
                3 => f64::from(*b) / 255.0,
                _ => f64::from(linear[usize::from(*b)]),
            });
            values.sum::<f64>() / count
        })
    }

    #[test]
    fn levels_halve_until_one_texel() {
        for (size, expected) in [
            ([1, 1], vec![]),
            ([2, 1], vec![[1, 1]]),
            ([5, 3], vec![[2, 1], [1, 1]]),
            ([1, 9], vec![[1, 4], [1, 2], [1, 1]]),
        ] {
            let levels = levels(&noise(size[0], size[1]), Content::Data);
            let sizes: Vec<_> = levels.iter().map(|level| [level.width, level.height]).collect();
            assert_eq!(sizes, expected, "{size:?}");
            assert_eq!(last_level(size) as usize, expected.len());
            assert!(levels.iter().all(|l| l.rgba.len() == 4 * (l.width * l.height) as usize));
        }
    }

    #[test]
    fn a_checkerboard_is_half_as_bright_and_not_half_the_bytes() {
        let board = image(64, 64, |x, y| [[0, 0, 0, 255], [255, 255, 255, 255]][((x + y) % 2) as usize]);
        for level in levels(&board, Content::Color) {
            // The sRGB encoding of 0.5 is 187.52.
            assert!(level.rgba.chunks(4).all(|texel| texel == [188, 188, 188, 255]), "{level:?}");
        }
        for level in levels(&board, Content::Data) {
            assert!(level.rgba.chunks(4).all(|texel| texel == [128, 128, 128, 255]), "{level:?}");
        }
    }

    /// No row or column is weighted less, whatever the size. Half a step of sRGB is at most 0.0043 in linear
    /// light.
    #[test]
    fn every_level_has_the_mean_of_the_image() {
        for (width, height) in [(16, 16), (5, 3), (7, 1), (1, 31), (13, 6), (100, 37)] {
            let whole = noise(width, height);
            let exact = mean(&whole);
            for level in levels(&whole, Content::Color) {
                for (found, exact) in mean(&level).iter().zip(exact) {
                    let what = format!("{width} x {height} at {} x {}", level.width, level.height);
                    assert!((found - exact).abs() < 0.0044, "{what}: {found}, exactly {exact}");
                }
            }
        }
    }

    #[test]
    fn parts_of_texels_count_by_their_area() {
        let row = image(5, 1, |x, _| [[10, 20, 30, 40, 50][x as usize]; 4]);
        let halves = levels(&row, Content::Data).remove(0);
        // (10 + 20 + 30 / 2) / 2.5 and (30 / 2 + 40 + 50) / 2.5
        assert_eq!(halves.rgba, [[18; 4], [42; 4]].concat());
    }

    #[test]
    fn holes_have_no_colour() {
        let leaf = image(4, 4, |x, _| if x < 2 { [0, 200, 0, 255] } else { [255, 0, 255, 0] });
        let cut = levels(&leaf, Content::CutColor);
        assert_eq!(cut[0].rgba[..8], [0, 200, 0, 255, 0, 200, 0, 0]);
        assert_eq!(cut[1].rgba, [0, 200, 0, 128]);
        let painted = levels(&leaf, Content::Color);
        assert_eq!(painted[0].rgba[..8], [0, 200, 0, 255, 255, 0, 255, 0]);
    }
}
