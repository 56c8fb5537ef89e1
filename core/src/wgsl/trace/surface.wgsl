// Interpolates the surface at a hit and computes the origins of rays that leave it.

struct Surface {
    // Index of the primitive that was hit.
    primitive: u32,
    t: f32,
    position: vec3f,
    // Barycentric weights of the second and third corner.
    barycentric: vec2f,
    object: u32,
    // Shading normal and face normal, both on the viewer's side of the face.
    normal: vec3f,
    face: vec3f,
    // Distance of spawned rays' origins from the face.
    offset: f32,
    inside: bool,
    texcoord: vec2f,
    color: vec3f,
    // Alpha of the vertices.
    alpha: f32,
    // The ray cone: its width here and the growth of the width per unit of length.
    cone: vec2f,
    footprint: vec3f,
    maps: Maps,
}

fn surface_at(ray: Ray, hit: Hit) -> Surface {
    let corners = bvh_corners(hit.primitive);
    var s: Surface;
    if sphere_is(hit.primitive) {
        s = surface_of_sphere(ray, hit, corners[0], corners[1].x);
    } else {
        s = surface_of_triangle(ray, hit, corners);
    }
    s.primitive = hit.primitive;
    s.t = hit.t;
    s.barycentric = vec2f(hit.u, hit.v);
    s.object = shading_at(hit.primitive).w & SURFACE_OBJECT;
    s.cone = cone_arrived(ray, hit.t);
    if !sphere_is(hit.primitive) && texture_seam_matters(s.object) {
        let texcoords = vertex_texcoords(hit.primitive);
        s.footprint = cone_footprint(s.cone.x, normalize(ray.direction), s.face, corners, texcoords);
    }
    s.texcoord = vertex_texcoord(hit);
    s.color = vertex_color(hit);
    s.alpha = vertex_alpha(hit);
    s.maps = surface_maps(s, hit, corners, normalize(ray.direction));
    return s;
}

fn surface_of_sphere(ray: Ray, hit: Hit, center: vec3f, radius: f32) -> Surface {
    var s: Surface;
    s.face = surface_unit((ray.origin - center + hit.t * ray.direction) / radius, -normalize(ray.direction));
    s.position = center + radius * s.face;
    s.inside = dot(s.face, ray.direction) > 0.0;
    s.face = select(s.face, -s.face, s.inside);
    s.normal = s.face;
    s.offset = surface_offset(s.face, abs(center) + radius, radius);
    return s;
}

// Upper bound of 1 - cos of the angle between a normal and its encoding, as far as f32 resolves it.
const FLAT_ERROR: f32 = 2.0e-7;

fn surface_of_triangle(ray: Ray, hit: Hit, corners: array<vec3f, 3>) -> Surface {
    let ab = corners[1] - corners[0];
    let bc = corners[2] - corners[1];
    let ca = corners[0] - corners[2];
    let sides = max(max(abs(ab), abs(bc)), abs(ca));
    let size = max(max(sides.x, sides.y), sides.z);
    let viewer = -normalize(ray.direction);
    let winding = surface_unit(surface_cross(ab / size, bc / size, ca / size), viewer);
    let data = shading_at(hit.primitive);
    let smooth_normal = (1.0 - hit.u - hit.v) * octahedral_decode(data.x)
        + hit.u * octahedral_decode(data.y) + hit.v * octahedral_decode(data.z);
    // The shading normals define the outside; the winding may contradict them.
    let turned = dot(winding, smooth_normal) < 0.0;
    var s: Surface;
    s.inside = surface_from_behind(ray, corners, winding) != turned;
    s.face = select(winding, -winding, turned != s.inside);
    s.normal = s.face;
    // Opposite normals may cancel out. On flat triangles the normals equal the face's up to their encoding.
    let shading_normal = normalize(select(smooth_normal, -smooth_normal, s.inside));
    let flat_triangle = all(data.xx == data.yz) && dot(shading_normal, s.face) > 1.0 - FLAT_ERROR;
    if dot(smooth_normal, smooth_normal) > 1.0e-6 && !flat_triangle {
        s.normal = shading_normal;
    }
    // One rounding is relative to the coordinates, the others to the triangle's size.
    s.position = corners[0] + (hit.u * ab - hit.v * ca);
    s.offset = surface_offset(s.face, max(max(abs(corners[0]), abs(corners[1])), abs(corners[2])), size);
    return s;
}

// Face normal from the two shortest edges, which are the least parallel; slivers would lose precision with
// others.
fn surface_cross(ab: vec3f, bc: vec3f, ca: vec3f) -> vec3f {
    let lengths = vec3f(dot(ab, ab), dot(bc, bc), dot(ca, ca));
    if lengths.x >= max(lengths.y, lengths.z) {
        return cross(bc, ca);
    }
    if lengths.y >= lengths.z {
        return cross(ca, ab);
    }
    return cross(ab, bc);
}

fn surface_unit(v: vec3f, fallback: vec3f) -> vec3f {
    let size = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if !(size > 1.0e-30) {
        return fallback;
    }
    return normalize(v / size);
}

// Whether the ray comes from behind, by the winding. Repeats the decision of the intersection test, which is
// right at any angle, while the normal has rounding errors.
fn surface_from_behind(ray: Ray, corners: array<vec3f, 3>, winding: vec3f) -> bool {
    let shear = triangle_shear(ray);
    let a = triangle_flatten(shear, triangle_permute(corners[0] - ray.origin, shear.axis));
    let b = triangle_flatten(shear, triangle_permute(corners[1] - ray.origin, shear.axis));
    let c = triangle_flatten(shear, triangle_permute(corners[2] - ray.origin, shear.axis));
    let edges = triangle_edge_functions(a, b, c);
    let seen = (edges.x + edges.y + edges.z) * sign(shear.shear.z);
    if seen == 0.0 {
        return dot(winding, ray.direction) > 0.0;
    }
    return seen < 0.0;
}

fn surface_offset(face: vec3f, coordinates: vec3f, size: f32) -> f32 {
    return OFFSET_COORDINATES * dot(abs(face), coordinates) + OFFSET_SIZE * size;
}

// A ray that leaves the surface on the side that `direction` points to.
fn surface_spawn(s: Surface, direction: vec3f, t_max: f32, cone: vec2f) -> Ray {
    let side = select(-s.offset, s.offset, dot(direction, s.face) >= 0.0);
    return Ray(s.position + side * s.face, t_max, direction, s.primitive, 0.0, cone);
}

// Continues a ray straight through the surface.
fn surface_pass(s: Surface, ray: Ray) -> Ray {
    return Ray(ray.origin, FAR, ray.direction, s.primitive, s.t, ray.cone);
}
