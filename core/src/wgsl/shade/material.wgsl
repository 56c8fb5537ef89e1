// Evaluates materials at a point (Whitted 1980); the formulas are in core/MATERIALS.md.

fn material_is(m: Material, flag: u32) -> bool {
    return (m.flags & flag) != 0u;
}

// The fraction of the specular lobe that is traced as a mirror.
fn material_gloss(m: Material) -> f32 {
    return max(0.0, 1.0 - 2.0 * anisotropy_widest(m));
}

// The index of refraction on the viewer's side over that on the other; `inside` means that the viewer is behind
// the surface.
fn material_ratio(m: Material, inside: bool) -> f32 {
    return select(1.0 / m.ior, m.ior, inside);
}

// The factor (1 - cos)^5 of Schlick's approximation.
fn material_grazing(cosine: f32) -> f32 {
    let x = 1.0 - cosine;
    let x2 = x * x;
    return x2 * x2 * x;
}

// Reflectance of the dielectric part.
fn material_dielectric(m: Material, cosine: f32, inside: bool) -> vec3f {
    let solid_inside = inside && m.transmission > 0.0 && !material_is(m, OBJECT_THIN);
    let ratio = material_ratio(m, solid_inside);
    var dielectric = material_specular(m, fresnel_reflectance(cosine, ratio, fresnel_transmitted(cosine, ratio)));
    dielectric = iridescence_over(m, 0.0, dielectric, cosine, ratio);
    if material_is(m, OBJECT_THIN) {
        // Reflectance of a thin pane: both faces with all internal reflections.
        dielectric = 2.0 * dielectric / (1.0 + dielectric);
    }
    return dielectric;
}

fn material_fresnel(m: Material, cosine: f32, inside: bool) -> vec3f {
    let metal = m.base + (1.0 - m.base) * material_grazing(cosine);
    return mix(material_dielectric(m, cosine, inside), iridescence_over(m, 1.0, metal, cosine, 0.0), m.metallic);
}

// Fraction of light that passes the clear coat and the sheen.
fn material_under(m: Material, cosine: f32) -> f32 {
    return material_coat_passes(m, cosine) * material_sheen_passes(m, cosine);
}

// Weight of the reflected ray's radiance.
fn material_mirror(m: Material, cosine: f32, inside: bool) -> vec3f {
    if material_is(m, OBJECT_WEIGHTS) {
        return vec3f(m.weights.y);
    }
    if material_is(m, OBJECT_UNLIT) {
        return vec3f(0.0);
    }
    let under = material_under(m, cosine);
    return material_coat_mirror(m, cosine) + under * material_fresnel(m, cosine, inside) * material_gloss(m);
}

// Weight of the refracted ray's radiance, if there is one.
fn material_refraction(m: Material, cosine: f32, inside: bool) -> vec3f {
    if material_is(m, OBJECT_WEIGHTS) {
        return vec3f(m.weights.z);
    }
    if material_is(m, OBJECT_UNLIT) || m.transmission == 0.0 {
        return vec3f(0.0);
    }
    let entering = m.base * m.transmission * (1.0 - m.metallic) * (1.0 - material_dielectric(m, cosine, inside));
    return material_under(m, cosine) * entering;
}

// Albedo of the diffuse lobe.
fn material_diffuse(m: Material, cosine: f32, inside: bool) -> vec3f {
    if material_is(m, OBJECT_WEIGHTS) {
        return m.base * m.weights.x;
    }
    return material_scattered(m, translucency_reflected(m) * m.base, cosine, inside);
}

// What a diffuse lobe of this colour has of the light, below the layers and the specular lobe.
fn material_scattered(m: Material, color: vec3f, cosine: f32, inside: bool) -> vec3f {
    let gloss = material_gloss(m);
    let diffuse = material_under(m, cosine) * color * ((1.0 - m.metallic) * (1.0 - m.transmission));
    if gloss > 0.0 {
        return diffuse * (1.0 - material_dielectric(m, cosine, inside) * gloss);
    }
    return diffuse;
}

