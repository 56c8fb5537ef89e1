// For scenes in which all colours are refracted alike.

fn dispersion_material(path: ptr<function, Path>, m: Material, s: Surface) -> Material {
    return m;
}

fn dispersion_refract(path: ptr<function, Path>, s: Surface, m: Material, bsdf_sample: BsdfSample) {}
