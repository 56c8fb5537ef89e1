// Materials of objects with all texture slots, each with its own coordinates, where scenes need them.

struct Material {
    base: vec3f,
    metallic: f32,
    emission: vec3f,
    roughness: f32,
    weights: vec3f,
    flags: u32,
    transmission: f32,
    ior: f32,
    occlusion: f32,
    // Averaged normal of the normal map in the tangent frame; zero without one.
    bump: vec3f,
    // Colour and strength of the dielectric reflection; strength and roughness of the clear coat.
    specular: vec4f,
    coat: vec2f,
    // Colour and roughness of the sheen.
    sheen: vec4f,
    anisotropy: Anisotropy,
    iridescence: Iridescence,
    translucency: Translucency,
    coat_normal: CoatNormal,
}

fn material_at(object: u32, texcoord: vec2f, footprint: vec3f, color: vec3f, maps: Maps) -> Material {
    var m: Material;
    m.flags = object_at(object).flags;
    let record = material_record(object);
    let base = material_lookup(record, SLOT_BASECOLOR, Lookup(object_at(object).base_color_texture, texcoord, footprint), maps);
    m.base = object_at(object).base_color * color * texture_color(base.place, base.texcoord, base.footprint).rgb;
    m.roughness = 1.0;
    m.ior = 1.5;
    m.occlusion = 1.0;
    m.specular = vec4f(1.0);
    if !material_is(m, OBJECT_MATTE) {
        if HAS_EMISSION {
            m.emission = frame.exposure * object_at(object).emission;
        }
        if HAS_EMISSIVE_TEXTURES {
            let glow = material_lookup(record, SLOT_EMISSIVE, Lookup(object_at(object).emissive_texture, texcoord, footprint), maps);
            m.emission *= texture_color(glow.place, glow.texcoord, glow.footprint).rgb;
        }
        m.roughness = object_at(object).roughness;
        m.metallic = object_at(object).metallic;
        if HAS_METALLIC_ROUGHNESS_TEXTURES {
            let own = Lookup(object_at(object).metallic_roughness_texture, texcoord, footprint);
            let rough = material_lookup(record, SLOT_METALLICROUGHNESS, own, maps);
            let surface = texture_data(rough.place, rough.texcoord, rough.footprint);
            m.roughness *= surface.g;
            m.metallic *= surface.b;
        }
        if material_is(m, OBJECT_WEIGHTS) {
            m.weights = object_at(object).weights;
        }
        m.transmission = object_at(object).transmission;
        m.ior = object_at(object).ior;
    }
    if record != 0u {
        material_extend(&m, record, Lookup(vec4u(0u), texcoord, footprint), maps);
    }
    return m;
}

// Adds what the record of a material has.
fn material_extend(m: ptr<function, Material>, record: u32, at: Lookup, maps: Maps) {
    let header = object_part(0u, record);
    let through = material_lookup(record, SLOT_TRANSMISSION, at, maps);
    (*m).transmission *= texture_data(through.place, through.texcoord, through.footprint).r;
    let hidden = material_lookup(record, SLOT_OCCLUSION, at, maps);
    let open = texture_data(hidden.place, hidden.texcoord, hidden.footprint).r;
    (*m).occlusion = 1.0 + bitcast<f32>(header.w) * (open - 1.0);
    if HAS_LAYERS {
        material_layer(m, record, at, maps);
    }
    if HAS_NORMAL_MAPS && (header.x & RECORD_NORMAL_MAP) != 0u {
        let bumps = material_lookup(record, SLOT_NORMAL, at, maps);
        if (bumps.place.z & TEXTURE_PRESENT) != 0u {
            let average = 2.0 * texture_data(bumps.place, bumps.texcoord, bumps.footprint).rgb - 1.0;
            (*m).roughness = material_toksvig((*m).roughness, length(average));
            let scale = bitcast<f32>(header.z);
            (*m).bump = average * vec3f(scale, scale, 1.0);
        }
    }
    (*m).anisotropy = anisotropy_at(record, at, maps);
    (*m).iridescence = iridescence_at(record, at, maps);
    (*m).translucency = translucency_at(record, at, maps);
    coat_normal_read(m, record, at, maps);
}

// Fraction of ambient light that reaches the point.
fn material_occlusion(m: Material) -> f32 {
    return m.occlusion;
}
