//! Tests of the f64 traversal itself.

use glam::{DVec3, Vec3};
use glimpse::{
    Scene,
    reference::{Hit, Ray, Tracer, Verdict},
    stress::Random,
};
use glimpse_tests::builder::{Builder, front_camera, matte};

fn soup(seed: u64) -> Scene {
    let mut random = Random(seed);
    let mut builder = Builder::new();
    let corner = |random: &mut Random| random.inside(DVec3::NEG_ONE, DVec3::ONE).as_vec3();
    for _ in 0..150 {
        let object = builder.object(matte(Vec3::ONE));
        let (at, u, v) = (corner(&mut random), corner(&mut random), corner(&mut random));
        builder.quad(object, at, 0.3 * u, 0.3 * v);
    }
    for _ in 0..50 {
        let object = builder.object(matte(Vec3::ONE));
        builder.sphere(object, corner(&mut random), 0.01 + 0.2 * random.unit() as f32);
    }
    builder.seen_by(front_camera())
}

fn rays(seed: u64, count: usize) -> impl Iterator<Item = Ray> {
    let mut random = Random(seed);
    std::iter::repeat_with(move || Ray {
        origin: random.inside(DVec3::splat(-1.5), DVec3::splat(1.5)),
        direction: random.direction(),
        t_max: f64::INFINITY,
        width: 0.0,
        growth: 0.0,
    })
    .take(count)
}

#[test]
fn the_tree_loses_no_hit() {
    for seed in 0..4 {
        let tracer = Tracer::new(&soup(seed));
        let mut hits = 0;
        for ray in rays(100 + seed, 20_000) {
            let nearest = tracer.nearest(&ray);
            assert_eq!(nearest, tracer.nearest_of_all(&ray), "{ray:?}");
            hits += usize::from(nearest.is_some());
        }
        assert!((2_000..18_000).contains(&hits), "{hits} of 20000 rays hit");
    }
}

#[test]
fn rays_along_the_axes_are_no_exception() {
    let mut builder = Builder::new();
    let object = builder.object(matte(Vec3::ONE));
    for i in -3..3 {
        builder.quad(object, Vec3::new(i as f32, -1.0, 0.0), Vec3::X, 2.0 * Vec3::Y);
    }
    let tracer = Tracer::new(&builder.seen_by(front_camera()));
    let at = |x: f64, y: f64| Ray {
        origin: DVec3::new(x, y, 5.0),
        direction: DVec3::NEG_Z,
        t_max: f64::INFINITY,
        width: 0.0,
        growth: 0.0,
    };
    // On a shared edge, on an outer edge, inside, and beside.
    for (x, y) in [(1.0, 0.0), (0.25, 1.0), (0.25, 0.5)] {
        assert_eq!(tracer.nearest(&at(x, y)), Some(Hit { object: 0, t: 5.0 }), "({x}, {y})");
    }
    assert_eq!(tracer.nearest(&at(0.25, 1.001)), None);
}

#[test]
fn an_empty_scene_is_never_hit() {
    let tracer = Tracer::new(&Scene::default());
    assert!(rays(7, 100).all(|ray| tracer.nearest(&ray).is_none()));
    assert!(rays(7, 100).all(|ray| tracer.judge(&ray, None) == Verdict::Same));
}

/// `judge` accepts the exact answer rounded to f32, and no other.
#[test]
fn the_judge_is_not_to_be_bribed() {
    let tracer = Tracer::new(&soup(11));
    let (mut hits, mut explained) = (0, 0);
    for ray in rays(12, 20_000) {
        let Some(hit) = tracer.nearest(&ray) else {
            assert_eq!(tracer.judge(&ray, None), Verdict::Same);
            let invented = Some(Hit { object: 3, t: 1.0 });
            assert!(matches!(tracer.judge(&ray, invented), Verdict::Wrong(_)));
            continue;
        };
        hits += 1;
        let rounded = Hit { t: f64::from(hit.t as f32), ..hit };
        assert_eq!(tracer.judge(&ray, Some(rounded)), Verdict::Same, "{hit:?}");
        let lies = [
            None,
            Some(Hit { object: (hit.object + 1) % 200, ..hit }),
            Some(Hit { t: hit.t * 1.01 + 1e-2, ..hit }),
            Some(Hit { t: hit.t * 0.99 - 1e-2, ..hit }),
        ];
        // Rays that graze an edge may rarely have two answers.
        explained +=
            lies.iter().filter(|lie| !matches!(tracer.judge(&ray, **lie), Verdict::Wrong(_))).count();
    }
    assert!(hits > 2_000, "{hits}");
    assert!(explained <= hits / 500, "{explained} lies about {hits} hits passed");
}
