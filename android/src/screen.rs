//! The activity's window: its surface, and direct access to its buffers.

use glimpse::Gpu;
use ndk::{hardware_buffer_format::HardwareBufferFormat, native_window::NativeWindow};

/// Creates a surface for the window.
pub fn surface(instance: &wgpu::Instance, window: NativeWindow) -> Result<wgpu::Surface<'static>, String> {
    instance.create_surface(Handle(window)).map_err(|error| match Gpu::adapters().is_empty() {
        true => NEEDS_VULKAN.to_owned(),
        false => format!("The window takes no pictures: {error}"),
    })
}

/// Implements the handles from which wgpu creates a surface.
struct Handle(NativeWindow);

impl wgpu::rwh::HasWindowHandle for Handle {
    fn window_handle(&self) -> Result<wgpu::rwh::WindowHandle<'_>, wgpu::rwh::HandleError> {
        self.0.window_handle()
    }
}

impl wgpu::rwh::HasDisplayHandle for Handle {
    fn display_handle(&self) -> Result<wgpu::rwh::DisplayHandle<'_>, wgpu::rwh::HandleError> {
        Ok(wgpu::rwh::DisplayHandle::android())
    }
}

const NEEDS_VULKAN: &str = "Glimpse needs a graphics driver for Vulkan, and this device has none that can show pictures. \
                            OpenGL ES is not used: it promises four storage buffers to a compute shader, the ray \
                            tracer binds eight.";

/// Why there is no device, in words for users of a phone.
pub fn refusal(error: glimpse::Error) -> String {
    match error {
        glimpse::Error::NoAdapter(reason) => {
            log::info!("no adapter: {reason}");
            NEEDS_VULKAN.to_owned()
        }
        glimpse::Error::Missing { what, need, have, adapter } => {
            format!("This device's graphics ({adapter}) are not enough: {what} needs {need}, it has {have}.")
        }
        other => other.to_string(),
    }
}

/// Width and height of the window in pixels, at least one each.
pub fn pixels(window: &NativeWindow) -> [u32; 2] {
    [window.width(), window.height()].map(|side| u32::try_from(side).unwrap_or(0).max(1))
}

/// Writes a picture into the window's buffer, without a graphics device.
pub fn post(window: &NativeWindow, picture: &egui::ColorImage) -> std::io::Result<()> {
    let [width, height] = picture.size;
    window.set_buffers_geometry(width as i32, height as i32, Some(HardwareBufferFormat::R8G8B8X8_UNORM))?;
    let mut buffer = window.lock(None)?;
    let lines = buffer.lines().ok_or_else(|| std::io::Error::other("a buffer of unknown format"))?;
    for (line, colours) in lines.zip(picture.pixels.chunks_exact(width)) {
        for (place, colour) in line.chunks_exact_mut(4).zip(colours) {
            for (byte, channel) in place.iter_mut().zip(colour.to_array()) {
                byte.write(channel);
            }
        }
    }
    Ok(())
}
