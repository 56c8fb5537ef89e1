// Lobes of surfaces that are not all matte.

fn lobes_unlit(m: Material) -> bool {
    return material_is(m, OBJECT_UNLIT);
}

fn lobes_emission(m: Material) -> vec3f {
    return m.emission;
}

// Samples reflection or refraction, for a number between the diffuse lobe's chance and the sum of the first three.
fn lobes_specular(s: Surface, m: Material, lobes: Lobes, ray: Ray, direction: vec3f, number: f32) -> BsdfSample {
    if !HAS_REFRACTION || lobes.chances.z == 0.0 || number < lobes.chances.x + lobes.chances.y {
        let mirrored = coat_mirror(s, m, lobes, number);
        let reflected = surface_spawn(s, normalize(reflect(direction, mirrored.normal)), FAR, cone_bent(s, 1.0, 2.0));
        return BsdfSample(reflected, mirrored.weight, RAY_REFLECTION, 0.0);
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
