// Stores the attributes that supersampling compares between neighbouring pixels.

fn pixel_edges_record(pixel: vec2u, a: Attributes, secondary: vec2u, color: vec3f) {
    var normal = 0u;
    if a.object != 0u {
        normal = octahedral_encode(a.normal);
    }
    pixel_edges_store(pixel, PixelEdges(pixel_edges_word(a.object, a.shadow), normal, secondary.x, secondary.y, color));
}

// Between references with similar reflections, the secondary hit of one serves for the pixel.
fn pixel_edges_record_interpolated(pixel: vec2u, reference: vec2u, middle: Attributes, color: vec3f) {
    pixel_edges_record(pixel, middle, pixel_edges_secondary_words(reference), color);
}

// Packs the object (OID + 1), the number of shadowed lights, and whether the surface is textured.
fn pixel_edges_word(object: u32, shadow: u32) -> u32 {
    if object == 0u {
        return 0u;
    }
    let textured = select(0u, PIXEL_EDGES_TEXTURE, texture_seam_matters(object - 1u));
    return object | (countOneBits(shadow) << PIXEL_EDGES_SHADOW_SHIFT) | textured;
}
