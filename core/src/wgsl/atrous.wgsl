// What a pixel counts for in another one (Dammertz et al. 2010, equations 6 and 7, with the distance from the surface's plane
// in place of that of two points).

// The first level's width of differences of luminance over their sum, of one sample; it halves with each level.
const ATROUS_LUMINANCE: f32 = 4.0;
// Widths of the distance from the plane, in pixels there; of what mirrors show, of the difference of distances over them.
const ATROUS_PLANE: f32 = 2.0;
const ATROUS_DEPTH: f32 = 0.1;
// Of the difference of albedos.
const ATROUS_ALBEDO: f32 = 0.5;
// Less than that is black.
const ATROUS_BLACK: f32 = 1.0e-20;

// A pixel that is filtered, or one that it looks at.
struct AtrousPixel {
    light: vec3f,
    luminance: f32,
    normal: vec3f,
    albedo: vec3f,
    depth: f32,
    point: vec3f,
    // Side of a pixel there.
    footprint: f32,
}

fn atrous_pixel(pixel: vec2u, guide: vec4u) -> AtrousPixel {
    let light = filtered_load(pixel);
    let ray = frame_ray_at(vec2f(pixel) + 0.5, 1.0, 1.0);
    let depth = bitcast<f32>(guide.y);
    return AtrousPixel(
        light,
        dot(FILTERED_LUMINANCE, light),
        octahedral_decode(guide.x),
        guides_albedo(guide),
        depth,
        ray.origin + depth * ray.direction,
        ray.cone.x + ray.cone.y * depth,
    );
}

fn atrous_weight(p: AtrousPixel, q: AtrousPixel, kind: u32) -> f32 {
    let luminance = (p.luminance - q.luminance) / max(p.luminance + q.luminance, ATROUS_BLACK) / ATROUS_LUMINANCE;
    let albedo = (p.albedo - q.albedo) / ATROUS_ALBEDO;
    let plane = dot(p.normal, q.point - p.point) / (ATROUS_PLANE * p.footprint);
    let depth = (p.depth - q.depth) / (ATROUS_DEPTH * p.depth);
    let away = select(depth, plane, kind == GUIDE_DIRECT);
    let narrow = f32(frame.sample + 1u) * f32(frame.step.x * frame.step.x);
    let cosine = max(dot(p.normal, q.normal), 0.0);
    let cosine2 = cosine * cosine;
    let cosine8 = cosine2 * cosine2 * cosine2 * cosine2;
    let cosine32 = cosine8 * cosine8 * cosine8 * cosine8;
    return cosine32 * exp2(-(narrow * luminance * luminance + dot(albedo, albedo) + away * away));
}
