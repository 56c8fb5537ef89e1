// Finds the first diffuse surface along a path, whose attributes guide the denoiser.

struct GBufferPixel {
    // A unit of length in units of the primary ray's parameter.
    unit: f32,
    // How far the path has gone, in those; at the first diffuse surface once it is found.
    depth: f32,
    kind: u32,
    normal: u32,
    albedo: vec3f,
    // It shone before the first diffuse surface was left.
    shone: bool,
    stopped: bool,
    // Some surface was left by its mirror or through it.
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

// A surface counts as diffuse by how it is left more often, for the light that it scatters is in all of its samples; or
// if this path is to leave it so.
fn gbuffer_surface(path: ptr<function, Path>, s: Surface, lobes: Lobes, diffuse: bool) {
    if (*path).gbuffer_pixel.kind == GBUFFER_NONE && (diffuse || 2.0 * lobes.chances.x >= lobes.sum) {
        (*path).gbuffer_pixel.kind = select(GBUFFER_MIRRORED, GBUFFER_DIRECT, (*path).level == 1u);
        (*path).gbuffer_pixel.normal = octahedral_encode(s.normal);
        (*path).gbuffer_pixel.albedo = (*path).throughput * lobes.diffuse;
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
