// Two eyes side by side, the left one's picture on the left. They look in parallel; pictures that converge are shifted for
// that. So a point is in the same row of both.

const EYES_LEFT: u32 = 0u;
const EYES_RIGHT: u32 = 1u;

// Of each picture; of an odd width the right one lacks its last column.
fn eyes_width() -> u32 {
    return (frame.size.x + 1u) / 2u;
}

fn eyes_of(pixel: vec2u) -> u32 {
    return select(EYES_LEFT, EYES_RIGHT, pixel.x >= eyes_width());
}

// Whether both pixels belong to the picture of one eye.
fn eyes_same(a: vec2u, b: vec2u) -> bool {
    return eyes_of(a) == eyes_of(b);
}

// Position of the pixel in the picture of its eye.
fn eyes_pixel(pixel: vec2u) -> vec2u {
    return vec2u(pixel.x - eyes_of(pixel) * eyes_width(), pixel.y);
}

fn eyes_other(eye: u32) -> u32 {
    return EYES_LEFT + EYES_RIGHT - eye;
}

fn eyes_side(eye: u32) -> f32 {
    return select(-1.0, 1.0, eye == EYES_RIGHT);
}

fn eyes_origin(eye: u32) -> vec3f {
    return frame.camera.origin + (eyes_side(eye) * frame.camera.eyes.x) * frame.camera.right;
}

// From the left border of an eye's picture to that of one in the middle of the frame.
fn eyes_offset() -> f32 {
    return 0.5 * (f32(frame.size.x) - f32(eyes_width()));
}

// The primary ray through a place in [0, 1]^2 of a pixel.
fn eyes_ray(pixel: vec2u, place: vec2f) -> Ray {
    var ray = frame_ray_at(vec2f(eyes_pixel(pixel)) + vec2f(eyes_offset(), 0.0) + place, 1.0, 1.0);
    let side = eyes_side(eyes_of(pixel));
    ray.origin += (side * frame.camera.eyes.x) * frame.camera.right;
    ray.direction -= (side * frame.camera.eyes.y) * frame.camera.right;
    return ray;
}

// To a point, which is at 1 of the ray's parameter, and up to `t_max` of it.
fn eyes_ray_to(eye: u32, point: vec3f, t_max: f32) -> Ray {
    let depth = dot(point - frame.camera.origin, frame.camera.forward) / dot(frame.camera.forward, frame.camera.forward);
    let side = frame_side(frame.camera.inverse_height) * depth;
    return Ray(eyes_origin(eye), t_max, point - eyes_origin(eye), MISS, 0.0, vec2f(0.0, side));
}

// Where the eye sees a point: the index of the pixel in the frame, row by row, + 1; 0 if it does not.
fn eyes_project(eye: u32, point: vec3f) -> u32 {
    let side = eyes_side(eye);
    let shift = vec2f(0.5 * side * frame.camera.eyes.y * f32(frame.size.y) - eyes_offset(), 0.0);
    let place = frame_place(point - (side * frame.camera.eyes.x) * frame.camera.right) + shift;
    let first = eye * eyes_width();
    let size = vec2f(f32(min(eyes_width(), frame.size.x - first)), f32(frame.size.y));
    if !(all(place >= vec2f(0.0)) && all(place < size)) {
        return 0u;
    }
    return u32(place.y) * frame.size.x + first + u32(place.x) + 1u;
}
