//! The texture atlas: all images of a scene with their mip levels, packed into the layers (pages) of one array
//! texture. Level 0 of an image is one rectangle. All smaller levels share a second one: level 1 at its left, the
//! levels from 2 on below each other at its right.

use etagere::{AtlasAllocator, size2};

use crate::{
    Error, Gpu, Result,
    device::mip::{self, Content},
    scene::{Image8, Scene, Texture, Wrap},
};

/// Flags and wrap modes in the third word of a texture's place, shared with `texture_atlas.wgsl`.
pub const TEXTURE_NEAREST: u32 = 0x4000_0000;
pub const TEXTURE_PRESENT: u32 = 0x8000_0000;
pub const WRAP_REPEAT: u32 = 0;
pub const WRAP_MIRROR: u32 = 1;
const WRAP_CLAMP: u32 = 2;

/// The most pages that the page index in a place can address.
pub const MAX_PAGES: u32 = 1 << 11;

/// The pages on the device, with one view as sRGB and one as linear values.
pub struct Atlas {
    texture: wgpu::Texture,
    /// View as sRGB colours, decoded when read.
    pub color: wgpu::TextureView,
    /// View of the same texels without decoding.
    pub data: wgpu::TextureView,
    places: Vec<[u32; 4]>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Place {
    page: u32,
    x: u32,
    y: u32,
}

impl Atlas {
    /// Packs and uploads the images that textures use; without textures, a single white texel.
    ///
    /// # Errors
    /// [`Error::Missing`] if an image or the number of pages exceeds the device's limits.
    pub fn upload(gpu: &Gpu, scene: &mut Scene) -> Result<Self> {
        let contents = Content::of_images(scene);
        let images = std::mem::take(&mut scene.images);
        let limits = gpu.limits();
        let missing = |what: &str, need: String, have: u32| Error::Missing {
            what: what.into(),
            need,
            have: have.to_string(),
            adapter: gpu.facts().info.name.clone(),
        };
        let longest = images.iter().map(|i| i.width.max(i.height)).max().unwrap_or(1);
        if longest > limits.max_texture_dimension_2d {
            let need = format!("{longest} texels a side");
            return Err(missing("the largest texture", need, limits.max_texture_dimension_2d));
        }
        let Packing { page, pages, spots } = packing(&images, limits.max_texture_dimension_2d)?;
        let most = limits.max_texture_array_layers.min(MAX_PAGES);
        if pages > most {
            let need = format!("{pages} pages of {} x {} texels", page[0], page[1]);
            return Err(missing("the textures", need, most));
        }
        let bytes = 4 * u64::from(page[0]) * u64::from(page[1]) * u64::from(pages);
        let texture = gpu.checked("the textures", Some(bytes), |device| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some("atlas"),
                size: wgpu::Extent3d { width: page[0], height: page[1], depth_or_array_layers: pages },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::Rgba8Unorm,
                usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
                view_formats: &[wgpu::TextureFormat::Rgba8UnormSrgb],
            })
        })?;
        let places = scene
            .textures
            .iter()
            .map(|t| shader_place(t, spots[t.image as usize], &images[t.image as usize]))
            .collect();
        for ((image, [whole, levels]), content) in images.into_iter().zip(&spots).zip(contents) {
            let size = [image.width, image.height];
            write(gpu, &texture, *whole, &image);
            for (level, smaller) in (1..).zip(mip::levels(&image, content)) {
                let [x, y] = level_corner(size, level);
                write(gpu, &texture, Place { x: levels.x + x, y: levels.y + y, ..*levels }, &smaller);
            }
        }
        let view = |format| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2Array),
                format: Some(format),
                ..Default::default()
            })
        };
        Ok(Self {
            color: view(wgpu::TextureFormat::Rgba8UnormSrgb),
            data: view(wgpu::TextureFormat::Rgba8Unorm),
            texture,
            places,
        })
    }

    /// The place of a texture in the atlas, encoded for the shaders; zeros for `None`.
    pub fn place(&self, index: Option<u32>) -> [u32; 4] {
        index.and_then(|i| self.places.get(i as usize)).copied().unwrap_or_default()
    }

    /// Size of the pages in bytes.
    pub fn bytes(&self) -> u64 {
        let size = self.texture.size();
        4 * u64::from(size.width) * u64::from(size.height) * u64::from(size.depth_or_array_layers)
    }
}

