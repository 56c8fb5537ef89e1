// The lobes that a path may continue by, with microfacets; each is chosen with a probability proportional to its
// largest channel.

struct Lobes {
    diffuse: vec3f,
    mirror: vec3f,
    refraction: vec3f,
    // Largest channel of these three.
    chances: vec3f,
    // Sum of the largest channels of all lobes.
    sum: f32,
    // Cosine of the angle to the normal on the viewer's side and, for smooth refraction, on the other.
    cosine: f32,
    beyond: f32,
    // Reflection by the rough surface, and by a rough coat over it.
    glossy: Microfacets,
    coat: Microfacets,
    behind: Behind,
    // Largest channel of the sheen's albedo, what a coat lets through to it, and what it needs to be evaluated.
    sheen_chance: f32,
    sheen_scale: vec3f,
    view: vec3f,
    material: Material,
    albedo: vec3f,
}

// The lobes at a surface; `direction` is the unit direction of the incident ray.
fn lobes_at(s: Surface, m: Material, direction: vec3f) -> Lobes {
    var lobes: Lobes;
    lobes.cosine = clamp(-dot(s.normal, direction), 0.0, 1.0);
    if material_is(m, OBJECT_WEIGHTS) {
        lobes.diffuse = material_diffuse(m, lobes.cosine, s.inside);
        lobes.mirror = material_mirror(m, lobes.cosine, s.inside);
        lobes.refraction = material_refraction(m, lobes.cosine, s.inside);
    } else {
        lobes_add_layers(&lobes, s, m, -direction);
    }
    lobes.albedo += lobes.diffuse + behind_albedo(lobes.behind);
    if lobes.glossy.chance == 0.0 {
        lobes.beyond = fresnel_transmitted(lobes.cosine, material_ratio(m, s.inside));
        if lobes.beyond <= 0.0 && !material_is(m, OBJECT_THIN) {
            lobes.refraction = vec3f(0.0);
        }
    }
    lobes.chances = vec3f(max_component(lobes.diffuse), max_component(lobes.mirror), max_component(lobes.refraction));
    if lobes.glossy.chance > 0.0 {
        // By how much is refracted, but never 0, as some microfacets may refract where the surface does not.
        lobes.chances.z *= max(0.25, 1.0 - max_component(microfacets_fresnel(lobes.glossy, lobes.cosine)));
    }
    lobes.sum = lobes.chances.x + lobes.chances.y + lobes.chances.z + lobes.glossy.chance + lobes.coat.chance
        + lobes.sheen_chance + behind_chance(lobes.behind);
    return lobes;
}

// A coat over the surface, whose dielectric part covers the diffuse lobe and refraction.
fn lobes_add_layers(lobes: ptr<function, Lobes>, s: Surface, m: Material, view: vec3f) {
    let cosine = (*lobes).cosine;
    let frame = lobes_frame(m, s.normal);
    var under = vec3f(material_coat_passes(m, cosine));
    let coat = material_coat(m);
    if coat.x > 0.0 && coat.y >= LEAST_ROUGHNESS {
        var albedo: vec3f;
        (*lobes).coat = microfacets_of(coat_frame(m, frame), vec2f(coat.y * coat.y), view, vec3f(0.04 * coat.x), vec3f(coat.x), 0.0, &albedo);
        (*lobes).albedo += albedo;
        under = 1.0 - albedo;
    } else {
        (*lobes).mirror = 1.0 - under;
    }
    if material_has_sheen(m) {
        let sheen = under * material_sheen_albedo(m, cosine);
        (*lobes).sheen_chance = max_component(sheen);
        (*lobes).sheen_scale = under;
        (*lobes).view = view;
        (*lobes).material = m;
        (*lobes).albedo += sheen;
        under *= material_sheen_passes(m, cosine);
    }
    let diffuse = translucency_reflected(m) * m.base * ((1.0 - m.metallic) * (1.0 - m.transmission));
    let refraction = m.base * ((1.0 - m.metallic) * m.transmission);
    if lobes_smooth(m) {
        let fresnel = material_fresnel(m, cosine, s.inside);
        (*lobes).mirror += under * fresnel;
        let passed = 1.0 - material_dielectric(m, cosine, s.inside);
        (*lobes).diffuse = under * diffuse * passed;
        (*lobes).behind = behind_of(m, under * passed);
        (*lobes).refraction = under * refraction * passed;
        return;
    }
    if m.roughness >= 1.0 && m.metallic == 0.0 && m.transmission == 0.0 {
        (*lobes).diffuse = under * diffuse;
        (*lobes).behind = behind_of(m, under);
        return;
    }
    let thin = material_is(m, OBJECT_THIN);
    let ratio = select(0.0, material_ratio(m, s.inside && !thin), m.transmission > 0.0);
    var covered: vec3f;
    lobes_reflection(m, 0.0, frame, view, ratio, &covered);
    var albedo: vec3f;
    (*lobes).glossy = lobes_reflection(m, m.metallic, frame, view, ratio, &albedo);
    (*lobes).glossy.scale *= under;
    (*lobes).glossy.chance *= max_component(under);
    (*lobes).albedo += under * albedo;
    (*lobes).diffuse = under * diffuse * (1.0 - covered);
    (*lobes).behind = behind_of(m, under * (1.0 - covered));
    (*lobes).refraction = under * refraction;
}

// Reflection by a rough surface without its coat, as if it had this metalness.
fn lobes_reflection(
    m: Material, metallic: f32, frame: mat3x3f, view: vec3f, ratio: f32, albedo: ptr<function, vec3f>
) -> Microfacets {
    // The bound changes no value: it keeps compilers from rearranging the sums below by how the value was found.
    var f0 = min(material_f0(m), vec3f(1.0));
    f0 += metallic * (m.base - f0);
    var f90 = vec3f(material_strength(m));
    f90 += metallic * (1.0 - f90);
    let cosine = clamp(dot(frame[2], view), 0.0, 1.0);
    f0 = iridescence_over(m, metallic, f0, cosine, ratio);
    f90 = iridescence_over(m, metallic, f90, cosine, ratio);
    if material_is(m, OBJECT_THIN) {
        // Both faces of the pane.
        f0 = 2.0 * f0 / (1.0 + f0);
        f90 = 2.0 * f90 / (1.0 + f90);
    }
    return microfacets_of(frame, lobes_alpha(m), view, f0, f90, ratio, albedo);
}
