// For scenes of diffuse, non-emissive materials: paths use the diffuse lobe only.

struct Lobes {
    diffuse: vec3f,
    chances: vec3f,
    sum: f32,
}

fn lobes_unlit(m: Material) -> bool {
    return false;
}

fn lobes_emission(m: Material) -> vec3f {
    return vec3f(0.0);
}

fn lobes_at(s: Surface, m: Material, direction: vec3f) -> Lobes {
    let largest = max_component(m.base);
    return Lobes(m.base, vec3f(largest, 0.0, 0.0), largest);
}

fn lobes_specular(s: Surface, m: Material, lobes: Lobes, ray: Ray, direction: vec3f, number: f32) -> BsdfSample {
    return BsdfSample(ray, vec3f(0.0), RAY_REFLECTION, 0.0);
}
