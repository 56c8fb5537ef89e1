// Measures arithmetic throughput: eight independent chains of multiply-adds.

var<storage, read_write> results: array<f32>;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(global_invocation_id) id: vec3u) {
    // Keeps numbers bounded and away from subnormal ones, which may be slow.
    let factor = vec4f(0.999);
    let term = vec4f(0.001 * f32(id.x & 7u) + 0.001);
    var a = term;
    var b = term + 0.1;
    for (var turn = 0u; turn < TURNS; turn += 1u) {
        a = fma(a, factor, term);
        b = fma(b, factor, term);
        a = fma(a, factor, term);
        b = fma(b, factor, term);
        a = fma(a, factor, term);
        b = fma(b, factor, term);
        a = fma(a, factor, term);
        b = fma(b, factor, term);
    }
    results[id.x] = dot(a + b, vec4f(1.0));
}
