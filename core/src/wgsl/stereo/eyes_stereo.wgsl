// Camera rays of two eyes, whose images are side by side with the left eye's on the left. View directions are
// parallel; convergence shifts the images. A point is therefore in the same row of both.

const EYES_LEFT: u32 = 0u;
const EYES_RIGHT: u32 = 1u;

// Width of each image; with an odd frame width the right one lacks its last column.
fn eyes_width() -> u32 {
    return (frame.size.x + 1u) / 2u;
}

fn eyes_of(pixel: vec2u) -> u32 {
    return select(EYES_LEFT, EYES_RIGHT, pixel.x >= eyes_width());
}

// Whether both pixels belong to the image of the same eye.
fn eyes_same(a: vec2u, b: vec2u) -> bool {
    return eyes_of(a) == eyes_of(b);
}

// Position of the pixel in its eye's image.
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

// Offset of an eye's image from one in the middle of the frame.
fn eyes_offset() -> f32 {
    return 0.5 * (f32(frame.size.x) - f32(eyes_width()));
}

// The primary ray through position `place` in [0, 1]^2 of a pixel.
fn eyes_ray(pixel: vec2u, place: vec2f) -> Ray {
    var ray = frame_ray_at(vec2f(eyes_pixel(pixel)) + vec2f(eyes_offset(), 0.0) + place, 1.0, 1.0);
    let side = eyes_side(eyes_of(pixel));
    ray.origin += (side * frame.camera.eyes.x) * frame.camera.right;
    ray.direction -= (side * frame.camera.eyes.y) * frame.camera.right;
    return ray;
}

// The ray from an eye to a point, which is at parameter 1; the ray ends at `t_max`.
fn eyes_ray_to(eye: u32, point: vec3f, t_max: f32) -> Ray {
    let depth = dot(point - frame.camera.origin, frame.camera.forward) / dot(frame.camera.forward, frame.camera.forward);
    let side = frame_side(frame.camera.inverse_height) * depth;
    return Ray(eyes_origin(eye), t_max, point - eyes_origin(eye), MISS, 0.0, vec2f(0.0, side));
}

// Projects a point into an eye's image: 1 + the index of the pixel in the frame, row by row, or 0 if it is
// outside.
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