fn write(gpu: &Gpu, texture: &wgpu::Texture, spot: Place, image: &Image8) {
    gpu.queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: 0,
            origin: wgpu::Origin3d { x: spot.x, y: spot.y, z: spot.page },
            aspect: wgpu::TextureAspect::All,
        },
        &image.rgba,
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * image.width), rows_per_image: None },
        wgpu::Extent3d { width: image.width, height: image.height, depth_or_array_layers: 1 },
    );
}

/// Encodes a texture's place for `texture_atlas.wgsl`: rectangles, page, wrap modes and flags.
fn shader_place(texture: &Texture, [whole, levels]: [Place; 2], image: &Image8) -> [u32; 4] {
    let wrap = |w| match w {
        Wrap::Repeat => WRAP_REPEAT,
        Wrap::MirroredRepeat => WRAP_MIRROR,
        Wrap::ClampToEdge => WRAP_CLAMP,
    };
    let nearest = if texture.nearest { TEXTURE_NEAREST } else { 0 };
    let wraps = wrap(texture.wrap[0]) << 11 | wrap(texture.wrap[1]) << 13;
    [
        whole.x | whole.y << 16,
        image.width | image.height << 16,
        whole.page | wraps | levels.page << 15 | nearest | TEXTURE_PRESENT,
        levels.x | levels.y << 16,
    ]
}

/// Corner of a level, from 1 on, within the rectangle of the smaller levels.
fn level_corner(size: [u32; 2], level: u32) -> [u32; 2] {
    if level == 1 {
        return [0, 0];
    }
    let above = (2..level).map(|above| mip::level_size(size, above)[1]).sum();
    [mip::level_size(size, 1)[0], above]
}

/// Width and height of the rectangle of all levels from 1 on; zero for an image of a single texel.
fn levels_size(size: [u32; 2]) -> [u32; 2] {
    let last = mip::last_level(size);
    let [right, below] = level_corner(size, last + 1);
    match last {
        0 => [0, 0],
        1 => mip::level_size(size, 1),
        _ => [right + mip::level_size(size, 2)[0], below.max(mip::level_size(size, 1)[1])],
    }
}

/// A packing of all images into pages.
struct Packing {
    /// Width and height of the pages in texels.
    page: [u32; 2],
    pages: u32,
    /// The rectangles of each image: level 0, and all smaller levels.
    spots: Vec<[Place; 2]>,
}

/// Side in texels that pages exceed only for a larger rectangle.
const PAGE_SIDE: u32 = 4096;
/// Ratios of height to width of the pages that are tried, in eighths.
const PAGE_EIGHTHS: [u32; 5] = [4, 6, 8, 10, 12];

/// Finds the packing that takes the least memory.
fn packing(images: &[Image8], longest: u32) -> Result<Packing> {
    let whole = images.iter().map(|i| [i.width, i.height]);
    let sizes: Vec<_> = whole.clone().chain(whole.map(levels_size)).collect();
    let mut best: Option<(u64, Packing)> = None;
    for eighths in PAGE_EIGHTHS {
        let page = page_size(&sizes, eighths).map(|side| side.min(longest));
        let (pages, places) = packed(&sizes, page)?;
        let texels = u64::from(page[0]) * u64::from(page[1]) * u64::from(pages);
        if best.as_ref().is_none_or(|(least, _)| texels < *least) {
            let (images, levels) = places.split_at(images.len());
            let spots = images.iter().zip(levels).map(|(image, levels)| [*image, *levels]).collect();
            best = Some((texels, Packing { page, pages, spots }));
        }
    }
    best.map(|(_, packing)| packing).ok_or_else(|| Error::scene("images", "no page holds them"))
}

/// Width and height of the pages: no larger than the area of all rectangles needs, but at least as wide and as
/// high as the largest rectangle. An image of 16384 x 1 thus makes wide pages instead of large square ones.
fn page_size(sizes: &[[u32; 2]], eighths: u32) -> [u32; 2] {
    let area: u64 = sizes.iter().map(|[width, height]| u64::from(*width) * u64::from(*height)).sum();
    let side = ((area as f64 * 1.1).sqrt() as u32).next_power_of_two().min(PAGE_SIDE);
    let width = sizes.iter().map(|[width, _]| *width).max().unwrap_or(1);
    let height = sizes.iter().map(|[_, height]| *height).max().unwrap_or(1);
    [side.max(width), (side * eighths / 8).max(height).max(1)]
}

