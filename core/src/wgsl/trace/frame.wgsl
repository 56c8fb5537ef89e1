// The frame's constants and its primary rays.

// Where primary rays start and where they go.
struct FrameCamera {
    origin: vec3f,
    // 1, or 0 of a perspective camera.
    orthographic: f32,
    right: vec3f,
    // 1 / size.y, of samples.
    inverse_height: f32,
    up: vec3f,
    padding_x: u32,
    forward: vec3f,
    padding_y: u32,
    // How far the eyes are aside of the origin, and how far their pictures are shifted, in lengths of `right`.
    eyes: vec2f,
    padding_z: vec2u,
}

// What a dispatch treats.
struct FramePart {
    // Where this part of the pass begins: a row of workgroups, or a place in the list.
    first: u32,
    // The samples that the pass treats: each stride-th row from `row` until before `end`.
    stride: u32,
    row: u32,
    end: u32,
    // What is stored of row y is in row |y - turn|.
    turn: u32,
    // The most samples that a thread of the postcorrection traces.
    walk: u32,
    // The direction of a scan, or the distance of the samples that a filter reads.
    step: vec2i,
}

// How much may differ between samples that count as similar.
struct FrameTolerances {
    // Kim 2016, Table 1.
    pos: f32,
    norm: f32,
    tex: f32,
    gcol: f32,
    // Of objects, normals, shadow counts and textures, at the primary hit and at the secondary one (Jin 2009, Table 1).
    tau_primary: vec4f,
    tau_secondary: vec4f,
    tau_col: f32,
    // The least of the nine thresholds.
    tau_least: f32,
    // The objects whose differences count: OID + 1 of the first and of the last.
    focus_first: u32,
    focus_last: u32,
    // How much the ends of a quincunx may differ.
    quincunx_threshold: f32,
    padding_x: u32,
    padding_y: u32,
    padding_z: u32,
}

// Of path tracing.
struct FramePaths {
    // Where the eyes look, in pixels, and the probability of stopping for each pixel away from there.
    gaze: vec2f,
    stop: f32,
    // 1 over the sum of strength times area of all emitters.
    emitter_scale: f32,
    emitters: u32,
    // Of each pixel, since the camera rests.
    sample: u32,
    // Samples of each pixel that were traced elsewhere and added.
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
    // In samples.
    size: vec2u,
    // The ranks that are traced anew: the first and how many.
    refresh_first: u32,
    refresh_count: u32,
    // Not 0 where the camera is that of the frame before.
    still: u32,
    padding_x: u32,
    padding_y: u32,
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
    // The primitive that the ray leaves, MISS if it leaves none.
    left: u32,
    // Where it left it; above 0 for rays that pass straight through, on their way since before.
    after: f32,
    // How wide what the ray stands for is where it starts, and what that grows by in a unit of the ray's parameter.
    cone: vec2f,
}

// Through a sample (a pixel, unless pixels have several), for which it stands; a perspective ray's parameter is the view depth
// along `forward`.
fn frame_ray(pixel: vec2u) -> Ray {
    return frame_ray_in(pixel, 1.0);
}

// Through a cell of a grid that is so many times as fine as that of the samples.
fn frame_ray_in(stratum: vec2u, fineness: f32) -> Ray {
    return frame_ray_at(vec2f(stratum) + jitter_in(stratum), fineness, 1.0);
}

// What textures are averaged over, of the width that a sample stands for. An average that is as wide is blurred by the filter
// that it is taken with: extra samples beside single ones are closest to 64 a pixel at 0.85 (wooden_staircase, sponza_dabrovic:
// 1 is 0.3 dB worse).
const FRAME_FOOTPRINT: f32 = 0.85;

// The width of a cell at depth 1, from its scale.
fn frame_side(scale: f32) -> f32 {
    return FRAME_FOOTPRINT * 2.0 * scale * length(frame.camera.up);
}

// Through a place in such a grid, for a square of so many cells' side.
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

// The place in the image, in samples from the upper left, where a point is seen; negative behind the camera.
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

// Where a row of the frame is stored in the band.
fn frame_band_row(y: u32) -> u32 {
    return u32(abs(i32(y) - i32(frame.part.turn)));
}

// The place of a thread in a square tile, along a Z-order curve: threads that run together see neighbouring pixels.
fn frame_tile(index: u32) -> vec2u {
    var bits = vec2u(index, index >> 1u) & vec2u(0x55555555u);
    bits = (bits | (bits >> vec2u(1u))) & vec2u(0x33333333u);
    bits = (bits | (bits >> vec2u(2u))) & vec2u(0x0f0f0f0fu);
    return (bits | (bits >> vec2u(4u))) & vec2u(0x00ff00ffu);
}
