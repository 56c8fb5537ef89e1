// Order of tiles on GPUs: workgroups treat the tiles in their own order.

const ORDER_SINGLY: u32 = 1u;
const ORDER_RUNS: u32 = 1u;

fn order_tile(group: vec3u, groups: vec3u, run: u32) -> vec2u {
    return group.xy + vec2u(0u, frame.part.first);
}
