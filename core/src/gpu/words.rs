//! What kernels read at any place.

use super::Gpu;
use crate::{Error, Result};

/// Texels of an image's row, of four words each.
pub const TEXEL_ROW: u32 = 4096;

const TEXEL_BYTES: u32 = 16;

/// Words in a buffer or in an image.
pub enum Words {
    /// A storage buffer.
    Buffer(wgpu::Buffer),
    /// Four words a texel, row by row.
    Texels(wgpu::Texture, wgpu::TextureView),
}

impl Words {
    pub fn binding(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Buffer(buffer) => buffer.as_entire_binding(),
            Self::Texels(_, view) => wgpu::BindingResource::TextureView(view),
        }
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        match self {
            Self::Buffer(buffer) => buffer.size(),
            Self::Texels(image, _) => image_bytes(image.height()),
        }
    }
}

fn image_bytes(rows: u32) -> u64 {
    u64::from(TEXEL_ROW) * u64::from(TEXEL_BYTES) * u64::from(rows)
}

impl Gpu {
    /// An image with this content, of at least one row.
    pub(crate) fn texels<T: bytemuck::NoUninit>(&self, label: &str, content: &[T]) -> Result<Words> {
        let mut bytes = bytemuck::cast_slice(content).to_vec();
        let rows = self.check_texels(label, bytes.len() as u64)?;
        let in_all = image_bytes(rows);
        bytes.resize(in_all as usize, 0);
        let size = wgpu::Extent3d { width: TEXEL_ROW, height: rows, depth_or_array_layers: 1 };
        self.checked(&format!("image `{label}`"), Some(in_all), |device| {
            let image = device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::Rgba32Uint,
                usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
                view_formats: &[],
            });
            let layout = wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(TEXEL_ROW * TEXEL_BYTES),
                rows_per_image: None,
            };
            self.queue.write_texture(image.as_image_copy(), &bytes, layout, size);
            let view = image.create_view(&wgpu::TextureViewDescriptor::default());
            Words::Texels(image, view)
        })
    }

    /// Whether one image can hold that many bytes; its rows.
    pub(crate) fn check_texels(&self, label: &str, bytes: u64) -> Result<u32> {
        let rows = bytes.div_ceil(image_bytes(1)).max(1);
        let have = self.device.limits().max_texture_dimension_2d;
        u32::try_from(rows).ok().filter(|rows| *rows <= have).ok_or_else(|| Error::Missing {
            what: format!("image `{label}`"),
            need: format!("{rows} rows of {TEXEL_ROW} texels"),
            have: have.to_string(),
            adapter: self.facts.info.name.clone(),
        })
    }
}
