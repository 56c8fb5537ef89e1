// Path tracing: adds one sample to every pixel's sum. Each thread traces several pixels in turn, so that threads
// that run in lockstep wait for the longest path only once.

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let corner = PATH_TILE * tile_order(group, groups, TILE_ORDER_SINGLE) + frame_tile(local);
    let across = PATH_TILE / 8u;
    var turn = 0u;
    var going = false;
    var path: Path;
    loop {
        if !going {
            if turn == across * across {
                break;
            }
            let pixel = corner + 8u * vec2u(turn % across, turn / across);
            turn += 1u;
            if any(pixel >= frame.size) {
                continue;
            }
            path = path_begin(pixel);
        }
        going = path_step(&path);
        if !going {
            path_end(path);
        }
    }
}

fn path_end(path: Path) {
    if COUNTS {
        var attributes: Attributes;
        attributes.object = path.object;
        attributes.depth = path.depth;
        attributes.normal = path.normal;
        inspect_pixel(path.pixel, ORIGIN_BASE, attributes);
    }
    gbuffer_store(path);
    samples_add(path.pixel, path.stereo_reuse, path.radiance);
}
