// Camera rays of a frame for one eye.

// Whether both pixels belong to the image of the same eye.
fn eyes_same(a: vec2u, b: vec2u) -> bool {
    return true;
}

// Position of the pixel in its eye's image.
fn eyes_pixel(pixel: vec2u) -> vec2u {
    return pixel;
}

// The primary ray through position `place` in [0, 1]^2 of a pixel.
fn eyes_ray(pixel: vec2u, place: vec2f) -> Ray {
    return frame_ray_at(vec2f(pixel) + place, 1.0, 1.0);
}
