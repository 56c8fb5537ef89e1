// For scenes in which every surface has two sides.

fn side_stops(ray: Ray, primitive: u32, shadow: bool) -> bool {
    return true;
}
