// For frames that do not compare secondary hits: stores nothing.

fn secondary_begin() {}
fn secondary_hit(weight: vec3f, s: Surface, shadow: u32) {}

fn secondary_packed() -> vec2u {
    return vec2u(0u);
}
