// Anisotropic microfacets (KHR_materials_anisotropy): a lobe that is wider along a direction of the surface; the formulas
// are in core/MATERIALS.md.

struct Anisotropy {
    // Unit direction of the wider side in the frame of tangent and bitangent.
    direction: vec2f,
    strength: f32,
    // The surface's tangent and the sign of its bitangent.
    tangent: vec4f,
}

fn anisotropy_at(record: u32, at: Lookup, maps: Maps) -> Anisotropy {
    let factors = bitcast<vec3f>(object_part(0u, record + RECORD_ANISOTROPY).xyz);
    let lookup = material_lookup(record, SLOT_ANISOTROPY, at, maps);
    var direction = vec2f(1.0, 0.0);
    var strength = factors.x;
    if (lookup.place.z & TEXTURE_PRESENT) != 0u {
        let texel = texture_data(lookup.place, lookup.texcoord, lookup.footprint).rgb;
        let drawn = 2.0 * texel.rg - 1.0;
        let length2 = dot(drawn, drawn);
        if length2 > ANISOTROPY_LEAST_LENGTH2 {
            direction = drawn * inverseSqrt(length2);
        }
        strength *= texel.b;
    }
    let turn = mat2x2f(factors.yz, vec2f(-factors.z, factors.y));
    // What has no tangents has +Z, as an encoded zero is decoded.
    let tangent = select(maps.tangent, vec4f(0.0, 0.0, 1.0, 1.0), all(maps.tangent.xyz == vec3f(0.0)));
    return Anisotropy(turn * direction, strength, tangent);
}

// Squared length below which an averaged direction counts as none.
const ANISOTROPY_LEAST_LENGTH2: f32 = 1.0e-4;

// The wider side's direction, the narrower side's and the normal.
fn anisotropy_frame(m: Material, normal: vec3f) -> mat3x3f {
    let tangent = m.anisotropy.tangent;
    var along = tangent.xyz - dot(normal, tangent.xyz) * normal;
    if dot(along, along) < 1.0e-8 {
        along = vec3f(1.0, 0.0, 0.0) - normal.x * normal;
    }
    let t = normalize(along);
    let b = tangent.w * cross(normal, t);
    let wide = m.anisotropy.direction.x * t + m.anisotropy.direction.y * b;
    return mat3x3f(wide, cross(normal, wide), normal);
}

// Widths of the lobe of a surface of this roughness along the first two axes of the frame.
fn anisotropy_alpha(m: Material, roughness: f32) -> vec2f {
    let alpha = roughness * roughness;
    return vec2f(mix(alpha, 1.0, m.anisotropy.strength * m.anisotropy.strength), alpha);
}

// Roughness along the wider side.
fn anisotropy_widest(m: Material) -> f32 {
    if m.anisotropy.strength == 0.0 {
        return m.roughness;
    }
    return sqrt(anisotropy_alpha(m, m.roughness).x);
}

// Normal by which the filtered map is reflected: bent towards the plane that the view and the narrower side span.
fn anisotropy_normal(m: Material, normal: vec3f, view: vec3f) -> vec3f {
    let strength = m.anisotropy.strength;
    if strength == 0.0 {
        return normal;
    }
    let narrow = anisotropy_frame(m, normal)[1];
    let facing = view - dot(view, narrow) * narrow;
    let length2 = dot(facing, facing);
    if length2 < 1.0e-8 {
        return normal;
    }
    let rest = 1.0 - strength * (1.0 - m.roughness);
    return normalize(mix(facing * inverseSqrt(length2), normal, rest * rest * rest * rest));
}

// The lobe for one light, as `material_microfacets` with exponents by direction.
fn anisotropy_lobe(m: Material, f0: vec3f, f90: vec3f, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    if m.anisotropy.strength == 0.0 {
        return material_microfacets(f0, f90, m.roughness, normal, view, light);
    }
    let sum = view + light;
    let h = (sum * inverseSqrt(max(dot(sum, sum), 1.0e-12))) * anisotropy_frame(m, normal);
    let alpha = anisotropy_alpha(m, max(m.roughness, 0.2));
    let exponents = max(2.0 / (alpha * alpha) - 2.0, vec2f(0.0));
    let across = h.xy * h.xy;
    let exponent = dot(across, exponents) / max(across.x + across.y, 1.0e-12);
    let scale = sqrt((exponents.x + 2.0) * (exponents.y + 2.0)) / (2.0 * PI);
    let distribution = scale * pow(max(h.z, 1.0e-6), exponent);
    let grazing = material_grazing(clamp(dot(view, sum) * inverseSqrt(max(dot(sum, sum), 1.0e-12)), 0.0, 1.0));
    let widest = max(max(dot(normal, light), dot(normal, view)), 0.05);
    return (f0 + (f90 - f0) * grazing) * ((1.0 - m.roughness) * distribution / (4.0 * widest));
}
