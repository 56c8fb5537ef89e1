// Ray cones (Akenine-Moeller et al. 2021, "Improved Shader and Texture Level of Detail Using Ray Cones"): the
// width of the region around a ray that its sample represents, and the growth of this width. After a focus the
// width is negative, as the image is inverted.

// The cone where a ray hits: its width, and its growth per unit of length from there on.
fn cone_arrived(ray: Ray, t: f32) -> vec2f {
    return vec2f(ray.cone.x + t * ray.cone.y, ray.cone.y / length(ray.direction));
}

// Second moments (ss, tt, st), in texture coordinates, of the axes of the ellipse in which the cone intersects a
// triangle.
fn cone_footprint(width: f32, direction: vec3f, face: vec3f, corners: array<vec3f, 3>, texcoords: array<vec2f, 3>) -> vec3f {
    let ab = corners[1] - corners[0];
    let ac = corners[2] - corners[0];
    let sides = max(abs(ab), abs(ac));
    let size = max(max(sides.x, sides.y), sides.z);
    let normal = cross(ab / size, ac / size);
    let area2 = dot(normal, normal);
    let sine = cross(face, direction);
    if !(area2 > 1.0e-30) || width == 0.0 {
        return vec3f(0.0);
    }
    // At normal incidence any direction in the surface will do.
    let upright = dot(sine, sine) < 1.0e-12;
    let other = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(face.x) > 0.5);
    let across = normalize(select(sine, cross(face, other), upright));
    let along = cross(face, across) / max(abs(dot(face, direction)), CONE_LEAST_COSINE);
    let second = cross(ac / size, normal) / area2;
    let third = cross(normal, ab / size) / area2;
    let st1 = texcoords[1] - texcoords[0];
    let st2 = texcoords[2] - texcoords[0];
    let scale = width / size;
    let a = clamp(scale * (dot(across, second) * st1 + dot(across, third) * st2), vec2f(-CONE_MOST), vec2f(CONE_MOST));
    let b = clamp(scale * (dot(along, second) * st1 + dot(along, third) * st2), vec2f(-CONE_MOST), vec2f(CONE_MOST));
    return vec3f(a * a + b * b, a.x * a.y + b.x * b.y);
}

// The footprint in the encoding of the attributes.
fn cone_attribute(s: Surface) -> vec3f {
    let sign = texture_fold_sign(s.object, s.texcoord);
    return attributes_footprint(s.footprint * vec3f(1.0, 1.0, sign));
}

// Mean curvature at the hit: change of the normal per unit of length, averaged over directions; positive where
// the surface is convex towards the viewer.
fn cone_curvature(s: Surface) -> f32 {
    let corners = bvh_corners(s.primitive);
    var curvature: f32;
    if sphere_is(s.primitive) {
        curvature = 1.0 / corners[1].x;
    } else {
        let data = shading_at(s.primitive);
        let a = octahedral_decode(data.x);
        let b = octahedral_decode(data.y);
        let c = octahedral_decode(data.z);
        curvature = (cone_turn(b - a, corners[1] - corners[0]) + cone_turn(c - b, corners[2] - corners[1])
            + cone_turn(a - c, corners[0] - corners[2])) / 3.0;
    }
    return select(curvature, -curvature, s.inside);
}

fn cone_turn(normal: vec3f, edge: vec3f) -> f32 {
    return dot(normal, edge) / max(dot(edge, edge), 1.0e-30);
}

// The cone of a ray that leaves the surface: it keeps the fraction `kept` of its growth and gains `turned` times
// the turn of the normal over its width.
fn cone_bent(s: Surface, kept: f32, turned: f32) -> vec2f {
    let growth = kept * s.cone.y + turned * cone_curvature(s) * s.cone.x;
    return vec2f(s.cone.x, clamp(growth, -CONE_MOST_GROWTH, CONE_MOST_GROWTH));
}
