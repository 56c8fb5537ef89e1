// Dispersion (KHR_materials_dispersion): a path refracts all its light by the index of one channel, drawn once for the path,
// and from its first dispersive refraction on carries that channel alone.

// Dimension of the choice of the channel, beyond those of all vertices.
const DISPERSION_DIMENSION: u32 = 0x20000000u;

// Whether the path carries one channel alone.
var<private> dispersion_split: bool;

fn dispersion_of(s: Surface, m: Material) -> f32 {
    let record = material_record(s.object);
    if record == 0u || !material_is(m, OBJECT_SOLID) {
        return 0.0;
    }
    return bitcast<f32>(object_part(0u, record + RECORD_DISPERSION).x);
}

fn dispersion_channel(pixel: vec2u) -> u32 {
    return min(u32(3.0 * rng_pair(pixel, DISPERSION_DIMENSION).x), 2u);
}

// The material with the path's index of refraction: the index in red, green and blue grows in equal steps.
fn dispersion_material(path: ptr<function, Path>, m: Material, s: Surface) -> Material {
    if (*path).level == 1u {
        dispersion_split = false;
    }
    let dispersion = dispersion_of(s, m);
    if dispersion == 0.0 {
        return m;
    }
    var of_channel = m;
    let step = f32(dispersion_channel((*path).pixel)) - 1.0;
    of_channel.ior = max(m.ior + step * DISPERSION_STEP * dispersion * (m.ior - 1.0), 1.0);
    return of_channel;
}

// Leaves the path one channel where it is refracted.
fn dispersion_refract(path: ptr<function, Path>, s: Surface, m: Material, bsdf_sample: BsdfSample) {
    if dispersion_split || bsdf_sample.kind != RAY_REFRACTION || bsdf_sample.density > 0.0 || dispersion_of(s, m) == 0.0 {
        return;
    }
    dispersion_split = true;
    let channel = dispersion_channel((*path).pixel);
    (*path).throughput *= select(vec3f(0.0), vec3f(3.0), vec3u(0u, 1u, 2u) == vec3u(channel));
}
