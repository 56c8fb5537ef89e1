// The similarity checks of Kim 2016, Table 1, on the attribute vectors of two reference pixels.
//
// Deviations: tolerances are strict bounds, so that a tolerance of 0 traces everything. G4 fails only if both
// distances from the other's tangent plane exceed the rounding errors of the stored normals and depths; as
// printed, it compares the signs of rounding errors on flat surfaces. Its tangent planes are those of the faces,
// since an interpolated shading normal on a flat face looks like an inflection. TX is the table's formula, not
// the prose.

fn similarity_position(pixel: vec2u, depth: f32) -> vec3f {
    let ray = frame_ray(pixel);
    return ray.origin + depth * ray.direction;
}

fn similarity_seam(a: vec2f, b: vec2f) -> bool {
    let t = frame.tolerances.tex;
    let low = min(a, b);
    let high = max(a, b);
    return any((low < vec2f(t)) & (high > vec2f(1.0 - t)));
}

// The similarity checks that fail for a pair of references, as CHECK_* bits.
fn similarity_failed(a: Attributes, a_pixel: vec2u, b: Attributes, b_pixel: vec2u) -> u32 {
    if a.object != b.object {
        return CHECK_OID;
    }
    if a.object == 0u {
        // Two references without a hit pass every check, unless the tolerance traces everything.
        return select(CHECK_POS, 0u, frame.tolerances.pos > 0.0);
    }
    let a_position = similarity_position(a_pixel, a.depth);
    let b_position = similarity_position(b_pixel, b.depth);
    let step = b_position - a_position;
    let distance = length(step);
    var failed = select(CHECK_POS, 0u, distance < frame.tolerances.pos);
    failed |= select(CHECK_NORM, 0u, dot(a.normal, b.normal) > frame.tolerances.norm);
    let from_a = dot(step, a.face);
    let from_b = -dot(step, b.face);
    let extent = dot(abs(a_position) + abs(frame.camera.origin), vec3f(1.0));
    let rounding = 1.5 * NORMAL_ERROR * distance + 5.0e-7 * (extent + a.depth + b.depth);
    failed |= select(0u, CHECK_CONVEX, from_a * from_b < 0.0 && min(abs(from_a), abs(from_b)) > rounding);
    if HAS_TEXTURES || HAS_TANGENTS {
        let seam = texture_seam_matters(a.object - 1u) && similarity_seam(a.texcoord, b.texcoord);
        failed |= select(0u, CHECK_TEX, seam || !similarity_maps(a.object - 1u, a.maps, b.maps));
    }
    if HAS_LIGHTS {
        failed |= select(CHECK_SHADOW, 0u, a.shadow == b.shadow);
    }
    if HAS_GCOL {
        let same = similarity_mirrors(a, b) || length(a.gcol - b.gcol) < frame.tolerances.gcol;
        failed |= select(CHECK_GCOL, 0u, same);
    }
    return failed;
}

// The attribute vector half way between two references. Deviation: the paper interpolates linearly in the image;
// here all attributes are interpolated with perspective correction, which is exact on a plane, and the point lies
// on the pixel's ray.
fn similarity_interpolate(a: Attributes, b: Attributes) -> Attributes {
    var middle = a;
    if a.object == 0u {
        return middle;
    }
    let perspective = frame.camera.orthographic == 0.0;
    let a_weight = select(0.5, b.depth / (a.depth + b.depth), perspective);
    let b_weight = 1.0 - a_weight;
    middle.depth = select(0.5 * (a.depth + b.depth), 2.0 * a.depth * a_weight, perspective);
    middle.normal = normalize(a_weight * a.normal + b_weight * b.normal);
    if HAS_FACE {
        middle.face = normalize(a_weight * a.face + b_weight * b.face);
    }
    middle.mirrors_environment = a.mirrors_environment && b.mirrors_environment;
    middle.gcol = 0.5 * (a.gcol + b.gcol);
    middle.texcoord = a_weight * a.texcoord + b_weight * b.texcoord;
    middle.color = a_weight * a.color + b_weight * b.color;
    middle.alpha = a_weight * a.alpha + b_weight * b.alpha;
    middle.footprint = 0.5 * (a.footprint + b.footprint);
    middle.maps = maps_interpolate(a.maps, b.maps, a_weight);
    return middle;
}

// Shades an attribute vector.
fn similarity_shade(pixel: vec2u, a: Attributes) -> vec3f {
    if a.object == 0u {
        return environment_radiance(frame_ray(pixel).direction);
    }
    let ray = frame_ray(pixel);
    var m = material_at(a.object - 1u, a.texcoord, attributes_moments(a.footprint), a.color, a.maps);
    let position = ray.origin + a.depth * ray.direction;
    let view = -normalize(ray.direction);
    coat_orient(&m, a.normal, a.face, view, a.maps);
    let normal = material_normal(m, a.normal, a.face, view, a.maps);
    let covered = coverage_of(a.object - 1u, a.texcoord, attributes_moments(a.footprint), a.alpha);
    return similarity_secondary(a, m, normal, view, covered) + covered * material_local(m, position, normal, view, false, a.shadow);
}
