// The ray through a sample of the quincunx.

fn quincunx_ray(point: vec2u) -> Ray {
    return frame_ray_at(vec2f(point + vec2u(0u, 8u * frame.row)), 8.0);
}
