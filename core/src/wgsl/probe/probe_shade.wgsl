// Traces and shades the caller's rays; returns radiance and attributes.

struct ProbeSample {
    color: vec3f,
    depth: f32,
    normal: vec3f,
    // OID + 1, or 0 if the ray hits nothing.
    object: u32,
    // Reflected and refracted radiance in the colour.
    gcol: vec3f,
    shadow: u32,
    texcoord: vec2f,
    padding0: u32,
    padding1: u32,
}

var<storage, read_write> results: array<ProbeSample>;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = probe_index(group, local);
    if index >= arrayLength(&rays) {
        return;
    }
    let sample = sample_follow(probe_ray(index));
    let a = sample.attributes;
    results[index] = ProbeSample(sample.color, a.depth, a.normal, a.object, a.gcol, a.shadow, a.texcoord, 0u, 0u);
}
