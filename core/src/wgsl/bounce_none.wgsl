// Nothing in the scene reflects or refracts.

fn bounce(first: Surface, material: Material, direction: vec3f) -> vec3f {
    return vec3f(0.0);
}
