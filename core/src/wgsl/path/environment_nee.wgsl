// Light of an environment map by next-event estimation and, with multiple importance sampling, also by paths that leave
// the scene.

// Probabilities of the texels of a square octahedral map and, by level, of their squares of 2x2, 4x4, ... texels.
var environment_powers: texture_2d<f32>;

// Dimension of the choice of a direction.
const PATH_ENVIRONMENT: u32 = 512u;

// The largest number below 1.
const BELOW_ONE: f32 = 0.99999994;

// Density of the directions that are drawn in a texel, per unit of solid angle; `d` is of unit length.
fn environment_density(probability: f32, d: vec3f) -> f32 {
    let side = f32(textureDimensions(environment_powers).x);
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
    let side = textureDimensions(environment_powers).x;
    let at = min(vec2u(environment_place(d) * f32(side)), vec2u(side - 1u));
    return density / (density + environment_density(textureLoad(environment_powers, at, 0).x, d));
}

// Whether a uniform number selects the second of two probabilities (y), and its uniform remainder (x).
fn environment_split(number: f32, first: f32, second: f32) -> vec2f {
    let share = first / (first + second);
    if number >= share {
        return vec2f(min((number - share) / (1.0 - share), BELOW_ONE), 1.0);
    }
    return vec2f(min(number / share, BELOW_ONE), 0.0);
}

// Estimate of the light of the map times the response to it, without the part that is left to paths that leave the scene.
fn environment_light(s: Surface, lobes: Lobes, pixel: vec2u, dimension: u32) -> vec3f {
    var number = rng_pair(pixel, dimension + PATH_ENVIRONMENT);
    // From the 2x2 squares of the last level down to a texel (Clarberg et al. 2005).
    var texel = vec2u(0u);
    for (var level = i32(textureNumLevels(environment_powers)) - 1; level >= 0; level--) {
        texel *= 2u;
        let top = vec2f(
            textureLoad(environment_powers, texel, level).x,
            textureLoad(environment_powers, texel + vec2u(1u, 0u), level).x,
        );
        let bottom = vec2f(
            textureLoad(environment_powers, texel + vec2u(0u, 1u), level).x,
            textureLoad(environment_powers, texel + vec2u(1u, 1u), level).x,
        );
        let down = environment_split(number.y, top.x + top.y, bottom.x + bottom.y);
        let row = select(top, bottom, down.y == 1.0);
        let across = environment_split(number.x, row.x, row.y);
        number = vec2f(across.x, down.x);
        texel += vec2u(vec2f(across.y, down.y));
    }
    let side = textureDimensions(environment_powers).x;
    let place = (vec2f(texel) + number) / f32(side);
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
    let drawn = environment_density(textureLoad(environment_powers, texel, 0).x, d);
    let response = response_to(s, lobes, direction);
    let met = select(0.0, response.density, WEIGHS_EMITTERS);
    return layers_through() * environment_radiance(direction) * (response.value / (drawn + met));
}
