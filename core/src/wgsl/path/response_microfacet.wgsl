// Light from sampled directions by the diffuse lobe and the microfacet lobes; light that is mirrored by smooth surfaces
// or refracted is found by the paths.

struct Response {
    // The lobes times the cosine.
    value: vec3f,
    // Density with which a path continues in the direction, per unit of solid angle.
    density: f32,
}

// Whether light is looked for.
fn response_exists(lobes: Lobes) -> bool {
    let rough = lobes.glossy.chance + lobes.coat.chance + lobes.sheen_chance;
    return lobes.chances.x + rough + behind_chance(lobes.behind) > 0.0;
}

fn response_reaches(s: Surface, direction: vec3f) -> bool {
    return dot(s.normal, direction) > 0.0 && dot(s.face, direction) > 0.0 || behind_reaches(s, direction);
}

fn response_to(s: Surface, lobes: Lobes, direction: vec3f) -> Response {
    let cosine = max(dot(s.normal, direction), 0.0);
    let glossy = microfacets_response(lobes.glossy, direction);
    let coat = microfacets_response(lobes.coat, direction);
    var value = lobes.diffuse * (cosine / PI) + glossy.rgb + coat.rgb;
    var density = lobes.chances.x * (cosine / PI) + lobes.glossy.chance * glossy.a + lobes.coat.chance * coat.a;
    if lobes.sheen_chance > 0.0 {
        value += lobes.sheen_scale * cosine * material_sheen_lobe(lobes.material, s.normal, lobes.view, direction);
        density += lobes.sheen_chance * (cosine / PI);
    }
    let behind = behind_response(lobes.behind, s, direction);
    value += behind.rgb;
    density += behind.a;
    return Response(value, density / lobes.sum);
}

// Radiance towards the viewer, from the light of all directions times the response.
fn response_radiance(lobes: Lobes, light: vec3f) -> vec3f {
    return light;
}

// Albedo of the lobes whose light the denoiser filters.
fn response_albedo(lobes: Lobes) -> vec3f {
    return lobes.albedo;
}

// Continues by the lobe that `number`, up to the sum of chances, selects; the weight is 0 where that leads nowhere.
fn response_sample(
    s: Surface, m: Material, lobes: Lobes, ray: Ray, direction: vec3f, number: f32, random: vec2f
) -> BsdfSample {
    let mirrored = lobes.chances.x + lobes.chances.y;
    let specular = mirrored + lobes.chances.z;
    if number >= lobes.chances.x && number < specular {
        if number >= mirrored && lobes.glossy.chance > 0.0 {
            return response_refraction(s, m, lobes, random);
        }
        return lobes_specular(s, m, lobes, ray, direction, number);
    }
    var drawn: vec3f;
    var cone = vec2f(0.0);
    var kind = RAY_DIFFUSE;
    if number < lobes.chances.x {
        drawn = directions_cosine(s.normal, random);
    } else {
        cone = cone_bent(s, 1.0, 2.0);
        kind = RAY_REFLECTION;
        if behind_chance(lobes.behind) > 0.0 && number >= lobes.sum - behind_chance(lobes.behind) {
            drawn = directions_cosine(-s.normal, random);
            cone = vec2f(0.0);
            kind = RAY_REFRACTION;
        } else if number < specular + lobes.glossy.chance {
            drawn = microfacets_draw(lobes.glossy, random);
        } else if lobes.sheen_chance == 0.0 || number < specular + lobes.glossy.chance + lobes.coat.chance {
            drawn = microfacets_draw(lobes.coat, random);
        } else {
            drawn = directions_cosine(s.normal, random);
            cone = vec2f(0.0);
            kind = RAY_DIFFUSE;
        }
    }
    let response = response_to(s, lobes, drawn);
    var weight = vec3f(0.0);
    if response_reaches(s, drawn) && response.density > 0.0 {
        weight = response.value / response.density;
    }
    return BsdfSample(surface_spawn(s, drawn, FAR, cone), weight, kind, response.density);
}

// Refraction by a microfacet (Walter et al. 2007). A thin pane turns what its microfacets reflect to its other side.
fn response_refraction(s: Surface, m: Material, lobes: Lobes, random: vec2f) -> BsdfSample {
    let lobe = lobes.glossy;
    let thin = material_is(m, OBJECT_THIN);
    let h = microfacets_normal(lobe, random);
    let cosine = dot(lobe.view, h);
    let ratio = material_ratio(m, s.inside);
    let transmitted = fresnel_transmitted(cosine, ratio);
    var beyond = fresnel_refracted(-lobe.view, h, cosine, ratio, transmitted);
    if thin {
        beyond = reflect(-lobe.view, h) * vec3f(1.0, 1.0, -1.0);
    }
    let drawn = normalize(lobe.frame * beyond);
    var weight = vec3f(0.0);
    if beyond.z < 0.0 && dot(s.face, drawn) < 0.0 && (thin || transmitted > 0.0) {
        let passed = (1.0 - microfacets_fresnel(lobe, cosine)) * microfacets_unshadowed(lobe, beyond);
        weight = lobes.refraction * passed * (lobes.sum / lobes.chances.z);
    }
    return BsdfSample(surface_spawn(s, drawn, FAR, s.cone), weight, RAY_REFRACTION, 0.0);
}
