// The attributes that supersampling compares between pixels (Jin 2009, Table 1), as planes of the attribute
// buffer for every row of the band. Deviations: normals have 32 bits; of the secondary rays, the one with the
// largest weight is kept, reflected or refracted; and a texture seen in a mirror counts even if the mirror's
// weight is small.

struct PixelEdges {
    // Packed primary hit: OID + 1, the number of shadowed lights, and PIXEL_EDGES_TEXTURE.
    primary: u32,
    normal: u32,
    // The same of the secondary hit; 0 if there is none.
    secondary: u32,
    secondary_normal: u32,
    // Linear radiance of the sample.
    color: vec3f,
}

const PIXEL_EDGES_OBJECT: u32 = 0x01ffffffu;
const PIXEL_EDGES_SHADOW_SHIFT: u32 = 25u;
const PIXEL_EDGES_TEXTURE: u32 = 0x80000000u;

fn pixel_edges_place(pixel: vec2u, plane: u32) -> u32 {
    let row = frame_band_row(pixel.y);
    return (row / 2u * CHANNELS + PIXEL_EDGES_FIRST + row % 2u * PIXEL_EDGE_CHANNELS + plane) * frame.size.x + pixel.x;
}

fn pixel_edges_color(pixel: vec2u) -> vec3f {
    return bitcast<vec3f>(vec3u(
        attributes_read(pixel_edges_place(pixel, PIXEL_EDGE_COLOR)),
        attributes_read(pixel_edges_place(pixel, PIXEL_EDGE_COLOR + 1u)),
        attributes_read(pixel_edges_place(pixel, PIXEL_EDGE_COLOR + 2u)),
    ));
}

// The two words that describe the secondary hit.
fn pixel_edges_secondary_words(pixel: vec2u) -> vec2u {
    if !HAS_GCOL {
        return vec2u(0u);
    }
    return vec2u(
        attributes_read(pixel_edges_place(pixel, PIXEL_EDGE_SECONDARY)),
        attributes_read(pixel_edges_place(pixel, PIXEL_EDGE_SECONDARY + 1u)),
    );
}

fn pixel_edges_load(pixel: vec2u) -> PixelEdges {
    let secondary = pixel_edges_secondary_words(pixel);
    return PixelEdges(
        attributes_read(pixel_edges_place(pixel, 0u)),
        attributes_read(pixel_edges_place(pixel, 1u)),
        secondary.x,
        secondary.y,
        pixel_edges_color(pixel),
    );
}

fn pixel_edges_store(pixel: vec2u, e: PixelEdges) {
    attributes_write(pixel_edges_place(pixel, 0u), e.primary);
    attributes_write(pixel_edges_place(pixel, 1u), e.normal);
    if HAS_GCOL {
        attributes_write(pixel_edges_place(pixel, PIXEL_EDGE_SECONDARY), e.secondary);
        attributes_write(pixel_edges_place(pixel, PIXEL_EDGE_SECONDARY + 1u), e.secondary_normal);
    }
    let color = bitcast<vec3u>(e.color);
    attributes_write(pixel_edges_place(pixel, PIXEL_EDGE_COLOR), color.x);
    attributes_write(pixel_edges_place(pixel, PIXEL_EDGE_COLOR + 1u), color.y);
    attributes_write(pixel_edges_place(pixel, PIXEL_EDGE_COLOR + 2u), color.z);
}

// The 3x3 pixels around and including `pixel`, row by row from the upper left; beyond the frame, the nearest
// inside.
fn pixel_edges_neighbour(pixel: vec2u, index: u32) -> vec2u {
    let beside = vec2i(pixel) + vec2i(i32(index % 3u), i32(index / 3u)) - 1;
    return pixel_edges_inside(beside);
}

// The nearest pixel whose attributes are stored.
fn pixel_edges_inside(pixel: vec2i) -> vec2u {
    let low = vec2i(0, i32(max(frame.part.row, PIXEL_EDGES_APRON) - PIXEL_EDGES_APRON));
    return vec2u(clamp(pixel, low, vec2i(frame.size) - 1));
}
