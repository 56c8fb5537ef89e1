// For scenes without reflection and refraction: a sample is its primary ray alone.

struct PathState {
    ray: Ray,
    weight: vec3f,
    level: u32,
    kind: u32,
}

fn scatter_next(state: ptr<function, PathState>) -> bool {
    return false;
}

fn scatter(s: Surface, m: Material, state: PathState, direction: vec3f) -> vec3f {
    return vec3f(0.0);
}
