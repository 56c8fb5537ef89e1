// For frames without stereo reuse: a sample counts in its own pixel only.

struct StereoReuse {
    nothing: u32,
}

fn stereo_reuse_begin() -> StereoReuse {
    return StereoReuse(0u);
}

fn stereo_reuse_record(path: ptr<function, Path>, primitive: u32) {}
