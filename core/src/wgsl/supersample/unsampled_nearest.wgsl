// The sample at a pixel's centre stands for its inactive quarters (Jin 2009, Figure 5).

fn unsampled_correction(pixel: vec2u, mask: u32) -> vec3f {
    return vec3f(0.0);
}

fn unsampled_output(pixel: vec2u, mask: u32) {}
