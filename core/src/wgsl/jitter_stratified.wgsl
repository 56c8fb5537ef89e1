// Samples lie anywhere in their cells (lecture, "Jittered sampling"), at places that follow from cell and seed: the hash
// pcg3d (Jarzynski, Olano 2020, "Hash Functions for GPU Rendering", JCGT 9(3)).

fn jitter_in(cell: vec2u) -> vec2f {
    var v = vec3u(cell, frame.seed) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    return vec2f(v.xy >> vec2u(8u)) / 16777216.0;
}
