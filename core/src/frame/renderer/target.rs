//! Renders frames into a texture of the caller.

use super::Renderer;
use crate::{Error, Result, passes::FrameSpec};

impl Renderer {
    /// Makes `target`, a texture of the caller, the destination of all following frames in place of the
    /// renderer's own texture; [`Renderer::display`] returns it from then on. It must be of this renderer's
    /// device, of the frame's size and of the format [`Rgba8Unorm`](wgpu::TextureFormat::Rgba8Unorm), with one
    /// mip level, layer and sample. Its usages must contain
    /// [`STORAGE_BINDING`](wgpu::TextureUsages::STORAGE_BINDING), and [`COPY_SRC`](wgpu::TextureUsages::COPY_SRC)
    /// for [`Renderer::display_image`]. Texels are sRGB-encoded; a view in
    /// [`Rgba8UnormSrgb`](wgpu::TextureFormat::Rgba8UnormSrgb) decodes them. Binds all passes again, so do not
    /// call it for every frame. A [change](Renderer::change) of the size returns to the renderer's own texture.
    ///
    /// # Errors
    /// [`Error::Setting`] names the property of the texture that does not fit; or the device failed. The
    /// destination is then unchanged.
    pub fn set_target(&mut self, target: &wgpu::Texture) -> Result<()> {
        check(target, self.targets.size)?;
        let spec = FrameSpec::new(&self.scene, &self.spec.settings);
        self.passes = self.link(&spec, target, None)?;
        self.targets.display = target.clone();
        self.has_target = true;
        self.forget_linked();
        Ok(())
    }
}

/// Checks that kernels can write frames of this size into the texture.
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

/// Checks that the display image can be read back; a texture of the caller may lack the usage.
pub(super) fn check_readback(display: &wgpu::Texture) -> Result<()> {
    if display.usage().contains(wgpu::TextureUsages::COPY_SRC) {
        return Ok(());
    }
    Err(refused("COPY_SRC among its usages to read it back", format!("{:?}", display.usage())))
}

fn refused(expected: &str, found: String) -> Error {
    Error::setting("target texture", expected, found)
}
