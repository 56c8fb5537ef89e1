// Records of extended materials, and normal maps.

// The place of an object's record; 0 without one.
fn material_record(object: u32) -> u32 {
    return select(0u, object_part(object, 3u).x, (object_part(object, 3u).w & OBJECT_EXTENDED) != 0u);
}

fn material_has_normal_map(object: u32) -> bool {
    let record = material_record(object);
    return HAS_NORMAL_MAPS && record != 0u && (object_part(0u, record).x & RECORD_NORMAL_MAP) != 0u;
}

fn material_has_tangents(object: u32) -> bool {
    let record = material_record(object);
    return record != 0u && object_part(0u, record).x != 0u;
}

// A texture with the coordinates at which a slot reads it.
struct Lookup {
    place: vec4u,
    texcoord: vec2f,
    // Second moments (ss, tt, st).
    footprint: vec3f,
}

// Where a slot of a record is read; `own` is what the object itself has for it.
fn material_lookup(record: u32, slot: u32, own: Lookup, maps: Maps) -> Lookup {
    if record == 0u {
        return own;
    }
    let at = record + RECORD_SLOTS + SLOT_PARTS * slot;
    var lookup = Lookup(object_part(0u, at), own.texcoord, own.footprint);
    let more = object_part(0u, at + 2u);
    if HAS_SLOT_COORDINATES && more.z != 0u {
        let columns = bitcast<vec4f>(object_part(0u, at + 1u));
        let transform = mat2x2f(columns.xy, columns.zw);
        let second = more.z == SET_SECOND;
        lookup.texcoord = transform * select(maps.first, maps.second, second) + bitcast<vec2f>(more.xy);
        let m = select(own.footprint, maps.second_footprint, second);
        let moved = transform * mat2x2f(m.xz, m.zy) * transpose(transform);
        lookup.footprint = vec3f(moved[0].x, moved[1].y, moved[0].y);
    }
    return lookup;
}

// Lengths of averaged normals above this count as 1: texels are rounded.
const NORMAL_LENGTH: f32 = 0.98;

// Roughness of a surface whose averaged normal has this length: bumps that are smaller than a pixel (Toksvig 2004,
// "Mipmapping Normal Maps").
fn material_toksvig(roughness: f32, length: f32) -> f32 {
    let alpha = roughness * roughness;
    let alpha2 = alpha * alpha;
    let shortened = clamp(length / NORMAL_LENGTH, 0.001, 1.0);
    let spread = 2.0 * (1.0 - shortened) / shortened * (1.0 - alpha2);
    return sqrt(sqrt((alpha2 + spread) / (1.0 + spread)));
}

// Cosine between the face and mirrored rays, at least.
const LEAST_MIRRORED: f32 = 0.01;

// The shading normal of a normal map. Where the surface mirrors it is bent so that the mirrored ray leaves on the viewer's
// side of the face.
fn material_normal(m: Material, normal: vec3f, face: vec3f, view: vec3f, maps: Maps) -> vec3f {
    return material_bent(m.bump, material_gloss(m) > 0.0, normal, face, view, maps);
}

// A normal bent by an averaged normal in the tangent frame, which is zero without a normal map.
fn material_bent(bump: vec3f, mirrors: bool, normal: vec3f, face: vec3f, view: vec3f, maps: Maps) -> vec3f {
    let along = maps.tangent.xyz - dot(normal, maps.tangent.xyz) * normal;
    let length2 = dot(along, along);
    if !HAS_NORMAL_MAPS || all(bump == vec3f(0.0)) || length2 < 1.0e-8 {
        return normal;
    }
    let tangent = along * inverseSqrt(length2);
    let bitangent = maps.tangent.w * cross(normal, tangent);
    let bent = normalize(bump.x * tangent + bump.y * bitangent + bump.z * normal);
    if !mirrors {
        return bent;
    }
    let mirrored = 2.0 * dot(bent, view) * bent - view;
    let least = min(0.9 * max(dot(face, view), 0.0), LEAST_MIRRORED);
    let below = least - dot(mirrored, face);
    if below <= 0.0 {
        return bent;
    }
    return normalize(view + normalize(mirrored + below * face));
}
