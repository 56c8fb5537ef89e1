// Partial coverage (glTF's alpha mode BLEND): the share of what is seen at a point that is the surface; the rest is
// what a ray sees that goes straight on.

fn coverage_of(object: u32, texcoord: vec2f, footprint: vec3f, vertex_alpha: f32) -> f32 {
    if (object_at(object).flags & OBJECT_BLEND) == 0u {
        return 1.0;
    }
    let texture = texture_color(object_at(object).base_color_texture, texcoord, footprint);
    return clamp(object_at(object).alpha * vertex_alpha * texture.a, 0.0, 1.0);
}
