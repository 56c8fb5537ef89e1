// The tone curve of Khronos PBR Neutral: compresses the largest channel above 0.76, by which highlights lose saturation.

// Reflectance of a dielectric at normal incidence, which the curve takes away from base colours.
const TONE_REFLECTANCE: f32 = 0.04;
const TONE_START: f32 = 0.8 - TONE_REFLECTANCE;
const TONE_DESATURATION: f32 = 0.15;

fn tone_mapped(radiance: vec3f) -> vec3f {
    let least = min(radiance.x, min(radiance.y, radiance.z));
    let offset = select(TONE_REFLECTANCE, least - 6.25 * least * least, least < 2.0 * TONE_REFLECTANCE);
    let color = radiance - offset;
    let peak = max(color.x, max(color.y, color.z));
    if peak < TONE_START {
        return color;
    }
    let room = 1.0 - TONE_START;
    let compressed = 1.0 - room * room / (peak + room - TONE_START);
    let colorful = 1.0 / (TONE_DESATURATION * (peak - compressed) + 1.0);
    return mix(vec3f(compressed), color * (compressed / peak), colorful);
}
