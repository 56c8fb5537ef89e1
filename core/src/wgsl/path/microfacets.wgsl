// Reflection by microfacets: the distribution of Trowbridge & Reitz (GGX) with height-correlated shadowing (Heitz
// 2014). Vectors are in the lobe's frame of tangent, bitangent and normal.

struct Microfacets {
    // Columns: tangent, bitangent and normal.
    frame: mat3x3f,
    // Unit vector to the viewer, in the frame.
    view: vec3f,
    // Widths along tangent and bitangent.
    alpha: vec2f,
    // Reflectance at normal and at grazing incidence.
    f0: vec3f,
    f90: vec3f,
    // The viewer's index of refraction over that of the other side, where light may be reflected totally; else 0.
    ratio: f32,
    // Factor on the lobe: compensation of multiple scattering, and what layers above let through.
    scale: vec3f,
    // Largest channel of the albedo; 0 without the lobe.
    chance: f32,
}

// Least cosine of the view angle: shading normals may point away from the viewer.
const MICROFACETS_LEAST_COSINE: f32 = 1.0e-3;

// The lobe of a surface of this roughness around a normal; `albedo` receives its directional albedo. What microfacets
// scatter more than once has the lobe's shape (Turquin 2019, "Practical multiple scattering compensation for
// microfacet models", equation 16).
fn microfacets_of(
    frame: mat3x3f, alpha: vec2f, view: vec3f, f0: vec3f, f90: vec3f, ratio: f32, albedo: ptr<function, vec3f>
) -> Microfacets {
    var lobe: Microfacets;
    lobe.frame = frame;
    let local = view * frame;
    lobe.view = normalize(vec3f(local.xy, max(local.z, MICROFACETS_LEAST_COSINE)));
    lobe.alpha = alpha;
    lobe.f0 = f0;
    lobe.f90 = f90;
    lobe.ratio = ratio;
    let shares = lobes_shares(alpha, lobe_albedo_entry(lobe.view.z, sqrt(sqrt(alpha.x * alpha.y))).xy);
    lobe.scale = 1.0 + f0 * (1.0 / shares.x - 1.0);
    *albedo = lobe.scale * (f0 * shares.x + (f90 - f0) * shares.y);
    if ratio > 0.0 {
        lobe.scale = vec3f(1.0);
        *albedo = shares.x * microfacets_fresnel(lobe, lobe.view.z);
    }
    lobe.chance = max_component(*albedo);
    return lobe;
}

// Schlick's approximation; from the denser side, at the angle of refraction.
fn microfacets_fresnel(lobe: Microfacets, cosine: f32) -> vec3f {
    var across = clamp(cosine, 0.0, 1.0);
    if lobe.ratio > 1.0 {
        across = fresnel_transmitted(across, lobe.ratio);
    }
    return lobe.f0 + (lobe.f90 - lobe.f0) * material_grazing(across);
}

// Length of a vector that is stretched by the lobe's widths.
fn microfacets_length(lobe: Microfacets, v: vec3f) -> f32 {
    return length(vec3f(lobe.alpha * v.xy, v.z));
}

// The lobe times the cosine for light from a direction of the world, and the density with which it is drawn.
fn microfacets_response(lobe: Microfacets, direction: vec3f) -> vec4f {
    let light = direction * lobe.frame;
    if lobe.chance <= 0.0 || light.z <= 0.0 {
        return vec4f(0.0);
    }
    let sum = lobe.view + light;
    let h = sum * inverseSqrt(max(dot(sum, sum), 1.0e-12));
    let slope = h / vec3f(lobe.alpha, 1.0);
    let square = dot(slope, slope);
    let distribution = 1.0 / (PI * lobe.alpha.x * lobe.alpha.y * square * square);
    let view_length = microfacets_length(lobe, lobe.view);
    let shadowed = lobe.view.z * microfacets_length(lobe, light) + light.z * view_length;
    let fresnel = microfacets_fresnel(lobe, dot(lobe.view, h));
    let value = fresnel * lobe.scale * (0.5 * distribution * light.z / shadowed);
    return vec4f(value, 0.5 * distribution / (lobe.view.z + view_length));
}

// A visible normal (Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps").
fn microfacets_normal(lobe: Microfacets, random: vec2f) -> vec3f {
    let v = normalize(vec3f(lobe.alpha * lobe.view.xy, lobe.view.z));
    let angle = 2.0 * PI * random.x;
    let z = (1.0 - random.y) * (1.0 + v.z) - v.z;
    let r = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    let cap = vec3f(r * cos(angle), r * sin(angle), z) + v;
    return normalize(vec3f(lobe.alpha * cap.xy, max(cap.z, 1.0e-6)));
}

// A direction of the world that the lobe reflects to the viewer.
fn microfacets_draw(lobe: Microfacets, random: vec2f) -> vec3f {
    return normalize(lobe.frame * reflect(-lobe.view, microfacets_normal(lobe, random)));
}

// Share of the light that passes a visible normal and is not shadowed beyond it, by the cosine there.
fn microfacets_unshadowed(lobe: Microfacets, beyond: vec3f) -> f32 {
    let view_length = microfacets_length(lobe, lobe.view);
    let z = abs(beyond.z);
    return z * (lobe.view.z + view_length) / (lobe.view.z * microfacets_length(lobe, beyond) + z * view_length);
}
