// The surface at a hit.

// Normals of a primitive's corners (octahedral), and object | SURFACE_* flags.
var<storage, read> shading: array<vec4u>;

struct Surface {
    position: vec3f,
    object: u32,
    // Shading normal and normal of the face, both on the viewer's side of the face.
    normal: vec3f,
    face: vec3f,
    // New rays start this far from the face.
    offset: f32,
    inside: bool,
    texcoord: vec2f,
    color: vec3f,
}

fn surface_at(ray: Ray, hit: Hit) -> Surface {
    let data = shading[hit.primitive];
    let corners = bvh_corners(hit.primitive);
    var s: Surface;
    s.object = data.w & SURFACE_OBJECT;
    var extent: vec3f;
    var longest: f32;
    if sphere_is(hit.primitive) {
        let center = corners[0];
        let radius = corners[1].x;
        s.normal = normalize(ray.origin - center + hit.t * ray.direction);
        s.face = s.normal;
        s.position = center + radius * s.normal;
        extent = abs(center) + radius;
        longest = radius;
    } else {
        let w = 1.0 - hit.u - hit.v;
        s.position = w * corners[0] + hit.u * corners[1] + hit.v * corners[2];
        let a = corners[1] - corners[0];
        let b = corners[2] - corners[0];
        longest = max(max(max(abs(a.x), abs(a.y)), abs(a.z)), max(max(abs(b.x), abs(b.y)), abs(b.z)));
        s.face = normalize(cross(a / longest, b / longest));
        s.normal = normalize(
            w * octahedral_decode(data.x) + hit.u * octahedral_decode(data.y) + hit.v * octahedral_decode(data.z)
        );
        // The normals say which side is out; the winding may disagree.
        s.face = select(-s.face, s.face, dot(s.face, s.normal) >= 0.0);
        extent = max(max(abs(corners[0]), abs(corners[1])), abs(corners[2]));
    }
    s.inside = dot(s.face, ray.direction) > 0.0;
    s.face = select(s.face, -s.face, s.inside);
    s.normal = select(s.normal, -s.normal, s.inside);
    s.offset = SURFACE_OFFSET * (dot(abs(s.face), extent) + longest);
    s.texcoord = vertex_texcoord(hit);
    s.color = vertex_color(hit);
    return s;
}

// A ray that leaves the surface on the side that its direction points to.
fn surface_spawn(s: Surface, direction: vec3f, t_max: f32) -> Ray {
    let side = select(-s.offset, s.offset, dot(direction, s.face) >= 0.0);
    return Ray(s.position + side * s.face, t_max, direction);
}
