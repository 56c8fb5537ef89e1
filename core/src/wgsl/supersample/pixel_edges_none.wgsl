// For frames without extra samples: no attributes are stored for comparison.

fn pixel_edges_record(pixel: vec2u, a: Attributes, secondary: vec2u, color: vec3f) {}
fn pixel_edges_record_interpolated(pixel: vec2u, reference: vec2u, middle: Attributes, color: vec3f) {}
