//! What a window shows pictures on.

use std::{
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::Arc,
};

use glimpse::{DisplayImage, Gpu};
use glimpse_app::Vsync;
use wgpu::CurrentSurfaceTexture as Current;

use crate::Result;

/// A surface that is configured for the size of its window. What the window is, its owner knows.
pub struct Surface {
    surface: wgpu::Surface<'static>,
    gpu: Arc<Gpu>,
    config: wgpu::SurfaceConfiguration,
    vsync: Vsync,
    modes: Vec<wgpu::PresentMode>,
    /// It can be asked for pictures.
    ready: bool,
}

/// What there is to paint on now.
pub(crate) enum Acquired {
    /// A picture to be filled.
    Picture(wgpu::SurfaceTexture),
    /// None, for the time being: to be asked for again.
    NotNow,
    /// The surface is gone: a new one is to be made.
    Lost,
}

impl Surface {
    /// Takes a surface of a window that has that many pixels.
    ///
    /// # Errors
    /// An adapter that cannot show pictures there.
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
        // Frames and overlay are sRGB-encoded by themselves.
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

    /// The format of its pictures.
    pub fn format(&self) -> wgpu::TextureFormat {
        self.config.format
    }

    /// Pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    /// Follows the window and the choice of a present mode.
    pub fn follow(&mut self, size: [u32; 2], vsync: Vsync) {
        let size = extent(size);
        if size != self.size() || vsync != self.vsync {
            [self.config.width, self.config.height] = size;
            self.vsync = vsync;
            self.config.present_mode = self.mode(vsync);
            self.configure();
        }
    }

    /// The next picture. An outdated surface is configured again once; a storm of that is not waited for.
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

    /// Shows a picture.
    pub(crate) fn present(&self, picture: wgpu::SurfaceTexture) {
        if self.is_lost() {
            release(picture);
        } else {
            self.gpu.queue().present(picture);
        }
    }

    /// Whether its device is lost.
    pub(crate) fn is_lost(&self) -> bool {
        self.gpu.lost().is_some()
    }

    /// A picture in main memory, before it is shown.
    ///
    /// # Errors
    /// A surface whose pictures cannot be read, or a device that failed.
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
        // Every surface has this one.
        if self.modes.contains(&wanted) { wanted } else { wgpu::PresentMode::Fifo }
    }
}

/// Lets a picture of a lost device go. wgpu (30) neither presents nor discards it then, and panics when the surface is
/// dropped that still counts it; while unwinding, and only then, it does let go.
fn release(picture: wgpu::SurfaceTexture) {
    // No hook hears of it: nothing went wrong.
    let _ = catch_unwind(AssertUnwindSafe(|| {
        let _held = picture;
        resume_unwind(Box::new("the device is lost"))
    }));
}

/// A window without pixels gets one.
fn extent(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.max(1))
}
