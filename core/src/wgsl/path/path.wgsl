// One sample of a path tracer (Kajiya 1986): a path from the eye that continues by one lobe at each surface.

// Bounce level from which on Russian roulette may end a path.
const PATH_ROULETTE_LEVEL: u32 = 3u;

// Random dimensions per vertex: after the position in the pixel, each vertex has PATH_DIMENSIONS pairs.
const PATH_DIMENSIONS: u32 = 4u;
// Dimension of the choice of lobe, and of stopping away from the gaze.
const PATH_LOBE: u32 = 0u;
// Dimension of the direction of a diffuse or rough lobe.
const PATH_DIRECTION: u32 = 1u;
// Dimension of the choice of emitter, and of Russian roulette.
const PATH_EMITTER: u32 = 2u;
// Dimension of the point on the emitter.
const PATH_POINT: u32 = 3u;
// Distance between the dimensions of successive light samples.
const PATH_LIGHT_SAMPLE: u32 = 1024u;

struct Path {
    pixel: vec2u,
    ray: Ray,
    kind: u32,
    // Throughput: weight of the radiance that arrives along the ray.
    throughput: vec3f,
    // Bounce level: 1 for the primary ray.
    level: u32,
    // Density with which a lobe sampled the ray, per unit of solid angle; 0 for mirrored, refracted and primary rays.
    density: f32,
    // Radiance found so far.
    radiance: vec3f,
    stereo_reuse: StereoReuse,
    // Attributes of the first hit: OID + 1, distance, normal.
    object: u32,
    depth: f32,
    normal: vec3f,
    gbuffer_pixel: GBufferPixel,
}

fn path_begin(pixel: vec2u) -> Path {
    let place = rng_pair(pixel, RNG_PLACE_IN_PIXEL);
    let ray = eyes_ray(pixel, place);
    return Path(
        pixel, ray, RAY_PRIMARY, vec3f(1.0), 1u, 0.0, vec3f(0.0), stereo_reuse_begin(), 0u, FAR, vec3f(0.0), gbuffer_begin(ray)
    );
}

// Traces the ray to the next surface and scatters it there; false if the path ends.
fn path_step(path: ptr<function, Path>) -> bool {
    let ray = (*path).ray;
    inspect_ray((*path).kind);
    let hit = media_trace(ray, (*path).kind);
    if hit.primitive == MISS {
        (*path).radiance +=
            (*path).throughput * environment_radiance(ray.direction) * environment_weight((*path).density, ray.direction);
        return false;
    }
    let direction = normalize(ray.direction);
    var s = media_surface(surface_at(ray, hit));
    if layers_pass(path, s) {
        return true;
    }
    if !layers_passed() {
        stereo_reuse_record(path, hit.primitive);
    }
    let m = dispersion_material(path, media_material(surface_material(&s, direction), s), s);
    (*path).throughput *= media_absorbed(s, ray);
    if COUNTS && (*path).level == 1u {
        (*path).object = s.object + 1u;
        (*path).depth = hit.t;
        (*path).normal = s.normal;
    }
    gbuffer_hit(path, hit.t);
    if lobes_unlit(m) {
        (*path).radiance += (*path).throughput * m.base;
        return false;
    }
    let emission = lobes_emission(m);
    gbuffer_emission(path, emission);
    if any(emission != vec3f(0.0)) {
        (*path).radiance += (*path).throughput * emission * emitters_weight((*path).density, s, direction);
    }
    if (*path).level >= frame.depth {
        return false;
    }
    let pixel = (*path).pixel;
    let dimension = PATH_DIMENSIONS * (*path).level;
    let lobes = lobes_at(s, m, direction);
    let random = rng_pair(pixel, dimension + PATH_LOBE);
    gbuffer_surface(path, s, lobes, random.x * lobes.sum < lobes.chances.x);
    if lobes.sum <= 0.0 {
        return false;
    }
    if response_exists(lobes) {
        let light = punctual_light(s, lobes)
            + emitters_light(s, lobes, pixel, dimension)
            + environment_light(s, lobes, pixel, dimension);
        (*path).radiance += (*path).throughput * response_radiance(lobes, light);
    }
    if (*path).level >= FOVEATION_LEVEL {
        if foveation_terminates(pixel, random.y) {
            gbuffer_terminate(path);
            return false;
        }
        (*path).throughput *= foveation_weight(pixel);
    }
    return path_scatter(path, s, m, lobes, direction, random.x * lobes.sum);
}

// Continues by the lobe that `number`, up to the sum of chances, selects, unless Russian roulette ends the path;
// `direction` is the unit direction of the incident ray.
fn path_scatter(
    path: ptr<function, Path>, s: Surface, m: Material, lobes: Lobes, direction: vec3f, number: f32
) -> bool {
    let dimension = PATH_DIMENSIONS * (*path).level;
    gbuffer_scatter(path, number < lobes.chances.x);
    let random = rng_pair((*path).pixel, dimension + PATH_DIRECTION);
    let bsdf_sample = response_sample(s, m, lobes, (*path).ray, direction, number, random);
    if all(bsdf_sample.weight == vec3f(0.0)) {
        return false;
    }
    (*path).throughput *= bsdf_sample.weight;
    dispersion_refract(path, s, m, bsdf_sample);
    if ROULETTE && (*path).level >= PATH_ROULETTE_LEVEL {
        let survivors = min(max_component((*path).throughput), 1.0);
        if rng_pair((*path).pixel, dimension + PATH_EMITTER).y >= survivors {
            return false;
        }
        (*path).throughput /= survivors;
    }
    (*path).ray = bsdf_sample.ray;
    (*path).kind = bsdf_sample.kind;
    (*path).density = bsdf_sample.density;
    (*path).level += 1u;
    return true;
}
