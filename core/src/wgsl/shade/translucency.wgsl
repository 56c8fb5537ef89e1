// Diffuse transmission (KHR_materials_diffuse_transmission): a Lambertian lobe on the other side of the surface.

struct Translucency {
    // Share of the diffuse light that is transmitted, and the colour of that light.
    share: f32,
    color: vec3f,
}

fn translucency_at(record: u32, at: Lookup, maps: Maps) -> Translucency {
    let factors = bitcast<vec4f>(object_part(0u, record + RECORD_TRANSLUCENCY));
    let tint = material_lookup(record, SLOT_DIFFUSETRANSMISSIONCOLOR, at, maps);
    let share = material_lookup(record, SLOT_DIFFUSETRANSMISSION, at, maps);
    return Translucency(
        factors.w * texture_data(share.place, share.texcoord, share.footprint).a,
        factors.rgb * texture_color(tint.place, tint.texcoord, tint.footprint).rgb,
    );
}

// Whether light on the back of an object is seen from its front.
fn translucency_is(object: u32) -> bool {
    let record = material_record(object);
    return record != 0u && bitcast<f32>(object_part(0u, record + RECORD_TRANSLUCENCY).w) > 0.0;
}

// Share of the diffuse light that is reflected.
fn translucency_reflected(m: Material) -> f32 {
    return 1.0 - m.translucency.share;
}

// Albedo of the lobe on the other side.
fn translucency_albedo(m: Material, cosine: f32, inside: bool) -> vec3f {
    if m.translucency.share == 0.0 || material_is(m, OBJECT_WEIGHTS) {
        return vec3f(0.0);
    }
    return material_scattered(m, m.translucency.share * m.translucency.color, cosine, inside);
}

// Ambient and direct light from behind.
fn translucency_local(m: Material, position: vec3f, normal: vec3f, view: vec3f, inside: bool, shadow: u32) -> vec3f {
    let cosine = clamp(dot(normal, view), 0.0, 1.0);
    let albedo = translucency_albedo(m, cosine, inside);
    if all(albedo == vec3f(0.0)) {
        return vec3f(0.0);
    }
    let passed = environment_passed(m, cosine) * material_occlusion(m);
    return albedo * passed * environment_ambient(-normal) + translucency_lit(albedo, position, normal, shadow);
}
