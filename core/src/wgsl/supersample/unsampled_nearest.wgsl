// Inactive subpixels of a pixel have the colour of the sample at its centre (Jin 2009, Figure 5).

fn unsampled_correction(pixel: vec2u, mask: u32) -> vec3f {
    return vec3f(0.0);
}

fn unsampled_output(pixel: vec2u, mask: u32) {}
