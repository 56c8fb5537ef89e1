// The secondary hit of a sample (Jin 2009, 4.2.1): one bounce from the first hit, along the ray with the largest
// weight.

var<private> secondary_weight: f32;
var<private> secondary_words: vec2u;

fn secondary_begin() {
    secondary_weight = 0.0;
    secondary_words = vec2u(0u);
}

fn secondary_hit(weight: vec3f, s: Surface, shadow: u32) {
    let largest = max(weight.x, max(weight.y, weight.z));
    if largest > secondary_weight {
        secondary_weight = largest;
        secondary_words = vec2u(pixel_edges_word(s.object + 1u, shadow), octahedral_encode(s.normal));
    }
}

fn secondary_packed() -> vec2u {
    return secondary_words;
}
