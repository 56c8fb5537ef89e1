// Traversal of the compressed wide BVH (Ylitie, Karras & Laine 2017) built with obvhs: 80-byte nodes of eight
// children with boxes of 8-bit planes, visited front to back by the octant of the ray.

struct Hit {
    t: f32,
    primitive: u32,
    u: f32,
    v: f32,
}

fn bvh_corners(primitive: u32) -> array<vec3f, 3> {
    return array<vec3f, 3>(bvh_corner(primitive, 0u), bvh_corner(primitive, 1u), bvh_corner(primitive, 2u));
}

// Per-ray terms of the slab test.
struct Slabs {
    origin: vec3f,
    inverse: vec3f,
    negative: vec3<bool>,
    octant: u32,
}

fn bvh_slabs(ray: Ray) -> Slabs {
    // A component of zero would give 0 x infinity at a plane through the origin. Its replacement turns the ray by
    // less than the rounding error of the triangle test's shear.
    let size = abs(ray.direction);
    let least = 1.0e-18 * max(size.x, max(size.y, size.z));
    let direction = select(ray.direction, select(vec3f(-least), vec3f(least), ray.direction >= vec3f(0.0)), size < vec3f(least));
    let negative = direction < vec3f(0.0);
    let octant = select(4u, 0u, negative.x) | select(2u, 0u, negative.y) | select(1u, 0u, negative.z);
    return Slabs(ray.origin, 1.0 / direction, negative, octant * 0x01010101u);
}

// Tests four children; returns a mask of those that the ray hits before t_max.
fn bvh_four(meta4: u32, octant: u32, lo_x: u32, hi_x: u32, lo_y: u32, hi_y: u32, lo_z: u32, hi_z: u32,
            scale: vec3f, near_start: vec3f, far_start: vec3f, negative: vec3<bool>, t_max: f32) -> u32 {
    let near_x = vec4f(unpack4xU8(select(lo_x, hi_x, negative.x))) * scale.x + near_start.x;
    let far_x = vec4f(unpack4xU8(select(hi_x, lo_x, negative.x))) * scale.x + far_start.x;
    let near_y = vec4f(unpack4xU8(select(lo_y, hi_y, negative.y))) * scale.y + near_start.y;
    let far_y = vec4f(unpack4xU8(select(hi_y, lo_y, negative.y))) * scale.y + far_start.y;
    let near_z = vec4f(unpack4xU8(select(lo_z, hi_z, negative.z))) * scale.z + near_start.z;
    let far_z = vec4f(unpack4xU8(select(hi_z, lo_z, negative.z))) * scale.z + far_start.z;
    let near = max(max(near_x, near_y), max(near_z, vec4f(0.0)));
    let far = min(min(far_x, far_y), far_z);
    let met = near <= min(far, vec4f(t_max));

    let inner = (((meta4 & (meta4 << 1u)) & 0x10101010u) >> 4u) * 0xffu;
    let index = vec4u(unpack4xU8((meta4 ^ (octant & inner)) & 0x1f1f1f1fu));
    let bits = vec4u(unpack4xU8((meta4 >> 5u) & 0x07070707u));
    let shifted = select(vec4u(0u), bits << index, met);
    return shifted.x | shifted.y | shifted.z | shifted.w;
}

struct Visit {
    group: vec2u,
    leaves: vec2u,
}

