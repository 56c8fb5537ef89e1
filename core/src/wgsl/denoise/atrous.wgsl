// Edge-stopping weights between pixels (Dammertz et al. 2010, equations 6 and 7, with the distance from the
// surface's plane in place of that between two points).

// Width for the difference of light divided by the sum, after one sample; it halves with each level.
const ATROUS_LIGHT: f32 = 1.5;
// Width for the distance from the plane, in pixel widths there; and for mirrored surfaces, for the relative
// difference of distances.
const ATROUS_PLANE: f32 = 2.0;
const ATROUS_DEPTH: f32 = 0.125;
// Widths for the difference of unit normals, and for that of albedos.
const ATROUS_NORMAL: f32 = 0.25;
const ATROUS_ALBEDO: f32 = 0.5;

// Terms of the weights that depend on the filtered pixel alone.
struct AtrousPixel {
    words: vec4u,
    normal: vec3f,
    albedo: f32,
    sum: f32,
    // Distance from the pixel's plane, in widths, of a point on another pixel's ray, as a linear function of its
    // depth (x + depth * y): the change per step across, per step down, and the value at the pixel itself.
    plane_across: vec2f,
    plane_down: vec2f,
    plane_own: vec2f,
    narrow: f32,
}

fn atrous_normal(word: u32) -> vec3f {
    return unpack4x8snorm(word).xyz;
}

fn atrous_albedo(word: u32) -> f32 {
    return f32(word >> 24u & 127u) / ATROUS_BUFFER_ALBEDO;
}

fn atrous_pixel(pixel: vec2u, words: vec4u) -> AtrousPixel {
    let depth = bitcast<f32>(words.y);
    let normal = atrous_normal(words.x);
    // Rays change linearly across the image.
    let ray = eyes_ray(pixel, vec2f(0.5, 0.5));
    let left = eyes_ray(pixel, vec2f(0.0, 0.5));
    let above = eyes_ray(pixel, vec2f(0.5, 0.0));
    let width = ATROUS_PLANE / FRAME_FOOTPRINT * (ray.cone.x + ray.cone.y * depth);
    let scaled = normal / width;
    let step = 2.0 * f32(frame.part.step.x);
    var p: AtrousPixel;
    p.words = words;
    p.normal = normal;
    p.albedo = atrous_albedo(words.x);
    p.sum = bitcast<f32>(words.z);
    p.narrow = f32(frame.paths.sample + 1u + frame.paths.merged) * f32(frame.part.step.x * frame.part.step.x) / (ATROUS_LIGHT * ATROUS_LIGHT);
    if (words.x & ATROUS_BUFFER_MIRRORED) != 0u {
        let along = 1.0 / (ATROUS_DEPTH * depth);
        p.plane_own = vec2f(-depth * along, along);
        return p;
    }
    p.plane_across = step * vec2f(dot(scaled, ray.origin - left.origin), dot(scaled, ray.direction - left.direction));
    p.plane_down = step * vec2f(dot(scaled, ray.origin - above.origin), dot(scaled, ray.direction - above.direction));
    let slope = dot(scaled, ray.direction);
    p.plane_own = vec2f(-depth * slope, slope);
    return p;
}

fn atrous_weight(p: AtrousPixel, offset: vec2f, q: vec4u) -> f32 {
    let sum = bitcast<f32>(q.z);
    let depth = bitcast<f32>(q.y);
    let light = (p.sum - sum) / max(p.sum + sum, ATROUS_BUFFER_BLACK);
    let albedo = (p.albedo - atrous_albedo(q.x)) * (1.0 / ATROUS_ALBEDO);
    let normal = (p.normal - atrous_normal(q.x)) * (1.0 / ATROUS_NORMAL);
    let plane = p.plane_own + offset.x * p.plane_across + offset.y * p.plane_down;
    let away = plane.x + depth * plane.y;
    let weight = exp2(-(p.narrow * light * light + albedo * albedo + dot(normal, normal) + away * away));
    let alike = ((p.words.x ^ q.x) & ATROUS_BUFFER_MIRRORED) == 0u && depth > 0.0;
    return select(0.0, weight, alike);
}
