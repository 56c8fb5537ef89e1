// An environment map: radiance by direction in octahedral projection, centred on +Y (Cigolle et al. 2014).

struct EnvironmentUniform {
    // Cosine and sine of the map's rotation about +Y.
    rotation: vec2f,
    padding: vec2f,
}

var<uniform> environment: EnvironmentUniform;
var environment_map: texture_2d<f32>;
// Levels filtered for rough reflection, from the narrowest lobe to the widest.
var environment_levels: texture_2d<f32>;
// Irradiance over pi by normal.
var environment_diffuse: texture_2d<f32>;

// A direction of the world in the map's own frame.
fn environment_turned(d: vec3f) -> vec3f {
    let r = environment.rotation;
    return vec3f(r.x * d.x - r.y * d.z, d.y, r.y * d.x + r.x * d.z);
}

// A texel at most one outside of the square, which is folded along its border.
fn environment_texel(map: texture_2d<f32>, at: vec2i, side: i32, level: i32) -> vec3f {
    let across = at.x < 0 || at.x >= side;
    let p = select(at, vec2i(clamp(at.x, 0, side - 1), side - 1 - at.y), across);
    let along = p.y < 0 || p.y >= side;
    let q = select(p, vec2i(side - 1 - p.x, clamp(p.y, 0, side - 1)), along);
    return textureLoad(map, q, level).rgb;
}

// Place in [0, 1]^2 of a direction in the map's frame, of any length.
fn environment_place(d: vec3f) -> vec2f {
    let p = d / (abs(d.x) + abs(d.y) + abs(d.z));
    let outer = 1.0 - abs(p.zx);
    let folded = select(-outer, outer, p.xz >= vec2f(0.0));
    return 0.5 * select(p.xz, folded, p.y < 0.0) + 0.5;
}

// Bilinear interpolation at a direction in the map's frame, of any length.
fn environment_bilinear(map: texture_2d<f32>, level: i32, side: i32, d: vec3f) -> vec3f {
    let place = environment_place(d);
    let at = place * f32(side) - 0.5;
    let low = vec2i(floor(at));
    let weight = at - floor(at);
    let top = mix(
        environment_texel(map, low, side, level), environment_texel(map, low + vec2i(1, 0), side, level), weight.x
    );
    let bottom = mix(
        environment_texel(map, low + vec2i(0, 1), side, level), environment_texel(map, low + vec2i(1, 1), side, level), weight.x
    );
    return frame.exposure * mix(top, bottom, weight.y);
}

// Radiance that arrives from a direction in the map's frame.
fn environment_whole(d: vec3f) -> vec3f {
    return environment_bilinear(environment_map, 0, i32(textureDimensions(environment_map).x), d);
}

// The same, averaged over the lobe of a filtered level. The level's width is not asked for: lavapipe answers all threads
// of a vector with that of the first one's level.
fn environment_level(level: f32, d: vec3f) -> vec3f {
    return environment_bilinear(environment_levels, i32(level), i32(ENVIRONMENT_FILTERED >> u32(level)), d);
}

// Radiance that arrives from a direction of the world.
fn environment_radiance(direction: vec3f) -> vec3f {
    return environment_whole(environment_turned(direction));
}

// Radiance averaged over the lobe of a roughness around a direction. Lobes narrower than the first filtered level are
// blended with the map.
fn environment_lobe(direction: vec3f, roughness: f32) -> vec3f {
    let d = environment_turned(direction);
    let last = f32(textureNumLevels(environment_levels)) - 1.0;
    let level = clamp(log2(max(ENVIRONMENT_LOBE * roughness * roughness, 0.25)), -1.0, last);
    if level <= -1.0 {
        return environment_whole(d);
    }
    let low = floor(level);
    let wider = environment_level(min(low + 1.0, last), d);
    if level < 0.0 {
        return mix(environment_whole(d), wider, level - low);
    }
    return mix(environment_level(low, d), wider, level - low);
}

// Radiance along a ray that meets nothing; its kind tells the roughness of the surface that it left.
fn environment_missed(kind: u32, direction: vec3f) -> vec3f {
    return environment_lobe(direction, f32(kind >> 8u) / 255.0);
}

// Radiance in the place of a ray that a limit cuts off: it is taken to meet nothing.
fn environment_cut_off(kind: u32, direction: vec3f) -> vec3f {
    return environment_missed(kind, direction);
}

// Irradiance over pi of a surface with a unit normal.
fn environment_ambient(normal: vec3f) -> vec3f {
    let side = i32(textureDimensions(environment_diffuse).x);
    return environment_bilinear(environment_diffuse, 0, side, environment_turned(normal));
}