// Tests the children of a node: returns inner ones as a group and primitives as a mask.
fn bvh_visit(index: u32, slabs: Slabs, t_max: f32) -> Visit {
    let n0 = bvh_node(index, 0u);
    let n1 = bvh_node(index, 1u);
    let n2 = bvh_node(index, 2u);
    let n3 = bvh_node(index, 3u);
    let n4 = bvh_node(index, 4u);
    let exponents = vec3u(n0.w & 0xffu, (n0.w >> 8u) & 0xffu, (n0.w >> 16u) & 0xffu);
    let unit = bitcast<vec3f>(exponents << vec3u(23u));
    let scale = unit * slabs.inverse;
    let low = bitcast<vec3f>(n0.xyz) - slabs.origin;
    let start = low * slabs.inverse;
    // Boxes grow by BVH_ROUNDING times a bound of the distance to their planes along any axis.
    let distance = max(abs(low.x), max(abs(low.y), abs(low.z))) + 256.0 * max(unit.x, max(unit.y, unit.z));
    let margin = abs(slabs.inverse) * (BVH_ROUNDING * distance);
    let mask =
        bvh_four(n1.z, slabs.octant, n2.x, n2.z, n3.x, n3.z, n4.x, n4.z, scale, start - margin, start + margin, slabs.negative, t_max) |
        bvh_four(n1.w, slabs.octant, n2.y, n2.w, n3.y, n3.w, n4.y, n4.w, scale, start - margin, start + margin, slabs.negative, t_max);
    return Visit(vec2u(n1.x, (mask & 0xff000000u) | (n0.w >> 24u)), vec2u(n1.y, mask & 0x00ffffffu));
}

// Whether a hit is nearer than the best one. At the same distance the lower OID wins, then the lower primitive
// index, whatever the order of traversal.
fn bvh_nearer(t: f32, primitive: u32, best: Hit) -> bool {
    if best.primitive == MISS || abs(t - best.t) > SAME_DISTANCE * best.t {
        return t < best.t;
    }
    return bvh_precedes(primitive, best.primitive);
}

fn bvh_precedes(a: u32, b: u32) -> bool {
    let object = shading_at(a).w & SURFACE_OBJECT;
    let other = shading_at(b).w & SURFACE_OBJECT;
    return object < other || (object == other && a < b);
}

// Whether a hit comes after the pane that a straight-through ray has left, in the same strict order of hits. The
// ray's edge functions are unchanged, so no surface is hit twice or missed.
fn bvh_ahead(ray: Ray, t: f32, primitive: u32) -> bool {
    if !HAS_PANES {
        return true;
    }
    return t > ray.after || (t == ray.after && bvh_precedes(ray.left, primitive));
}

// Finds the nearest hit (`any` false), or any hit (`any` true; then only its existence is meaningful).
fn bvh_traverse(ray: Ray, any: bool) -> Hit {
    let slabs = bvh_slabs(ray);
    let shear = triangle_shear(ray);
    var best = Hit(ray.t_max, MISS, 0.0, 0.0);
    // Ray parameter of the closest hit so far; farther nodes are skipped.
    var reach = ray.t_max;
    var stack: array<vec2u, BVH_STACK>;
    var stacked = 0u;
    var group = vec2u(0u, 0x80000000u);
    loop {
        let child = firstLeadingBit(group.y);
        group.y &= ~(1u << child);
        if group.y > 0x00ffffffu {
            stack[stacked] = group;
            stacked += 1u;
        }
        let slot = (child - 24u) ^ (slabs.octant & 0xffu);
        let before = countOneBits(group.y & 0xffu & ~(0xffffffffu << slot));
        inspect_step(COST_NODE_VISITS);
        let visit = bvh_visit(group.x + before, slabs, reach);
        group = visit.group;
        var leaves = visit.leaves.y;
        while leaves != 0u {
            let bit = firstTrailingBit(leaves);
            leaves &= leaves - 1u;
            let primitive = visit.leaves.x + bit;
            inspect_step(COST_PRIMITIVE_TESTS);
            var found: TriangleHit;
            if sphere_is(primitive) {
                let t = sphere_hit(ray, primitive);
                found = TriangleHit(t, 0.0, 0.0, t > 0.0 && t < reach);
            } else if primitive != ray.left {
                found = triangle_hit(shear, bvh_corners(primitive), reach);
            }
            if found.hit && bvh_ahead(ray, found.t, primitive) && side_stops(ray, primitive, any)
                && any_hit_accepts(primitive, found.u, found.v, any) && bvh_nearer(found.t, primitive, best) {
                best = Hit(found.t, primitive, found.u, found.v);
                reach = found.t * (1.0 + max(2.0 * SAME_DISTANCE, 2.4e-7));
            }
            if any && best.primitive != MISS {
                return best;
            }
        }
        if group.y <= 0x00ffffffu {
            if stacked == 0u {
                break;
            }
            stacked -= 1u;
            group = stack[stacked];
        }
    }
    return best;
}