/// Packs the rectangles, largest first. Returns the number of pages, at least one, and the place of each
/// rectangle.
fn packed(sizes: &[[u32; 2]], page: [u32; 2]) -> Result<(u32, Vec<Place>)> {
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by_key(|i| std::cmp::Reverse(sizes[*i].iter().max()));
    let mut places = vec![Place::default(); sizes.len()];
    let mut allocators = Vec::new();
    for i in order.into_iter().filter(|i| sizes[*i] != [0, 0]) {
        places[i] = place(&mut allocators, sizes[i], page)?;
    }
    Ok((allocators.len().max(1) as u32, places))
}

/// Allocates a rectangle on one of the pages; adds a page if none has room.
fn place(allocators: &mut Vec<AtlasAllocator>, [width, height]: [u32; 2], page: [u32; 2]) -> Result<Place> {
    let wanted = size2(width as i32, height as i32);
    let found = |number: usize, allocator: &mut AtlasAllocator| {
        let corner = allocator.allocate(wanted)?.rectangle.min;
        Some(Place { page: number as u32, x: corner.x as u32, y: corner.y as u32 })
    };
    if let Some(spot) = allocators.iter_mut().enumerate().find_map(|(number, a)| found(number, a)) {
        return Ok(spot);
    }
    let mut fresh = AtlasAllocator::new(size2(page[0] as i32, page[1] as i32));
    let spot = found(allocators.len(), &mut fresh);
    allocators.push(fresh);
    spot.ok_or_else(|| {
        Error::scene(
            "images",
            format!("{width} x {height} texels do not fit a page of {} x {}", page[0], page[1]),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blank(sizes: &[[u32; 2]]) -> Vec<Image8> {
        sizes.iter().map(|&[width, height]| Image8 { width, height, rgba: Vec::new() }).collect()
    }

    #[test]
    fn pages_are_as_large_as_their_images() {
        for (sizes, expected, pages) in [
            (vec![], [1, 1], 1),
            (vec![[1, 1]], [1, 1], 1),
            (vec![[16_384, 1]], [16_384, 256], 1),
            (vec![[1, 16_384]], [256, 16_384], 1),
            (vec![[4096, 4096]], [4096, 6144], 1),
            (vec![[5000, 5000]], [5000, 5000], 2),
        ] {
            let packing = packing(&blank(&sizes), 16_384).expect("packs");
            assert_eq!((packing.page, packing.pages), (expected, pages), "{sizes:?}");
        }
    }

    /// Images and every level of them.
    #[test]
    fn nothing_overlaps_and_everything_is_on_a_page() {
        let mut sizes: Vec<_> = (0..100).map(|i| [1 + i * 37 % 61, 1 + i * 53 % 67]).collect();
        sizes.extend([[1, 1], [1, 64], [200, 1], [2, 2], [3, 90]]);
        let Packing { page, pages, spots } = packing(&blank(&sizes), 16_384).expect("packs");
        let mut rectangles = Vec::new();
        for (size, [whole, levels]) in sizes.iter().zip(spots) {
            rectangles.push((whole, *size));
            for level in 1..=mip::last_level(*size) {
                let [x, y] = level_corner(*size, level);
                let spot = Place { x: levels.x + x, y: levels.y + y, ..levels };
                rectangles.push((spot, mip::level_size(*size, level)));
            }
        }
        for (i, (a, p)) in rectangles.iter().enumerate() {
            assert!(a.page < pages && a.x + p[0] <= page[0] && a.y + p[1] <= page[1], "{a:?} {p:?}");
            for (b, q) in &rectangles[..i] {
                let apart = a.page != b.page
                    || a.x + p[0] <= b.x
                    || b.x + q[0] <= a.x
                    || a.y + p[1] <= b.y
                    || b.y + q[1] <= a.y;
                assert!(apart, "{a:?} {p:?} and {b:?} {q:?}");
            }
        }
    }
}
