// Texture lookups without mip levels: the texture at the hit point, whatever the footprint.

fn texture_color(place: vec4u, texcoord: vec2f, footprint: vec3f) -> vec4f {
    if !texture_present(place) {
        return vec4f(1.0);
    }
    return texture_point(atlas_color, texture_whole(place), texture_wrap(place.z), texcoord);
}

fn texture_data(place: vec4u, texcoord: vec2f, footprint: vec3f) -> vec4f {
    if !texture_present(place) {
        return vec4f(1.0);
    }
    return texture_point(atlas_data, texture_whole(place), texture_wrap(place.z), texcoord);
}
