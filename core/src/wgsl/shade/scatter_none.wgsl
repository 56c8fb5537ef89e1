// For scenes without mirrors and glass: a sample is its primary ray alone.

struct Branch {
    ray: Ray,
    weight: vec3f,
    level: u32,
    kind: u32,
}

fn bounce_next(branch: ptr<function, Branch>) -> bool {
    return false;
}

fn bounce_split(s: Surface, m: Material, branch: Branch, direction: vec3f) -> vec3f {
    return vec3f(0.0);
}
