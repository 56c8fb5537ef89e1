// Frames and widths of microfacet lobes in scenes without anisotropy.

// Whether the surface is taken as a mirror.
fn lobes_smooth(m: Material) -> bool {
    return m.roughness < LEAST_ROUGHNESS;
}

fn lobes_frame(m: Material, normal: vec3f) -> mat3x3f {
    return directions_frame(normal);
}

fn lobes_alpha(m: Material) -> vec2f {
    return vec2f(m.roughness * m.roughness);
}

// The albedos of a lobe of reflectance 1 by which it is compensated, from those in the table.
fn lobes_shares(alpha: vec2f, shares: vec2f) -> vec2f {
    return shares;
}
