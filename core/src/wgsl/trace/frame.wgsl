// The frame's uniform constants and its primary rays.

// The camera's origin and basis vectors, which define primary rays.
struct FrameCamera {
    origin: vec3f,
    // 1 if orthographic, 0 if perspective.
    orthographic: f32,
    right: vec3f,
    // 1 / size.y, in samples.
    inverse_height: f32,
    up: vec3f,
    padding_x: u32,
    forward: vec3f,
    padding_y: u32,
    // Offset of each eye from the origin, and horizontal shift of its image; both in lengths of `right`.
    eyes: vec2f,
    padding_z: vec2u,
}

// The range that a dispatch processes.
struct FramePart {
    // Start of this part of the pass: a row of workgroups, or an index into the list.
    first: u32,
    // The rows of samples that the pass processes: every `stride`-th one in `row..end`.
    stride: u32,
    row: u32,
    end: u32,
    // Row y is stored as row |y - turn| of the buffers.
    turn: u32,
    // The most samples that one thread of the postcorrection traces.
    walk: u32,
    // Direction of a scan, or distance of a filter's taps, in samples.
    step: vec2i,
}

// Tolerances and thresholds of the tests between samples.
struct FrameTolerances {
    // Kim 2016, Table 1.
    pos: f32,
    norm: f32,
    tex: f32,
    gcol: f32,
    // Thresholds for objects, normals, shadow counts and textures, of the primary and the secondary hit (Jin
    // 2009, Table 1).
    tau_primary: vec4f,
    tau_secondary: vec4f,
    tau_col: f32,
    // The smallest of the nine thresholds.
    tau_least: f32,
    // The range of objects whose attributes are compared: OID + 1 of the first and of the last.
    focus_first: u32,
    focus_last: u32,
    // Contrast threshold of the quincunx.
    quincunx_threshold: f32,
    padding_x: u32,
    padding_y: u32,
    padding_z: u32,
}

// Constants of path tracing.
struct FramePaths {
    // Position of the gaze in pixels, and the probability of stopping per pixel of distance from it.
    gaze: vec2f,
    stop: f32,
    // Reciprocal of the sum of strength times area over all emitters.
    emitter_scale: f32,
    emitters: u32,
    // Index of the frame's sample since the camera came to rest.
    sample: u32,
    // Samples per pixel that were added from elsewhere.
    merged: u32,
    padding_x: u32,
}

struct FrameUniform {
    camera: FrameCamera,
    part: FramePart,
    tolerances: FrameTolerances,
    paths: FramePaths,
    background: vec3f,
    min_weight: f32,
    ambient: vec3f,
    depth: u32,
    fallback_radiance: vec3f,
    seed: u32,
    // Samples across and down.
    size: vec2u,
    // The ranks that the frame traces: the first and their number.
    refresh_first: u32,
    refresh_count: u32,
    // Not 0 if the camera is the same as in the frame before.
    still: u32,
    // Factor on the light of all sources.
    exposure: f32,
    // Not 0 if the camera may be inside of a solid that touches others.
    eye_in_solid: u32,
    padding_z: u32,
}

var<uniform> frame: FrameUniform;

const FAR: f32 = 3.0e38;
const PI: f32 = 3.14159265358979;

const MISS: u32 = 0xffffffffu;

struct Ray {
    origin: vec3f,
    t_max: f32,
    direction: vec3f,
    // The primitive that the ray starts on, MISS if none.
    left: u32,
    // Ray parameter of the surface left; above 0 for rays that continue straight through a pane.
    after: f32,
    // Ray cone: width at the origin, and its growth per unit of the ray's parameter.
    cone: vec2f,
}

// The primary ray through the centre of a sample, with a cone as wide as the sample. For perspective rays the
// parameter is the view depth along `forward`.
fn frame_ray(pixel: vec2u) -> Ray {
    return frame_ray_in(pixel, 1.0);
}

// The ray through a cell of a grid `fineness` times as fine as that of the samples.
fn frame_ray_in(stratum: vec2u, fineness: f32) -> Ray {
    return frame_ray_at(vec2f(stratum) + jitter_in(stratum), fineness, 1.0);
}

// Width of texture averages relative to the sample's width. An average as wide as the sample would be blurred
// again by its own filter kernel: 0.85 is closest to 64 samples per pixel (on wooden_staircase and
// sponza_dabrovic, 1 is 0.3 dB worse).
const FRAME_FOOTPRINT: f32 = 0.85;

// Width of a cell at depth 1.
fn frame_side(scale: f32) -> f32 {
    return FRAME_FOOTPRINT * 2.0 * scale * length(frame.camera.up);
}

// The ray through position `at` of a grid `fineness` times as fine, with a cone `strata` cells wide.
fn frame_ray_at(at: vec2f, fineness: f32, strata: f32) -> Ray {
    let size = fineness * vec2f(frame.size);
    let scale = frame.camera.inverse_height / fineness;
    let x = (2.0 * at.x - size.x) * scale;
    let y = (size.y - 2.0 * at.y) * scale;
    let spread = x * frame.camera.right + y * frame.camera.up;
    let side = frame_side(scale) * strata;
    return Ray(
        frame.camera.origin + frame.camera.orthographic * spread,
        FAR,
        frame.camera.forward + (1.0 - frame.camera.orthographic) * spread,
        MISS,
        0.0,
        side * vec2f(frame.camera.orthographic, 1.0 - frame.camera.orthographic),
    );
}

// Position in the image where a point is seen, in samples from the upper left; negative behind the camera.
fn frame_place(point: vec3f) -> vec2f {
    let size = vec2f(frame.size);
    let away = point - frame.camera.origin;
    let depth = dot(away, frame.camera.forward) / dot(frame.camera.forward, frame.camera.forward);
    let x = dot(away, frame.camera.right) / dot(frame.camera.right, frame.camera.right);
    let y = dot(away, frame.camera.up) / dot(frame.camera.up, frame.camera.up);
    let along = select(depth, 1.0, frame.camera.orthographic != 0.0);
    if !(depth > 0.0) {
        return vec2f(-1.0);
    }
    return 0.5 * (size + vec2f(x, -y) / along * size.y);
}

// Row of the band's buffers that stores row y of the frame.
fn frame_band_row(y: u32) -> u32 {
    return u32(abs(i32(y) - i32(frame.part.turn)));
}

// Position of a thread in a square tile along a Z-order curve, so that threads of a subgroup process neighbouring
// pixels.
fn frame_tile(index: u32) -> vec2u {
    var bits = vec2u(index, index >> 1u) & vec2u(0x55555555u);
    bits = (bits | (bits >> vec2u(1u))) & vec2u(0x33333333u);
    bits = (bits | (bits >> vec2u(2u))) & vec2u(0x0f0f0f0fu);
    return (bits | (bits >> vec2u(4u))) & vec2u(0x00ff00ffu);
}
