// Transmittance of a medium over a distance (Beer-Lambert).

fn media_transmittance(object: u32, distance: f32) -> vec3f {
    if !HAS_LAYERS || object == MEDIA_VACUUM || material_record(object) == 0u {
        return vec3f(1.0);
    }
    return exp(-distance * bitcast<vec3f>(object_part(0u, material_record(object) + 2u).xyz));
}
