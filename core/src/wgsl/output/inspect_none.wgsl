// Counters for timed frames: functions without effect.

fn inspect_step(kind: u32) {}
fn inspect_ray(kind: u32) {}
fn inspect_pixel(pixel: vec2u, origin: u32, attributes: Attributes) {}
fn inspect_claimed() {}
fn inspect_failed(pixel: vec2u, failed: u32) {}
fn inspect_extra(pixel: vec2u) {}
fn inspect_more(pixel: vec2u) {}
fn inspect_edges(pixel: vec2u, edges: u32) {}
fn inspect_refined(pixel: vec2u, strata: u32, round: u32) {}
