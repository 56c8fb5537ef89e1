// Sheen of cloth (KHR_materials_sheen): the distribution of Estevez & Kulla 2017 with the visibility of Neubelt & Pettineo
// 2013; the formulas are in core/MATERIALS.md.

// The sheen's albedo, and the factor on the lobe that keeps it at most 1.
fn sheen_share(m: Material, cosine: f32) -> vec2f {
    return lobe_albedo_entry(cosine, m.sheen.a).zw;
}

fn material_has_sheen(m: Material) -> bool {
    return any(m.sheen.rgb > vec3f(0.0));
}

// Share of light for all directions that the sheen reflects.
fn material_sheen_albedo(m: Material, cosine: f32) -> vec3f {
    if !material_has_sheen(m) {
        return vec3f(0.0);
    }
    return m.sheen.rgb * sheen_share(m, cosine).x;
}

// Share of light that the sheen leaves for what is below it.
fn material_sheen_passes(m: Material, cosine: f32) -> f32 {
    let albedo = material_sheen_albedo(m, cosine);
    return 1.0 - max(albedo.x, max(albedo.y, albedo.z));
}

fn material_sheen_lobe(m: Material, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    let toward_view = max(dot(normal, view), 0.0);
    let toward_light = dot(normal, light);
    if !material_has_sheen(m) || toward_light <= 0.0 {
        return vec3f(0.0);
    }
    let sum = view + light;
    let h = sum * inverseSqrt(max(dot(sum, sum), 1.0e-12));
    let roughness = max(m.sheen.a, LEAST_SHEEN_ROUGHNESS);
    let inverse = 1.0 / (roughness * roughness);
    // The squared sine, which a difference from 1 would round off.
    let across = cross(normal, h);
    let sine2 = clamp(dot(across, across), 1.0e-12, 1.0);
    let distribution = (2.0 + inverse) * pow(sine2, 0.5 * inverse) / (2.0 * PI);
    let visibility = 0.25 / max(toward_light + toward_view - toward_light * toward_view, 1.0e-6);
    return m.sheen.rgb * (sheen_share(m, toward_view).y * distribution * visibility);
}
