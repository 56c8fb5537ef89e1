// The primitives of a path's hits that the other eye is tested against: index + 1, 0 for none.

struct StereoReuse {
    first: u32,
    // The primitive seen in a planar mirror.
    second: u32,
}

fn stereo_reuse_begin() -> StereoReuse {
    return StereoReuse(0u, 0u);
}

fn stereo_reuse_record(path: ptr<function, Path>, primitive: u32) {
    if (*path).level == 1u {
        (*path).stereo_reuse.first = primitive + 1u;
    }
    if (*path).level == 2u && (*path).kind == RAY_REFLECTION {
        (*path).stereo_reuse.second = primitive + 1u;
    }
}
