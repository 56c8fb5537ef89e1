//! Many frames: nothing that one leaves behind changes another.

use std::{
    f64::consts::TAU,
    hash::{DefaultHasher, Hash, Hasher},
};

use glam::{DMat3, DVec3};

use super::{Bench, Case, Outcome, unexposed};
use crate::{Camera, Error, Renderer, Result, scene::builtin};

pub const CASE: Case = Case {
    name: "time",
    construction: "adaptive frames of builtin:cornell, one for each 100 rays (10,000 for the usual million): half of them of \
                   a still camera, half of one that goes around in 100 steps, in turns",
    rule: "every still frame is the first one bit for bit, every moving frame that of the round before; every tenth is \
           finite in linear radiance",
    run,
};

const SIZE: [u32; 2] = [32, 24];
const STEPS: usize = 100;

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let scene = builtin("cornell").ok_or_else(|| Error::scene("builtin:cornell", "expected to be there"))?;
    let still = *scene.camera(None)?;
    let (low, high) = scene.bounds().unwrap_or_default();
    let center = (0.5 * (low + high)).as_dvec3();
    let scene = bench.upload(scene)?;
    let mut renderer = Renderer::new(bench.gpu, &scene, SIZE, &unexposed())?;
    let mut outcome = Outcome::default();
    let frames = bench.rays.div_ceil(100).max(2 * STEPS as u64 + 2) as usize;
    // The first place is the still camera's.
    let mut known: Vec<Option<u64>> = vec![None; STEPS + 1];
    for frame in 0..frames {
        let step = frame / 2 % STEPS;
        let (place, camera) =
            if frame % 2 == 0 { (0, still) } else { (step + 1, around(&still, center, step)) };
        renderer.render(&camera)?;
        let mut hasher = DefaultHasher::new();
        renderer.display_image()?.as_raw().hash(&mut hasher);
        let hash = hasher.finish();
        let same = *known[place].get_or_insert(hash) == hash;
        outcome.check(same, || format!("frame {frame} is not the one that it was at place {place}"));
        outcome.rays += u64::from(SIZE[0] * SIZE[1]) - 1;
        if frame % 10 < 2 {
            let finite = renderer.linear_image(&camera)?.as_raw().iter().all(|c| c.is_finite());
            outcome.check(finite, || format!("frame {frame} at place {place} is not finite"));
        }
    }
    Ok(outcome)
}

/// The camera turned about the vertical axis through the middle.
fn around(camera: &Camera, center: DVec3, step: usize) -> Camera {
    let turn = DMat3::from_rotation_y(TAU * step as f64 / STEPS as f64);
    let axis = |v: glam::Vec3| (turn * v.as_dvec3()).as_vec3();
    Camera {
        origin: (center + turn * (camera.origin.as_dvec3() - center)).as_vec3(),
        right: axis(camera.right),
        up: axis(camera.up),
        forward: axis(camera.forward),
        ..*camera
    }
}
