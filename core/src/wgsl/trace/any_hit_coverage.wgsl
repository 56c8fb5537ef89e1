// Any-hit filter for scenes with partial coverage, or alpha at vertices: shadow rays pass through partly covering
// surfaces, which dim them.

// Share of the light that the surfaces passed by the shadow ray let through.
var<private> any_hit_through: f32;

fn any_hit_accepts(primitive: u32, u: f32, v: f32, shadow: bool) -> bool {
    let flags = shading_at(primitive).w;
    if shadow && (flags & SURFACE_NO_SHADOW) != 0u {
        return false;
    }
    let blends = (flags & SURFACE_BLEND) != 0u;
    if !(shadow && blends) && (flags & SURFACE_ALPHA) == 0u {
        return true;
    }
    let object = flags & SURFACE_OBJECT;
    let hit = Hit(0.0, primitive, u, v);
    let alpha = object_at(object).alpha * vertex_alpha(hit)
        * texture_alpha(object_at(object).base_color_texture, vertex_texcoord(hit));
    if !blends {
        return alpha >= object_at(object).alpha_cutoff;
    }
    any_hit_through *= 1.0 - alpha;
    return alpha >= 1.0;
}
