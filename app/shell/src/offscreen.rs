//! Plays a script without a window: frames are drawn into an image.

use std::sync::Arc;

use glimpse::{DisplayImage, Gpu};
use glimpse_app::script::ShellEvent;

use crate::{
    Result, Setup,
    session::{Leftover, Session},
};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Plays the script of the setup to its end.
///
/// # Errors
/// There is no device, or a step of the script failed: `FILE:LINE: expected ..., found ...`.
pub fn run(setup: Setup) -> Result<()> {
    let size = setup.screen.map_or(setup.size, |screen| screen.pixels);
    let mut shell =
        OffscreenShell { session: Session::new(setup, Arc::new(|| ())), target: None, size, paused: false };
    shell.attach()?;
    while shell.frame()? {}
    Ok(())
}

struct OffscreenShell {
    session: Session,
    /// The device and the image that replaces the window's surface.
    target: Option<(Arc<Gpu>, wgpu::Texture)>,
    size: [u32; 2],
    paused: bool,
}

impl OffscreenShell {
    fn attach(&mut self) -> Result<()> {
        let setup = self.session.setup();
        let gpu =
            Gpu::for_surface(&glimpse::instance(), setup.adapter.as_deref(), None, setup.limits.as_ref());
        let gpu = Arc::new(gpu.map_err(|error| error.to_string())?);
        self.session.attach(&gpu, FORMAT);
        self.target = Some((gpu.clone(), image(&gpu, self.size)));
        Ok(())
    }

    /// Updates the session and draws a frame; returns false at the end of the script.
    fn frame(&mut self) -> Result<bool> {
        let (mut update, leftover) = self.session.frame(egui::RawInput::default(), self.size, 1.0)?;
        let view = match &self.target {
            Some((_, target)) if !self.paused => Some(target.create_view(&Default::default())),
            _ => None,
        };
        self.session.app.paint(&mut update.painting, view.as_ref(), self.size);
        self.follow(leftover)
    }

    fn follow(&mut self, leftover: Leftover) -> Result<bool> {
        if let Some((gpu, target)) = &self.target
            && self.session.wants_shot()
            && !self.paused
            && gpu.lost().is_none()
        {
            let bytes = gpu.read_texture(target, 4).map_err(|error| error.to_string())?;
            let picture = DisplayImage::from_raw(target.width(), target.height(), bytes);
            self.session.shoot(&picture.ok_or("short readback")?)?;
        }
        match leftover.event {
            Some(ShellEvent::Size(size)) => self.resize(size),
            Some(ShellEvent::Rotate) => {
                self.session.turn();
                let [width, height] = self.size;
                self.resize([height, width]);
            }
            Some(ShellEvent::Pause | ShellEvent::Minimise) => self.paused = true,
            Some(ShellEvent::Resume | ShellEvent::Restore) => self.paused = false,
            Some(ShellEvent::LoseSurface) => self.resize(self.size),
            Some(ShellEvent::LoseDevice) => {
                if let Some((gpu, _)) = &self.target {
                    gpu.destroy();
                }
            }
            Some(ShellEvent::FullScreen(_) | ShellEvent::LowMemory | ShellEvent::Thermal(_)) | None => {}
        }
        if leftover.new_device {
            self.attach()?;
        }
        Ok(!leftover.quit)
    }

    fn resize(&mut self, size: [u32; 2]) {
        self.size = size;
        if let Some((gpu, target)) = &mut self.target {
            *target = image(gpu, size);
        }
    }
}

fn image(gpu: &Gpu, [width, height]: [u32; 2]) -> wgpu::Texture {
    gpu.device().create_texture(&wgpu::TextureDescriptor {
        label: Some("window"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}
