// Part of check TX in scenes with extended materials: whether tangents and second coordinates of two references may
// be interpolated. Tangents turn where parts of the texture meet that are apart in the image.

fn similarity_maps(object: u32, a: Maps, b: Maps) -> bool {
    if HAS_TANGENTS && material_has_tangents(object) {
        if a.tangent.w != b.tangent.w || dot(a.tangent.xyz, b.tangent.xyz) <= frame.tolerances.norm {
            return false;
        }
    }
    return !HAS_SLOT_COORDINATES || !similarity_seam(a.second - floor(a.second), b.second - floor(b.second));
}
