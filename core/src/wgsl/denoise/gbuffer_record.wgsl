// Finds the first diffuse surface along a path, whose attributes guide the denoiser.

struct GBufferPixel {
    // A unit of length in units of the primary ray's parameter.
    unit: f32,
    // Length of the path so far in these units; it stops at the first diffuse surface.
    depth: f32,
    kind: u32,
    normal: u32,
    albedo: vec3f,
    // Whether the path met emission before it left the first diffuse surface.
    shone: bool,
    stopped: bool,
    // Whether the path left some surface by reflection or refraction.
    specular: bool,
}

fn gbuffer_begin(ray: Ray) -> GBufferPixel {
    let unit = 1.0 / length(ray.direction);
    return GBufferPixel(unit, 0.0, GBUFFER_NONE, 0u, vec3f(0.0), false, false, false);
}

fn gbuffer_hit(path: ptr<function, Path>, t: f32) {
    if (*path).gbuffer_pixel.kind == GBUFFER_NONE {
        (*path).gbuffer_pixel.depth += (t - (*path).ray.after) * length((*path).ray.direction) * (*path).gbuffer_pixel.unit;
    }
}

fn gbuffer_emission(path: ptr<function, Path>, emission: vec3f) {
    if (*path).gbuffer_pixel.kind == GBUFFER_NONE && any(emission != vec3f(0.0)) {
        (*path).gbuffer_pixel.shone = true;
    }
}

// Records a surface as the first diffuse one if paths mostly leave it by the diffuse lobe, as all of its samples
// then contain diffuse light, or if this path does.
fn gbuffer_surface(path: ptr<function, Path>, s: Surface, lobes: Lobes, diffuse: bool) {
    if (*path).gbuffer_pixel.kind == GBUFFER_NONE && (diffuse || 2.0 * lobes.chances.x >= lobes.sum) {
        (*path).gbuffer_pixel.kind = select(GBUFFER_MIRRORED, GBUFFER_DIRECT, (*path).level == 1u);
        (*path).gbuffer_pixel.normal = octahedral_encode(s.normal);
        (*path).gbuffer_pixel.albedo = (*path).throughput * response_albedo(lobes);
    }
}

fn gbuffer_terminate(path: ptr<function, Path>) {
    (*path).gbuffer_pixel.stopped = true;
}

fn gbuffer_scatter(path: ptr<function, Path>, diffuse: bool) {
    if !diffuse {
        (*path).gbuffer_pixel.specular = true;
    }
}

fn gbuffer_store(path: Path) {
    let found = path.gbuffer_pixel;
    let place = gbuffer_place(path.pixel);
    var kind = select(found.kind, GBUFFER_NONE, found.shone);
    var albedo = found.albedo;
    var surface = vec2u(found.normal, bitcast<u32>(found.depth));
    if frame.paths.sample > 0u {
        let before = gbuffer[place];
        kind = select(gbuffer_kind(before), GBUFFER_NONE, kind == GBUFFER_NONE);
        albedo = mix(gbuffer_albedo(before), albedo, 1.0 / f32(frame.paths.sample + 1u));
        surface = before.xy;
    }
    let smoothed = u32(found.stopped && !found.specular);
    gbuffer[place] = vec4u(surface, gbuffer_pack(albedo, kind), smoothed);
}
