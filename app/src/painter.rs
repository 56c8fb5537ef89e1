//! Draws the overlay's output on a surface or into an image.

use glimpse::Gpu;

/// The overlay's output of one update, ready to be drawn.
pub struct Painting {
    /// Triangle meshes with clip rectangles.
    pub jobs: Vec<egui::ClippedPrimitive>,
    /// Changes of the overlay's textures since the last update.
    pub textures: egui::TexturesDelta,
    /// Pixels of the target per point of the overlay.
    pub pixels_per_point: f32,
}

/// The overlay's pipelines and textures on one device, for targets of one format.
pub struct Painter {
    renderer: egui_wgpu::Renderer,
}

impl Painter {
    /// Creates the pipelines for targets of that format, whose values are interpreted as sRGB-encoded.
    #[must_use]
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        // Without dithering, so that the frame's pixels reach the screen unchanged.
        let options = egui_wgpu::RendererOptions { dithering: false, ..Default::default() };
        Self { renderer: egui_wgpu::Renderer::new(gpu.device(), format, options) }
    }

    /// Uploads the complete font texture of the overlay.
    pub fn load_fonts(&mut self, gpu: &Gpu, image: egui::ColorImage) {
        let whole = egui::epaint::ImageDelta::full(image, egui::TextureOptions::LINEAR);
        self.renderer.update_texture(gpu.device(), gpu.queue(), egui::TextureId::default(), &whole);
    }

    /// Registers a picture as a texture of the overlay, under the id `known` if given. Uses nearest filtering
    /// if the picture is `exact`, that is, shown at one texel per pixel, and linear filtering otherwise.
    pub fn register(
        &mut self,
        gpu: &Gpu,
        picture: &wgpu::Texture,
        exact: bool,
        known: Option<egui::TextureId>,
    ) -> egui::TextureId {
        let view = picture.create_view(&wgpu::TextureViewDescriptor::default());
        let filter = if exact { wgpu::FilterMode::Nearest } else { wgpu::FilterMode::Linear };
        match known {
            None => self.renderer.register_native_texture(gpu.device(), &view, filter),
            Some(id) => {
                self.renderer.update_egui_texture_from_wgpu_texture(gpu.device(), &view, filter, id);
                id
            }
        }
    }

    /// Removes a texture that is no longer shown.
    pub fn forget(&mut self, texture: egui::TextureId) {
        self.renderer.free_texture(&texture);
    }

    /// Applies the changes of the overlay's textures. Must be called with every painting, drawn or not, as
    /// each contains only changes.
    pub fn update(&mut self, gpu: &Gpu, painting: &mut Painting) {
        let textures = std::mem::take(&mut painting.textures);
        for (id, deltas) in &textures.set {
            for delta in deltas {
                self.renderer.update_texture(gpu.device(), gpu.queue(), *id, delta);
            }
        }
        for id in &textures.free {
            self.renderer.free_texture(id);
        }
    }

    /// Clears the target, of `size` pixels, to black, draws the painting and submits.
    pub fn paint(&mut self, gpu: &Gpu, painting: &Painting, target: &wgpu::TextureView, size: [u32; 2]) {
        let (device, queue) = (gpu.device(), gpu.queue());
        let mut encoder =
            device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("painter") });
        let screen =
            egui_wgpu::ScreenDescriptor { size_in_pixels: size, pixels_per_point: painting.pixels_per_point };
        let before = self.renderer.update_buffers(device, queue, &mut encoder, &painting.jobs, &screen);
        let mut pass = encoder
            .begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("painter"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: target,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..Default::default()
            })
            .forget_lifetime();
        self.renderer.render(&mut pass, &painting.jobs, &screen);
        drop(pass);
        queue.submit(before.into_iter().chain([encoder.finish()]));
    }
}
