// Evaluates Fresnel's equations at the caller's boundaries.

struct ProbeBoundary {
    cosine: f32,
    ratio: f32,
}

struct ProbeFresnel {
    reflectance: f32,
    // Cosine of the angle of refraction.
    transmitted: f32,
    // 1 at total internal reflection, else 0.
    total: u32,
    padding0: u32,
    // Direction of refraction for normal +z and an incident ray along +x; zero at total reflection.
    refracted: vec3f,
    padding1: u32,
}

var<storage, read> rays: array<ProbeBoundary>;
var<storage, read_write> results: array<ProbeFresnel>;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = (group.y * TRACE_ROW + group.x) * TRACE_GROUP + local;
    if index >= arrayLength(&rays) {
        return;
    }
    let cosine = rays[index].cosine;
    let ratio = rays[index].ratio;
    var result: ProbeFresnel;
    result.transmitted = fresnel_transmitted(cosine, ratio);
    result.reflectance = fresnel_reflectance(cosine, ratio, result.transmitted);
    result.total = select(0u, 1u, result.transmitted <= 0.0);
    if result.total == 0u {
        let direction = vec3f(sqrt((1.0 - cosine) * (1.0 + cosine)), 0.0, -cosine);
        result.refracted = fresnel_refracted(direction, vec3f(0.0, 0.0, 1.0), cosine, ratio, result.transmitted);
    }
    results[index] = result;
}
