// The least and the greatest display-encoded colour of a pixel and its eight neighbours.

struct ContrastRange {
    low: vec3f,
    high: vec3f,
}

fn contrast_range(pixel: vec2u) -> ContrastRange {
    var range = ContrastRange(vec3f(1.0), vec3f(0.0));
    for (var i = 0u; i < 9u; i += 1u) {
        let shown = contrast_shown(pixel_edges_color(pixel_edges_neighbour(pixel, i)));
        range.low = min(range.low, shown);
        range.high = max(range.high, shown);
    }
    return range;
}
