// Fresnel's equations at the boundary of two dielectrics; `ratio` is the viewer's index over that of the other
// side, `cosine` that of the angle of incidence on the viewer's side, in [0, 1].

// Cosine of the angle of refraction; 0 for total reflection and at the critical angle. As 1 - r^2 + (r c)^2,
// since 1 - r^2 (1 - c^2) would lose the cosine of a grazing ray.
fn fresnel_transmitted(cosine: f32, ratio: f32) -> f32 {
    let along = ratio * cosine;
    let square = (1.0 - ratio) * (1.0 + ratio) + along * along;
    // No boundary; the square of a small cosine may underflow.
    if ratio == 1.0 {
        return cosine;
    }
    return select(0.0, sqrt(square), square > 0.0);
}

// Reflectance for unpolarised light; `transmitted` is the cosine of the angle of refraction.
fn fresnel_reflectance(cosine: f32, ratio: f32, transmitted: f32) -> f32 {
    if transmitted <= 0.0 {
        return 1.0;
    }
    let s = (ratio * cosine - transmitted) / (ratio * cosine + transmitted);
    let p = (cosine - ratio * transmitted) / (cosine + ratio * transmitted);
    return min(0.5 * (s * s + p * p), 1.0);
}

// Unit direction of the refracted ray; `direction` points to the boundary, `normal` to the viewer.
fn fresnel_refracted(direction: vec3f, normal: vec3f, cosine: f32, ratio: f32, transmitted: f32) -> vec3f {
    return normalize(ratio * direction + (ratio * cosine - transmitted) * normal);
}
