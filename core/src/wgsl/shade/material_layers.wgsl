// Specular colour, specular-glossiness factors and clear coats of extended materials.

fn material_layer(m: ptr<function, Material>, record: u32, at: Lookup, maps: Maps) {
    let factors = bitcast<vec4f>(object_part(0u, record + 1u));
    if (object_part(0u, record + 2u).w & RECORD_SPECULAR_GLOSSINESS) != 0u {
        let glossy = material_lookup(record, SLOT_SPECULARGLOSSINESS, at, maps);
        let texel = texture_color(glossy.place, glossy.texcoord, glossy.footprint);
        material_from_glossiness(m, factors * texel);
    } else {
        let tint = material_lookup(record, SLOT_SPECULARCOLOR, at, maps);
        let strength = material_lookup(record, SLOT_SPECULAR, at, maps);
        let color = texture_color(tint.place, tint.texcoord, tint.footprint).rgb;
        let share = texture_data(strength.place, strength.texcoord, strength.footprint).a;
        (*m).specular = factors * vec4f(color, share);
    }
    let coat = material_lookup(record, SLOT_CLEARCOAT, at, maps);
    let rough = material_lookup(record, SLOT_CLEARCOATROUGHNESS, at, maps);
    (*m).coat = bitcast<vec2f>(object_part(0u, record + 3u).xy) * vec2f(
        texture_data(coat.place, coat.texcoord, coat.footprint).r,
        texture_data(rough.place, rough.texcoord, rough.footprint).g,
    );
    if HAS_SHEEN {
        let tint = material_lookup(record, SLOT_SHEENCOLOR, at, maps);
        let fibres = material_lookup(record, SLOT_SHEENROUGHNESS, at, maps);
        (*m).sheen = bitcast<vec4f>(object_part(0u, record + 4u)) * vec4f(
            texture_color(tint.place, tint.texcoord, tint.footprint).rgb,
            texture_data(fibres.place, fibres.texcoord, fibres.footprint).a,
        );
    }
}

// Perceived brightness of a colour.
fn material_brightness(color: vec3f) -> f32 {
    return sqrt(dot(color * color, vec3f(0.299, 0.587, 0.114)));
}

// Metalness, base colour and roughness from a diffuse colour, specular reflectance and glossiness, as the appendix of
// KHR_materials_pbrSpecularGlossiness converts them.
fn material_from_glossiness(m: ptr<function, Material>, glossy: vec4f) {
    let dielectric = 0.04;
    let diffuse = (*m).base;
    let specular = glossy.rgb;
    let rest = 1.0 - max(specular.r, max(specular.g, specular.b));
    let bright = material_brightness(specular);
    let b = material_brightness(diffuse) * rest / (1.0 - dielectric) + bright - 2.0 * dielectric;
    let root = sqrt(max(b * b - 4.0 * dielectric * (dielectric - bright), 0.0));
    let metallic = select(clamp((root - b) / (2.0 * dielectric), 0.0, 1.0), 0.0, bright < dielectric);
    let from_diffuse = diffuse * (rest / ((1.0 - dielectric) * max(1.0 - metallic, 1.0e-6)));
    let from_specular = (specular - dielectric * (1.0 - metallic)) / max(metallic, 1.0e-6);
    (*m).base = clamp(mix(from_diffuse, from_specular, metallic * metallic), vec3f(0.0), vec3f(1.0));
    (*m).metallic = metallic;
    (*m).roughness = 1.0 - glossy.a;
}

// Reflectance of the dielectric part, from that of Fresnel's equations.
fn material_specular(m: Material, dielectric: f32) -> vec3f {
    if !HAS_LAYERS || all(m.specular == vec4f(1.0)) {
        return vec3f(dielectric);
    }
    let at_normal = (m.ior - 1.0) / (m.ior + 1.0);
    let grazing = clamp((dielectric - at_normal * at_normal) / (1.0 - at_normal * at_normal), 0.0, 1.0);
    let f0 = material_f0(m);
    return f0 + (m.specular.a - f0) * grazing;
}

// The same at normal incidence.
fn material_f0(m: Material) -> vec3f {
    let at_normal = (m.ior - 1.0) / (m.ior + 1.0);
    if !HAS_LAYERS {
        return vec3f(at_normal * at_normal);
    }
    return min(at_normal * at_normal * m.specular.rgb, vec3f(1.0)) * m.specular.a;
}

// The same at grazing incidence.
fn material_strength(m: Material) -> f32 {
    if !HAS_LAYERS {
        return 1.0;
    }
    return m.specular.a;
}

fn material_f90(m: Material) -> vec3f {
    if !HAS_LAYERS || m.specular.a == 1.0 {
        return vec3f(1.0);
    }
    return vec3f(mix(m.specular.a, 1.0, m.metallic));
}

// The clear coat's index is 1.5.
const COAT_RATIO: f32 = 1.0 / 1.5;

// Strength and roughness of the clear coat.
fn material_coat(m: Material) -> vec2f {
    return m.coat;
}

fn material_coat_reflectance(m: Material, cosine: f32) -> f32 {
    let toward = coat_cosine(m, cosine);
    return m.coat.x * fresnel_reflectance(toward, COAT_RATIO, fresnel_transmitted(toward, COAT_RATIO));
}

// Fraction of light that passes the clear coat.
fn material_coat_passes(m: Material, cosine: f32) -> f32 {
    if !HAS_LAYERS || m.coat.x == 0.0 {
        return 1.0;
    }
    return 1.0 - material_coat_reflectance(m, cosine);
}

fn material_coat_mirror(m: Material, cosine: f32) -> vec3f {
    if !HAS_LAYERS || m.coat.x == 0.0 {
        return vec3f(0.0);
    }
    return vec3f(material_coat_reflectance(m, cosine) * max(0.0, 1.0 - 2.0 * m.coat.y));
}

fn material_coat_lobe(m: Material, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    if !HAS_LAYERS || m.coat.x == 0.0 {
        return vec3f(0.0);
    }
    return material_microfacets(vec3f(0.04 * m.coat.x), vec3f(m.coat.x), m.coat.y, normal, view, light);
}
