// For scenes of extended materials whose coats have the normals of what they cover.

struct CoatNormal {
    nothing: u32,
}

fn coat_normal_read(m: ptr<function, Material>, record: u32, at: Lookup, maps: Maps) {}

fn coat_orient(m: ptr<function, Material>, normal: vec3f, face: vec3f, view: vec3f, maps: Maps) {}
