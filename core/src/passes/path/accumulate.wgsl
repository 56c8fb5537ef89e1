// Adds samples that the CPU has traced to the sums of every pixel (Kim & Sung 2021, Algorithm 5, lines 4 to 9).

var<storage, read> cpu_samples: array<f32>;

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let pixel = 16u * group.xy + frame_tile(local);
    if any(pixel >= frame.size) {
        return;
    }
    let place = 3u * (pixel.y * frame.size.x + pixel.x);
    samples_store(pixel, samples_load(pixel) + vec3f(cpu_samples[place], cpu_samples[place + 1u], cpu_samples[place + 2u]));
    output(pixel, samples_mean(pixel));
}
