// For scenes in which every surface hides what is behind it: no ray goes straight on.

fn straight_continue(state: ptr<function, PathState>, s: Surface, gcol: ptr<function, vec3f>) {}
