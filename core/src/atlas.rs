//! All images of a scene in the pages of one array texture.

use etagere::{AtlasAllocator, size2};

use crate::{
    Error, Gpu, Result,
    scene::{Image8, Scene, Texture, Wrap},
};

/// Flags and wrap modes in the last word of a place, shared with `texture_atlas.wgsl`.
pub const TEXTURE_NEAREST: u32 = 0x4000_0000;
pub const TEXTURE_PRESENT: u32 = 0x8000_0000;
pub const WRAP_REPEAT: u32 = 0;
pub const WRAP_MIRROR: u32 = 1;
const WRAP_CLAMP: u32 = 2;

/// The pages on the device, read as sRGB and as plain numbers.
pub struct Atlas {
    texture: wgpu::Texture,
    /// Decodes sRGB.
    pub color: wgpu::TextureView,
    /// The texels as they are.
    pub data: wgpu::TextureView,
    places: Vec<[u32; 3]>,
}

#[derive(Clone, Copy)]
struct Place {
    page: u32,
    x: u32,
    y: u32,
}

impl Atlas {
    /// Packs and uploads the images that textures show; a scene without textures gets one white texel.
    ///
    /// # Errors
    /// [`Error::Missing`] where an image or the number of pages exceeds the device.
    pub fn upload(gpu: &Gpu, scene: &mut Scene) -> Result<Self> {
        let images = std::mem::take(&mut scene.images);
        let limits = gpu.limits();
        let page = page_size(&images);
        let longest = page[0].max(page[1]);
        if longest > limits.max_texture_dimension_2d {
            return Err(Error::Missing {
                what: "the largest texture".into(),
                need: format!("{longest} texels a side"),
                have: limits.max_texture_dimension_2d.to_string(),
                adapter: gpu.facts().info.name.clone(),
            });
        }
        let mut allocators: Vec<AtlasAllocator> = Vec::new();
        let mut spots = Vec::with_capacity(images.len());
        for image in &images {
            spots.push(place(&mut allocators, [image.width, image.height], page)?);
        }
        let pages = allocators.len().max(1) as u32;
        if pages > limits.max_texture_array_layers {
            return Err(Error::Missing {
                what: "the textures".into(),
                need: format!("{pages} pages of {} x {} texels", page[0], page[1]),
                have: limits.max_texture_array_layers.to_string(),
                adapter: gpu.facts().info.name.clone(),
            });
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
        for (image, spot) in images.into_iter().zip(&spots) {
            gpu.queue.write_texture(
                wgpu::TexelCopyTextureInfo {
                    texture: &texture,
                    mip_level: 0,
                    origin: wgpu::Origin3d { x: spot.x, y: spot.y, z: spot.page },
                    aspect: wgpu::TextureAspect::All,
                },
                &image.rgba,
                wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(4 * image.width),
                    rows_per_image: None,
                },
                wgpu::Extent3d { width: image.width, height: image.height, depth_or_array_layers: 1 },
            );
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

    /// Where texture `index` stands, as the shaders read it; zeros for no texture.
    pub fn place(&self, index: Option<u32>) -> [u32; 3] {
        index.and_then(|i| self.places.get(i as usize)).copied().unwrap_or_default()
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        let size = self.texture.size();
        4 * u64::from(size.width) * u64::from(size.height) * u64::from(size.depth_or_array_layers)
    }
}

/// A texture's place as `texture_atlas.wgsl` reads it.
fn shader_place(texture: &Texture, spot: Place, image: &Image8) -> [u32; 3] {
    let wrap = |w| match w {
        Wrap::Repeat => WRAP_REPEAT,
        Wrap::MirroredRepeat => WRAP_MIRROR,
        Wrap::ClampToEdge => WRAP_CLAMP,
    };
    let nearest = if texture.nearest { TEXTURE_NEAREST } else { 0 };
    [
        spot.x | spot.y << 16,
        image.width | image.height << 16,
        spot.page | wrap(texture.wrap[0]) << 16 | wrap(texture.wrap[1]) << 18 | nearest | TEXTURE_PRESENT,
    ]
}

/// The most texels a side that pages have without need.
const PAGE_SIDE: u32 = 4096;

/// Width and height of the pages: no larger than all texels need, and as wide and as high as the largest image is. An
/// image of 16384 x 1 makes a page that is wide and not one that is square.
fn page_size(images: &[Image8]) -> [u32; 2] {
    let area: u64 = images.iter().map(|i| u64::from(i.width) * u64::from(i.height)).sum();
    let side = ((area as f64 * 1.1).sqrt() as u32).next_power_of_two().min(PAGE_SIDE);
    let width = images.iter().map(|i| i.width).max().unwrap_or(1);
    let height = images.iter().map(|i| i.height).max().unwrap_or(1);
    [side.max(width), side.max(height)]
}

/// A place for an image on the pages, the last of which may be new.
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

    fn places(sizes: &[[u32; 2]]) -> ([u32; 2], Vec<Place>) {
        let image = |&[width, height]: &[u32; 2]| Image8 { width, height, rgba: Vec::new() };
        let page = page_size(&sizes.iter().map(image).collect::<Vec<_>>());
        let mut pages = Vec::new();
        (page, sizes.iter().map(|size| place(&mut pages, *size, page).unwrap()).collect())
    }

    #[test]
    fn pages_are_as_large_as_their_images() {
        assert_eq!(page_size(&[]), [1, 1]);
        for (sizes, expected) in [
            (vec![[1, 1]], [1, 1]),
            (vec![[16_384, 1]], [16_384, 256]),
            (vec![[1, 16_384]], [256, 16_384]),
            (vec![[3, 5], [64, 2]], [64, 16]),
            (vec![[4096, 4096]; 3], [4096, 4096]),
            (vec![[5000, 5000]], [5000, 5000]),
        ] {
            let (page, places) = places(&sizes);
            assert_eq!(page, expected, "{sizes:?}");
            for (place, [width, height]) in places.iter().zip(&sizes) {
                assert!(place.x + width <= page[0] && place.y + height <= page[1], "{sizes:?}");
            }
        }
    }

    #[test]
    fn images_do_not_overlap() {
        let sizes: Vec<_> = (0..200).map(|i| [1 + i * 37 % 61, 1 + i * 53 % 67]).collect();
        let (_, places) = places(&sizes);
        let apart = |i: usize, j: usize| {
            let ([a, b], [p, q]) = ([places[i], places[j]], [sizes[i], sizes[j]]);
            a.page != b.page
                || a.x + p[0] <= b.x
                || b.x + q[0] <= a.x
                || a.y + p[1] <= b.y
                || b.y + q[1] <= a.y
        };
        assert!((0..sizes.len()).all(|i| (0..i).all(|j| apart(i, j))));
    }
}
