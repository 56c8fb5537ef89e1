// Rays through the media of solids that touch, overlap or contain one another.

// The most surfaces that are looked for along a ray before one is seen.
const MEDIA_STEPS: u32 = 256u;

// Media of the branches that are left for later.
var<private> media_stack: array<Media, SCATTER_STACK>;

// What the traversal looks for: the media around the start of a primary ray, which are left without having been
// entered; the next surface; surfaces that touch a boundary.
const MEDIA_START: u32 = 0u;
const MEDIA_NEXT: u32 = 1u;
const MEDIA_TOUCH: u32 = 2u;

// The media at the start of a ray of this kind; returns what is looked for first.
fn media_begin(ray: Ray, kind: u32) -> u32 {
    media_contact = 0.0;
    if kind == RAY_PRIMARY && ray.after == 0.0 {
        media_here.count = 0u;
        media_beyond.count = 0u;
        media_through = vec3f(1.0);
        return select(MEDIA_START, MEDIA_NEXT, frame.eye_in_solid == 0u);
    }
    if kind == RAY_REFRACTION || ray.after > 0.0 {
        media_here = media_beyond;
    }
    return MEDIA_NEXT;
}

// The first surface along the ray that is seen: boundaries that change nothing are crossed. `kind` is that of the ray.
fn media_trace(ray: Ray, kind: u32) -> Hit {
    var step = media_begin(ray, kind);
    var onward = ray;
    var boundary: Boundary;
    var hit: Hit;
    for (var i = 0u; i < MEDIA_STEPS; i += 1u) {
        hit = bvh_traverse(onward, false);
        let solid = hit.primitive != MISS && media_is_solid(hit.primitive);
        if step == MEDIA_START {
            if solid {
                media_cross(media_object(hit), media_side(ray, hit).inside);
            }
            onward = media_onward(ray, hit, ray.t_max);
            if hit.primitive == MISS {
                step = MEDIA_NEXT;
                onward = ray;
            }
            continue;
        }
        if step == MEDIA_TOUCH && !media_touches(boundary, ray, hit) {
            let seen = media_seen(boundary);
            if seen.primitive != MISS {
                return seen;
            }
            media_here = media_beyond;
            media_contact = 0.0;
            step = MEDIA_NEXT;
            onward = media_onward(ray, boundary.last, ray.t_max);
            continue;
        }
        if step == MEDIA_NEXT {
            media_beyond = media_here;
            if hit.primitive == MISS {
                media_through = vec3f(1.0);
                return hit;
            }
            media_through *= media_transmittance(media_top(media_here), (hit.t - onward.after) * length(ray.direction));
        }
        if !solid {
            return hit;
        }
        if step == MEDIA_NEXT {
            boundary = media_open(ray, hit);
            step = MEDIA_TOUCH;
        }
        media_extend(&boundary, ray, hit);
        onward = media_onward(ray, hit, boundary.first.t + MEDIA_SEARCH * boundary.offset / boundary.slant);
    }
    return hit;
}

// Keeps the media of a branch with its place in the stack.
fn media_push(place: u32, kind: u32) {
    if kind == RAY_REFRACTION {
        media_stack[place] = media_beyond;
    } else {
        media_stack[place] = media_here;
    }
}

fn media_pop(place: u32) {
    media_here = media_stack[place];
    media_beyond = media_here;
}
