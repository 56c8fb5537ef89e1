// Finds the first diffuse surface along a path, whose attributes guide the denoiser.

struct Guide {
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

fn guides_begin(ray: Ray) -> Guide {
    let unit = 1.0 / length(ray.direction);
    return Guide(unit, 0.0, GUIDE_NONE, 0u, vec3f(0.0), false, false, false);
}

fn guides_arrive(path: ptr<function, Path>, t: f32) {
    if (*path).guide.kind == GUIDE_NONE {
        (*path).guide.depth += (t - (*path).ray.after) * length((*path).ray.direction) * (*path).guide.unit;
    }
}

fn guides_shine(path: ptr<function, Path>, emission: vec3f) {
    if (*path).guide.kind == GUIDE_NONE && any(emission != vec3f(0.0)) {
        (*path).guide.shone = true;
    }
}

// A surface counts as diffuse by how it is left more often, for the light that it scatters is in all of its samples; or
// if this path is to leave it so.
fn guides_surface(path: ptr<function, Path>, s: Surface, lobes: Lobes, diffuse: bool) {
    if (*path).guide.kind == GUIDE_NONE && (diffuse || 2.0 * lobes.chances.x >= lobes.sum) {
        (*path).guide.kind = select(GUIDE_MIRRORED, GUIDE_DIRECT, (*path).level == 1u);
        (*path).guide.normal = octahedral_encode(s.normal);
        (*path).guide.albedo = (*path).throughput * lobes.diffuse;
    }
}

fn guides_stop(path: ptr<function, Path>) {
    (*path).guide.stopped = true;
}

fn guides_leave(path: ptr<function, Path>, diffuse: bool) {
    if !diffuse {
        (*path).guide.specular = true;
    }
}

fn guides_end(path: Path) {
    let found = path.guide;
    let place = guides_place(path.pixel);
    var kind = select(found.kind, GUIDE_NONE, found.shone);
    var albedo = found.albedo;
    var surface = vec2u(found.normal, bitcast<u32>(found.depth));
    if frame.paths.sample > 0u {
        let before = guides[place];
        kind = select(guides_kind(before), GUIDE_NONE, kind == GUIDE_NONE);
        albedo = mix(guides_albedo(before), albedo, 1.0 / f32(frame.paths.sample + 1u));
        surface = before.xy;
    }
    let smoothed = u32(found.stopped && !found.specular);
    guides[place] = vec4u(surface, guides_packed(albedo, kind), smoothed);
}
