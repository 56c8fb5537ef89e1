// The lobes that a path may continue by; each is chosen with a probability proportional to its largest channel.

struct Lobes {
    diffuse: vec3f,
    mirror: vec3f,
    refraction: vec3f,
    // Largest channel of each lobe.
    chances: vec3f,
    // Sum of the largest channels.
    sum: f32,
    // Cosine of the angle to the normal on the viewer's side and, for refraction, on the other.
    cosine: f32,
    beyond: f32,
}

// The sampled lobe.
struct BsdfSample {
    ray: Ray,
    // The lobe's weight divided by the probability of choosing it; 0 if the path ends.
    weight: vec3f,
    kind: u32,
    // Density of the direction per unit of solid angle; 0 for mirrored and refracted rays.
    density: f32,
}

fn lobes_unlit(m: Material) -> bool {
    return material_is(m, OBJECT_UNLIT);
}

fn lobes_emission(m: Material) -> vec3f {
    return m.emission;
}

// The lobes at a surface; `direction` is the unit direction of the incident ray.
fn lobes_at(s: Surface, m: Material, direction: vec3f) -> Lobes {
    var lobes: Lobes;
    lobes.cosine = clamp(-dot(s.normal, direction), 0.0, 1.0);
    lobes.diffuse = material_albedo(m, lobes.cosine, s.inside);
    if HAS_REFLECTION {
        lobes.mirror = material_mirror(m, lobes.cosine, s.inside);
    }
    if HAS_REFRACTION {
        lobes.refraction = material_refraction(m, lobes.cosine, s.inside);
        lobes.beyond = fresnel_transmitted(lobes.cosine, material_ratio(m, s.inside));
        if lobes.beyond <= 0.0 && !material_is(m, OBJECT_THIN) {
            lobes.refraction = vec3f(0.0);
        }
    }
    lobes.chances = vec3f(max_component(lobes.diffuse), max_component(lobes.mirror), max_component(lobes.refraction));
    lobes.sum = lobes.chances.x + lobes.chances.y + lobes.chances.z;
    return lobes;
}

// Samples reflection or refraction, for a number between the diffuse lobe's chance and the sum.
fn lobes_specular(s: Surface, m: Material, lobes: Lobes, ray: Ray, direction: vec3f, number: f32) -> BsdfSample {
    if !HAS_REFRACTION || lobes.chances.z == 0.0 || number < lobes.chances.x + lobes.chances.y {
        let reflected = surface_spawn(s, normalize(reflect(direction, s.normal)), FAR, cone_bent(s, 1.0, 2.0));
        return BsdfSample(reflected, lobes.mirror * (lobes.sum / lobes.chances.y), RAY_REFLECTION, 0.0);
    }
    let weight = lobes.refraction * (lobes.sum / lobes.chances.z);
    if material_is(m, OBJECT_THIN) {
        return BsdfSample(surface_pass(s, ray), weight, RAY_REFRACTION, 0.0);
    }
    let ratio = material_ratio(m, s.inside);
    let refracted = fresnel_refracted(direction, s.normal, lobes.cosine, ratio, lobes.beyond);
    let cone = cone_bent(s, ratio, ratio * lobes.cosine - lobes.beyond);
    return BsdfSample(surface_spawn(s, refracted, FAR, cone), weight, RAY_REFRACTION, 0.0);
}
