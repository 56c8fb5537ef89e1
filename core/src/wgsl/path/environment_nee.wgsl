// Light of an environment map by next-event estimation and, with multiple importance sampling, also by paths that leave
// the scene.

// Cumulative probability up to and including each texel of a square octahedral map, and its own probability.
var environment_shares: texture_2d<f32>;

// Dimension of the choice of a texel; the next one is that of the place in it.
const PATH_ENVIRONMENT: u32 = 512u;

// Density of the directions that are drawn in a texel, per unit of solid angle; `d` is of unit length.
fn environment_density(probability: f32, d: vec3f) -> f32 {
    let side = f32(textureDimensions(environment_shares).x);
    let norm = abs(d.x) + abs(d.y) + abs(d.z);
    return probability * 0.25 * side * side / (norm * norm * norm);
}

// Weight of the radiance that a path finds along a direction sampled with `density` (0: not sampled from a
// lobe) and that leaves the scene; next-event estimation contributes the rest.
fn environment_weight(density: f32, direction: vec3f) -> f32 {
    if density == 0.0 {
        return 1.0;
    }
    if !WEIGHS_EMITTERS {
        return 0.0;
    }
    let d = environment_turned(normalize(direction));
    let side = textureDimensions(environment_shares).x;
    let at = min(vec2u(environment_place(d) * f32(side)), vec2u(side - 1u));
    return density / (density + environment_density(textureLoad(environment_shares, at, 0).y, d));
}

// Estimate of the light of the map times the response to it, without the part that is left to paths that leave the scene.
fn environment_light(s: Surface, lobes: Lobes, pixel: vec2u, dimension: u32) -> vec3f {
    let number = rng_pair(pixel, dimension + PATH_ENVIRONMENT).x;
    let side = textureDimensions(environment_shares).x;
    // The first texel whose cumulative probability exceeds the number.
    var low = 0u;
    var high = side * side - 1u;
    while low < high {
        let middle = (low + high) / 2u;
        if textureLoad(environment_shares, vec2u(middle % side, middle / side), 0).x <= number {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    let texel = vec2u(low % side, low / side);
    let place = (vec2f(texel) + rng_pair(pixel, dimension + PATH_ENVIRONMENT + 1u)) / f32(side);
    let p = 2.0 * place - 1.0;
    let y = 1.0 - abs(p.x) - abs(p.y);
    let fold = vec2f(max(-y, 0.0));
    let across = p - select(-fold, fold, p >= vec2f(0.0));
    let d = normalize(vec3f(across.x, y, across.y));
    let r = environment.rotation;
    let direction = vec3f(r.x * d.x + r.y * d.z, d.y, r.x * d.z - r.y * d.x);
    if !response_reaches(s, direction) {
        return vec3f(0.0);
    }
    inspect_ray(RAY_SHADOW);
    if layers_arrive(surface_spawn(s, direction, FAR, vec2f(0.0)), MISS).primitive != MISS {
        return vec3f(0.0);
    }
    let drawn = environment_density(textureLoad(environment_shares, texel, 0).y, d);
    let response = response_to(s, lobes, direction);
    let met = select(0.0, response.density, WEIGHS_EMITTERS);
    return layers_through() * environment_radiance(direction) * (response.value / (drawn + met));
}
