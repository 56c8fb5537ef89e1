// For scenes with single-sided surfaces: rays pass through their backs, as rasterisers cull back faces by the
// winding. Shadow rays stop at either side. A ray along the face meets its front.

fn side_stops(ray: Ray, primitive: u32, shadow: bool) -> bool {
    if shadow || (shading_at(primitive).w & SURFACE_SINGLE_SIDED) == 0u {
        return true;
    }
    return !surface_from_behind(ray, bvh_corners(primitive), vec3f(0.0));
}
