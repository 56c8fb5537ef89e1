//! Frames in a texture of the caller's.

use super::Renderer;
use crate::{Error, Result, passes::FrameSpec};

impl Renderer {
    /// Frames go into this texture of the caller's from here on, which [`Renderer::display`] then gives, instead of one of the
    /// renderer's own. It is of this renderer's device, of the frame's size and of the format
    /// [`Rgba8Unorm`](wgpu::TextureFormat::Rgba8Unorm), with one mip level, layer and sample; its usages have
    /// [`STORAGE_BINDING`](wgpu::TextureUsages::STORAGE_BINDING), and [`COPY_SRC`](wgpu::TextureUsages::COPY_SRC) if
    /// [`Renderer::display_image`] is to read it back. Texels hold sRGB-encoded values: a view in
    /// [`Rgba8UnormSrgb`](wgpu::TextureFormat::Rgba8UnormSrgb) decodes them. All passes are bound anew, so this is no call for
    /// each frame. A [change](Renderer::change) of the size ends it.
    ///
    /// # Errors
    /// [`Error::Setting`] says what of the texture is not so; a device that failed. Frames then go where they went before.
    pub fn set_target(&mut self, target: &wgpu::Texture) -> Result<()> {
        check(target, self.targets.size)?;
        let spec = FrameSpec::new(&self.scene, &self.settings);
        self.passes = self.link(&spec, target, None)?;
        self.targets.display = target.clone();
        self.has_target = true;
        self.forget_linked();
        Ok(())
    }
}

/// Whether kernels can write frames of that size into a texture.
fn check(target: &wgpu::Texture, [width, height]: [u32; 2]) -> Result<()> {
    let found = target.size();
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let of = |size: wgpu::Extent3d| format!("{}x{}x{}", size.width, size.height, size.depth_or_array_layers);
    let (expected, found) = if target.dimension() != wgpu::TextureDimension::D2 || found != size {
        (format!("a 2D texture of {}", of(size)), format!("{:?} of {}", target.dimension(), of(found)))
    } else if target.format() != wgpu::TextureFormat::Rgba8Unorm {
        ("the format Rgba8Unorm".to_owned(), format!("{:?}", target.format()))
    } else if [target.mip_level_count(), target.sample_count()] != [1, 1] {
        let (levels, samples) = (target.mip_level_count(), target.sample_count());
        ("one mip level and one sample".to_owned(), format!("{levels} and {samples}"))
    } else if !target.usage().contains(wgpu::TextureUsages::STORAGE_BINDING) {
        ("STORAGE_BINDING among its usages".to_owned(), format!("{:?}", target.usage()))
    } else {
        return Ok(());
    };
    Err(refused(&expected, found))
}

/// Whether the display image can be read back, which one of the caller's may not allow.
pub(super) fn check_readback(display: &wgpu::Texture) -> Result<()> {
    if display.usage().contains(wgpu::TextureUsages::COPY_SRC) {
        return Ok(());
    }
    Err(refused("COPY_SRC among its usages to read it back", format!("{:?}", display.usage())))
}

fn refused(expected: &str, found: String) -> Error {
    Error::setting("target texture", expected, found)
}
