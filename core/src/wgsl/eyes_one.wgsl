// One eye sees the whole picture.

// Does one eye see both pixels?
fn eyes_same(a: vec2u, b: vec2u) -> bool {
    return true;
}

// The pixel in the eye's own picture.
fn eyes_pixel(pixel: vec2u) -> vec2u {
    return pixel;
}

// Through a place in a pixel.
fn eyes_ray(pixel: vec2u, place: vec2f) -> Ray {
    return frame_ray_at(vec2f(pixel) + place, 1.0, 1.0);
}
