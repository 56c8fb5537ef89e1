// Directional albedos of lobes by the cosine of the view angle and roughness.

// Rows of roughness from 0 to 1; columns of the square root of the cosine.
var lobe_albedos: texture_2d<f32>;

// The albedo of a GGX lobe of reflectance 1, and the part of it that the reflectance at grazing incidence weights; the
// albedo of a white sheen, and the factor on it that keeps it at most 1.
fn lobe_albedo_entry(cosine: f32, roughness: f32) -> vec4f {
    let side = f32(ALBEDO_SIDE);
    let place = vec2f(sqrt(clamp(cosine, 0.0, 1.0)), clamp(roughness, 0.0, 1.0)) * (side - 1.0);
    let low = min(floor(place), vec2f(side - 2.0));
    let weight = place - low;
    let at = vec2u(low);
    let top = mix(textureLoad(lobe_albedos, at, 0), textureLoad(lobe_albedos, at + vec2u(1u, 0u), 0), weight.x);
    let bottom = mix(
        textureLoad(lobe_albedos, at + vec2u(0u, 1u), 0), textureLoad(lobe_albedos, at + vec2u(1u, 1u), 0), weight.x
    );
    return mix(top, bottom, weight.y);
}
