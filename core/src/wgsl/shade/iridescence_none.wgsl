// For scenes without thin films.

// A reflectance of the surface under its film.
fn iridescence_over(m: Material, metallic: f32, reflectance: vec3f, cosine: f32, ratio: f32) -> vec3f {
    return reflectance;
}
