// For frames without extra samples: no attributes are stored for comparison.

fn edges_keep(pixel: vec2u, a: Attributes, secondary: vec2u, color: vec3f) {}
fn edges_keep_interpolated(pixel: vec2u, reference: vec2u, middle: Attributes, color: vec3f) {}
