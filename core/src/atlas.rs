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
        let widest = images.iter().map(|i| i.width.max(i.height)).max().unwrap_or(1);
        let area: u64 = images.iter().map(|i| u64::from(i.width) * u64::from(i.height)).sum();
        // Pages no larger than one texture's worth of all texels needs to be.
        let side = ((area as f64 * 1.1).sqrt() as u32)
            .next_power_of_two()
            .clamp(widest, 4096.max(widest))
            .min(limits.max_texture_dimension_2d);
        if widest > side {
            return Err(Error::Missing {
                what: format!("a texture of {widest} texels a side"),
                need: format!("{widest} texels"),
                have: side.to_string(),
                adapter: gpu.facts().info.name.clone(),
            });
        }
        let mut allocators: Vec<AtlasAllocator> = Vec::new();
        let mut spots = Vec::with_capacity(images.len());
        for image in &images {
            spots.push(place(&mut allocators, image.width, image.height, side));
        }
        let pages = allocators.len().max(1) as u32;
        if pages > limits.max_texture_array_layers {
            return Err(Error::Missing {
                what: "the textures".into(),
                need: format!("{pages} pages of {side} x {side} texels"),
                have: limits.max_texture_array_layers.to_string(),
                adapter: gpu.facts().info.name.clone(),
            });
        }
        let side = if images.is_empty() { 1 } else { side };
        let bytes = 4 * u64::from(side) * u64::from(side) * u64::from(pages);
        let texture = gpu.checked("the textures", Some(bytes), |device| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some("atlas"),
                size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: pages },
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

fn place(allocators: &mut Vec<AtlasAllocator>, width: u32, height: u32, side: u32) -> Place {
    let wanted = size2(width as i32, height as i32);
    let found = |page: usize, allocator: &mut AtlasAllocator| {
        allocator.allocate(wanted).map(|a| Place {
            page: page as u32,
            x: a.rectangle.min.x as u32,
            y: a.rectangle.min.y as u32,
        })
    };
    if let Some(spot) = allocators.iter_mut().enumerate().find_map(|(page, a)| found(page, a)) {
        return spot;
    }
    let mut fresh = AtlasAllocator::new(size2(side as i32, side as i32));
    let spot =
        found(allocators.len(), &mut fresh).unwrap_or(Place { page: allocators.len() as u32, x: 0, y: 0 });
    allocators.push(fresh);
    spot
}
