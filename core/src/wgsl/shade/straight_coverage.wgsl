// Continues a ray straight through a partly covering surface, for the share that the surface leaves, and weights the
// surface by the rest. Straight rays count as one level together, however many surfaces they pass: what is behind
// them is at level 2 at least. They go to the stack first, hence are traced last, so that a level never leaves
// more than two branches for later.

fn straight_continue(state: ptr<function, PathState>, s: Surface, gcol: ptr<function, vec3f>) {
    let covered = coverage_of(s.object, s.texcoord, s.footprint, s.alpha);
    if covered < 1.0 {
        let beyond = surface_pass(s, (*state).ray);
        *gcol += scatter_push(beyond, (1.0 - covered) * (*state).weight, max((*state).level, 2u), RAY_REFRACTION);
    }
    (*state).weight *= covered;
}
