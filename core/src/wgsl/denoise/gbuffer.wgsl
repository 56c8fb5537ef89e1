// The G-buffer that guides the denoiser: the first diffuse surface of each pixel's paths, seen directly or
// through mirrors and glass. Four words per pixel: the normal; its distance along the primary ray (both of the
// first sample); the albedo times the transmittance of mirrors and glass before it, as a mean of all samples with
// 10 bits per channel, and above it the kind of guide; and a flag that is not 0 if the last path was stopped and
// used only diffuse lobes.

var<storage, read_write> gbuffer: array<vec4u>;

// The pixel is not filtered: some path met no diffuse surface, or met emission before it left the first.
const GBUFFER_NONE: u32 = 0u;
const GBUFFER_DIRECT: u32 = 1u;
const GBUFFER_MIRRORED: u32 = 2u;

const GBUFFER_ALBEDO: f32 = 1023.0;

fn gbuffer_place(pixel: vec2u) -> u32 {
    return frame_band_row(pixel.y) * frame.size.x + pixel.x;
}

fn gbuffer_kind(gbuffer_pixel: vec4u) -> u32 {
    return gbuffer_pixel.z >> 30u;
}

fn gbuffer_albedo(gbuffer_pixel: vec4u) -> vec3f {
    return vec3f(vec3u(gbuffer_pixel.z, gbuffer_pixel.z >> 10u, gbuffer_pixel.z >> 20u) & vec3u(1023u)) / GBUFFER_ALBEDO;
}

fn gbuffer_pack(albedo: vec3f, kind: u32) -> u32 {
    let steps = vec3u(round(GBUFFER_ALBEDO * clamp(albedo, vec3f(0.0), vec3f(1.0))));
    return steps.x | steps.y << 10u | steps.z << 20u | kind << 30u;
}
