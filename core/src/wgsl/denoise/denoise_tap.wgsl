// Neighbourhoods of pixels for the denoisers.

// Whether the tap lies inside the image and belongs to the same eye.
fn denoise_tap_is_inside(pixel: vec2u, tap: vec2i) -> bool {
    return all(tap >= vec2i(0)) && all(tap < vec2i(frame.size)) && eyes_same(pixel, vec2u(tap));
}
