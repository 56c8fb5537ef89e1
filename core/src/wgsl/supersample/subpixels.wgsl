// The two-step test of a pixel's subpixels (Jin 2009, 4.1.3, 4.2.2): the attributes that differ from three
// neighbours select the threshold, then the contrast of the four colours decides.

struct Test {
    // Bit i is set where subpixel i, numbered as in active_subpixels.wgsl, is active.
    subpixels: u32,
    // For any subpixel: bit 0 if the contrast exceeds the colour threshold, bits 1 to 8 if attributes of Table 1
    // differ.
    differing: u32,
}

fn subpixels_test(pixel: vec2u) -> Test {
    if !COUNTS && !subpixels_may_differ(pixel) {
        return Test(0u, 0u);
    }
    let own = pixel_edges_load(pixel);
    let own_shown = contrast_shown(own.color);
    // Textures are tested on the pixel itself, independent of its neighbours.
    let own_bits = subpixels_textures(own);
    var bits: array<u32, 9>;
    var shown: array<vec3f, 9>;
    for (var i = 0u; i < 9u; i += 1u) {
        if i == 4u {
            // Skips the pixel itself.
            continue;
        }
        let other = pixel_edges_load(pixel_edges_neighbour(pixel, i));
        bits[i] = subpixels_differing(own, other);
        shown[i] = contrast_shown(other.color);
    }
    var test = Test(0u, 0u);
    for (var subpixel = 0u; subpixel < 4u; subpixel += 1u) {
        let column = 2u * (subpixel & 1u);
        let row = 3u * (subpixel & 2u);
        let differing = own_bits | bits[3u + column] | bits[row + 1u] | bits[row + column];
        let low = min(min(own_shown, shown[3u + column]), min(shown[row + 1u], shown[row + column]));
        let high = max(max(own_shown, shown[3u + column]), max(shown[row + 1u], shown[row + column]));
        if contrast_exceeds(low, high, subpixels_threshold(differing)) {
            test.subpixels |= 1u << subpixel;
        }
        test.differing |= select(0u, 1u, contrast_exceeds(low, high, frame.tolerances.tau_col)) | (differing << 1u);
    }
    return test;
}

// Early test: if the colours around the pixel differ by less than this, no subpixel is active, whatever the
// attributes.
fn subpixels_may_differ(pixel: vec2u) -> bool {
    let range = contrast_range(pixel);
    return contrast_exceeds(range.low, range.high, 0.999 * frame.tolerances.tau_least);
}

fn subpixels_in_focus(word: u32) -> bool {
    let object = word & PIXEL_EDGES_OBJECT;
    return object >= frame.tolerances.focus_first && object <= frame.tolerances.focus_last;
}

fn subpixels_textures(own: PixelEdges) -> u32 {
    return select(0u, 8u, subpixels_in_focus(own.primary) && (own.primary & PIXEL_EDGES_TEXTURE) != 0u)
        | select(0u, 128u, subpixels_in_focus(own.secondary) && (own.secondary & PIXEL_EDGES_TEXTURE) != 0u);
}

fn subpixels_differing(own: PixelEdges, other: PixelEdges) -> u32 {
    return subpixels_differing_at(own.primary, other.primary, own.normal, other.normal)
        | (subpixels_differing_at(own.secondary, other.secondary, own.secondary_normal, other.secondary_normal) << 4u);
}

// Bits of differing object, normal and number of shadowed lights.
fn subpixels_differing_at(a: u32, b: u32, a_normal: u32, b_normal: u32) -> u32 {
    if !subpixels_in_focus(a) && !subpixels_in_focus(b) {
        return 0u;
    }
    let objects = (a ^ b) & PIXEL_EDGES_OBJECT;
    let shadows = ((a ^ b) & ~PIXEL_EDGES_TEXTURE) >> PIXEL_EDGES_SHADOW_SHIFT;
    let both = (a & PIXEL_EDGES_OBJECT) != 0u && (b & PIXEL_EDGES_OBJECT) != 0u;
    let bent = both && a_normal != b_normal
        && dot(octahedral_decode(a_normal), octahedral_decode(b_normal)) <= frame.tolerances.norm;
    return select(0u, 1u, objects != 0u) | select(0u, 2u, bent) | select(0u, 4u, shadows != 0u);
}

fn subpixels_threshold(differing: u32) -> f32 {
    if differing == 0u {
        return frame.tolerances.tau_col;
    }
    var least = 1.0;
    for (var i = 0u; i < 4u; i += 1u) {
        least = min(least, select(1.0, frame.tolerances.tau_primary[i], (differing & (1u << i)) != 0u));
        least = min(least, select(1.0, frame.tolerances.tau_secondary[i], (differing & (16u << i)) != 0u));
    }
    return least;
}
