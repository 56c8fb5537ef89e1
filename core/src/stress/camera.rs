//! Cameras and frames of extreme shape.

use std::f64::consts::PI;

use glam::{DMat3, DVec3, Mat4, Vec3};

use super::{
    Bench, Case, Outcome, Random,
    mesh::{Mesh, Objects, rotation},
    unexposed,
};
use crate::{
    Camera, Method, Renderer, Result, Settings,
    scene::{Environment, Material},
};

pub const CASE: Case = Case {
    name: "camera",
    construction: "eyes inside a closed white sphere of 1,024 triangles, exactly on its corners and faces, and outside; \
                   fields of view of 1e-4 to 179.99 degrees; frames of 1x1, 1xN, Nx1, 16384x1 and ordinary ones; both methods",
    rule: "finite; from inside no hole",
    run,
};

const DEGREES: [f64; 8] = [1.0e-4, 1.0e-2, 1.0, 45.0, 120.0, 179.0, 179.9, 179.99];

/// The position of the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    Inside,
    OnSurface,
    Outside,
}

fn run(bench: &Bench<'_>) -> Result<Outcome> {
    let mut outcome = Outcome::default();
    let mesh = Mesh::sphere(4).placed(DMat3::IDENTITY, DVec3::splat(0.25));
    let white = Material { base_color: Vec3::ONE, unlit: true, ..Material::default() };
    let mut scene = mesh.scene(white, Objects::One);
    scene.environment = Environment { background: Vec3::ZERO, ..scene.environment };
    let scene = bench.upload(scene)?;
    let sizes = [[1, 1], [1, 64], [64, 1], [7, 1_021], [1_021, 7], [16_384, 1], [1, 16_384], [256, 192]];
    let pixels: u64 = sizes.iter().map(|[w, h]| u64::from(w * h)).sum();
    let frames = bench.rays.div_ceil(2 * pixels).max(3);
    for size in sizes {
        for method in [Method::Full, Method::Adaptive] {
            let settings = Settings { method, ..unexposed() };
            let mut renderer = Renderer::new(bench.gpu, &scene, size, &settings)?;
            for frame in 0..frames {
                let mut random = Random(bench.seed ^ frame << 8);
                let place = [Place::Inside, Place::OnSurface, Place::Outside][(frame % 3) as usize];
                let (camera, degrees) = camera(&mesh, place, &mut random)?;
                let image = renderer.linear_image(&camera)?;
                for (x, y, pixel) in image.enumerate_pixels() {
                    let whole = place != Place::Inside || pixel.0 == [1.0; 3];
                    outcome.check(whole && pixel.0.iter().all(|c| c.is_finite()), || {
                        format!(
                            "{size:?}, {method:?}, {degrees} degrees, {place:?}, seed {}, frame {frame}: ({x}, {y}) is {:?}",
                            bench.seed, pixel.0
                        )
                    });
                }
            }
        }
    }
    Ok(outcome)
}

fn camera(mesh: &Mesh, place: Place, random: &mut Random) -> Result<(Camera, f64)> {
    let degrees = DEGREES[random.below(DEGREES.len())];
    let [a, b, c] = mesh.triangles[random.below(mesh.triangles.len())];
    let center = DVec3::splat(0.25);
    let eye = match (place, random.below(2)) {
        (Place::Inside, _) => center + 0.7 * random.unit() * random.direction(),
        (Place::OnSurface, 0) => a,
        (Place::OnSurface, _) => (a + b + c) / 3.0,
        (Place::Outside, _) => center + (1.2 + 1.0e4 * random.unit()) * random.direction(),
    };
    let matrix = Mat4::from_mat3_translation(rotation(random).as_mat3(), eye.as_vec3());
    Ok((Camera::perspective(&matrix, (degrees * PI / 180.0) as f32)?, degrees))
}
