//! Rays exactly through corners and edges: every crossing counts once.

use glam::{DVec3, Vec3};

use super::{
    Bench, Case, Outcome, Random,
    mesh::{Mesh, Objects},
    ray, thin_pane, unexposed,
};
use crate::{Result, Settings, probe::ProbeRay, scene::Environment};

pub const CASE: Case = Case {
    name: "vertices",
    construction: "corners, edges and eyes on a grid that f32 holds exactly, so that each ray runs exactly through a corner \
                   or a point of an edge; eyes inside and outside of spheres, double fans, a torus; what stops nothing \
                   counts the crossings, panes that halve the light show them",
    rule: "from inside odd (one, where the mesh is convex), from outside even: no miss, no double count",
    run,
};

/// The grid of the corners; points of edges lie on one four times as fine.
const GRID: f64 = 1.0 / 512.0;
/// Half the light passes a pane, and this many panes are followed.
const DEPTH: u32 = 12;

struct Target<'a> {
    name: &'static str,
    mesh: &'a Mesh,
    convex: bool,
}

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let meshes = [
        ("tetrahedron", Mesh::sphere(0), true),
        ("sphere 64", Mesh::sphere(2), false),
        ("sphere 1024", Mesh::sphere(4), false),
        ("fans 8", Mesh::fans(8), true),
        ("fans 512", Mesh::fans(512), false),
        ("torus", Mesh::torus(24, 12), false),
    ];
    let mut outcome = Outcome::default();
    let share = bench.rays.div_ceil(2 * meshes.len() as u64);
    for (index, (name, mesh, convex)) in meshes.into_iter().enumerate() {
        let mesh = mesh.snapped(GRID);
        let target = Target { name, mesh: &mesh, convex };
        cross(bench, &target, share, &mut Random(bench.seed ^ index as u64), &mut outcome)?;
    }
    Ok(outcome)
}

fn cross(
    bench: &Bench<'_>,
    target: &Target<'_>,
    share: u64,
    random: &mut Random,
    outcome: &mut Outcome,
) -> Result<()> {
    let mut scene = target.mesh.scene(thin_pane(), Objects::One);
    scene.environment = Environment { background: Vec3::ONE, ..scene.environment };
    let scene = bench.upload(scene)?;
    let eyes: Vec<_> = std::iter::repeat_with(|| eye(target.mesh, random)).take(64).flatten().collect();
    let aimed: Vec<_> = (0..share).map(|_| through(target.mesh, &eyes, random)).collect();
    let rays: Vec<_> = aimed.iter().map(|(ray, _)| *ray).collect();
    let settings = Settings { depth: DEPTH, min_weight: 0.0, ..unexposed() };
    let counts = bench.probe(&scene).count(&rays)?;
    let samples = bench.probe(&scene).shade(&rays, &settings)?;
    for (i, (ray, inside)) in aimed.iter().enumerate() {
        let right = |crossings: u32| match (inside, target.convex) {
            (true, true) => crossings == 1,
            (true, false) => crossings % 2 == 1,
            (false, true) => crossings == 0 || crossings == 2,
            (false, false) => crossings.is_multiple_of(2),
        };
        let replay = |what: &str, found: f32| {
            let side = if *inside { "inside" } else { "outside" };
            format!("{}, seed {}: ray {i} {ray:?} from {side}: {found} {what}", target.name, bench.seed)
        };
        outcome.check(right(counts[i]), || replay("crossings", counts[i] as f32));
        let panes = -samples[i].color[0].log2();
        outcome.check(panes.fract() == 0.0 && right(panes as u32), || replay("panes", panes));
    }
    Ok(())
}

/// A point of the grid that is clearly inside or clearly outside.
fn eye(mesh: &Mesh, random: &mut Random) -> Option<(DVec3, bool)> {
    let reach = if random.below(2) == 0 { 0.9 } else { 3.0 };
    let point = random.inside(DVec3::splat(-reach), DVec3::splat(reach));
    let point = (point / GRID).round() * GRID;
    let winding = mesh.winding(point).abs();
    ((winding - winding.round()).abs() < 1e-6).then_some((point, winding > 0.5))
}

fn through(mesh: &Mesh, eyes: &[(DVec3, bool)], random: &mut Random) -> (ProbeRay, bool) {
    let mut pick = |count| random.below(count);
    let (eye, inside) = eyes[pick(eyes.len())];
    let triangle = mesh.triangles[pick(mesh.triangles.len())];
    let (corner, quarter) = (pick(3), pick(4));
    let (a, b) = (triangle[corner], triangle[(corner + 1) % 3]);
    let target = a + (b - a) * (0.25 * quarter as f64);
    (ray(eye, target - eye), inside)
}
