// Boundaries of solids that touch, overlap or contain one another. Surfaces that a ray crosses within the distance by
// which rays are offset from a face touch: they are one boundary, between the media before the first and behind the
// last of them.

// The media along the ray, and those behind the surface that it hit.
var<private> media_here: Media;
var<private> media_beyond: Media;
// Transmittance of the media that the ray went through since the last surface that was shaded.
var<private> media_through: vec3f;
// Distance from the face within which surfaces touch the one that was hit; 0 if none does.
var<private> media_contact: f32;
// Touching surfaces of greatly different sizes have different offsets: they are searched for this many offsets away.
const MEDIA_SEARCH: f32 = 64.0;

fn media_is_solid(primitive: u32) -> bool {
    return (object_at(shading_at(primitive).w & SURFACE_OBJECT).flags & OBJECT_SOLID) != 0u;
}

// The part of a surface that its crossing depends on: face, side and offset.
fn media_side(ray: Ray, hit: Hit) -> Surface {
    let corners = bvh_corners(hit.primitive);
    if sphere_is(hit.primitive) {
        return surface_of_sphere(ray, hit, corners[0], corners[1].x);
    }
    return surface_of_triangle(ray, hit, corners);
}

// Changes the media behind by a crossing. A solid that is left without having been entered surrounded the ray all along.
fn media_cross(object: u32, inside: bool) {
    if !inside {
        media_beyond = media_added(media_beyond, object, false);
        return;
    }
    let place = media_find(media_beyond, object);
    if place < media_beyond.count {
        media_beyond = media_removed(media_beyond, place);
    } else {
        media_here = media_added(media_here, object, true);
    }
}

fn media_onward(ray: Ray, last: Hit, t_max: f32) -> Ray {
    return Ray(ray.origin, t_max, ray.direction, last.primitive, last.t, ray.cone);
}

// Surfaces of solids that touch, from the first one on.
struct Boundary {
    first: Hit,
    last: Hit,
    // The last surface that led into the medium behind it, and the last that led out of the medium before it.
    entered: Hit,
    exited: Hit,
    // Offset of rays from the first face, and the cosine to the face per unit of the ray's parameter.
    offset: f32,
    slant: f32,
}

fn media_object(hit: Hit) -> u32 {
    return shading_at(hit.primitive).w & SURFACE_OBJECT;
}

fn media_open(ray: Ray, hit: Hit) -> Boundary {
    let s = media_side(ray, hit);
    let slant = max(abs(dot(s.face, ray.direction)), 1.0e-3 * length(ray.direction));
    return Boundary(hit, hit, hit, hit, s.offset, slant);
}

fn media_extend(boundary: ptr<function, Boundary>, ray: Ray, hit: Hit) {
    let object = media_object(hit);
    let inside = media_side(ray, hit).inside;
    media_cross(object, inside);
    (*boundary).last = hit;
    if !inside && media_top(media_beyond) == object {
        (*boundary).entered = hit;
    }
    if inside && media_top(media_here) == object {
        (*boundary).exited = hit;
    }
}

// Whether a surface touches the boundary.
fn media_touches(boundary: Boundary, ray: Ray, hit: Hit) -> bool {
    if hit.primitive == MISS {
        return false;
    }
    let offset = max(media_side(ray, hit).offset, boundary.offset);
    let touches = (hit.t - boundary.last.t) * boundary.slant <= offset;
    if touches {
        media_contact = max(media_contact, offset);
    }
    return touches;
}

// The surface of a boundary that is seen: that of the medium that begins, or else ends there. MISS if nothing changes.
fn media_seen(boundary: Boundary) -> Hit {
    let before = media_top(media_here);
    let behind = media_top(media_beyond);
    var shown = boundary.exited;
    if behind == media_object(boundary.entered) {
        shown = boundary.entered;
    }
    let clear = (object_at(media_object(shown)).flags & OBJECT_CLEAR) != 0u;
    if before == behind || (clear && media_ior(before) == media_ior(behind)) {
        shown.primitive = MISS;
    }
    return shown;
}

// Rays that leave a boundary start beyond all of its surfaces.
fn media_surface(s: Surface) -> Surface {
    var leaving = s;
    leaving.offset += 2.0 * media_contact;
    return leaving;
}

// Indices of refraction are relative to the medium on the other side.
fn media_material(m: Material, s: Surface) -> Material {
    var relative = m;
    let before = media_ior(media_top(media_here));
    if (m.flags & OBJECT_SOLID) != 0u {
        let behind = media_ior(media_top(media_beyond));
        relative.ior = select(behind / before, before / behind, s.inside);
    } else if (m.flags & (OBJECT_THIN | OBJECT_WEIGHTS)) == 0u {
        relative.ior = m.ior / before;
    }
    return relative;
}

fn media_absorbed(s: Surface, ray: Ray) -> vec3f {
    let through = media_through;
    media_through = vec3f(1.0);
    return through;
}