// The part of a metal's reflection that is not traced as a mirror; it counts as diffuse as well.
fn material_rough_metal(m: Material, cosine: f32) -> vec3f {
    if material_is(m, OBJECT_WEIGHTS) {
        return vec3f(0.0);
    }
    return iridescence_over(m, 1.0, m.base, cosine, 0.0) * (m.metallic * (1.0 - material_gloss(m)));
}

// The part of a metal's reflection of lights that is not in its lobe, as if it were diffuse.
fn material_lit_metal(m: Material, cosine: f32) -> vec3f {
    if material_is(m, OBJECT_WEIGHTS) {
        return vec3f(0.0);
    }
    return iridescence_over(m, 1.0, m.base, cosine, 0.0) * (m.metallic * m.roughness);
}

// Sum of the albedos of the diffuse and the specular lobe.
fn material_albedo(m: Material, cosine: f32, inside: bool) -> vec3f {
    return material_diffuse(m, cosine, inside) + material_rough_metal(m, cosine);
}

// Radiance towards the viewer without further rays: emission, ambient and direct light. `view` is the unit vector
// to the viewer; bit i of `shadow` means that light i does not reach the point.
fn material_local(m: Material, position: vec3f, normal: vec3f, view: vec3f, inside: bool, shadow: u32) -> vec3f {
    if material_is(m, OBJECT_UNLIT) {
        return m.base;
    }
    let cosine = clamp(dot(normal, view), 0.0, 1.0);
    let diffuse = material_diffuse(m, cosine, inside);
    let lit = diffuse + material_lit_metal(m, cosine) * material_sheen_passes(m, cosine);
    return m.emission + environment_reflected(m, diffuse, normal, view) * material_occlusion(m)
        + lights_reflected(m, lit, position, normal, view, shadow)
        + translucency_local(m, position, normal, view, inside, shadow) + coat_lit(m, position, view, shadow);
}

// The specular lobes for one light.
fn material_lobe(m: Material, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    let cosine = clamp(dot(normal, view), 0.0, 1.0);
    let sheen = material_coat_passes(m, cosine) * material_sheen_lobe(m, normal, view, light);
    let coat = coat_shared_lobe(m, normal, view, light) + sheen;
    if m.roughness >= 1.0 || material_is(m, OBJECT_WEIGHTS) {
        return coat;
    }
    let f0 = iridescence_over(m, m.metallic, mix(material_f0(m), m.base, m.metallic), cosine, 0.0);
    let f90 = iridescence_over(m, m.metallic, material_f90(m), cosine, 0.0);
    let under = material_under(m, cosine);
    return coat + under * anisotropy_lobe(m, f0, f90, normal, view, light);
}

// Microfacet lobe for one light (Blinn-Phong distribution, Neumann's visibility term), with its reflectance at normal
// and at grazing incidence.
fn material_microfacets(f0: vec3f, f90: vec3f, rough: f32, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    // Zero if the light comes from the opposite of the view direction.
    let sum = view + light;
    let half_way = sum * inverseSqrt(max(dot(sum, sum), 1.0e-12));
    // A point light's image in a perfect mirror would have no width; it is shown with at least roughness 0.2.
    let roughness = max(rough, 0.2);
    let alpha2 = roughness * roughness * roughness * roughness;
    let exponent = max(2.0 / alpha2 - 2.0, 0.0);
    let distribution = (exponent + 2.0) / (2.0 * PI) * pow(max(dot(normal, half_way), 1.0e-6), exponent);
    let grazing = material_grazing(clamp(dot(view, half_way), 0.0, 1.0));
    let fresnel = f0 + (f90 - f0) * grazing;
    let widest = max(max(dot(normal, light), dot(normal, view)), 0.05);
    return fresnel * ((1.0 - rough) * distribution / (4.0 * widest));
}
