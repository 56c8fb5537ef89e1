//! Directions with zeros, denormals and every length.

use glam::{DVec3, Vec3};

use super::{
    Bench, Case, Outcome, Random, judge, matte,
    mesh::{Mesh, Objects},
};
use crate::{
    Result,
    probe::{ProbeHit, ProbeRay},
    reference::Tracer,
    scene::Sphere,
};

pub const CASE: Case = Case {
    name: "directions",
    construction: "directions whose components are +-0, denormal, tiny or ordinary, of length 1e-38 to 1e38, along axes and \
                   diagonals, through a sphere of triangles, analytic spheres and planes along the axes; directions and \
                   origins that are zero, infinite or not a number",
    rule: "object as the reference, but for ties; what is no ray meets nothing",
    run,
};

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut random = Random(bench.seed);
    let mut scene =
        Mesh::sphere(3).placed(glam::DMat3::IDENTITY, DVec3::X).scene(matte(), Objects::EachTriangle);
    for axis in 0..3 {
        let mut corner = [DVec3::ZERO; 3];
        for (i, (u, v)) in [(-4.0, -4.0), (-4.0, 8.0), (8.0, -4.0)].into_iter().enumerate() {
            corner[i][axis] = -3.0;
            corner[i][(axis + 1) % 3] = u;
            corner[i][(axis + 2) % 3] = v;
        }
        Mesh { triangles: vec![corner] }.add_to(&mut scene, Objects::One);
        let object = scene.objects.len() as u32;
        scene.objects.push(scene.objects[0].clone());
        let center = Vec3::NEG_ONE + Vec3::AXES[axis];
        scene.spheres.push(Sphere { center, radius: 0.5, object });
    }
    let tracer = Tracer::new(&scene);
    let scene = bench.upload(scene)?;
    let (rays, none): (Vec<_>, Vec<_>) = (0..bench.rays).map(|_| extreme(&mut random)).partition(is_ray);
    let probe = bench.probe(&scene);
    let mut outcome = Outcome::default();
    judge(&mut outcome, &tracer, &rays, &probe.trace(&rays)?.0, || format!("seed {}", bench.seed));
    for (ray, hit) in none.iter().zip(probe.trace(&none)?.0) {
        outcome.check(hit.primitive == ProbeHit::MISS, || {
            format!("seed {}: {ray:?} is no ray, {hit:?}", bench.seed)
        });
    }
    Ok(outcome)
}

fn is_ray(ray: &ProbeRay) -> bool {
    let direction = Vec3::from(ray.direction);
    Vec3::from(ray.origin).is_finite() && direction.is_finite() && direction != Vec3::ZERO
}

fn extreme(random: &mut Random) -> ProbeRay {
    let mut origin = random.inside(DVec3::splat(-2.5), DVec3::splat(2.5)).as_vec3();
    let length = 10_f64.powf(76.0 * random.unit() - 38.0);
    let mut component = || {
        let value = 2.0 * random.unit() - 1.0;
        match random.below(8) {
            0 => 0.0,
            1 => -0.0,
            2 => (value * 1.0e-39) as f32,
            3 => (value * length * 1.0e-20) as f32,
            4 => (value.signum() * length) as f32,
            _ => (value * length) as f32,
        }
    };
    let mut direction = Vec3::new(component(), component(), component());
    if random.below(64) == 0 {
        let wrong = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY][random.below(3)];
        match random.below(2) {
            0 => origin[random.below(3)] = wrong,
            _ => direction[random.below(3)] = wrong,
        }
    }
    if random.below(16) == 0 {
        origin[random.below(3)] = -3.0;
    }
    ProbeRay {
        origin: origin.into(),
        t_max: f32::INFINITY,
        direction: direction.into(),
        ..ProbeRay::default()
    }
}
