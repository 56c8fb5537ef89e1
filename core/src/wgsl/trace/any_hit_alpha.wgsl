// Any-hit filter for scenes with alpha-masked surfaces, and with surfaces that shadow rays ignore.

fn any_hit_accepts(primitive: u32, u: f32, v: f32, shadow: bool) -> bool {
    let flags = shading_at(primitive).w;
    if shadow && (flags & SURFACE_NO_SHADOW) != 0u {
        return false;
    }
    if (flags & SURFACE_ALPHA) == 0u {
        return true;
    }
    let object = flags & SURFACE_OBJECT;
    let texcoord = vertex_texcoord(Hit(0.0, primitive, u, v));
    let alpha = object_at(object).alpha * texture_alpha(object_at(object).base_color_texture, texcoord);
    return alpha >= object_at(object).alpha_cutoff;
}
