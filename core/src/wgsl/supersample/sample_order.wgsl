// The order of a pixel's sixteen samples (Sobol'): each four in succession have one in each subpixel, column and
// row of the pixel's 4x4 cells.

fn sample_order_stratum(i: u32) -> vec2u {
    let a = i & 1u;
    let b = (i >> 1u) & 1u;
    let c = (i >> 2u) & 1u;
    let d = (i >> 3u) & 1u;
    return vec2u(2u * a + b, 2u * (a ^ b ^ c ^ d) + (b ^ d));
}
