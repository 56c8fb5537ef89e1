// For frames without a denoiser: no attributes of first diffuse surfaces are kept.

struct GBufferPixel {
    nothing: u32,
}

fn gbuffer_begin(ray: Ray) -> GBufferPixel {
    return GBufferPixel(0u);
}

fn gbuffer_hit(path: ptr<function, Path>, t: f32) {}

fn gbuffer_emission(path: ptr<function, Path>, emission: vec3f) {}

fn gbuffer_surface(path: ptr<function, Path>, s: Surface, lobes: Lobes, diffuse: bool) {}

fn gbuffer_terminate(path: ptr<function, Path>) {}

fn gbuffer_scatter(path: ptr<function, Path>, diffuse: bool) {}

fn gbuffer_store(path: Path) {}
