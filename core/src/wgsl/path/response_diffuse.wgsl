// Light from sampled directions by the diffuse lobe alone; mirrored and refracted light is found by the paths.

struct Response {
    // The cosine; the albedo over pi is a factor on the sum of all light.
    value: f32,
    // Density with which a path continues in the direction, per unit of solid angle.
    density: f32,
}

// Whether light is looked for.
fn response_exists(lobes: Lobes) -> bool {
    return lobes.chances.x > 0.0;
}

fn response_reaches(s: Surface, direction: vec3f) -> bool {
    return dot(s.normal, direction) > 0.0 && dot(s.face, direction) > 0.0;
}

fn response_to(s: Surface, lobes: Lobes, direction: vec3f) -> Response {
    let cosine = max(dot(s.normal, direction), 0.0);
    return Response(cosine, cosine / PI * (lobes.chances.x / lobes.sum));
}

// Radiance towards the viewer, from the light of all directions times the response.
fn response_radiance(lobes: Lobes, light: vec3f) -> vec3f {
    return lobes.diffuse * (1.0 / PI) * light;
}

// Albedo of the lobes whose light the denoiser filters.
fn response_albedo(lobes: Lobes) -> vec3f {
    return lobes.diffuse;
}

// Continues by the lobe that `number`, up to the sum of chances, selects; the weight is 0 where that leads nowhere.
fn response_sample(
    s: Surface, m: Material, lobes: Lobes, ray: Ray, direction: vec3f, number: f32, random: vec2f
) -> BsdfSample {
    if number >= lobes.chances.x {
        return lobes_specular(s, m, lobes, ray, direction, number);
    }
    let drawn = directions_cosine(s.normal, random);
    let density = max(dot(drawn, s.normal), 0.0) / PI * (lobes.chances.x / lobes.sum);
    let weight = lobes.diffuse * (lobes.sum / lobes.chances.x);
    let above = dot(s.face, drawn) > 0.0;
    return BsdfSample(surface_spawn(s, drawn, FAR, vec2f(0.0)), select(vec3f(0.0), weight, above), RAY_DIFFUSE, density);
}
