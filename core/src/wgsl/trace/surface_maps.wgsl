// Tangents and second texture coordinates at a hit, from the tables behind the objects.

fn surface_maps(s: Surface, hit: Hit, corners: array<vec3f, 3>, direction: vec3f) -> Maps {
    var maps: Maps;
    maps.first = s.texcoord;
    let record = material_record(s.object);
    if record == 0u || sphere_is(hit.primitive) {
        return maps;
    }
    let tables = object_part(0u, record).xy;
    let weights = vec3f(1.0 - hit.u - hit.v, hit.u, hit.v);
    let tangents = tables.x & ~RECORD_NORMAL_MAP;
    if HAS_TANGENTS && tangents != 0u {
        let words = object_part(0u, tangents + hit.primitive);
        let a = maps_tangent_decode(words.x);
        let tangent = weights.x * a.xyz + weights.y * maps_tangent_decode(words.y).xyz
            + weights.z * maps_tangent_decode(words.z).xyz;
        let side = select(1.0, -1.0, s.inside);
        maps.tangent = side * vec4f(tangent * inverseSqrt(max(dot(tangent, tangent), 1.0e-12)), a.w);
    }
    if HAS_SLOT_COORDINATES && tables.y != 0u {
        let ab = bitcast<vec4f>(object_part(0u, tables.y + 2u * hit.primitive));
        let c = bitcast<vec2f>(object_part(0u, tables.y + 2u * hit.primitive + 1u).xy);
        maps.second = weights.x * ab.xy + weights.y * ab.zw + weights.z * c;
        let texcoords = array<vec2f, 3>(ab.xy, ab.zw, c);
        maps.second_footprint = cone_footprint(s.cone.x, direction, s.face, corners, texcoords);
    }
    return maps;
}

// Transmittance of what the ray has crossed: an absorbing solid that it leaves (Beer-Lambert).
fn surface_absorbed(s: Surface, ray: Ray) -> vec3f {
    let record = material_record(s.object);
    if !HAS_LAYERS || record == 0u || !s.inside {
        return vec3f(1.0);
    }
    let absorption = bitcast<vec3f>(object_part(0u, record + 2u).xyz);
    return exp(-s.t * length(ray.direction) * absorption);
}

// The material of a surface, whose normal becomes that of the normal map; `direction` is the unit direction of the
// incident ray.
fn surface_material(s: ptr<function, Surface>, direction: vec3f) -> Material {
    var m = material_at((*s).object, (*s).texcoord, (*s).footprint, (*s).color, (*s).maps);
    coat_orient(&m, (*s).normal, (*s).face, -direction, (*s).maps);
    (*s).normal = material_normal(m, (*s).normal, (*s).face, -direction, (*s).maps);
    return m;
}
