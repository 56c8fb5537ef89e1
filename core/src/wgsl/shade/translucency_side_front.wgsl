// For scenes whose surfaces are lit from the viewer's side alone.

// The surface as a light sees it.
fn translucency_side(s: Surface, direction: vec3f) -> Surface {
    return s;
}
