// Materials of objects: factors and textures with common coordinates.

struct Material {
    base: vec3f,
    metallic: f32,
    emission: vec3f,
    roughness: f32,
    weights: vec3f,
    flags: u32,
    transmission: f32,
    ior: f32,
}

fn material_at(object: u32, texcoord: vec2f, footprint: vec3f, color: vec3f, maps: Maps) -> Material {
    var m: Material;
    m.flags = object_at(object).flags;
    m.base = object_at(object).base_color * color * texture_color(object_at(object).base_color_texture, texcoord, footprint).rgb;
    m.roughness = 1.0;
    m.ior = 1.5;
    if !material_is(m, OBJECT_MATTE) {
        if HAS_EMISSION {
            m.emission = frame.exposure * object_at(object).emission;
        }
        if HAS_EMISSIVE_TEXTURES {
            m.emission *= texture_color(object_at(object).emissive_texture, texcoord, footprint).rgb;
        }
        m.roughness = object_at(object).roughness;
        m.metallic = object_at(object).metallic;
        if HAS_METALLIC_ROUGHNESS_TEXTURES {
            let surface = texture_data(object_at(object).metallic_roughness_texture, texcoord, footprint);
            m.roughness *= surface.g;
            m.metallic *= surface.b;
        }
        if material_is(m, OBJECT_WEIGHTS) {
            m.weights = object_at(object).weights;
        }
        m.transmission = object_at(object).transmission;
        m.ior = object_at(object).ior;
    }
    return m;
}

// Reflectance of the dielectric part, from that of Fresnel's equations.
fn material_specular(m: Material, dielectric: f32) -> vec3f {
    return vec3f(dielectric);
}

// The same at normal incidence.
fn material_f0(m: Material) -> vec3f {
    let at_normal = (m.ior - 1.0) / (m.ior + 1.0);
    return vec3f(at_normal * at_normal);
}

// The same at grazing incidence.
fn material_strength(m: Material) -> f32 {
    return 1.0;
}

fn material_f90(m: Material) -> vec3f {
    return vec3f(1.0);
}

// Strength and roughness of the clear coat.
fn material_coat(m: Material) -> vec2f {
    return vec2f(0.0);
}

// Fraction of light that passes the clear coat.
fn material_coat_passes(m: Material, cosine: f32) -> f32 {
    return 1.0;
}

fn material_coat_mirror(m: Material, cosine: f32) -> vec3f {
    return vec3f(0.0);
}

fn material_coat_lobe(m: Material, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    return vec3f(0.0);
}

// Fraction of ambient light that reaches the point.
fn material_occlusion(m: Material) -> f32 {
    return 1.0;
}
