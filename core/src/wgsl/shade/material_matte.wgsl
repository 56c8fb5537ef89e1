// For scenes of diffuse materials only: a material is its albedo.

struct Material {
    base: vec3f,
}

fn material_at(object: u32, texcoord: vec2f, footprint: vec3f, color: vec3f, maps: Maps) -> Material {
    return Material(object_at(object).base_color * color * texture_color(object_at(object).base_color_texture, texcoord, footprint).rgb);
}

fn material_local(m: Material, position: vec3f, normal: vec3f, view: vec3f, inside: bool, shadow: u32) -> vec3f {
    return environment_ambient(normal) * m.base + lights_reflected(m, m.base, position, normal, view, shadow);
}

fn material_lobe(m: Material, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    return vec3f(0.0);
}
