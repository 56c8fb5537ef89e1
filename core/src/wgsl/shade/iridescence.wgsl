// Thin films (KHR_materials_iridescence): interference in a layer over the surface by the model of Belcour & Barla 2017, "A
// Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", in the form of the extension's appendix.

struct Iridescence {
    // Share of the surface that the film covers, its index of refraction and its thickness in nanometres.
    strength: f32,
    ior: f32,
    thickness: f32,
}

fn iridescence_at(record: u32, at: Lookup, maps: Maps) -> Iridescence {
    let factors = bitcast<vec4f>(object_part(0u, record + RECORD_IRIDESCENCE));
    let cover = material_lookup(record, SLOT_IRIDESCENCE, at, maps);
    let depth = material_lookup(record, SLOT_IRIDESCENCETHICKNESS, at, maps);
    return Iridescence(
        factors.x * texture_data(cover.place, cover.texcoord, cover.footprint).r,
        factors.y,
        mix(factors.z, factors.w, texture_data(depth.place, depth.texcoord, depth.footprint).g),
    );
}

// A reflectance of the surface, as if it had this metalness, under its film; `ratio` is the viewer's index over that of the
// other side where light comes from the denser side, else at most 1.
fn iridescence_over(m: Material, metallic: f32, reflectance: vec3f, cosine: f32, ratio: f32) -> vec3f {
    let strength = m.iridescence.strength;
    var outside = cosine;
    if ratio > 1.0 {
        outside = fresnel_transmitted(cosine, ratio);
    }
    if strength == 0.0 || outside <= 0.0 {
        return reflectance;
    }
    var film = vec3f(0.0);
    if metallic < 1.0 {
        film = (1.0 - metallic) * iridescence_film(m.iridescence, material_f0(m), outside);
    }
    if metallic > 0.0 {
        film += metallic * iridescence_film(m.iridescence, m.base, outside);
    }
    return mix(reflectance, film, strength);
}

// Reflectance of a film over a base of this reflectance at normal incidence.
fn iridescence_film(film: Iridescence, f0: vec3f, cosine: f32) -> vec3f {
    // A vanishing film has the index of the air above it.
    let ior = mix(1.0, film.ior, smoothstep(0.0, 0.03, film.thickness));
    let inner2 = 1.0 - (1.0 - cosine * cosine) / (ior * ior);
    if inner2 <= 0.0 {
        return vec3f(1.0);
    }
    let inner = sqrt(inner2);
    let at_top = (ior - 1.0) / (ior + 1.0);
    let top = at_top * at_top + (1.0 - at_top * at_top) * material_grazing(cosine);
    let root = sqrt(clamp(f0, vec3f(0.0), vec3f(0.9999)));
    let base_ior = (1.0 + root) / (1.0 - root);
    let at_base = (base_ior - ior) / (base_ior + ior);
    let base = at_base * at_base + (1.0 - at_base * at_base) * material_grazing(inner);
    // Half a wave is lost where light is reflected by the denser medium.
    let turned = select(PI, 0.0, ior < 1.0) + select(vec3f(0.0), vec3f(PI), base_ior < vec3f(ior));
    let path = 2.0 * ior * film.thickness * inner;
    let both = min(top * base, vec3f(0.9999));
    let passed = (1.0 - top) * (1.0 - top) * base / (1.0 - both);
    let order = sqrt(both);
    let first = order * (passed - (1.0 - top));
    let sum = top + passed + 2.0 * first * iridescence_sensitivity(path, turned)
        + 2.0 * order * first * iridescence_sensitivity(2.0 * path, 2.0 * turned);
    return clamp(sum, vec3f(0.0), vec3f(1.0));
}

// The Fourier transform of the eye's sensitivity, in linear RGB, at an optical path difference in nanometres: Gaussians for
// X (two), Y and Z of the CIE's observer.
fn iridescence_sensitivity(path: f32, shift: vec3f) -> vec3f {
    let phase = 2.0e-9 * PI * path;
    let widths = vec3f(4.3278e9, 9.3046e9, 6.6121e9);
    let heights = vec3f(5.4856e-13, 4.4201e-13, 5.2481e-13) * sqrt(2.0 * PI * widths);
    var xyz = heights * cos(vec3f(1.6810e6, 1.7953e6, 2.2084e6) * phase + shift) * exp(-phase * phase * widths);
    xyz.x += 9.7470e-14 * sqrt(2.0 * PI * 4.5282e9) * cos(2.2399e6 * phase + shift.x) * exp(-4.5282e9 * phase * phase);
    let rgb_from_xyz = mat3x3f(
        vec3f(3.2404542, -0.9692660, 0.0556434), vec3f(-1.5371385, 1.8760108, -0.2040259), vec3f(-0.4985314, 0.0415560, 1.0572252)
    );
    return rgb_from_xyz * (xyz / 1.0685e-7);
}
