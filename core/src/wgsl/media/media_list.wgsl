// Lists of the solids that a point lies in, by increasing precedence (Schmidt & Budge 2002, "Simple Nested Dielectrics
// in Ray Traced Images"): of two solids the one of the higher priority fills the space that both take up; of the same
// priority the one that the ray entered later; of those entered at one boundary the one of the greater index.

struct Media {
    objects: array<u32, MEDIA_MOST>,
    count: u32,
}

// The medium outside of all solids.
const MEDIA_VACUUM: u32 = 0xffffffffu;

fn media_priority(object: u32) -> u32 {
    return object_at(object).flags >> OBJECT_PRIORITY_SHIFT;
}

fn media_ior(object: u32) -> f32 {
    if object == MEDIA_VACUUM {
        return 1.0;
    }
    return object_at(object).ior;
}

fn media_top(list: Media) -> u32 {
    if list.count == 0u {
        return MEDIA_VACUUM;
    }
    return list.objects[list.count - 1u];
}

// Adds a solid below those that take precedence over it.
fn media_added(list: Media, object: u32, outermost: bool) -> Media {
    var added = list;
    // A full list loses the solid of the least precedence.
    if added.count == MEDIA_MOST {
        added = media_removed(added, 0u);
    }
    var at = added.count;
    while at > 0u && media_precedes(added.objects[at - 1u], object, outermost) {
        added.objects[at] = added.objects[at - 1u];
        at -= 1u;
    }
    added.objects[at] = object;
    added.count += 1u;
    return added;
}

// Whether a solid of a list takes precedence over one that the ray enters, or that was around it from the start
// (`outermost`).
fn media_precedes(other: u32, object: u32, outermost: bool) -> bool {
    let difference = i32(media_priority(other)) - i32(media_priority(object));
    if difference != 0 || outermost {
        return difference >= 0;
    }
    return other > object && media_find(media_here, other) == media_here.count;
}

// The place of a solid in a list, or the list's length.
fn media_find(list: Media, object: u32) -> u32 {
    for (var i = list.count; i > 0u; i -= 1u) {
        if list.objects[i - 1u] == object {
            return i - 1u;
        }
    }
    return list.count;
}

fn media_removed(list: Media, place: u32) -> Media {
    var left = list;
    left.count -= 1u;
    for (var i = place; i < left.count; i += 1u) {
        left.objects[i] = left.objects[i + 1u];
    }
    return left;
}
