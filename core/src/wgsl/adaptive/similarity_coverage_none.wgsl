// For scenes in which every surface hides what is behind it.

fn similarity_coverage_failed(a: Attributes, b: Attributes) -> u32 {
    return 0u;
}
