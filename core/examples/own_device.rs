//! Renders into a texture of the program's own device, and draws a triangle over the frame: `own_device OUT.png`.

use std::{env, error::Error, fs};

use glimpse::{
    DisplayImage, Gpu, GpuScene, Renderer, Settings,
    scene::builtin,
    to_png,
    wgpu::{self, TextureUsages},
};

const SIZE: [u32; 2] = [640, 360];

/// A white triangle in the upper left corner.
const OVERLAY: &str = "
    @vertex fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
        let corners = array(vec2f(-0.95, 0.9), vec2f(-0.95, 0.6), vec2f(-0.8, 0.75));
        return vec4f(corners[index], 0.0, 1.0);
    }
    @fragment fn fragment() -> @location(0) vec4f {
        return vec4f(1.0);
    }
";

fn main() -> Result<(), Box<dyn Error>> {
    let out = env::args().nth(1).ok_or("usage: own_device OUT.png")?;

    // What such a program has already. Its device has what frames need, beside what itself needs.
    let instance = glimpse::instance();
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&Gpu::requirements(&adapter)))?;
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let target = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("frame"),
        size: wgpu::Extent3d { width: SIZE[0], height: SIZE[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: TextureUsages::STORAGE_BINDING | TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let overlay = overlay(&device, format);

    let gpu = Gpu::from_device(&adapter, &device, &queue)?;
    device.set_device_lost_callback(gpu.on_lost());
    let scene = builtin("cornell").ok_or("no such built-in scene")?;
    let camera = *scene.camera(None)?;
    let scene = GpuScene::upload(&gpu, scene)?;
    let mut renderer = Renderer::new(&gpu, &scene, SIZE, &Settings::default())?;
    renderer.set_target(&target)?;

    for commands in renderer.frame(&camera)? {
        queue.submit([commands]);
    }
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    draw(&mut encoder, &overlay, &target);
    queue.submit([encoder.finish()]);

    let bytes = gpu.read_texture(&target, 4)?;
    let image = DisplayImage::from_raw(SIZE[0], SIZE[1], bytes).ok_or("short readback")?;
    fs::write(out, to_png(&image)?)?;
    Ok(())
}

fn overlay(device: &wgpu::Device, format: wgpu::TextureFormat) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("overlay"),
        source: wgpu::ShaderSource::Wgsl(OVERLAY.into()),
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("overlay"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: None,
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: None,
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(format.into())],
        }),
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        multiview_mask: None,
        cache: None,
    })
}

fn draw(encoder: &mut wgpu::CommandEncoder, overlay: &wgpu::RenderPipeline, target: &wgpu::Texture) {
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("overlay"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    });
    pass.set_pipeline(overlay);
    pass.draw(0..3, 0..1);
}
