// Frames and widths of microfacet lobes in scenes with anisotropy.

// Whether the surface is taken as a mirror.
fn lobes_smooth(m: Material) -> bool {
    return m.roughness < LEAST_ROUGHNESS && m.anisotropy.strength == 0.0;
}

fn lobes_frame(m: Material, normal: vec3f) -> mat3x3f {
    if m.anisotropy.strength == 0.0 {
        return directions_frame(normal);
    }
    return anisotropy_frame(m, normal);
}

fn lobes_alpha(m: Material) -> vec2f {
    return anisotropy_alpha(m, max(m.roughness, LEAST_ROUGHNESS));
}

// The albedos of a lobe of reflectance 1 by which it is compensated, from those of an isotropic lobe: more than the
// anisotropic one has, so that compensation never adds light.
fn lobes_shares(alpha: vec2f, shares: vec2f) -> vec2f {
    let more = 1.0 + 0.3 * (1.0 - sqrt(min(alpha.x, alpha.y) / max(alpha.x, alpha.y)));
    return vec2f(min(more * shares.x, 1.0), shares.y);
}
