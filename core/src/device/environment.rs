//! The environment map on the device.

use glam::Vec3;
use wgpu::{TextureFormat, TextureUsages};

use crate::{
    Gpu, Result,
    device::mirror::gpu_struct,
    scene::{EnvironmentDistribution, EnvironmentMap},
};

gpu_struct! {
    /// The map's rotation, as shaders read it.
    pub struct EnvironmentUniform {
        rotation: [f32; 2], padding: [f32; 2],
    }
}

/// Images of radiance, of irradiance and of the distribution of directions, 32-bit floating point, and the constants of the map.
pub struct GpuEnvironment {
    map: wgpu::TextureView,
    levels: wgpu::TextureView,
    irradiance: wgpu::TextureView,
    powers: wgpu::TextureView,
    uniform: wgpu::Buffer,
    bytes: u64,
}

impl GpuEnvironment {
    /// Filters and uploads a map.
    ///
    /// # Errors
    /// [`crate::Error::Missing`] if the device cannot hold it.
    pub fn upload(gpu: &Gpu, map: &EnvironmentMap) -> Result<Self> {
        let rgba =
            |texels: &[Vec3]| texels.iter().map(|texel| texel.extend(1.0).to_array()).collect::<Vec<_>>();
        let levels: Vec<_> = map.filtered().iter().map(|level| (level.side, rgba(&level.texels))).collect();
        let levels: Vec<_> =
            levels.iter().map(|(side, texels)| (*side, bytemuck::cast_slice(texels))).collect();
        let whole = rgba(map.texels());
        let whole = [(map.side(), bytemuck::cast_slice(&whole))];
        let irradiance = map.irradiance_over_pi();
        let matte = rgba(&irradiance.texels);
        let matte = [(irradiance.side, bytemuck::cast_slice(&matte))];
        let distribution = EnvironmentDistribution::of(map);
        let powers: Vec<_> = distribution
            .levels
            .iter()
            .map(|(side, probabilities)| (*side, bytemuck::cast_slice(probabilities)))
            .collect();
        let (sine, cosine) = map.rotation().sin_cos();
        let uniform = EnvironmentUniform { rotation: [cosine, sine], padding: [0.0; 2] };
        let bytes = [&whole[..], &levels, &matte, &powers]
            .concat()
            .iter()
            .map(|(_, texels)| texels.len() as u64)
            .sum();
        Ok(Self {
            map: texture(gpu, "environment_map", TextureFormat::Rgba32Float, &whole)?,
            levels: texture(gpu, "environment_levels", TextureFormat::Rgba32Float, &levels)?,
            irradiance: texture(gpu, "environment_diffuse", TextureFormat::Rgba32Float, &matte)?,
            powers: texture(gpu, "environment_powers", TextureFormat::R32Float, &powers)?,
            uniform: gpu.filled("environment", bytemuck::bytes_of(&uniform), wgpu::BufferUsages::UNIFORM)?,
            bytes,
        })
    }

    /// Names and bindings of the resources that shaders read.
    pub fn resources(&self) -> [(&'static str, wgpu::BindingResource<'_>); 5] {
        [
            ("environment", self.uniform.as_entire_binding()),
            ("environment_map", wgpu::BindingResource::TextureView(&self.map)),
            ("environment_levels", wgpu::BindingResource::TextureView(&self.levels)),
            ("environment_diffuse", wgpu::BindingResource::TextureView(&self.irradiance)),
            ("environment_powers", wgpu::BindingResource::TextureView(&self.powers)),
        ]
    }

    /// Device memory of the images, in bytes.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }
}

/// A square image with mip levels, each with its width in texels and its bytes.
pub fn texture(
    gpu: &Gpu,
    label: &str,
    format: TextureFormat,
    levels: &[(u32, &[u8])],
) -> Result<wgpu::TextureView> {
    let size = |side: u32| wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 1 };
    let side = levels.first().map_or(1, |(side, _)| *side);
    let bytes = levels.iter().map(|(_, texels)| texels.len() as u64).sum();
    gpu.checked(&format!("image `{label}`"), Some(bytes), |device| {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: size(side),
            mip_level_count: levels.len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
            view_formats: &[],
        });
        for (level, (side, texels)) in (0..).zip(levels) {
            let row = texels.len() as u32 / side;
            gpu.queue.write_texture(
                wgpu::TexelCopyTextureInfo { mip_level: level, ..texture.as_image_copy() },
                texels,
                wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
                size(*side),
            );
        }
        texture.create_view(&wgpu::TextureViewDescriptor::default())
    })
}
