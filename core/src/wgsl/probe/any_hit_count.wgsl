// Any-hit filter of the probe that counts the surfaces along a ray: no surface stops it.

var<private> any_hit_counted: u32;
// Read by shadow rays, which the probe has none of.
var<private> any_hit_through: f32;

fn any_hit_accepts(primitive: u32, u: f32, v: f32, shadow: bool) -> bool {
    any_hit_counted += 1u;
    return false;
}
