// Maps workgroups to tiles in order, for GPUs.

const TILE_ORDER_SINGLE: u32 = 1u;
const TILE_ORDER_RUN: u32 = 1u;

fn tile_order(group: vec3u, groups: vec3u, run: u32) -> vec2u {
    return group.xy + vec2u(0u, frame.part.first);
}
