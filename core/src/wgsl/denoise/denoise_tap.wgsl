// Neighbourhoods of pixels as the denoisers see them.

// Is there such a pixel, and does the same eye see it?
fn denoise_tap_is_inside(pixel: vec2u, tap: vec2i) -> bool {
    return all(tap >= vec2i(0)) && all(tap < vec2i(frame.size)) && eyes_same(pixel, vec2u(tap));
}
