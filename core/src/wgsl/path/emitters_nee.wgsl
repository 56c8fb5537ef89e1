// Light from emissive surfaces by next-event estimation and, with multiple importance sampling, also by paths
// that hit them.

// Each emissive primitive, and the bits of the cumulative probability up to and including it.
var<storage, read> emitters: array<vec2u>;

// Shadow rays end this factor beyond the point on the emitter, so that rounding does not decide the hit.
const EMITTERS_REACH: f32 = 1.001;

// Density of next-event estimation per unit of solid angle, for a point on an emitter seen at this cosine and
// distance.
fn emitters_density(object: u32, cosine: f32, distance: f32) -> f32 {
    let emission = object_at(object).emission;
    return (emission.x + emission.y + emission.z) * frame.paths.emitter_scale * distance * distance / abs(cosine);
}

// Weight of emission that a path hits along a direction sampled with `density` (0: not sampled from the BSDF);
// next-event estimation contributes the rest.
fn emitters_weight(density: f32, s: Surface, direction: vec3f) -> f32 {
    if density == 0.0 {
        return 1.0;
    }
    if !WEIGHS_EMITTERS {
        return 0.0;
    }
    return density / (density + f32(LIGHT_SAMPLES) * emitters_density(s.object, dot(s.face, direction), s.t));
}

// The primitive that a uniform number selects: the first whose cumulative probability exceeds it.
fn emitters_select(number: f32) -> u32 {
    var low = 0u;
    var high = frame.paths.emitters - 1u;
    while low < high {
        let middle = (low + high) / 2u;
        if bitcast<f32>(emitters[middle].y) <= number {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    return emitters[low].x;
}

struct EmitterPoint {
    position: vec3f,
    normal: vec3f,
}

// A point on a primitive, uniform over its area.
fn emitters_point(primitive: u32, place: vec2f) -> EmitterPoint {
    let corners = bvh_corners(primitive);
    if sphere_is(primitive) {
        let z = 1.0 - 2.0 * place.x;
        let r = sqrt(max(0.0, 1.0 - z * z));
        let angle = 2.0 * PI * place.y;
        let normal = vec3f(r * cos(angle), r * sin(angle), z);
        return EmitterPoint(corners[0] + corners[1].x * normal, normal);
    }
    let r = sqrt(place.x);
    let ab = corners[1] - corners[0];
    let ac = corners[2] - corners[0];
    let position = corners[0] + (r * (1.0 - place.y)) * ab + (r * place.y) * ac;
    return EmitterPoint(position, surface_unit(surface_cross(ab, corners[2] - corners[1], -ac), vec3f(0.0)));
}

// Estimate of the light from emitters times the response to it, without the part that is left to paths that hit them.
fn emitters_light(s: Surface, lobes: Lobes, pixel: vec2u, dimension: u32) -> vec3f {
    var sum = vec3f(0.0);
    for (var i = 0u; i < LIGHT_SAMPLES; i += 1u) {
        let at = dimension + PATH_LIGHT_SAMPLE * i;
        let which = (f32(i) + rng_pair(pixel, at + PATH_EMITTER).x) / f32(LIGHT_SAMPLES);
        sum += emitters_sample(s, lobes, which, rng_pair(pixel, at + PATH_POINT));
    }
    return sum;
}

fn emitters_sample(s: Surface, lobes: Lobes, which: f32, place: vec2f) -> vec3f {
    let primitive = emitters_select(which);
    let point = emitters_point(primitive, place);
    let way = point.position - s.position;
    let distance = length(way);
    let direction = way / distance;
    let seen = dot(point.normal, direction);
    if !(response_reaches(s, direction) && seen != 0.0) {
        return vec3f(0.0);
    }
    inspect_ray(RAY_SHADOW);
    let ray = surface_spawn(s, direction, EMITTERS_REACH * distance, vec2f(0.0));
    let hit = layers_arrive(ray, primitive);
    if hit.primitive != primitive {
        return vec3f(0.0);
    }
    let object = shading_at(primitive).w & SURFACE_OBJECT;
    var emission = frame.exposure * object_at(object).emission;
    if HAS_EMISSIVE_TEXTURES || sphere_is(primitive) {
        let arrived = surface_at(ray, hit);
        // From outside, a ray hits the near side of a sphere, which hides points on the far side.
        if sphere_is(primitive) && arrived.inside != (seen > 0.0) {
            return vec3f(0.0);
        }
        if HAS_EMISSIVE_TEXTURES {
            emission = lobes_emission(material_at(object, arrived.texcoord, arrived.footprint, arrived.color, arrived.maps));
        }
    }
    let drawn = f32(LIGHT_SAMPLES) * emitters_density(object, seen, distance);
    let response = response_to(s, lobes, direction);
    let met = select(0.0, response.density, WEIGHS_EMITTERS);
    return layers_through() * emission * (response.value / (drawn + met));
}
