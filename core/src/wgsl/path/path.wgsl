// One sample of a path tracer (Kajiya 1986): a path from the eye that continues by one lobe at each surface.

// Bounce level from which on Russian roulette may end a path.
const PATH_ROULETTE_LEVEL: u32 = 3u;

// Random dimensions per vertex: after the position in the pixel, each vertex has PATH_DIMENSIONS pairs.
const PATH_DIMENSIONS: u32 = 4u;
// Dimension of the choice of lobe, and of stopping away from the gaze.
const PATH_LOBE: u32 = 0u;
// Dimension of the diffuse direction.
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
    // Density with which the diffuse lobe sampled the ray, per unit of solid angle; 0 for other rays.
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
    let hit = bvh_traverse(ray, false);
    if hit.primitive == MISS {
        (*path).radiance +=
            (*path).throughput * environment_radiance(ray.direction) * environment_weight((*path).density, ray.direction);
        return false;
    }
    let direction = normalize(ray.direction);
    var s = surface_at(ray, hit);
    if layers_pass(path, s) {
        return true;
    }
    if !layers_passed() {
        stereo_reuse_record(path, hit.primitive);
    }
    let m = surface_material(&s, direction);
    (*path).throughput *= surface_absorbed(s, ray);
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
    if lobes.chances.x > 0.0 {
        let chance = lobes.chances.x / lobes.sum;
        let irradiance = punctual_irradiance(s)
            + emitters_irradiance(s, chance, pixel, dimension)
            + environment_irradiance(s, chance, pixel, dimension);
        (*path).radiance += (*path).throughput * lobes.diffuse * (1.0 / PI) * irradiance;
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
    var bsdf_sample: BsdfSample;
    var density = 0.0;
    gbuffer_scatter(path, number < lobes.chances.x);
    if number < lobes.chances.x {
        let drawn = path_diffuse_direction(s.normal, rng_pair((*path).pixel, dimension + PATH_DIRECTION));
        density = max(dot(drawn, s.normal), 0.0) / PI * (lobes.chances.x / lobes.sum);
        let weight = lobes.diffuse * (lobes.sum / lobes.chances.x);
        bsdf_sample = BsdfSample(surface_spawn(s, drawn, FAR, vec2f(0.0)), weight, RAY_DIFFUSE);
        if dot(s.face, drawn) <= 0.0 {
            return false;
        }
    } else {
        bsdf_sample = lobes_specular(s, m, lobes, (*path).ray, direction, number);
    }
    (*path).throughput *= bsdf_sample.weight;
    if ROULETTE && (*path).level >= PATH_ROULETTE_LEVEL {
        let survivors = min(max_component((*path).throughput), 1.0);
        if rng_pair((*path).pixel, dimension + PATH_EMITTER).y >= survivors {
            return false;
        }
        (*path).throughput /= survivors;
    }
    (*path).ray = bsdf_sample.ray;
    (*path).kind = bsdf_sample.kind;
    (*path).density = density;
    (*path).level += 1u;
    return true;
}

// A cosine-weighted direction around a unit normal.
fn path_diffuse_direction(n: vec3f, random: vec2f) -> vec3f {
    let r = sqrt(random.x);
    let angle = 2.0 * PI * random.y;
    // Building an Orthonormal Basis, Revisited (Duff et al. 2017).
    let side = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (side + n.z);
    let b = n.x * n.y * a;
    let x = vec3f(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    let y = vec3f(b, side + n.y * n.y * a, -n.y);
    return normalize(r * cos(angle) * x + r * sin(angle) * y + sqrt(max(0.0, 1.0 - random.x)) * n);
}
