// The side from which a light sees a surface, in scenes with diffuse transmission.

// The surface as a light sees it: from behind where a translucent one is lit from there.
fn translucency_side(s: Surface, direction: vec3f) -> Surface {
    if dot(s.normal, direction) >= 0.0 || !translucency_is(s.object) {
        return s;
    }
    var back = s;
    back.normal = -s.normal;
    back.face = -s.face;
    back.inside = !s.inside;
    return back;
}
