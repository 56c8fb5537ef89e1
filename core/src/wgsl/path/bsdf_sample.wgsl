// The sampled lobe.
struct BsdfSample {
    ray: Ray,
    // The lobe's weight divided by the probability of choosing it; 0 if the path ends.
    weight: vec3f,
    kind: u32,
    // Density of the direction per unit of solid angle; 0 for mirrored and refracted rays.
    density: f32,
}
