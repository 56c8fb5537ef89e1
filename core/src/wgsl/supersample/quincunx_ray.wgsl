// The ray through a quincunx sample. A sample of the first level represents half of the pixel's area, one that
// divides a subpixel an eighth of it, and so on.

const SQRT_2: f32 = 1.41421356;

fn quincunx_ray(point: vec2u) -> Ray {
    let inside = point % 4u;
    let odd = ((point.x ^ point.y) & 4u) != 0u;
    let first = all(inside == vec2u(0u)) && !odd;
    let second = inside.x == inside.y && (inside.x & 1u) == 0u;
    let side = SQRT_2 * select(select(1.0, 2.0, second), 4.0, first);
    return frame_ray_at(vec2f(point + vec2u(0u, 8u * frame.part.row)), 8.0, side);
}
