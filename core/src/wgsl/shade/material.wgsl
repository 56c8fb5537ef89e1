// Materials at a point, in Whitted's terms; the formulas are in core/MATERIALS.md.

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

fn material_at(object: u32, texcoord: vec2f, footprint: vec3f, color: vec3f) -> Material {
    var m: Material;
    m.flags = object_at(object).flags;
    m.base = object_at(object).base_color * color * texture_color(object_at(object).base_color_texture, texcoord, footprint).rgb;
    m.roughness = 1.0;
    m.ior = 1.5;
    if !material_is(m, OBJECT_MATTE) {
        if HAS_EMISSION {
            m.emission = object_at(object).emission;
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

fn material_is(m: Material, flag: u32) -> bool {
    return (m.flags & flag) != 0u;
}

// The share of the specular lobe that is traced as a mirror.
fn material_gloss(m: Material) -> f32 {
    return max(0.0, 1.0 - 2.0 * m.roughness);
}

// The index on the viewer's side over that on the other; `inside` is the side behind the surface.
fn material_ratio(m: Material, inside: bool) -> f32 {
    return select(1.0 / m.ior, m.ior, inside);
}

// The factor (1 - cos)^5 of Schlick's approximation.
fn material_grazing(cosine: f32) -> f32 {
    let x = 1.0 - cosine;
    let x2 = x * x;
    return x2 * x2 * x;
}

fn material_fresnel(m: Material, cosine: f32, inside: bool) -> vec3f {
    let solid_inside = inside && m.transmission > 0.0 && !material_is(m, OBJECT_THIN);
    let ratio = material_ratio(m, solid_inside);
    var dielectric = fresnel_reflectance(cosine, ratio, fresnel_transmitted(cosine, ratio));
    if material_is(m, OBJECT_THIN) {
        // Reflectance of a pane: both faces, all orders of internal reflection.
        dielectric = 2.0 * dielectric / (1.0 + dielectric);
    }
    let grazing = material_grazing(cosine);
    let metal = m.base + (1.0 - m.base) * grazing;
    return mix(vec3f(dielectric), metal, m.metallic);
}

// The share of the radiance along the reflected ray.
fn material_mirror(m: Material, cosine: f32, inside: bool) -> vec3f {
    if material_is(m, OBJECT_WEIGHTS) {
        return vec3f(m.weights.y);
    }
    if material_is(m, OBJECT_UNLIT) {
        return vec3f(0.0);
    }
    return material_fresnel(m, cosine, inside) * material_gloss(m);
}

// The share of the radiance along the refracted ray, where there is one.
fn material_refraction(m: Material, cosine: f32, inside: bool) -> vec3f {
    if material_is(m, OBJECT_WEIGHTS) {
        return vec3f(m.weights.z);
    }
    if material_is(m, OBJECT_UNLIT) || m.transmission == 0.0 {
        return vec3f(0.0);
    }
    return m.base * m.transmission * (1.0 - m.metallic) * (1.0 - material_fresnel(m, cosine, inside));
}

// The share of light that is scattered in all directions.
fn material_diffuse(m: Material, cosine: f32, inside: bool) -> vec3f {
    if material_is(m, OBJECT_WEIGHTS) {
        return m.base * m.weights.x;
    }
    let gloss = material_gloss(m);
    let diffuse = m.base * ((1.0 - m.metallic) * (1.0 - m.transmission));
    if gloss > 0.0 {
        return diffuse * (1.0 - material_fresnel(m, cosine, inside) * gloss);
    }
    return diffuse;
}

// What of a metal is not traced as a mirror: it scatters light from everywhere too.
fn material_rough_metal(m: Material) -> vec3f {
    if material_is(m, OBJECT_WEIGHTS) {
        return vec3f(0.0);
    }
    return m.base * (m.metallic * (1.0 - material_gloss(m)));
}

// Albedo of the diffuse and the specular lobe together.
fn material_albedo(m: Material, cosine: f32, inside: bool) -> vec3f {
    return material_diffuse(m, cosine, inside) + material_rough_metal(m);
}

// What the surface sends towards the viewer by itself: emission, ambient and direct light. `view` is the unit
// vector to the viewer, bit i of `shadow` says that light i does not reach the point.
fn material_local(m: Material, position: vec3f, normal: vec3f, view: vec3f, inside: bool, shadow: u32) -> vec3f {
    if material_is(m, OBJECT_UNLIT) {
        return m.base;
    }
    let diffuse = material_diffuse(m, clamp(dot(normal, view), 0.0, 1.0), inside);
    let ambient = diffuse + material_rough_metal(m);
    return m.emission + frame.ambient * ambient + lights_reflected(m, diffuse, position, normal, view, shadow);
}

// Microfacet lobe (Blinn-Phong distribution, Neumann's visibility) for one light.
fn material_lobe(m: Material, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    if m.roughness >= 1.0 || material_is(m, OBJECT_WEIGHTS) {
        return vec3f(0.0);
    }
    // Zero where the light comes from behind, along the view.
    let sum = view + light;
    let half_way = sum * inverseSqrt(max(dot(sum, sum), 1.0e-12));
    // A point light's image in a perfect mirror has no width: it is shown as wide as roughness 0.2 makes it.
    let roughness = max(m.roughness, 0.2);
    let alpha2 = roughness * roughness * roughness * roughness;
    let exponent = max(2.0 / alpha2 - 2.0, 0.0);
    let distribution = (exponent + 2.0) / (2.0 * PI) * pow(max(dot(normal, half_way), 1.0e-6), exponent);
    let grazing = material_grazing(clamp(dot(view, half_way), 0.0, 1.0));
    let at_normal = (m.ior - 1.0) / (m.ior + 1.0);
    let f0 = mix(vec3f(at_normal * at_normal), m.base, m.metallic);
    let fresnel = f0 + (1.0 - f0) * grazing;
    let widest = max(max(dot(normal, light), dot(normal, view)), 0.05);
    return fresnel * ((1.0 - m.roughness) * distribution / (4.0 * widest));
}
