// Whether coverage between two references is other than theirs: the radiance of what is behind and of secondary rays
// is interpolated with its weight.

fn similarity_coverage_failed(a: Attributes, b: Attributes) -> u32 {
    if a.object == 0u {
        return 0u;
    }
    let middle = similarity_interpolate(a, b);
    let bend = 2.0 * similarity_coverage(middle) - similarity_coverage(a) - similarity_coverage(b);
    return select(CHECK_GCOL, 0u, abs(bend) < frame.tolerances.gcol);
}

fn similarity_coverage(a: Attributes) -> f32 {
    return coverage_of(a.object - 1u, a.texcoord, attributes_moments(a.footprint), a.alpha);
}
