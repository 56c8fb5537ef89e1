//! Storage of randomly accessed scene data: buffers on GPUs, images on CPUs.

use super::Gpu;
use crate::Result;

/// Width in texels of the images; a texel holds four words.
pub const STORAGE_TEXTURE_WIDTH: u32 = 4096;

const TEXEL_BYTES: u32 = 16;

/// Scene data as 32-bit words.
#[derive(Clone)]
pub enum SceneStorage {
    /// A storage buffer.
    Buffer(wgpu::Buffer),
    /// An RGBA32Uint image, four words per texel, row by row.
    Texels(wgpu::Texture, wgpu::TextureView),
}

impl SceneStorage {
    pub fn binding(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Buffer(buffer) => buffer.as_entire_binding(),
            Self::Texels(_, view) => wgpu::BindingResource::TextureView(view),
        }
    }

    /// Size on the device in bytes.
    pub fn bytes(&self) -> u64 {
        match self {
            Self::Buffer(buffer) => buffer.size(),
            Self::Texels(image, _) => image_bytes(image.height()),
        }
    }
}

fn image_bytes(rows: u32) -> u64 {
    u64::from(STORAGE_TEXTURE_WIDTH) * u64::from(TEXEL_BYTES) * u64::from(rows)
}

impl Gpu {
    /// Stores words that shaders read four at a time.
    pub(crate) fn words<T: bytemuck::NoUninit>(&self, label: &str, content: &[T]) -> Result<SceneStorage> {
        if self.tier.stores_images() {
            self.texels(label, bytemuck::cast_slice(content))
        } else {
            Ok(SceneStorage::Buffer(self.storage(label, content)?))
        }
    }

    /// Stores three corners per primitive, like [`Gpu::words`]; in an image each corner has a texel.
    pub(crate) fn corners(&self, label: &str, content: &[[[f32; 3]; 3]]) -> Result<SceneStorage> {
        if self.tier.stores_images() {
            let texels: Vec<_> =
                content.iter().map(|corners| corners.map(|[x, y, z]| [x, y, z, 0.0])).collect();
            self.words(label, &texels)
        } else {
            self.words(label, content)
        }
    }

    /// Stores vertex attributes by primitive, like [`Gpu::words`]. In an image they take three texels: the
    /// coordinates of two corners, those of the third with its colour, and the colours of the first two. Colours are
    /// inverted there, so that zeros, which stand where there is nothing, are white.
    pub(crate) fn vertices(&self, label: &str, content: &[u32], primitives: usize) -> Result<SceneStorage> {
        if !self.tier.stores_images() {
            return self.words(label, content);
        }
        let stride = content.len() / primitives.max(1);
        let texels: Vec<_> = content
            .chunks_exact(stride.max(1))
            .flat_map(|words| {
                let at = |i: usize| words.get(i).copied().unwrap_or_default();
                let color = |i: usize| words.get(6 + i).map_or(0, |word| !word);
                [
                    [at(0), at(1), at(2), at(3)],
                    [at(4), at(5), color(4), color(5)],
                    [color(0), color(1), color(2), color(3)],
                ]
            })
            .collect();
        self.words(label, &texels)
    }

    /// Checks that the device can hold the corners of that many primitives.
    pub(crate) fn check_corners(&self, label: &str, primitives: usize) -> Result<()> {
        if self.tier.stores_images() {
            self.check_storage_texture(label, (primitives * size_of::<[[f32; 4]; 3]>()) as u64)
        } else {
            self.check_binding(label, (primitives * size_of::<[[f32; 3]; 3]>()) as u64)
        }
    }

    /// Creates an image with this content and at least one row.
    fn texels(&self, label: &str, content: &[u8]) -> Result<SceneStorage> {
        self.check_storage_texture(label, content.len() as u64)?;
        let row_bytes = image_bytes(1) as usize;
        let rows = content.len().div_ceil(row_bytes).max(1) as u32;
        self.checked(&format!("image `{label}`"), Some(image_bytes(rows)), |device| {
            let image = device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: STORAGE_TEXTURE_WIDTH, height: rows, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::Rgba32Uint,
                usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
                view_formats: &[],
            });
            let (whole, rest) = content.split_at(content.len() / row_bytes * row_bytes);
            let begun = (whole.len() / row_bytes) as u32;
            self.write_texels(&image, 0, [STORAGE_TEXTURE_WIDTH, begun], whole);
            self.write_texels(&image, begun, [rest.len() as u32 / TEXEL_BYTES, 1], rest);
            let view = image.create_view(&wgpu::TextureViewDescriptor::default());
            SceneStorage::Texels(image, view)
        })
    }

    /// Writes `width` x `height` texels from the start of row `row` on.
    fn write_texels(&self, image: &wgpu::Texture, row: u32, [width, height]: [u32; 2], texels: &[u8]) {
        if texels.is_empty() {
            return;
        }
        self.queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                origin: wgpu::Origin3d { x: 0, y: row, z: 0 },
                ..image.as_image_copy()
            },
            texels,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(STORAGE_TEXTURE_WIDTH * TEXEL_BYTES),
                rows_per_image: None,
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
    }

    /// Checks that one image can hold that many bytes.
    fn check_storage_texture(&self, label: &str, bytes: u64) -> Result<()> {
        let have = image_bytes(self.device.limits().max_texture_dimension_2d);
        self.check_bytes(format!("image `{label}`"), bytes, "in one image", have)
    }
}
