//! The surface of a window.

use std::{
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::Arc,
};

use glimpse::{DisplayImage, Gpu};
use glimpse_app::Vsync;
use wgpu::CurrentSurfaceTexture as Current;

use crate::Result;

/// A surface that is configured for the size of its window. The window itself belongs to the caller.
pub struct Surface {
    surface: wgpu::Surface<'static>,
    gpu: Arc<Gpu>,
    config: wgpu::SurfaceConfiguration,
    vsync: Vsync,
    modes: Vec<wgpu::PresentMode>,
    /// The last configuration succeeded.
    ready: bool,
}

/// The result of acquiring a surface texture.
pub(crate) enum Acquired {
    /// A texture to draw on.
    Picture(wgpu::SurfaceTexture),
    /// There is none at present; try again later.
    NotNow,
    /// The surface is lost: create a new one.
    Lost,
}

impl Surface {
    /// Configures a surface for a window of `size` pixels.
    ///
    /// # Errors
    /// The adapter does not support the surface.
    pub fn new(
        surface: wgpu::Surface<'static>,
        gpu: &Arc<Gpu>,
        size: [u32; 2],
        vsync: Vsync,
    ) -> Result<Self> {
        let capabilities = surface.get_capabilities(gpu.adapter());
        let [width, height] = extent(size);
        let mut config = surface
            .get_default_config(gpu.adapter(), width, height)
            .ok_or_else(|| format!("`{}` cannot show pictures in this window", gpu.facts().info.name))?;
        // The frame and the overlay are sRGB-encoded by shaders, so the format must not encode again.
        let plain = capabilities.formats.iter().copied().find(|format| !format.is_srgb());
        config.format = plain.unwrap_or(config.format);
        config.usage |= capabilities.usages & wgpu::TextureUsages::COPY_SRC;
        config.desired_maximum_frame_latency = 1;
        let modes = capabilities.present_modes;
        let mut made = Self { surface, gpu: gpu.clone(), config, vsync, modes, ready: false };
        made.config.present_mode = made.mode(vsync);
        made.configure();
        Ok(made)
    }

    /// The format of its textures.
    pub fn format(&self) -> wgpu::TextureFormat {
        self.config.format
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    /// Configures the surface again where the window's size or the choice of vsync has changed.
    pub fn follow(&mut self, size: [u32; 2], vsync: Vsync) {
        let size = extent(size);
        if size != self.size() || vsync != self.vsync {
            [self.config.width, self.config.height] = size;
            self.vsync = vsync;
            self.config.present_mode = self.mode(vsync);
            self.configure();
        }
    }

    /// Acquires the next texture. An outdated surface is configured again once a call.
    pub(crate) fn acquire(&mut self) -> Acquired {
        for _ in 0..2 {
            if !self.ready {
                self.configure();
            }
            if !self.ready {
                break;
            }
            match self.surface.get_current_texture() {
                Current::Success(picture) | Current::Suboptimal(picture) => {
                    return Acquired::Picture(picture);
                }
                Current::Outdated => self.ready = false,
                Current::Lost => return Acquired::Lost,
                Current::Timeout | Current::Occluded | Current::Validation => break,
            }
        }
        Acquired::NotNow
    }

    /// Presents a texture.
    pub(crate) fn present(&self, picture: wgpu::SurfaceTexture) {
        if self.is_lost() {
            release(picture);
        } else {
            self.gpu.queue().present(picture);
        }
    }

    /// The device is lost.
    pub(crate) fn is_lost(&self) -> bool {
        self.gpu.lost().is_some()
    }

    /// Reads a texture into main memory, before it is presented.
    ///
    /// # Errors
    /// The surface does not support copies, has another format than 8 bits a channel, or the device failed.
    pub(crate) fn read(&self, picture: &wgpu::SurfaceTexture) -> Result<DisplayImage> {
        if !self.config.usage.contains(wgpu::TextureUsages::COPY_SRC) {
            return Err("expected a window whose pictures can be read, found none".to_owned());
        }
        let mut bytes = self.gpu.read_texture(&picture.texture, 4).map_err(|error| error.to_string())?;
        use wgpu::TextureFormat::{Bgra8Unorm, Bgra8UnormSrgb, Rgba8Unorm, Rgba8UnormSrgb};
        match self.config.format {
            Rgba8Unorm | Rgba8UnormSrgb => {}
            Bgra8Unorm | Bgra8UnormSrgb => bytes.chunks_exact_mut(4).for_each(|pixel| pixel.swap(0, 2)),
            other => return Err(format!("expected a window of 8 bits a channel, found {other:?}")),
        }
        let [width, height] = self.size();
        DisplayImage::from_raw(width, height, bytes).ok_or_else(|| "short readback".to_owned())
    }

    fn configure(&mut self) {
        let configured = self.gpu.configure(&self.surface, &self.config);
        self.ready = configured.is_ok();
        if let Err(error) = configured {
            log::warn!("{error}");
        }
    }

    fn mode(&self, vsync: Vsync) -> wgpu::PresentMode {
        let wanted = match vsync {
            Vsync::On => wgpu::PresentMode::Fifo,
            Vsync::Newest => wgpu::PresentMode::Mailbox,
            Vsync::Off => wgpu::PresentMode::Immediate,
        };
        // Every surface supports FIFO.
        if self.modes.contains(&wanted) { wanted } else { wgpu::PresentMode::Fifo }
    }
}

/// Drops a texture of a lost device. wgpu (30) then neither presents nor discards the texture, and panics when its
/// surface is dropped later. It only releases the texture while unwinding, so a caught panic is used.
fn release(picture: wgpu::SurfaceTexture) {
    // `resume_unwind` does not call the panic hook, so nothing is printed.
    let _ = catch_unwind(AssertUnwindSafe(|| {
        let _held = picture;
        resume_unwind(Box::new("the device is lost"))
    }));
}

/// At least one pixel on each side, as a surface needs.
fn extent(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.max(1))
}
